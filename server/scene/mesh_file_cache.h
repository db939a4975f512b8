// glTF files that a Farlight scene's objects name: each is read once, its meshes are shared.
#pragma once

#include "server/scene/gltf_file.h"
#include "server/scene/scene_error.h"

#include <map>
#include <optional>

namespace farlight {

/// An object of a Farlight scene that stands for all objects of a glTF file.
struct MeshFileObject {
    std::string name;
    std::string path;  ///< As the scene says it, relative to the scene's folder.
    std::optional<std::uint32_t> material;  ///< For all of the file's objects instead of its own.
    glm::dmat4 world_from_file{1};
};

class MeshFileCache {
public:
    explicit MeshFileCache(std::filesystem::path base_dir);

    /// Adds an Object for each object of the file, named "object/part", and what they need.
    void add_instances(Scene& scene, const MeshFileObject& object, const ScenePlace& place);

private:
    struct Entry {
        std::vector<Object> objects;  // of the file
        std::uint32_t first_mesh = 0;  // where the file's meshes lie in the scene
        std::optional<std::uint32_t> first_material;  // empty until an object needs them
        std::vector<Material> materials;  // of the file
        std::vector<Image8> images;  // of the file, until its materials are added
    };

    Entry& entry(Scene& scene, const std::string& path, const ScenePlace& place);

    std::filesystem::path base_dir_;
    std::map<std::string, Entry> entries_;  // by path
};

}  // namespace farlight
