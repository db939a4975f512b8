// Scene: what a scene file says, on the CPU, before any GPU layout. Filled by scene_file and
// gltf_file.
//
// World space is right-handed, y up by convention, lengths in scene units (call them metres).
// Radiance and reflectance are linear RGB (Rec. 709 primaries).
#pragma once

#include "server/scene/animation.h"

#include <cstdint>
#include <glm/glm.hpp>
#include <map>
#include <memory>
#include <string>
#include <variant>
#include <vector>

namespace farlight {

/// Where a camera stands and looks. Double precision: scenes may lie far from the origin.
struct CameraPose {
    glm::dvec3 position{0, 0, 0};
    glm::dvec3 target{0, 0, -1};
    glm::dvec3 up{0, 1, 0};  ///< Need not be orthogonal to the view; parallel to it is repaired.
    double vertical_fov_degrees = 45;  ///< See camera_limits.h.

    bool operator==(const CameraPose&) const = default;
};

/// One camera keyframe; poses between two keyframes are interpolated linearly in time.
struct CameraKeyframe {
    double frame = 0;  ///< Frames since the path's start, strictly increasing.
    CameraPose pose;
};

constexpr std::uint32_t kNone = 0xffffffff;  ///< An index that points nowhere.

/// 8-bit texels as the file holds them, row 0 on top (glTF's v = 0). Whether they are sRGB follows
/// from what they are used for, not from the image.
struct Image8 {
    std::string name;
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<glm::u8vec4> texels;  ///< width * height; opaque white where a channel is missing.
};

enum class Wrap : std::uint8_t { kRepeat, kMirror, kClamp };

/// How a material looks up an image.
struct Texture {
    std::uint32_t image =
        kNone;  ///< Index into Scene::images; kNone: the constant beside it alone.
    Wrap wrap_u = Wrap::kRepeat;
    Wrap wrap_v = Wrap::kRepeat;
    bool nearest = false;  ///< Magnified without interpolation.
    std::uint8_t uv_set = 0;  ///< 0 or 1.
    glm::mat3 image_from_uv{1};  ///< KHR_texture_transform: (u, v, 1) of the mesh to the image's.

    bool used() const { return image != kNone; }
    bool operator==(const Texture&) const = default;
};

enum class AlphaMode : std::uint8_t {
    kOpaque,
    kMask,  ///< There where opacity >= alpha_cutoff.
    kBlend,  ///< Stochastic coverage: there with probability `opacity`.
};

/// Names and meanings follow glTF 2.0 and its KHR extensions; a texture multiplies the constant
/// beside it. The layers from the top: clearcoat; specular reflection of a dielectric (weight
/// `specular`, `ior`) over diffuse or transmitted light; blended by `metallic` with a conductor of
/// reflectance `albedo`. Defaults make a Lambertian reflector.
struct Material {
    std::string name;
    glm::vec3 albedo{0.8F};  ///< Base colour in [0, 1]: diffuse albedo, or a conductor's F0.
    glm::vec3 emission{0};  ///< Emitted radiance Le [W/(m^2 sr)], >= 0.
    bool emits_both_sides = false;  ///< Otherwise only on the side the geometric normal points to.
    Texture albedo_texture;  ///< sRGB; its alpha multiplies `opacity`.
    Texture emission_texture;  ///< sRGB.

    AlphaMode alpha_mode = AlphaMode::kOpaque;
    float opacity = 1;
    float alpha_cutoff = 0.5F;

    float metallic = 0;
    float roughness = 1;  ///< Perceptual, in [0, 1]; the GGX alpha is its square.
    Texture metallic_roughness_texture;  ///< Linear: roughness in G, metallic in B.
    Texture normal_texture;  ///< Linear, tangent space, 0..1 for -1..1.
    float normal_scale = 1;

