// Writes the terrain scene, about a million triangles, as binary glTF (scenes/terrain/README.md
// says what it shows).
//   make_terrain OUT.glb [SIDE]
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

static_assert(std::endian::native == std::endian::little, "glTF buffers are little-endian");

// Vertices along each edge: 2 * 706^2 = 996872 triangles.
constexpr uint32_t default_side = 707;
constexpr double half_extent = 2;  // [m]

// One term of the height: amplitude * sin(frequency x + phase) * cos(0.9 frequency z + 2 phase).
struct Wave {
    double frequency;  // [rad/m]
    double amplitude;  // [m]
    double phase;      // [rad]
};

constexpr std::array<Wave, 6> waves{
    {{2, 0.35, 0.3},
     {5, 0.16, 1.1},
     {11, 0.07, 2.3},
     {29, 0.03, 0.7},
     {83, 0.012, 1.9},
     {211, 0.005, 0.2}}};

double coordinate(uint32_t step, uint32_t side) {
    return -half_extent + step * (2 * half_extent / (side - 1));
}

// x outer, z inner.
std::vector<float> make_positions(uint32_t side) {
    // Each term is a product of a function of x and one of z: side, not side^2, of each are needed.
    std::vector<std::array<double, waves.size()>> along_x(side), along_z(side);
    for (uint32_t step = 0; step < side; ++step) {
        for (std::size_t k = 0; k < waves.size(); ++k) {
            const auto& [frequency, amplitude, phase] = waves[k];
            along_x[step][k] = amplitude * std::sin(frequency * coordinate(step, side) + phase);
            along_z[step][k] = std::cos(0.9 * frequency * coordinate(step, side) + 2 * phase);
        }
    }
    std::vector<float> positions;
    positions.reserve(std::size_t{3} * side * side);
    for (uint32_t i = 0; i < side; ++i) {
        for (uint32_t j = 0; j < side; ++j) {
            double height = 0;
            for (std::size_t k = 0; k < waves.size(); ++k) height += along_x[i][k] * along_z[j][k];
            for (const double c : {coordinate(i, side), height, coordinate(j, side)})
                positions.push_back(static_cast<float>(c));
        }
    }
    return positions;
}

std::vector<uint32_t> make_indices(uint32_t side) {
    std::vector<uint32_t> indices;
    indices.reserve(std::size_t{6} * (side - 1) * (side - 1));
    for (uint32_t i = 0; i + 1 < side; ++i) {
        for (uint32_t j = 0; j + 1 < side; ++j) {
            const uint32_t corner = i * side + j;
            for (const uint32_t vertex :
                 {corner, corner + 1, corner + side, corner + 1, corner + side + 1, corner + side})
                indices.push_back(vertex);
        }
    }
    return indices;
}

// Accessor bounds, which glTF 2.0 requires of positions.
std::string bounds(std::span<const float> positions) {
    std::array<float, 3> low{positions[0], positions[1], positions[2]}, high = low;
    for (std::size_t k = 3; k < positions.size(); ++k) {
        low[k % 3] = std::min(low[k % 3], positions[k]);
        high[k % 3] = std::max(high[k % 3], positions[k]);
    }
    return fmt::format(
        R"("min":[{},{},{}],"max":[{},{},{}])", low[0], low[1], low[2], high[0], high[1], high[2]);
}

// The camera stands at (1.9, 1.5, 2.6) and looks at (0, -0.1, 0).
std::string camera_node() {
    constexpr double x = 1.9, y = 1.6, z = 2.6;  // from the target to the eye
    const double heading = std::atan2(x, z), pitch = -std::atan2(y, std::hypot(x, z));
    const double ch = std::cos(heading / 2), sh = std::sin(heading / 2);
    const double cp = std::cos(pitch / 2), sp = std::sin(pitch / 2);
    return fmt::format(
        R"({{"name":"camera","camera":0,"translation":[1.9,1.5,2.6],"rotation":[{:.12f},{:.12f},{:.12f},{:.12f}]}})",
        ch * sp, sh * cp, -sh * sp, ch * cp);
}

