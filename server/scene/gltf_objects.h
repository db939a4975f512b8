// glTF meshes and the nodes that show them -> Scene::meshes and objects.
#pragma once

#include "server/scene/gltf_animation.h"
#include "server/scene/mesh_repair.h"

#include <optional>

namespace farlight {

class GltfObjects {
public:
    /// The scene has its materials already.
    GltfObjects(GltfContainer& gltf, GltfRig& rig, Scene& scene);

    /// Adds an object for each primitive of the node's mesh, if it has one. Throws SceneError.
    void add(const GltfNode& node);

    const ObjectsOfNode& by_node() const { return by_node_; }
    /// Objects left out because their transform has no volume.
    std::size_t flat_instances() const { return flat_instances_; }
    /// What was left out or repaired.
    void add_notes() const;

private:
    /// A primitive as instances need it.
    struct Part {
        std::uint32_t mesh;
        std::uint32_t material;
        std::uint32_t joints = 0;  // one more than the largest that counts
    };

    const std::vector<Part>& parts_of(std::size_t mesh);
    void count_strokes(const nlohmann::json& primitive, const ScenePlace& place);
    Part read_part(const nlohmann::json& mesh, std::size_t primitive, const ScenePlace& place);
    std::optional<MeshInstance> placed(const GltfNode& node, const Part& part);
    void attach_skin(const GltfNode& node, const Part& part, MeshInstance& instance);
    std::vector<float> weights_of(
        const nlohmann::json& node, const MeshInstance& instance, std::size_t node_index) const;
    std::uint32_t default_material();

    GltfContainer& gltf_;
    GltfRig& rig_;
    Scene& scene_;
    std::map<std::size_t, std::vector<Part>> parts_;  // by glTF mesh
    std::optional<std::uint32_t> default_material_;
    ObjectsOfNode by_node_;
    MeshRepairs repairs_;
    std::size_t strokes_ = 0;  // primitives of points or lines
    std::uint64_t stroke_triangles_ = 0;  // that they become
    std::size_t flat_instances_ = 0;  // whose transform has no volume
};

}  // namespace farlight
