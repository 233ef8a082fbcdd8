// Directions towards the surroundings of the lamps. What lies close to a lamp is far brighter than
// all else and fills a small angle, so that bsdf and phase function find it rarely and every find
// is a bright dot. A share of the directions is therefore drawn uniformly from the cone round a
// sphere about the lamps (prepare/light_guide.cpp), and all are weighed by the density of the
// mixture: a defensive mixture [Hesterberg 1995], whose weights exceed those of the bsdf alone by
// 1 / (1 - share) at most.
#pragma once

#include "sampling/warp.cl"
#include "shared/features.h"
#include "shared/inline.h"
#include "shared/params.h"
#include "shared/path.h"

// Within a tenth of the best efficiency on closelight and fog; .1 to .2 alike, .4 worse.
#define GUIDE_SHARE 0.2f

// The weights 1 / (1 - share) of what is scattered past the cone multiply along a path. Where next
// to nothing is absorbed they would make rare samples of any size, so that a picture of a white
// room came out at half its brightness: surfaces therefore have a share of at most what they
// absorb, which keeps the second moment of a scattering at 1, and scatterings beyond these none.
// What they gain is not measurable beyond the eighth on closelight and fog.
#define GUIDE_SCATTERINGS 8

typedef struct {
    Vec3 axis;            // of the cone, unit
    float one_minus_cos;  // of its half angle: keeps the digits of narrow cones
    float share;          // of the directions that are drawn from it, [0, 1)
} Guide;

// As seen from p, after so many scatterings. Close to the sphere and inside there is no cone: the
// share is 0.
INLINE Guide guide_at(const RenderParams* params, const Vec3 p, const uint scattering) {
    Guide g;
    const Vec3 to = sub3(vec3(params->guide_x, params->guide_y, params->guide_z), p);
    const float distance2 = dot3(to, to);
    const float sine2 = min(params->guide_radius2 / distance2, 0.9f);
    g.axis = scale3(to, 1.0f / sqrt(distance2));
    g.one_minus_cos = sine2 / (1.0f + sqrt(1.0f - sine2));
    const int aims = (scattering < GUIDE_SCATTERINGS) & (sine2 < 0.9f);
    g.share = aims ? GUIDE_SHARE : 0.0f;
    return g;
}

// Of a surface of this base colour, `diffuse` of whose samples are not specular: none where the
// cone is below it.
INLINE Guide guide_over(const Guide guide, const Vec3 ng, const float diffuse, const Vec3 base) {
    Guide g = guide;
    const float sine2 = g.one_minus_cos * (2.0f - g.one_minus_cos);
    const float height = dot3(ng, g.axis);
    const int below = height < 0.0f ? height * height >= sine2 : 0;
    const float absorbed = 1.0f - max_component3(base);
    g.share = below ? 0.0f : min(g.share, absorbed) * diffuse;
    return g;
}

// pdf_w [1/sr] of a direction that bsdf or phase function would draw with pdf_w. `guided`: it was
// drawn from the cone, and so lies in it, whatever rounding says at the rim.
INLINE float guided_pdf_w(const Guide g, const int guided, const Vec3 wi, const float pdf_w) {
    const Vec3 step = sub3(wi, g.axis);
    const int inside = guided | (0.5f * dot3(step, step) <= g.one_minus_cos);
    const float cone = inside ? 0.5f * INV_PI_F / g.one_minus_cos : 0.0f;
    return fma(g.share, cone, (1.0f - g.share) * pdf_w);
}

// Whether the sample is drawn from the cone; u.u becomes a fresh number.
INLINE int choose_guided(const Guide g, Sample2* u) {
    const int guided = u->u < g.share;
    u->u = guided ? u->u / g.share : (u->u - g.share) / (1.0f - g.share);
    return guided;
}

INLINE Vec3 guide_sample(const Guide g, const Sample2 u) {
    const float d = u.u * g.one_minus_cos;
    const float sine = sqrt(d * (2.0f - d));
    const SineCosine phi = sincos_2pi(u.v);
    return to_world(frame_around(g.axis), vec3(sine * phi.cosine, sine * phi.sine, 1.0f - d));
}

// What roulette multiplies the throughput by: a direction that the guide favours carries little
// because it is drawn often, and is worth following all the same.
INLINE float guide_worth(const float guided_pdf_w, const float pdf_w) {
    return pdf_w > 0.0f ? max(1.0f, guided_pdf_w / pdf_w) : 1.0f;
}
