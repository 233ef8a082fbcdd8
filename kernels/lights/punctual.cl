// KHR_lights_punctual: point, spot and directional lights. Only light sampling can find them.
#pragma once

#include "lights/area_light.cl"
#include "shared/inline.h"

// [normalised] farther than the scene is wide, seen from any surface
#define OUTSIDE_SCENE (HAS_FAR_GEOMETRY ? 0x1p40f : 4.0f)

INLINE LightSample punctual_sample(global const DeviceLight* light, const Vec3 from) {
    const Vec3 intensity = vec3(light->intensity_r, light->intensity_g, light->intensity_b);
    const Vec3 shines = vec3(light->direction_x, light->direction_y, light->direction_z);
    const Vec3 to_light = sub3(vec3(light->position_x, light->position_y, light->position_z), from);
    const float distance2 = dot3(to_light, to_light);
    const float distance = sqrt(distance2);
    const int directional = light->kind == LIGHT_DIRECTIONAL;

    LightSample s;
    s.pdf_w = PDF_CERTAIN;
    s.wi = select3(directional, scale3(shines, -1.0f), scale3(to_light, 1.0f / distance));
    s.p = madd3(from, s.wi, directional ? OUTSIDE_SCENE : distance);

    // angular falloff of a spot, and the window that ends a range (both as the extension
    // recommends). 1 - cos, half the square of the chord, keeps the digits of narrow cones.
    const Vec3 chord = add3(s.wi, shines);
    const float cone =
        clamp(fma(-0.5f, dot3(chord, chord), light->spot_outer) * light->spot_scale, 0.0f, 1.0f);
    const float reach = light->range > 0.0f ? distance / light->range : 0.0f;
    const float reach4 = reach * reach * reach * reach;
    const float window = clamp(1.0f - reach4, 0.0f, 1.0f);
    const float falloff =
        directional ? 1.0f : (distance2 > 0.0f ? cone * cone * window / distance2 : 0.0f);
    s.radiance = scale3(intensity, falloff / light->pmf);
    return s;
}
