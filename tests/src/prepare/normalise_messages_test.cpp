// Why a scene has nothing to render: src/prepare/normalise.cpp.
#include "prepare/normalise.h"

#include "support/gltf_builder.h"

#include <gmock/gmock.h>

namespace wavepath {
namespace {

using testing::HasSubstr;

std::string error_with(const std::vector<float>& positions, const Vec3d& translation) {
    GltfBuilder gltf;
    gltf.object({{"attributes", {{"POSITION", gltf.accessor<float>("VEC3", positions)}}}});
    gltf.root["nodes"][0]["translation"] = translation;
    const Scene scene = load(gltf);
    return error_of([&] { normalise(scene); });
}

TEST(NormaliseMessages, SayWhatATriangleIsTooSmallFor) {
    const std::vector<float> triangle{0, 0, 0, 1, 0, 0, 0, 1, 0};
    EXPECT_EQ(error_with(triangle, {1e12, 0, 0}), "") << "doubles tell its corners apart";
    EXPECT_THAT(
        error_with(triangle, {1e16, 0, 0}),
        HasSubstr("every triangle is too small for its distance from the origin, 1e+16 m; move"));
    // in the file's floats two of its corners are one
    EXPECT_THAT(
        error_with({1e12F, 0, 0, 1e12F + 1, 0, 0, 1e12F, 1, 0}, {0, 0, 0}),
        HasSubstr("too small for its distance from the origin, 1e+12 m"));
    std::vector<float> stray = triangle;
    stray.insert(stray.end(), {1e12F, 0, 0, 1e12F, 0, 0, 1e12F, 0, 0});
    EXPECT_EQ(error_with(stray, {0, 0, 0}), "") << "a camera may be close to it: place() asks it";
    EXPECT_THAT(
        error_with({0, 0, 0, 1, 0, 0, 2, 0, 0}, {0, 0, 0}),
        HasSubstr("every triangle has zero area; there is nothing to render"));
}

}  // namespace
}  // namespace wavepath
