// Objects in pieces: the triangles, spheres and disks they consist of, in groups that get a tree
// each, and which of them emit. All at time 0.
#pragma once

#include "server/scene/lights.h"
#include "server/scene/scene.h"

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace farlight {

/// How an object reaches the tree.
enum class Placement : std::uint8_t {
    kWorld,  ///< At rest: its pieces lie in the world's own tree.
    kInstance,  ///< A tree in object space, placed by a transform: it moves, or shares a mesh.
    kDeforming,  ///< A tree of its own in world space, whose vertices move.
};

/// Triangles beyond the first copy from which on a mesh at rest stays shared instead of being
/// flattened for every object that shows it. A flattened copy is faster to trace (no transform, one
/// tree) and costs about 100 bytes a triangle with its share of the tree: up to here 25 MB.
constexpr std::size_t kSharedTriangles = 250'000;

/// One an object. `wide`: is_wide(); then nothing lies in the world's own tree, whose coordinates
/// are counted from one point.
std::vector<Placement> placements_of(const Scene& scene, bool wide = false);

/// What places the group of an instance before a node carries it: a mesh's transform; under a node
/// nothing else; a shape that rests is counted from its own center or corner, and placed there.
glm::dmat4 placement_of(const Object& object);

/// A triangle before a tree has put it in order. What else its corners carry stays in the mesh.
struct FlatTriangle {
    std::array<glm::vec3, 3> vertices;
    std::uint32_t object = 0;
    std::uint32_t light = 0;  ///< Index + 1, 0: none; in a group of instances from 1 on.
    std::uint32_t face = 0;  ///< Of the mesh; of a quad: 0 or 1.
};

struct FlatSphere {
    glm::vec3 center;
    float radius;
    std::uint32_t object;
    std::uint32_t light = 0;
};

struct FlatDisk {
    glm::vec3 center;
    float radius;
    glm::vec3 normal;
    std::uint32_t object;
    std::uint32_t light = 0;
};

/// What one tree is over.
struct FlatGroup {
    std::vector<FlatTriangle> triangles;
    std::vector<FlatSphere> spheres;
    std::vector<FlatDisk> disks;

    std::size_t size() const { return triangles.size() + spheres.size() + disks.size(); }
};

/// A group placed by an object's transform.
struct FlatInstance {
    std::uint32_t group = 0;
    std::uint32_t object = 0;
    std::uint32_t light = 0;  ///< Index + 1 of the light that the group's light 1 is; 0: none.
};

/// A light of an instance, in its group's space.
struct FlatInstanceLight {
    std::uint32_t light = 0;  ///< Index into FlatScene::lights.
    std::uint32_t instance = 0;
    Light shape;
};

/// Where the corners of an object's triangles come from.
struct FlatObject {
    std::shared_ptr<const Mesh> posed;  ///< Its own vertices, if it has a skin or morph targets.
    const Mesh* mesh = nullptr;  ///< None: not a mesh.
    glm::dmat4 group_from_mesh{1};
    glm::mat3 group_from_normal{1};
    bool mirrored = false;
};

struct FlatScene {
    bool wide = false;  ///< See scene_origin.h; false where something at rest is squeezed flat.
    std::vector<FlatGroup> groups;  ///< The world's, the instances', the deforming objects'.
    std::uint32_t first_deforming = 0;  ///< Group of deforming_objects[0]; the others follow.
    std::vector<FlatInstance> instances;
    std::vector<std::uint32_t> deforming_objects;
    std::vector<FlatObject> objects;  ///< One an object of the scene.
    std::vector<Light> lights;  ///< In world space, without their table; of an instance or a
                                ///< deforming object also such that have no power now.
    std::vector<FlatInstanceLight> instance_lights;
    std::size_t dropped_triangles = 0;  ///< Zero area or not finite once in their group's space.
};

/// A mirroring transform turns a winding round: two corners are swapped for outside to stay
/// outside.
inline glm::uvec3 wound(const glm::uvec3& corners, bool mirrored)
{
    return mirrored ? glm::uvec3(corners.x, corners.z, corners.y) : corners;
}

/// The corners of a face in the order of its triangle's vertices.
glm::uvec3 corners_of(const FlatObject& object, std::uint32_t face);

/// Whether a triangle can be hit.
bool has_area(const std::array<glm::vec3, 3>& vertices);

/// `scene` must outlive the result.
FlatScene flatten(const Scene& scene);

}  // namespace farlight
