// Scene: what a scene file says, on the CPU, before any GPU layout. Filled by scene_file and
// gltf_file.
//
// World space is right-handed, y up by convention, lengths in scene units (call them metres).
// Radiance and reflectance are linear RGB (Rec. 709 primaries).
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <map>
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

struct Material {
    std::string name;
    glm::vec3 albedo{0.8F};  ///< Lambertian reflectance, each channel in [0, 1].
    glm::vec3 emission{0};  ///< Emitted radiance Le [W/(m^2 sr)], >= 0.
    bool emits_both_sides = false;  ///< Otherwise only on the side the geometric normal points to.
};

/// Triangles in object space, one material for all (a glTF primitive becomes one mesh).
struct Mesh {
    std::string name;
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;  ///< Unit shading normals, one a position, or empty: flat.
    std::vector<glm::uvec3>
        triangles;  ///< Indices into positions; counter-clockwise seen from outside.
};

struct Sphere {
    glm::dvec3 center{0};
    double radius = 1;  ///< > 0.
};

/// Parallelogram corner + s * edge_u + t * edge_v, s and t in [0, 1]; normal = edge_u x edge_v.
struct Quad {
    glm::dvec3 corner{0};
    glm::dvec3 edge_u{1, 0, 0};
    glm::dvec3 edge_v{0, 1, 0};
};

struct MeshInstance {
    std::uint32_t mesh = 0;  ///< Index into Scene::meshes.
    glm::dmat4 world_from_object{1};
};

/// A thing in the world: one shape, one material, one id (its index) in the G-buffer.
/// A box of the scene file is a MeshInstance of a cube with flat faces.
struct Object {
    std::string name;
    std::uint32_t material = 0;  ///< Index into Scene::materials.
    std::variant<Sphere, Quad, MeshInstance> shape;
    bool framed = true;  ///< Counts towards scene_bounds(); a light placed by default does not.
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

struct Scene {
    std::string name;
    std::string file;
    std::vector<Material> materials;
    std::vector<Mesh> meshes;
    std::vector<Object> objects;
    glm::vec3 background{0};  ///< Radiance of a ray that leaves the scene, every direction alike.
    CameraPose camera;
    std::map<std::string, std::vector<CameraKeyframe>> camera_paths;
    std::vector<std::string> notes;  ///< What the loader decided or repaired, one sentence each.
};

/// World-space bounds of all framed objects; empty() for an empty scene.
Bounds scene_bounds(const Scene& scene);

}  // namespace farlight
