// Homogeneous media: extinction, and where on a segment a path stops.
//
// Colours extinguish at different rates. An exponential distance is drawn for one channel, chosen
// with probability pmf, and weighed by the density of all [balance heuristic over the channels,
// Veach 1997, section 9.2.2.1], so that no channel's weight exceeds 1 / pmf.
#pragma once

#include "sampling/exponential.cl"
#include "sampling/sobol.cl"
#include "sampling/vector.cl"
#include "sampling/warp.cl"
#include "shared/features.h"
#include "shared/inline.h"
#include "shared/scene.h"

INLINE Vec3 extinction(global const DeviceMedium* medium) {
    return vec3(medium->sigma_t_r, medium->sigma_t_g, medium->sigma_t_b);
}

INLINE Vec3 scattering_of(global const DeviceMedium* medium) {
    return vec3(medium->sigma_s_r, medium->sigma_s_g, medium->sigma_s_b);
}

// exp(-tau) by channel.
INLINE Vec3 transmittance(const Vec3 tau) {
    return vec3(exp_minus(tau.x), exp_minus(tau.y), exp_minus(tau.z));
}

// 1 - exp(-tau) by channel, all its digits.
INLINE Vec3 absorptance(const Vec3 tau) {
    return vec3(
        tau.x * mean_of_exp_minus(tau.x), tau.y * mean_of_exp_minus(tau.y),
        tau.z * mean_of_exp_minus(tau.z));
}

// Chances of the three channels: what the path carries in each.
INLINE Vec3 channel_pmf(const Vec3 throughput) {
    const float sum = throughput.x + throughput.y + throughput.z;
    const float third = 1.0f / 3.0f;
    return select3(sum > 0.0f, scale3(throughput, 1.0f / sum), vec3(third, third, third));
}

INLINE float choose_channel(const Vec3 pmf, const Vec3 values, const float u) {
    const float first_two = u < pmf.x ? values.x : values.y;
    return u < pmf.x + pmf.y ? first_two : values.z;
}

typedef struct {
    float distance;  // to the event, from the segment's start
    int stops;       // it is a scattering, else the end of the segment
    Vec3 weight;     // of the event, sigma_s or 1 times exp(-tau), over its density
} MediumEvent;

// Stops after an exponential distance, or passes with what the exponential leaves: pdf_t = sum of
// pmf sigma_t exp(-sigma_t t), chance to pass = sum of pmf exp(-sigma_t length).
INLINE MediumEvent sample_exponential(
    global const DeviceMedium* medium, const float length, const Vec3 pmf, const Sample2 u) {
    const Vec3 sigma_t = extinction(medium);
    const float rate = choose_channel(pmf, sigma_t, u.u);
    const float drawn = minus_log(1.0f - u.v) / rate;  // rate 0: infinite, or NaN for u.v = 0
    MediumEvent event;
    event.stops = drawn < length;
    event.distance = event.stops ? drawn : length;
    const Vec3 left = transmittance(scale3(sigma_t, event.distance));
    const Vec3 one = vec3(1.0f, 1.0f, 1.0f);
    const float density = dot3(pmf, mul3(select3(event.stops, sigma_t, one), left));
    event.weight =
        scale3(mul3(select3(event.stops, scattering_of(medium), one), left), 1.0f / density);
    return event;
}

// How a segment looks from a point that equiangular distances are drawn about [Kulla & Fajardo
// 2012]: they are uniform in the angle at the point.
typedef struct {
    float start;   // of the segment, from where the ray passes the point; below 0: before it
    float height;  // the point's distance from the ray
    float angle;   // that the segment subtends [turns]; below 0: there is no such point
} View;

INLINE View no_view(void) {
    View view;
    view.start = 0.0f;
    view.height = 1.0f;
    view.angle = -1.0f;
    return view;
}

// `to_point` leads from the segment's start to the point; `direction` is unit. A point on the ray
// counts as one a little off it.
INLINE View view_from(const Vec3 to_point, const Vec3 direction, const float length) {
    View view;
    view.start = -dot3(to_point, direction);
    const Vec3 across = madd3(to_point, direction, view.start);
    view.height = max(sqrt(dot3(across, across)), 0x1p-20f);
    view.angle = atan2_turns(
        view.height * length, fma(view.start, view.start + length, view.height * view.height));
    return view;
}

