#include "support/meshes.h"

#include <array>
#include <cmath>
#include <numbers>
#include <random>

namespace wavepath {
namespace {

using Point = std::array<double, 3>;

void add_triangle(TestMesh& mesh, const Point& a, const Point& b, const Point& c) {
    for (const Point& p : {a, b, c})
        for (const double x : p) mesh.positions.push_back(static_cast<float>(x));
}

void add_quad(TestMesh& mesh, const Point& a, const Point& b, const Point& c, const Point& d) {
    add_triangle(mesh, a, b, c);
    add_triangle(mesh, a, c, d);
}

void add_box(TestMesh& mesh, const Point& low, const Point& high) {
    const auto corner = [&](unsigned bits) {
        return Point{
            (bits & 1U) != 0 ? high[0] : low[0], (bits & 2U) != 0 ? high[1] : low[1],
            (bits & 4U) != 0 ? high[2] : low[2]};
    };
    const std::array<std::array<unsigned, 4>, 6> faces{
        {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
    for (const auto& f : faces)
        add_quad(mesh, corner(f[0]), corner(f[1]), corner(f[2]), corner(f[3]));
}

}  // namespace

TestMesh box_mesh() {
    TestMesh mesh{"box", {}, true};
    add_box(mesh, {-0.5, -0.4, -0.3}, {0.5, 0.4, 0.3});
    return mesh;
}

TestMesh room_mesh() {
    TestMesh mesh{"room", {}, true};
    add_box(mesh, {-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5});
    add_box(mesh, {-0.3, -0.5, -0.25}, {-0.1, 0.1, 0.05});
    add_box(mesh, {0.1, -0.5, 0.1}, {0.3, -0.2, 0.3});
    return mesh;
}

TestMesh sphere_mesh(unsigned rings, unsigned sectors) {
    TestMesh mesh{"sphere", {}, true};
    const auto point = [&](unsigned ring, unsigned sector) {
        if (ring == 0) return Point{0, 0.5, 0};
        if (ring == rings) return Point{0, -0.5, 0};
        const double theta = std::numbers::pi * ring / rings;
        const double phi = 2 * std::numbers::pi * (sector % sectors) / sectors;
        return Point{
            0.5 * std::sin(theta) * std::cos(phi), 0.5 * std::cos(theta),
            0.5 * std::sin(theta) * std::sin(phi)};
    };
    for (unsigned r = 0; r < rings; ++r)
        for (unsigned s = 0; s < sectors; ++s) {
            if (r > 0) add_triangle(mesh, point(r, s), point(r + 1, s), point(r, s + 1));
            if (r + 1 < rings)
                add_triangle(mesh, point(r + 1, s), point(r + 1, s + 1), point(r, s + 1));
        }
    return mesh;
}

TestMesh height_field_mesh(unsigned cells) {
    TestMesh mesh{"height field", {}, false};
    const auto point = [&](unsigned i, unsigned j) {
        const double x = static_cast<double>(i) / cells - 0.5;
        const double z = static_cast<double>(j) / cells - 0.5;
        return Point{
            x,
            0.1 * std::sin(9 * x) * std::cos(8 * z) +
                0.02 * std::sin(61 * x + 1) * std::cos(53 * z),
            z};
    };
    for (unsigned i = 0; i < cells; ++i)
        for (unsigned j = 0; j < cells; ++j)
            add_quad(mesh, point(i, j), point(i, j + 1), point(i + 1, j + 1), point(i + 1, j));
    return mesh;
}

TestMesh soup_mesh(std::size_t triangles) {
    TestMesh mesh{"soup", {}, false};
    std::mt19937 random(11);
    std::uniform_real_distribution<double> uniform(-0.5, 0.5);
    for (std::size_t i = 0; i < triangles; ++i) {
        const double size = std::pow(10.0, -3 * (uniform(random) + 0.5)) * 0.3;
        const Point center{uniform(random), uniform(random), uniform(random)};
        std::array<Point, 3> corners{};
        for (Point& corner : corners)
            for (std::size_t axis = 0; axis < 3; ++axis)
                corner[axis] = (1 - size) * center[axis] + size * uniform(random);
        add_triangle(mesh, corners[0], corners[1], corners[2]);
    }
    return mesh;
}

TestMesh rods_mesh(unsigned rods) {
    TestMesh mesh{"rods", {}, false};
    std::mt19937 random(12);
    std::uniform_real_distribution<double> uniform(-0.5, 0.5);
    for (unsigned i = 0; i < rods; ++i) {
        const Point from{uniform(random), uniform(random), uniform(random)};
        const Point to{uniform(random), uniform(random), uniform(random)};
        const double width = 0.001 + 0.002 * (uniform(random) + 0.5);
        const Point side{(to[1] - from[1]) * width, (from[0] - to[0]) * width, 0};
        const auto moved = [&](const Point& p) {
            return Point{0.99 * p[0] + side[0], 0.99 * p[1] + side[1], 0.99 * p[2]};
        };
        add_quad(mesh, from, to, moved(to), moved(from));
    }
    return mesh;
}

TestMesh slivers_mesh(std::size_t triangles) {
    TestMesh mesh{"slivers", {}, false};
    std::mt19937 random(13);
    std::uniform_real_distribution<double> uniform(-0.5, 0.5);
    for (std::size_t i = 0; i < triangles; ++i) {
        const Point from{uniform(random), uniform(random), uniform(random)};
        const Point to{uniform(random), uniform(random), uniform(random)};
        const double height = std::pow(10.0, -3.5 + 5 * uniform(random));
        // a needle, whose third corner is near its first, or a cap, where it is between the others
        const double along = i % 2 == 0 ? 0 : uniform(random) + 0.5;
        Point third{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double straight = from[axis] + along * (to[axis] - from[axis]);
            third[axis] = (1 - height) * straight + height * uniform(random);
        }
        add_triangle(mesh, from, to, third);
    }
    return mesh;
}

TestMesh repeated_mesh(const TestMesh& mesh, unsigned copies) {
    TestMesh repeated{"repeated " + mesh.name, {}, mesh.closed};
    for (unsigned i = 0; i < copies; ++i)
        repeated.positions.insert(
            repeated.positions.end(), mesh.positions.begin(), mesh.positions.end());
    return repeated;
}

}  // namespace wavepath
