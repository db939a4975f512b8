// Merging glTF files into a Farlight scene: meshes, pictures and materials are shared by all
// instances of a file, nodes and tracks are each instance's own.
#pragma once

#include "server/scene/scene_files.h"

namespace farlight {

/// The node that carries a thing, if one does, and where that node rests in the world.
struct Carrier {
    std::uint32_t node = kNone;
    glm::dvec3 origin{0};  ///< The node has no rotation and no scale at rest.
};

/// An object of a Farlight scene that stands for all that a glTF file holds.
struct GltfInstance {
    std::string name;  ///< Empty: its objects keep the file's names.
    std::string path;  ///< As the scene says it.
    std::optional<std::uint32_t> material;  ///< For all of the file's objects instead of its own.
    std::map<std::string, std::uint32_t> material_by_name;  ///< Instead of the file's of that name.
    glm::dmat4 world_from_file{1};
    Carrier carrier;
};

class GltfInstances {
public:
    /// With `whole_scene` the scene is nothing but a glTF file, and says so in its own notes.
    GltfInstances(Scene& scene, SceneFiles& files, bool whole_scene);

    /// Objects are named "instance/part", or like the instance where there is one part only.
    void add(const GltfInstance& instance, const ScenePlace& place);

    /// The first instance with a camera gives the scene its own; false: none has one.
    bool has_camera() const { return has_camera_; }

private:
    /// Where a file's parts lie in the scene.
    struct Entry {
        std::shared_ptr<const GltfScene> file;
        std::uint32_t first_mesh = 0;
        std::optional<std::uint32_t> first_material;  // empty until an object needs them
    };

    /// Where an instance's own parts begin in the scene.
    struct First {
        std::uint32_t object;
        std::uint32_t node;
        std::uint32_t skin;
        glm::dmat4 carrier_from_file;
    };

    Entry& entry(const std::string& path, const ScenePlace& place);
    void add_materials(Entry& entry);
    void add_objects(const Entry& entry, const GltfInstance& instance, const First& first);
    void add_lights(const Scene& file, const GltfInstance& instance, const First& first);
    void add_animation(
        const Animation& animation, const GltfInstance& instance, const First& first);
    void take_camera(const GltfScene& file, const GltfInstance& instance);

    Scene& scene_;
    SceneFiles& files_;
    bool whole_scene_;
    bool has_camera_ = false;
    std::map<std::string, Entry> entries_;  // by path
};

}  // namespace farlight