    float ior = 1.5F;  ///< >= 1, of the inside relative to vacuum.
    float specular = 0;  ///< Weight of the dielectric reflection, in [0, 1]; glTF's default is 1.
    glm::vec3 specular_color{1};  ///< F0 tint, >= 0.
    Texture specular_texture;  ///< Linear, A.
    Texture specular_color_texture;  ///< sRGB.

    float transmission = 0;  ///< Part of the diffuse light that is refracted instead, in [0, 1].
    Texture transmission_texture;  ///< Linear, R.
    bool thin_walled = false;  ///< Transmits without bending and has no inside.
    glm::vec3 absorption{0};  ///< sigma_a of the inside [1/m], >= 0.
    int priority = 0;  ///< Where two insides overlap the larger wins (Schmidt and Budge 2002).

    float clearcoat = 0;
    float clearcoat_roughness = 0;
    Texture clearcoat_texture;  ///< Linear, R.
    Texture clearcoat_roughness_texture;  ///< Linear, G.
    Texture clearcoat_normal_texture;  ///< Linear, tangent space.
    float clearcoat_normal_scale = 1;

    bool unlit =
        false;  ///< KHR_materials_unlit: shows `albedo` as if it were emission, reflects nothing.

    bool operator==(const Material&) const = default;
};

/// Displacements of a morph target, one a vertex; an empty list displaces nothing.
struct MorphTarget {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;
};

/// Triangles in object space, one material for all (a glTF primitive becomes one mesh).
/// A list that is not empty has one element a position.
struct Mesh {  // NOLINT: clang's implicit copy of `uvs` counts with a reserved name
    std::string name;
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;  ///< Unit shading normals; empty: flat.
    std::vector<glm::uvec3>
        triangles;  ///< Indices into positions; counter-clockwise seen from outside.
    std::vector<glm::vec2> uvs[2] = {};
    std::vector<glm::vec4> tangents = {};  ///< xyz unit, w = +-1 gives the bitangent's sign (glTF).
    std::vector<glm::vec4> colors = {};  ///< Linear, multiply albedo and opacity.
    std::vector<MorphTarget> morph_targets = {};
    std::vector<glm::u16vec4> joints = {};  ///< Indices into Skin::joints.
    std::vector<glm::vec4> weights = {};  ///< Of the joints, sum 1.
};

/// uv: longitude and latitude as on a globe: u = 0.5 + atan2(x, z) / 2 pi, v = acos(y) / pi.
struct Sphere {
    glm::dvec3 center{0};
    double radius = 1;  ///< > 0.
};

/// Flat, one-sided where it emits. It has no uv: (0, 0) everywhere.
struct Disk {
    glm::dvec3 center{0};
    glm::dvec3 normal{0, 0, 1};  ///< Unit.
    double radius = 1;  ///< > 0.
};

/// Parallelogram corner + s * edge_u + t * edge_v, s and t in [0, 1]; normal = edge_u x edge_v.
/// uv: (s, 1 - t), so that a picture stands upright on edge_u.
struct Quad {
    glm::dvec3 corner{0};
    glm::dvec3 edge_u{1, 0, 0};
    glm::dvec3 edge_v{0, 1, 0};
};

struct MeshInstance {
    std::uint32_t mesh = 0;  ///< Index into Scene::meshes.
    glm::dmat4 world_from_object{
        1};  ///< Under a node: node_from_object. Ignored with a skin (glTF).
    std::uint32_t skin = kNone;  ///< Index into Animation::skins.
    std::vector<float> morph_weights = {};  ///< At rest, one a morph target.
};

/// A thing in the world: one shape, one material, one id (its index) in the G-buffer.
/// A box of the scene file is a MeshInstance of a cube with flat faces.
struct Object {
    std::string name;
    std::uint32_t material = 0;  ///< Index into Scene::materials.
    std::variant<Sphere, Quad, MeshInstance, Disk>
        shape;  ///< In world space; under a node, in the node's.
    bool framed = true;  ///< Counts towards scene_bounds(); a light placed by default does not.
    std::uint32_t node = kNone;  ///< Index into Animation::nodes that carries it; kNone: at rest.
};

/// A light without extent: it is met by sampling alone.
struct PunctualLight {
    enum class Kind : std::uint8_t { kPoint, kSpot, kDirectional };
    std::string name;
    Kind kind = Kind::kPoint;
    glm::vec3 intensity{1};  ///< [W/sr]; directional: irradiance facing it [W/m^2]. >= 0.
    glm::dvec3 position{0};  ///< In world space; under a node, in the node's.
    glm::dvec3 direction{0, 0, -1};  ///< Unit, the way the light goes; likewise.
    double inner_cone = 0;  ///< Half angle of full intensity [rad], < outer_cone.
    double outer_cone =
        0.785398163397448;  ///< Half angle of any [rad], <= pi / 2 (KHR_lights_punctual).
    std::uint32_t node = kNone;  ///< As Object::node.
};

/// Radiance from all around, on an equirectangular map: u = 0.5 + atan2(x, -z) / 2 pi, v = acos(y)
/// / pi, so that the picture's middle lies along -z and its top is up.
struct EnvironmentMap {
    std::string file;
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<glm::vec3> texels;  ///< Linear radiance, finite, >= 0; row 0 on top.
};

/// What fills the space around all surfaces. Homogeneous.
struct Medium {
    std::string name;
    glm::vec3 sigma_a{0};  ///< Absorption [1/m].
    glm::vec3 sigma_s{0};  ///< Scattering [1/m].
    float g = 0;  ///< Mean cosine of Henyey-Greenstein, in (-1, 1); > 0: forward.

