// /objects and /meshes of a Farlight scene document.
#pragma once

#include "server/scene/mesh_repair.h"
#include "server/scene/scene_json_material.h"
#include "server/scene/scene_json_motion.h"

#include <optional>

namespace farlight {

class SceneObjects {
public:
    SceneObjects(
        Scene& scene, const SceneMaterials& materials, SceneMotion& motion, GltfInstances& files);

    /// Meshes that objects may share by name.
    void read_meshes(const nlohmann::json& meshes, const ScenePlace& place);

    void read(const nlohmann::json& objects, const ScenePlace& place);

    const MeshRepairs& repairs() const { return repairs_; }

private:
    void read_object(const nlohmann::json& value, const std::string& name, const ScenePlace& place);
    void read_file(const nlohmann::json& value, const std::string& name, const ScenePlace& place);
    std::uint32_t material_of(const nlohmann::json& object, const ScenePlace& place) const;
    MeshInstance read_box(
        const nlohmann::json& value, std::uint32_t material, const ScenePlace& place);
    MeshInstance read_mesh(
        const nlohmann::json& value, const std::string& name, const ScenePlace& place);
    std::uint32_t add_mesh(Mesh mesh);

    Scene& scene_;
    const SceneMaterials& materials_;
    SceneMotion& motion_;
    GltfInstances& files_;
    MeshRepairs repairs_;
    std::map<std::string, std::uint32_t> mesh_by_name_;
    std::optional<std::uint32_t> cube_;  // the mesh that all boxes share
    std::optional<std::uint32_t> cube_with_uvs_;  // likewise those with textures
};

}  // namespace farlight
