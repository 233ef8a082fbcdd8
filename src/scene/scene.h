// What a renderer needs to know of a glTF file: plain data, in the file's own units (metres, world
// space).
#pragma once

#include "shared/texture.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace wavepath {

using Vec3d = std::array<double, 3>;
using Rgb = std::array<float, 3>;        // linear, Rec. 709 primaries
using Matrix4 = std::array<double, 16>;  // column-major, as glTF stores it

inline constexpr Matrix4 identity_matrix{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

// What a surface does to light that meets it.
enum class Boundary {
    opaque,
    index_matched,  // passes straight, tinted by the base colour: nothing is reflected or refracted
    dielectric  // smooth: reflects and refracts by Fresnel's equations, tints what it lets through
};

// A homogeneous medium, per metre of world space.
struct Medium {
    Rgb sigma_a{0, 0, 0};   // [1/m] absorption
    Rgb sigma_s{0, 0, 0};   // [1/m] scattering
    Rgb emission{0, 0, 0};  // radiance emitted per metre: sigma_a B where it is isothermal
    float anisotropy = 0;   // [1] g of Henyey-Greenstein: mean cosine, -1 < g < 1

    bool emits() const { return emission[0] > 0 || emission[1] > 0 || emission[2] > 0; }
    bool scatters() const { return sigma_s[0] > 0 || sigma_s[1] > 0 || sigma_s[2] > 0; }
};

// Texels as they are coded, RGBA, row by row from the top; what the codes mean is the texture's.
struct TextureImage {
    uint32_t width = 0;
    uint32_t height = 0;
    bool wide = false;            // 16 bits a channel, else 8
    std::vector<uint32_t> words;  // one a texel, red lowest; two where it is wide
};

enum class Wrap { repeat, mirror, clamp };

// How a material reads an image.
struct Texture {
    std::optional<uint32_t> image;  // into Scene::images; none: 1 everywhere
    uint32_t uvs = 0;               // into Material::uv_sets
    Wrap wrap_s = Wrap::repeat, wrap_t = Wrap::repeat;
    bool nearest = false;  // else bilinear
    bool srgb = false;
    // KHR_texture_transform: image coordinates are (a u + b v + c, d u + e v + f).
    std::array<float, 6> transform{1, 0, 0, 0, 1, 0};
};

enum class AlphaMode { opaque, mask, blend };

// glTF 2.0 metallic-roughness with KHR_materials_ior, _specular, _transmission (thin walls),
// _emissive_strength and _unlit.
struct Material {
    std::string name;
    Rgb base_color{1, 1, 1};  // [1]
    float metallic = 1;       // [1] 0..1
    float roughness = 1;      // [1] 0..1, perceptual; alpha = roughness^2
    float ior = 1.5F;    // [1] >= 1, or 0: Fresnel reflectance 1 (legacy mode of KHR_materials_ior)
    float specular = 1;  // [1] specularFactor: weight of the dielectric's specular layer
    Rgb specular_color{1, 1, 1};  // [1] specularColorFactor: tints its F0
    float transmission = 0;       // [1] share of what enters that goes through (volumes: into them)
    Rgb emission{0, 0, 0};        // radiance: emissiveFactor * emissiveStrength
    bool double_sided = false;    // true: emits from both faces
    Boundary boundary = Boundary::opaque;
    Medium medium{};     // what it encloses, unless it is opaque
    bool unlit = false;  // reflects nothing; vertex colours multiply its emission
    AlphaMode alpha_mode = AlphaMode::opaque;
    float alpha = 1;         // [1] factor of base colour's alpha
    float alpha_cutoff = 0;  // [1] of AlphaMode::mask: what is below is not there
    float normal_scale = 1;  // [1] of TEXTURE_NORMAL's x and y
    std::array<Texture, TEXTURE_USES> textures{};  // what each multiplies: shared/texture.h
    std::vector<uint32_t> uv_sets{};               // TEXCOORD_n that the textures use, at most two

    const Texture& texture(TextureUse use) const { return textures[use]; }
    bool has(TextureUse use) const { return textures[use].image.has_value(); }
    bool emits() const { return emission[0] > 0 || emission[1] > 0 || emission[2] > 0; }
    // Whether nothing enters it anywhere.
    bool is_metal() const { return metallic == 1 && !has(TEXTURE_METALLIC_ROUGHNESS); }
    // Whether it is a boundary at some points, or for some of the light, and opaque else.
    bool transmits_in_part() const {
        return boundary != Boundary::opaque &&
               (transmission < 1 || metallic > 0 || has(TEXTURE_TRANSMISSION));
    }
};

// One glTF mesh primitive as a list of triangles in local space.
struct Primitive {
    std::string name;                       // "mesh name" or "mesh 3", for messages
    std::vector<float> positions;           // 3 a vertex [m]
    std::vector<float> normals;             // 3 a vertex, unit, or empty: flat shading
    std::vector<float> colors;              // 3 a vertex, linear, or empty: white
    std::vector<float> alphas;              // 1 a vertex, or empty: 1
    std::array<std::vector<float>, 2> uvs;  // 2 a vertex, of Material::uv_sets; or empty
    // 4 a corner of the triangles: unit tangent, and 1 or -1 for bitangent = that * cross(normal,
    // tangent). Empty where the material has no normal map.
    std::vector<float> tangents;
    std::vector<uint32_t> indices;  // 3 a triangle
    uint32_t material = 0;          // into Scene::materials
};

struct Instance {
    uint32_t primitive = 0;  // into Scene::primitives
    Matrix4 to_world = identity_matrix;
    uint32_t body = 0;  // instances of one number enclose a medium together: a node's mesh
};

struct Camera {
    std::string name;
    std::string node;  // that it hangs on, by name
    bool orthographic = false;
    double y_fov = 0.7853981633974483;   // [rad] perspective
    double x_mag = 1;                    // [m] orthographic half width
    double y_mag = 1;                    // [m] orthographic half height
    double aspect_ratio = 0;             // width / height; 0: the image's
    Matrix4 to_world = identity_matrix;  // looks along its local -Z, +Y up
};

enum class LightKind { point, spot, directional };

// KHR_lights_punctual; 1 cd = 1 W/sr, no 683.
struct PunctualLight {
    std::string name;
    LightKind kind = LightKind::point;
    Rgb intensity{1, 1, 1};     // color * intensity: [W/sr] point and spot, [W/m^2] directional
    Vec3d position{0, 0, 0};    // [m]
    Vec3d direction{0, 0, -1};  // unit, the way the light shines
    double range = 0;           // [m] 0: unlimited
    double inner_cone = 0;      // [rad]
    double outer_cone = 0.7853981633974483;  // [rad]
};

// Radiance from infinity. Lookup: u = atan2(z, x) / 2 pi + 0.5, v = acos(y) / pi from the top row.
struct Environment {
    Rgb radiance{0, 0, 0};  // of a constant environment, or the scale of `pixels`
    uint32_t width = 0;     // 0: constant
    uint32_t height = 0;
    std::vector<float> pixels;  // 3 a texel, linear, row by row from the top
    std::string name;           // the map's file
};

struct Scene {
    std::string name;                          // its file
    std::vector<std::filesystem::path> files;  // that it was read from beside that one
    std::vector<Material> materials;           // at least one
    std::vector<TextureImage> images;
    std::vector<Primitive> primitives;
    std::vector<Instance> instances;    // of primitives, in depth-first order of the node tree
    std::vector<Camera> cameras;        // of the scene, in depth-first order
    std::vector<PunctualLight> lights;  // of the scene, in depth-first order
    std::optional<Environment> environment;
    std::vector<std::string>
        ignored;  // what the file asks for and this program does not do, one line each, said once

    std::size_t triangle_count() const;  // instances expanded
};

}  // namespace wavepath
