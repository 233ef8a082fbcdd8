// Tests src/scene/corner_normals.cpp: vertex normals whatever their signs, and what follows from
// them.
#include "scene/corner_normals.h"

#include "gltf/gltf_loader.h"
#include "gltf/tangents.h"
#include "prepare/normalise.h"
#include "scene/transform.h"
#include "support/case_files.h"
#include "support/rendering.h"
#include "support/textured_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace wavepath {
namespace {

// A ball whose vertices have their own directions as normals.
Scene ball(const Material& material) {
    Scene scene = scene_named("ball");
    Primitive& primitive = add_icosphere(scene, material, {0, 0, 0}, 1, 2);
    for (std::size_t v = 0; v < primitive.positions.size() / 3; ++v)
        for (const double x : normalized(vec3_at(primitive.positions, v)))
            primitive.normals.push_back(static_cast<float>(x));
    return scene;
}

void turn_normal(Primitive& primitive, std::size_t vertex) {
    for (std::size_t k = 0; k < 3; ++k) primitive.normals[3 * vertex + k] *= -1;
}

// Some vertices have their normals turned, some triangles their winding: vertices are shared by
// triangles of either kind.
void mix_up(Primitive& primitive, unsigned seed) {
    std::mt19937 random(seed);
    for (std::size_t v = 0; v < primitive.normals.size() / 3; ++v)
        if (random() % 2 == 0) turn_normal(primitive, v);
    for (std::size_t i = 0; i < primitive.indices.size(); i += 3)
        if (random() % 2 == 0) std::swap(primitive.indices[i + 1], primitive.indices[i + 2]);
}

TEST(CornerNormals, FollowTheWindingOfEachTriangle) {
    const Matrix4 placements[] = {
        identity_matrix, compose({1, 2, 3}, {0, 0, 0, 1}, {-1, 1, 1}),
        compose({0, 0, 0}, {0.5, 0.5, 0.5, 0.5}, {2, 2, -2})};
    for (const Matrix4& placement : placements)
        for (const unsigned seed : {1U, 2U, 3U}) {
            Scene scene = ball(lambert(grey(0.5F)));
            mix_up(scene.primitives[0], seed);
            scene.instances[0].to_world = placement;
            const NormalisedScene out = normalise(scene);
            ASSERT_EQ(out.normals.size(), out.positions.size());
            for (std::size_t t = 0; t < out.triangle_count(); ++t) {
                const Vec3d a = vec3_at(out.positions, 3 * t);
                const Vec3d face = normalized(cross(
                    minus(vec3_at(out.positions, 3 * t + 1), a),
                    minus(vec3_at(out.positions, 3 * t + 2), a)));
                for (std::size_t c = 3 * t; c < 3 * t + 3; ++c) {
                    const Vec3d normal = vec3_at(out.normals, c);
                    EXPECT_GT(dot(normal, face), 0.9);
                    // the ball is centred: its normals are its positions
                    EXPECT_NEAR(
                        std::abs(dot(normal, normalized(vec3_at(out.positions, c)))), 1, 1e-6);
                }
            }
        }
}

TEST(CornerNormals, LeaveAloneWhatAgreesWithItsNeighbours) {
    Primitive primitive;
    primitive.positions = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    primitive.indices = {0, 1, 2};
    const auto kept = [&](const std::vector<float>& normals) {
        primitive.normals = normals;
        const std::array<Vec3d, 3> corners = corner_normals(primitive, 0);
        for (std::size_t c = 0; c < 3; ++c)
            if (corners[c] != vec3_at(normals, c)) return false;
        return true;
    };
    EXPECT_TRUE(kept({0, 0, 1, 0, 0, 1, 0, 0, 1}));
    EXPECT_TRUE(kept({0.8F, 0, 0.6F, -0.8F, 0, 0.6F, 0, 0, 1}));
    // over the edge of a thin plate, on the side of the two others
    EXPECT_TRUE(kept({0.6F, 0, 0.8F, 0.6F, 0, 0.8F, 0.995F, 0, -0.1F}));
    EXPECT_TRUE(kept({0, 0, 1, 0, 0, 1, -0.97F, 0, -0.24F}));
    EXPECT_FALSE(kept({0.6F, 0, 0.8F, 0.6F, 0, 0.8F, -0.95F, 0, -0.3F}));
    EXPECT_FALSE(kept({0, 0, 1, 0, 0, -1, 0, 0, 1}));
    EXPECT_FALSE(kept({0, 0, -1, 0, 0, -1, 0, 0, -1}));
    // a triangle without an area has no side
    primitive.positions = {0, 0, 0, 1, 0, 0, 2, 0, 0};
    EXPECT_TRUE(kept({0, 0, 1, 0, 0, -1, 0, 1, 0}));
}

// Normals of a tetrahedron's corners are 70 degrees from its faces.
TEST(CornerNormals, AreTurnedWhereAllAreBehind) {
    Primitive primitive;
    primitive.positions = {1, 1, 1, 1, -1, -1, -1, 1, -1};
    primitive.indices = {0, 1, 2};
    for (const float sign : {1.0F, -1.0F}) {
        primitive.normals.clear();
        for (const float x : primitive.positions) primitive.normals.push_back(sign * x);
        EXPECT_GT(dot(corner_normals(primitive, 0)[0], {1, 1, 1}), 0);
    }
}

TEST(CornerNormals, DoNotSplitTangents) {
    Scene scene = ball(lambert(grey(0.5F)));
    Primitive& primitive = scene.primitives[0];
    for (std::size_t v = 0; v < primitive.positions.size() / 3; ++v)
        for (const std::size_t k : {0, 1})
            primitive.uvs[0].push_back(primitive.positions[3 * v + k]);
    const std::vector<float> right = derive_tangents(primitive, primitive.uvs[0]);
    for (std::size_t v = 0; v < primitive.normals.size() / 3; v += 2) turn_normal(primitive, v);
    EXPECT_EQ(derive_tangents(primitive, primitive.uvs[0]), right);
}

// With a normal map and given tangents: the map's sides, and the picture, stay.
TEST(CornerNormals, WithoutSignsGiveTheSamePicture) {
    const auto picture = [](bool mixed) {
        Scene scene = bumpy_sphere(metal(grey(0.8F), 0.3F), steep_bumps());
        Primitive& primitive = scene.primitives[0];
        for (std::size_t v = 0; mixed && v < primitive.normals.size() / 3; ++v)
            if (v % 3 != 0) turn_normal(primitive, v);
        scene.environment.reset();
        PunctualLight light;
        light.kind = LightKind::directional;
        light.direction = normalized({-1, -2, -3});
        scene.lights = {light};
        return render_scene(
                   scene, square_settings("mis", orthographic({0, 0, 3}, {0, 0, 0}, 1.2), 24, 4))
            .film.image.channels;
    };
    EXPECT_EQ(picture(true), picture(false));
}

TEST(CornerNormals, OfTheFilesOfOthers) {
    const auto folder = case_folder("inverted-normals");
    if (folder.empty()) GTEST_SKIP() << "no folder of cases beside the checkout";
    for (const std::string end : {".gltf", "_metal.gltf"}) {
        const auto picture = [&](const std::string& name) {
            Scene scene = load_gltf(folder / (name + end));
            scene.environment = constant_environment(0.1F);
            const Camera camera = perspective({0, 0.5, 4}, {0, 0, 0}, 0.56);
            return render_scene(scene, square_settings("mis", camera, 24, 4)).film.image.channels;
        };
        const auto right = picture("right");
        for (const char* name : {"normals_inward", "winding_turned", "half_turned"}) {
            const auto found = picture(name);
            for (const char* channel : {"R", "normal.X", "normal.Y", "normal.Z"})
                for (std::size_t i = 0; i < right.at(channel).size(); ++i)
                    ASSERT_NEAR(found.at(channel)[i], right.at(channel)[i], 1e-3)
                        << name << end << " " << channel << " " << i;
        }
    }
}

}  // namespace
}  // namespace wavepath