// The distance at which the share u of the angle is swept; without cancellation.
INLINE float equiangular_distance(const View view, const float u) {
    const SineCosine swept = sincos_2pi(max(view.angle, 0.0f) * u);
    return fma(view.start, view.start, view.height * view.height) * swept.sine /
           fma(view.height, swept.cosine, -view.start * swept.sine);
}

INLINE float equiangular_pdf_t(const View view, const float distance) {
    const float along = view.start + distance;
    return view.height / (2.0f * PI_F * view.angle * fma(along, along, view.height * view.height));
}

// Stops on the segment for certain. `swept`: absorptance(sigma_t length). pdf_t:
// - uniform (notes 6): 1 / length;
// - truncated: sum of pmf sigma_t exp(-sigma_t t) / sum of pmf (1 - exp(-sigma_t length));
// - equiangular: height / (angle (height^2 + along^2)), or truncated without a point to look from;
// - mis: one of the last two, half the time each, weighed by the mean of both densities.
// Weight: sigma_s exp(-sigma_t t) / pdf_t.
INLINE MediumEvent sample_stop(
    global const DeviceMedium* medium,
    const float length,
    const Vec3 swept,
    const Vec3 pmf,
    const View view,
    const Sample2 u) {
    const Vec3 sigma_t = extinction(medium);
    const float reached = dot3(pmf, swept);
    const int has_view = view.angle > 0.0f;
    const int first_half = u.u < 0.5f;
    const float halved = first_half ? 2.0f * u.u : fma(2.0f, u.u, -1.0f);
    const int by_angle = DISTANCES == DISTANCE_EQUIANGULAR ? has_view : has_view & first_half;
    // exponentials are drawn for the channels in proportion to how often they would stop; media
    // that stop none of the path's channels weigh nothing, wherever they are stopped in
    const Vec3 stopping = scale3(mul3(pmf, swept), 1.0f / reached);
    const float pick = DISTANCES == DISTANCE_MIS ? halved : u.u;
    const float truncated = minus_log_1_minus(u.v * choose_channel(stopping, swept, pick)) /
                            choose_channel(stopping, sigma_t, pick);
    float drawn = reached > 0.0f ? truncated : u.v * length;
    if (DISTANCES == DISTANCE_UNIFORM) drawn = u.v * length;
    if (DISTANCES >= DISTANCE_EQUIANGULAR)
        drawn = by_angle ? equiangular_distance(view, u.v) : drawn;
    MediumEvent event;
    event.stops = 1;
    event.distance = clamp(drawn, 0.0f, length);
    const Vec3 left = transmittance(scale3(sigma_t, event.distance));
    float pdf_t = reached > 0.0f ? dot3(pmf, mul3(sigma_t, left)) / reached : 1.0f / length;
    if (DISTANCES == DISTANCE_UNIFORM) pdf_t = 1.0f / length;
    if (DISTANCES >= DISTANCE_EQUIANGULAR) {
        const float by_view = equiangular_pdf_t(view, event.distance);
        const float both = DISTANCES == DISTANCE_MIS ? 0.5f * (pdf_t + by_view) : by_view;
        pdf_t = has_view ? both : pdf_t;
    }
    event.weight = scale3(mul3(scattering_of(medium), left), 1.0f / pdf_t);
    return event;
}

// Passes with the chance that an exponential distance would, else stops as sample_stop does.
INLINE MediumEvent sample_stop_or_pass(
    global const DeviceMedium* medium,
    const float length,
    const Vec3 pmf,
    const View view,
    const Sample2 u) {
    const Vec3 tau = scale3(extinction(medium), length);
    const Vec3 swept = absorptance(tau);
    const float stopping = dot3(pmf, swept);
    Sample2 rest = u;
    rest.v = min(u.v / stopping, 0x1.fffffep-1f);
    MediumEvent event = sample_stop(medium, length, swept, pmf, view, rest);
    event.stops = u.v < stopping;
    const Vec3 left = transmittance(tau);
    const float passing = dot3(pmf, left);  // 0: rounding alone lets it pass
    event.weight = select3(
        event.stops, scale3(event.weight, 1.0f / stopping),
        scale3(left, passing > 0.0f ? 1.0f / passing : 0.0f));
    return event;
}
