// Chooses a point on a light for every path at a surface, or at a stop in a medium, and leaves the
// connection to `occlusion` or `connect_through_media` (notes 5, directRadianceEstimator, with the
// f_r that the notes leave out; notes 6).
//
// reads: rays, hits, surfaces, throughputs, ids, path_media, triangles, materials, lights,
// environment, media, textures (emission)
//
// writes: shadows
//
// One work-item a slot.

#include "geometry/interaction.cl"
#include "geometry/path_state.cl"
#include "geometry/surface_texture.cl"
#include "lights/area_light.cl"
#include "lights/environment.cl"
#include "lights/guide.cl"
#include "lights/punctual.cl"
#include "materials/dielectric.cl"
#include "media/medium_stack.cl"
#include "media/phase.cl"
#include "sampling/dimensions.cl"

kernel void direct_light(
    constant const RenderParams* restrict settings,
    const uint slots,
    global const float* restrict triangles,
    global const DeviceMaterial* restrict materials,
    global const DeviceLight* restrict lights,
    global const EnvironmentEntry* restrict environment,
    global const DeviceMedium* restrict media,
    TEXTURE_PARAMETERS,
    global const float* restrict rays,
    global const float* restrict hits,
    global const float* restrict surfaces,
    global const float* restrict throughputs,
    global const uint* restrict ids,
    global const float* restrict path_media,
    global float* restrict shadows) {
    const RenderParams params = *settings;
    const size_t stride = params.stride;
    const size_t slot = get_global_id(0);
    if (slot >= slots) return;
    const int primitive = hit_of(hits, stride, slot);
    PLANE(shadows, SHADOW_T_MAX)[slot] = 0.0f;
    const int in_medium = ((HAS_MEDIA & MEDIA_SCATTER) != 0) & (primitive == HIT_MEDIUM);
    if (!at_surface(primitive) && !in_medium) return;
    if (is_resumed(hits, stride, slot)) return;
    const Vec3 direction = load3(PLANE(rays, RAY_DIRECTION_X), stride, slot);
    const uint stack = HAS_MEDIA ? as_uint(PLANE(path_media, MEDIUM_STACK)[slot]) : 0;
    // a dielectric boundary shows lights on either side if it is rough, and none if it is smooth
    int refracts = 0;
    uint crossed = stack;
    float alpha = 1.0f;
    float ior_i = 1.0f;
    float ior_t = 1.0f;
    float weight_behind = 1.0f;
    if (HAS_DIELECTRICS) {
        global const DeviceMaterial* material =
            materials + as_int(PLANE(surfaces, SURFACE_MATERIAL)[slot]);
        refracts = !in_medium & (material->boundary == BOUNDARY_DIELECTRIC);
        if (refracts) {
            crossed = HAS_CONTACTS ? as_uint(PLANE(path_media, CONTACT_MEDIA)[slot])
                                   : cross_boundary(
                                         stack, material->medium,
                                         triangles + TRIANGLE_FLOATS * primitive, direction);
            weight_behind =
                HAS_CONTACTS ? 1.0f : weight_of_crossing(stack, crossed, material->medium);
            alpha = HAS_LOBE_TEXTURES ? PLANE(surfaces, SURFACE_ALPHA)[slot] : material->alpha;
            ior_i = refractive_index(media, stack);
            ior_t = refractive_index(media, crossed);
            if (!ROUGH_DIELECTRICS) return;
            if (!dielectric_is_rough(alpha, ior_i, ior_t)) return;
        }
    }
    const Vec3 p = load3(PLANE(surfaces, SURFACE_X), stride, slot);
    const Vec3 ng = load3(PLANE(surfaces, SURFACE_NG_X), stride, slot);
    Vec3 n = load_shading_normal(surfaces, stride, slot);
    const Surface surface = load_surface(materials, surfaces, stride, slot);

    const int is_wall = HAS_TRANSMISSION && !in_medium && surface.transmission > 0.0f;
    if (HAS_MEDIA & HAS_CONTACTS & is_wall)
        crossed = as_uint(PLANE(path_media, CONTACT_MEDIA)[slot]);

    // the light and the point
    const uint seed = PLANE(ids, ID_SEED)[slot];
    const uint index = PLANE(ids, ID_INDEX)[slot];
    const uint scattering = PLANE(ids, ID_SCATTERING)[slot];
    const uint branch = HAS_SPLITS ? PLANE(ids, ID_BRANCH)[slot] : 0;
    const Bits2 choice = scattering_pair(seed, index, branch, scattering, PAIR_CHOICE);
    const Bits2 point = scattering_pair(seed, index, branch, scattering, PAIR_LIGHT_POINT);
    global const DeviceLight* light =
        lights + (int)choose_light(lights, params.light_count, choice.u);
    LightSample s;
    s.p = p;
    s.wi = n;
    s.radiance = vec3(0.0f, 0.0f, 0.0f);
    s.pdf_w = PDF_CERTAIN;
    if (HAS_PUNCTUAL_LIGHTS) s = punctual_sample(light, p);
    if (HAS_AREA_LIGHTS) {
        LightSample area = area_light_sample(triangles, light, p, unit_pair(point));
        const int is_area = light->kind == LIGHT_TRIANGLE;
        if ((HAS_EMISSION_TEXTURES || HAS_ALPHA) && is_area) {
            global const float* triangle = triangles + (size_t)TRIANGLE_FLOATS * light->primitive;
            if (HAS_EMISSION_TEXTURES)
                area.radiance = mul3(
                    area.radiance, emission_on_triangle(TEXTURES, triangle, area.at.u, area.at.v));
            if (HAS_ALPHA)
                area.radiance =
                    scale3(area.radiance, cover_of(TEXTURES, triangle, area.at.u, area.at.v));
        }
        s.p = select3(is_area, area.p, s.p);
        s.wi = select3(is_area, area.wi, s.wi);
        s.radiance = select3(is_area, area.radiance, s.radiance);
        s.pdf_w = is_area ? area.pdf_w : s.pdf_w;
    }
    if (HAS_ENVIRONMENT) {
        const int is_environment = light->kind == LIGHT_ENVIRONMENT;
        const EnvironmentSample sky = environment_sample(environment, &params, point);
        const float pdf_w = light->pmf * sky.pdf_w;
        const Vec3 radiance = scale3(sky.radiance, pdf_w > 0.0f ? 1.0f / pdf_w : 0.0f);
        s.p = select3(is_environment, madd3(p, sky.wi, OUTSIDE_SCENE), s.p);
        s.wi = select3(is_environment, sky.wi, s.wi);
        s.radiance = select3(is_environment, radiance, s.radiance);
        s.pdf_w = is_environment ? pdf_w : s.pdf_w;
    }

    // what it brings: throughput * f_r cos * L_e / pdf_w, weighted against the bsdf's chance to
    // find it
    const Vec3 viewer = scale3(direction, -1.0f);
    if (ROUGH_DIELECTRICS && HAS_SHADING_NORMALS) {
        const Vec3 bent = interface_normal(n, ng, viewer, ior_i, ior_t, scattering);
        n = select3(refracts, bent, n);
    }
    const Frame frame = frame_around(n);
    const Vec3 wo = to_local(frame, viewer);
    Vec3 value = mul3(load3(PLANE(throughputs, THROUGHPUT_R), stride, slot), s.radiance);
    const Scattered scattered = scatter_towards(surface, frame, ng, wo, s.wi);
    Vec3 f = scattered.value;
    float pdf_w = scattered.pdf_w;
    // of the surface, that the connection leaves on
    float side = HAS_TRANSMISSION && dot3(ng, s.wi) < 0.0f ? -1.0f : 1.0f;
    Guide aimed;
    if (HAS_GUIDE) {
        aimed = guide_at(&params, p, scattering);
        const Guide guide = guide_over(aimed, ng, gltf_diffuse_share(surface, wo), surface.base);
        pdf_w = guided_pdf_w(guide, 0, s.wi, pdf_w);
    }
    if (HAS_MEDIA && MEDIA_SCATTER) {
        const float g = media[(int)max(innermost_medium(stack), 1u) - 1].anisotropy;
        const float phase = phase_eval(g, direction, s.wi);
        f = select3(in_medium, vec3(phase, phase, phase), f);
        float phase_pdf = phase_pdf_w(phase);
        if (HAS_GUIDE) phase_pdf = guided_pdf_w(aimed, 0, s.wi, phase_pdf);
        pdf_w = in_medium ? phase_pdf : pdf_w;
    }
    if (ROUGH_DIELECTRICS) {
        const DielectricValue v = dielectric_towards(frame, ng, wo, s.wi, alpha, ior_i, ior_t);
        const int beyond = dot3(ng, s.wi) < 0.0f;
        const Vec3 tint =
            select3(beyond, scale3(surface.base, weight_behind), vec3(1.0f, 1.0f, 1.0f));
        f = select3(refracts, scale3(tint, v.value), f);
        pdf_w = refracts ? v.pdf_w : pdf_w;
        side = refracts ? (beyond ? -1.0f : 1.0f) : side;
    }
    if (HAS_MEDIA & HAS_CONTACTS & (refracts | is_wall) & (side < 0.0f))
        f = mul3(f, load3(PLANE(path_media, CONTACT_R), stride, slot));
    value = mul3(value, f);
    if (WEIGH_BOTH) {
        // a sky below the horizon has no density and no radiance either
        const float weight = power_heuristic(max(s.pdf_w, FLT_MIN), pdf_w);
        value = scale3(value, s.pdf_w == PDF_CERTAIN ? 1.0f : weight);
    }
    // NaN passes every test, to be found and counted.
    // A product of steps: a chain of && becomes a vector of its own, and the kernel would stay
    // scalar on PoCL.
    float t_max = scattering < params.max_scatterings ? 1.0f : 0.0f;
    t_max *= (!in_medium & (side * dot3(ng, s.wi) <= 0.0f)) ? 0.0f : 1.0f;
    t_max *= value.x + value.y + value.z <= 0.0f ? 0.0f : 1.0f;
    const Vec3 origin = select3(in_medium, p, leave(p, scale3(ng, side)));
    const Vec3 to_light = sub3(s.p, origin);
    if ((TINTED_BOUNDARIES || LAMPS_ON_LAMPS) && HAS_AREA_LIGHTS) {
        const float offset = max(ray_offset(origin), ray_offset(s.p));
        const float reach = 1.0f + offset / LEAST_COSINE / sqrt(dot3(to_light, to_light));
        const int to_triangle = (t_max > 0.0f) & (light->kind == LIGHT_TRIANGLE);
        t_max = to_triangle ? reach : t_max;
    }
    store3(PLANE(shadows, SHADOW_ORIGIN_X), stride, slot, origin);
    store3(PLANE(shadows, SHADOW_DIRECTION_X), stride, slot, to_light);
    PLANE(shadows, SHADOW_T_MAX)[slot] = t_max;
    store3(PLANE(shadows, SHADOW_R), stride, slot, value);
    if (LAMPS_ON_LAMPS) PLANE(shadows, SHADOW_LAMP)
    [slot] = as_float(light->kind == LIGHT_TRIANGLE ? (int)light->primitive : -1);
    if (HAS_MEDIA) PLANE(shadows, SHADOW_MEDIA)[slot] = as_float(side < 0.0f ? crossed : stack);
}
