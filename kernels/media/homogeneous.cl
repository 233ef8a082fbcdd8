// Homogeneous media: extinction, and the distance to the next event.
//
// Colours extinguish at different rates. The distance is drawn for one channel, chosen with
// probability pmf, and weighed by the density of all [balance heuristic over the channels, Veach
// 1997, section 9.2.2.1], so that no channel's weight exceeds 1 / pmf.
#pragma once

#include "sampling/exponential.cl"
#include "sampling/sobol.cl"
#include "sampling/vector.cl"
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
    float distance;  // to the event
    int stops;       // it is a scattering, else the end of the segment
    Vec3 weight;     // of the event, sigma_s or 1 times exp(-tau), over its density
} MediumEvent;

// Stops after an exponential distance, or passes with what the exponential leaves: pdf_t = sum of
// pmf sigma_t exp(-sigma_t t), chance to pass = sum of pmf exp(-sigma_t length). A medium that does
// not scatter is passed for certain.
INLINE MediumEvent sample_exponential(
    global const DeviceMedium* medium, const float length, const Vec3 pmf, const Sample2 u) {
    const Vec3 sigma_t = extinction(medium);
    const Vec3 sigma_s = scattering_of(medium);
    const int scatters = max_component3(sigma_s) > 0.0f;
    const float rate = choose_channel(pmf, sigma_t, u.u);
    const float drawn = minus_log(1.0f - u.v) / rate;  // rate 0: infinite, or NaN for u.v = 0
    MediumEvent event;
    event.stops = scatters & (drawn < length);
    event.distance = event.stops ? drawn : length;
    const Vec3 left = transmittance(scale3(sigma_t, event.distance));
    const Vec3 one = vec3(1.0f, 1.0f, 1.0f);
    const float drawn_density = dot3(pmf, mul3(select3(event.stops, sigma_t, one), left));
    const float density = scatters ? drawn_density : 1.0f;
    event.weight = scale3(mul3(select3(event.stops, sigma_s, one), left), 1.0f / density);
    return event;
}
