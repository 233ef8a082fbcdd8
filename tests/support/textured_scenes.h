// Plates and balls for tests of what textures do to them.
#pragma once

#include "gltf/tangents.h"
#include "support/images.h"
#include "support/rendering.h"

#include <random>

namespace wavepath {

inline constexpr double full_view = 2;  // of the plate below

// A plate of 2 x 2 in the plane z = `z` whose picture stands upright seen from +z.
inline Primitive& add_plate(Scene& scene, const Material& material, double z = 0) {
    Primitive& plate = add_quad(scene, material, {-1, -1, z}, {2, 0, 0}, {0, 2, 0});
    plate.uvs[0] = {0, 1, 1, 1, 1, 0, 0, 0};
    return plate;
}

inline Camera above(double side) {
    return orthographic({0, 0, 3}, {0, 0, 0}, side);
}

inline RenderSettings depth_limited(
    const Camera& camera, uint32_t size, uint64_t samples, uint32_t depth) {
    RenderSettings settings = square_settings("mis", camera, size, samples);
    settings.termination = {TerminationKind::depth, depth, 1};
    return settings;
}

// A black plate with holes before a sky of radiance 1 shows the share of its holes.
inline Scene screen(AlphaMode mode, const std::vector<uint8_t>& alphas, uint32_t width) {
    Scene scene = scene_named("screen");
    Material material = lambert(grey(0));
    material.alpha_mode = mode;
    material.alpha_cutoff = 0.5F;
    add_plate(scene, material);
    std::vector<uint8_t> rgba;
    for (const uint8_t a : alphas) rgba.insert(rgba.end(), {255, 255, 255, a});
    add_texture(
        scene, scene.materials[0], TEXTURE_BASE_COLOR,
        image_of(width, static_cast<uint32_t>(alphas.size()) / width, rgba))
        .nearest = true;
    scene.environment = constant_environment(1);
    return scene;
}

inline std::vector<uint8_t> random_mask(std::size_t texels, std::size_t& holes) {
    std::mt19937 random(5);
    std::vector<uint8_t> alphas(texels);
    holes = 0;
    for (uint8_t& a : alphas) {
        a = random() % 3 == 0 ? 127 : 128;  // just below the cutoff and just above
        holes += a < 128 ? 1 : 0;
    }
    return alphas;
}

// A smooth sphere with a normal map whose texels are `codes` over its longitudes and latitudes.
inline Scene bumpy_sphere(const Material& material, TextureImage image) {
    Scene scene = scene_named("bumpy sphere");
    Primitive& sphere = add_icosphere(scene, material, {0, 0, 0}, 1, 3);
    sphere.normals = sphere.positions;
    for (std::size_t i = 0; i < sphere.positions.size(); i += 3) {
        const float* p = &sphere.positions[i];
        sphere.uvs[0].push_back(2 * p[0] + p[2]);
        sphere.uvs[0].push_back(2 * p[1] - p[2]);
    }
    add_texture(scene, scene.materials[0], TEXTURE_NORMAL, std::move(image));
    sphere.tangents = derive_tangents(sphere, sphere.uvs[0]);
    scene.environment = constant_environment(1);
    return scene;
}

inline TextureImage steep_bumps() {
    std::mt19937 random(11);
    std::vector<uint8_t> rgba;
    for (int i = 0; i < 64; ++i)
        rgba.insert(
            rgba.end(), {static_cast<uint8_t>(random() % 256), static_cast<uint8_t>(random() % 256),
                         static_cast<uint8_t>(140 + random() % 116), 255});
    return image_of(8, 8, rgba);
}

}  // namespace wavepath