std::string make_json(std::span<const float> positions, std::span<const uint32_t> indices) {
    constexpr double y_fov = 0.785398163397448;  // [rad] 45 degrees
    return fmt::format(
        R"({{"asset":{{"version":"2.0","generator":"wavepath tools/make_terrain","copyright":"The wavepath authors, Apache-2.0"}},)"
        R"("extensionsUsed":["KHR_materials_specular"],"scene":0,"scenes":[{{"nodes":[0,1]}}],)"
        R"("nodes":[{{"name":"ground","mesh":0}},{}],)"
        R"("cameras":[{{"name":"camera","type":"perspective","perspective":{{"yfov":{},"aspectRatio":1.0,"znear":0.001}}}}],)"
        R"("meshes":[{{"name":"ground","primitives":[{{"attributes":{{"POSITION":0}},"indices":1,"material":0}}]}}],)"
        R"("materials":[{{"name":"ground","doubleSided":true,"pbrMetallicRoughness":{{"baseColorFactor":[0.6,0.5,0.4,1.0],"metallicFactor":0.0}},)"
        R"("extensions":{{"KHR_materials_specular":{{"specularFactor":0.0}}}}}}],)"
        R"("accessors":[{{"bufferView":0,"componentType":5126,"count":{},"type":"VEC3",{}}},)"
        R"({{"bufferView":1,"componentType":5125,"count":{},"type":"SCALAR"}}],)"
        R"("bufferViews":[{{"buffer":0,"byteLength":{},"target":34962}},{{"buffer":0,"byteOffset":{},"byteLength":{},"target":34963}}],)"
        R"("buffers":[{{"byteLength":{}}}]}})",
        camera_node(), y_fov, positions.size() / 3, bounds(positions), indices.size(),
        positions.size_bytes(), positions.size_bytes(), indices.size_bytes(),
        positions.size_bytes() + indices.size_bytes());
}

void write_word(std::ostream& out, std::size_t word) {
    const auto narrow = static_cast<uint32_t>(word);
    out.write(reinterpret_cast<const char*>(&narrow), sizeof narrow);
}

// glTF 2.0 section 4: a 12-byte header, then a JSON and a binary chunk with 8 bytes of header each.
void write_glb(
    std::ostream& out,
    std::string json,
    std::span<const float> positions,
    std::span<const uint32_t> indices) {
    json.append((4 - json.size() % 4) % 4, ' ');  // chunks are multiples of 4 bytes
    const std::size_t binary_size = positions.size_bytes() + indices.size_bytes();
    out.write("glTF", 4);
    write_word(out, 2);
    write_word(out, 12 + 8 + json.size() + 8 + binary_size);
    write_word(out, json.size());
    out.write("JSON", 4);
    out << json;
    write_word(out, binary_size);
    out.write("BIN\0", 4);
    for (const auto bytes : {std::as_bytes(positions), std::as_bytes(indices)})
        out.write(
            reinterpret_cast<const char*>(bytes.data()),
            static_cast<std::streamsize>(bytes.size()));
}

void make_terrain(const std::filesystem::path& path, uint32_t side) {
    const std::vector<float> positions = make_positions(side);
    const std::vector<uint32_t> indices = make_indices(side);
    const std::filesystem::path unfinished = path.string() + ".part";
    std::ofstream out(unfinished, std::ios::binary);
    write_glb(out, make_json(positions, indices), positions, indices);
    out.close();
    if (!out)
        throw std::runtime_error(
            path.string() + ": cannot be written; is there space and permission?");
    std::filesystem::rename(unfinished, path);
}

}  // namespace

int main(int argument_count, char** arguments) {
    const uint32_t side =
        argument_count == 3 ? static_cast<uint32_t>(std::atoi(arguments[2])) : default_side;
    if (argument_count < 2 || argument_count > 3 || side < 2 || side > 10000) {
        fmt::print(stderr, "usage: make_terrain OUT.glb [SIDE], 2 to 10000 vertices a side\n");
        return 2;
    }
    try {
        make_terrain(arguments[1], side);
    } catch (const std::exception& error) {
        fmt::print(stderr, "error: {}\n", error.what());
        return 1;
    }
}