    bool operator==(const Medium&) const = default;
};

/// Thin lens; radius 0 is a pinhole.
struct Lens {
    double radius = 0;  ///< Of the aperture [m].
    double focus_distance = 0;  ///< View depth that is sharp [m]; 0: the camera's target.

    bool operator==(const Lens&) const = default;
};

struct Bounds {
    glm::dvec3 lower{1e300};
    glm::dvec3 upper{-1e300};

    void extend(const glm::dvec3& p) { lower = glm::min(lower, p), upper = glm::max(upper, p); }
    void extend(const Bounds& b)
    {
        lower = glm::min(lower, b.lower), upper = glm::max(upper, b.upper);
    }
    bool empty() const { return !(lower.x <= upper.x); }
    glm::dvec3 center() const { return 0.5 * (lower + upper); }
    double radius() const { return 0.5 * glm::length(upper - lower); }
};

/// A setting's value as a file may write it.
using SettingValue = std::variant<bool, double, std::string>;

struct Scene {
    std::string name;
    std::string file;
    std::vector<Material> materials;
    std::vector<Mesh> meshes;
    std::vector<Object> objects;
    std::vector<Image8> images;
    std::vector<PunctualLight> lights;
    glm::vec3 background{
        0};  ///< Radiance of a ray that leaves the scene; scales the map if there is one.
    std::shared_ptr<const EnvironmentMap> environment;
    glm::mat3 map_from_world{1};  ///< Rotation into the environment map's frame.
    Medium medium;
    Lens lens;
    Animation animation;  ///< Empty when nothing moves.
    /// Where the coordinates of all of the above start, in those of the cameras below: zero but in
    /// a scene made ready for a device (scene_origin.h).
    glm::dvec3 origin{0};
    CameraPose camera;
    std::map<std::string, std::vector<CameraKeyframe>> camera_paths;
    std::map<std::string, SettingValue>
        settings;  ///< What the scene is to be drawn with unless somebody says otherwise.
    std::vector<std::string> notes;  ///< What the loader decided or repaired, one sentence each.
};

/// World-space bounds of all framed objects at time 0; empty() for an empty scene.
Bounds scene_bounds(const Scene& scene);
/// One an object, framed or not.
std::vector<Bounds> object_bounds(const Scene& scene);

}  // namespace farlight
