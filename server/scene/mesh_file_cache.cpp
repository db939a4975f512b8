// Merging a glTF file into a scene.
#include "server/scene/mesh_file_cache.h"

#include "server/scene/material_textures.h"

#include <iterator>

namespace farlight {

namespace {

/// Loads, and says which object asked if that fails.
Scene load_for(const std::filesystem::path& file, const std::string& path, const ScenePlace& place)
{
    if (!is_gltf(file))
        refuse(place, in_quotes(path), "the path of a .gltf or .glb file");
    if (!std::filesystem::exists(file))
        refuse(place, in_quotes(path) + ", and no such file", "a .gltf or .glb file");
    try {
        return load_gltf(file).scene;
    } catch (const SceneError& error) {
        throw SceneError(place.file + ": " + place.pointer + ": in " + error.what());
    }
}

}  // namespace

MeshFileCache::MeshFileCache(std::filesystem::path base_dir) : base_dir_(std::move(base_dir)) { }

MeshFileCache::Entry& MeshFileCache::entry(
    Scene& scene, const std::string& path, const ScenePlace& place)
{
    const auto known = entries_.find(path);
    if (known != entries_.end())
        return known->second;
    Scene loaded = load_for(base_dir_ / path, path, place);
    Entry& entry = entries_[path];
    entry.objects = std::move(loaded.objects);
    entry.materials = std::move(loaded.materials);
    entry.images = std::move(loaded.images);
    entry.first_mesh = static_cast<std::uint32_t>(scene.meshes.size());
    std::move(loaded.meshes.begin(), loaded.meshes.end(), std::back_inserter(scene.meshes));
    for (const std::string& note : loaded.notes)
        scene.notes.push_back(std::string(path).append(": ").append(note));
    return entry;
}

void MeshFileCache::add_instances(
    Scene& scene, const MeshFileObject& object, const ScenePlace& place)
{
    Entry& file = entry(scene, object.path, place);
    if (!object.material && !file.first_material) {
        file.first_material = static_cast<std::uint32_t>(scene.materials.size());
        const auto first_image = static_cast<std::uint32_t>(scene.images.size());
        for (Material& material : file.materials) {
            for (Texture* texture : textures_of(material))
                if (texture->used())
                    texture->image += first_image;
            scene.materials.push_back(std::move(material));
        }
        std::move(file.images.begin(), file.images.end(), std::back_inserter(scene.images));
    }
    for (const Object& part : file.objects) {
        Object added = part;
        if (file.objects.size() == 1)
            added.name = object.name;
        else
            added.name = std::string(object.name).append("/").append(part.name);
        added.material = object.material ? *object.material : *file.first_material + part.material;
        auto& instance = std::get<MeshInstance>(added.shape);
        instance.mesh += file.first_mesh;
        instance.world_from_object = object.world_from_file * instance.world_from_object;
        scene.objects.push_back(std::move(added));
    }
}

}  // namespace farlight
