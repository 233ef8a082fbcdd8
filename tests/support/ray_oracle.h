// Rays and what Embree, in its robust mode, says they hit.
#pragma once

#include "support/meshes.h"

#include <array>
#include <bit>
#include <cstdint>
#include <memory>
#include <random>
#include <vector>

struct RTCSceneTy;

namespace wavepath {

struct TestRay {
    std::array<float, 3> origin{};
    std::array<float, 3> direction{};  // of any length
    float t_max = 0;                   // in lengths of the direction
    float padding = 0;
};
static_assert(sizeof(TestRay) == 32);

struct TestHit {
    float t = 0;
    float u = 0, v = 0;  // barycentrics of corners 1 and 2
    int primitive = -1;  // -1: none
};
static_assert(sizeof(TestHit) == 16);

inline bool same_bits(const TestHit& a, const TestHit& b) {
    using Bits = std::array<std::uint32_t, 4>;
    return std::bit_cast<Bits>(a) == std::bit_cast<Bits>(b);
}

class RayOracle {
  public:
    explicit RayOracle(const TestMesh& mesh);
    TestHit closest(const TestRay& ray) const;

    // Two answers to one ray, ours with a t and barycentrics that meet within 1e-5 of each other
    // unless the ray grazes its triangle, whose sliver float cannot measure: alike, or different
    // where float cannot decide, judged in double.
    //  - the same triangle, or hit points within 1e-5 of each other (adjacent or coincident), or
    //  - one of them stops at a triangle that has an edge within 1e-6 of the ray (a silhouette), or
    //  - ours is right: Embree meets slivers seen edge-on far from where the ray passes them.
    bool agree(const TestRay& ray, const TestHit& ours, const TestHit& theirs) const;

  private:
    std::array<double, 3> point_of(const TestHit& hit) const;
    bool is_on_ray(const TestRay& ray, const TestHit& hit) const;
    double edge_distance(const TestRay& ray, int primitive) const;
    bool passes_through(const TestRay& ray, int primitive) const;

    const TestMesh& mesh_;
    std::shared_ptr<RTCSceneTy> scene_;
};

// How rays are aimed.
enum class Aim { random, axis_parallel, edge, vertex };

// Rays from within 1.5 of the scene, or from around its middle where `from_inside`.
std::vector<TestRay> make_rays(
    const TestMesh& mesh, Aim aim, bool from_inside, std::size_t count, std::mt19937& random);

// Rays that mean nothing: without length or direction, of numbers that are none or too large.
std::vector<TestRay> degenerate_rays();

// As a probe's argument: 8 floats each.
std::vector<float> floats_of(const std::vector<TestRay>& rays);

}  // namespace wavepath
