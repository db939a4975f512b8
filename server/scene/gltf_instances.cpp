// Indices of a file become indices of the scene; what hung in the file's world hangs on the
// instance's node or lies in its frame.
#include "server/scene/gltf_instances.h"

#include "server/scene/material_textures.h"
#include "server/scene/scene_json_values.h"

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>

namespace farlight {

namespace {

template <typename T> std::uint32_t count(const std::vector<T>& list)
{
    return static_cast<std::uint32_t>(list.size());
}

glm::dvec3 moved(const glm::dmat4& to_from, const glm::dvec3& point)
{
    return to_from * glm::dvec4(point, 1);
}

/// The same direction where the frame changes none, or squeezes it to nothing.
glm::dvec3 turned(const glm::dmat4& to_from, const glm::dvec3& direction)
{
    if (glm::dmat3(to_from) == glm::dmat3(1))
        return direction;
    const glm::dvec3 turned = glm::dmat3(to_from) * direction;
    const double length = glm::length(turned);
    return length > 0 ? turned / length : direction;
}

/// A material of the file, or what the scene has put in its place.
std::uint32_t material_of(const Material& material, std::uint32_t own, const GltfInstance& instance)
{
    if (instance.material)
        return *instance.material;
    const auto other = instance.material_by_name.find(material.name);
    return other != instance.material_by_name.end() ? other->second : own;
}

void check_names(const Scene& file, const GltfInstance& instance, const ScenePlace& place)
{
    std::vector<std::string> names;
    for (const Material& material : file.materials)
        names.push_back(material.name);
    for (const auto& replaced : instance.material_by_name)
        if (std::find(names.begin(), names.end(), replaced.first) == names.end())
            refuse(place / "materials" / replaced.first, "a name that no material of the file has",
                one_of(names, "the file's materials"));
}

}  // namespace

GltfInstances::GltfInstances(Scene& scene, SceneFiles& files, bool whole_scene)
    : scene_(scene)
    , files_(files)
    , whole_scene_(whole_scene)
{
}

void GltfInstances::add(const GltfInstance& instance, const ScenePlace& place)
{
    Entry& found = entry(instance.path, place / "mesh" / "file");
    const Scene& file = found.file->scene;
    check_names(file, instance, place);
    if (!instance.material)
        add_materials(found);
    const First first{count(scene_.objects), count(scene_.animation.nodes),
        count(scene_.animation.skins),
        glm::translate(glm::dmat4(1), -instance.carrier.origin) * instance.world_from_file};
    add_objects(found, instance, first);
    add_lights(file, instance, first);
    add_animation(file.animation, instance, first);
    take_camera(*found.file, instance);
}

GltfInstances::Entry& GltfInstances::entry(const std::string& path, const ScenePlace& place)
{
    const auto known = entries_.find(path);
    if (known != entries_.end())
        return known->second;
    Entry& entry = entries_[path];
    entry.file = files_.gltf(path, place);
    const Scene& file = entry.file->scene;
    entry.first_mesh = count(scene_.meshes);
    scene_.meshes.insert(scene_.meshes.end(), file.meshes.begin(), file.meshes.end());
    for (const std::string& note : file.notes)
        scene_.notes.push_back(whole_scene_ ? note : std::string(path).append(": ").append(note));
    if (whole_scene_)
        scene_.name = file.name;
    return entry;
}

void GltfInstances::add_materials(Entry& entry)
{
    if (entry.first_material)
        return;
    const Scene& file = entry.file->scene;
    const std::uint32_t first_image = count(scene_.images);
    scene_.images.insert(scene_.images.end(), file.images.begin(), file.images.end());
    entry.first_material = count(scene_.materials);
    for (const Material& material : file.materials)
        for (Texture* texture : textures_of(scene_.materials.emplace_back(material)))
            if (texture->used())
                texture->image += first_image;
}

void GltfInstances::add_objects(
    const Entry& entry, const GltfInstance& instance, const First& first)
{
    const Scene& file = entry.file->scene;
    for (const Object& part : file.objects) {
        Object& added = scene_.objects.emplace_back(part);
        if (!instance.name.empty() && file.objects.size() == 1)
            added.name = instance.name;
        else if (!instance.name.empty())
            added.name = std::string(instance.name).append("/").append(part.name);
        added.material = material_of(file.materials[part.material],
            entry.first_material.value_or(0) + part.material, instance);
        auto& shape = std::get<MeshInstance>(added.shape);
        shape.mesh += entry.first_mesh;
        if (shape.skin != kNone)
            shape.skin += first.skin;
        if (part.node != kNone) {
            added.node = part.node + first.node;
        } else {
            added.node = instance.carrier.node;
            shape.world_from_object = first.carrier_from_file * shape.world_from_object;
        }
    }
}

void GltfInstances::add_lights(const Scene& file, const GltfInstance& instance, const First& first)
{
    for (const PunctualLight& light : file.lights) {
        PunctualLight& added = scene_.lights.emplace_back(light);
        if (!instance.name.empty())
            added.name = std::string(instance.name).append("/").append(light.name);
        if (light.node != kNone) {
            added.node = light.node + first.node;
            continue;
        }
        added.node = instance.carrier.node;
        added.position = moved(first.carrier_from_file, light.position);
        added.direction = turned(first.carrier_from_file, light.direction);
    }
}

void GltfInstances::add_animation(
    const Animation& animation, const GltfInstance& instance, const First& first)
{
    Animation& into = scene_.animation;
    for (const Node& node : animation.nodes) {
        Node& added = into.nodes.emplace_back(node);
        if (node.parent != kNone) {
            added.parent = node.parent + first.node;
        } else {
            added.parent = instance.carrier.node;
            added.local = first.carrier_from_file * node.local;
        }
    }
    for (const Skin& skin : animation.skins)
        for (std::uint32_t& joint : into.skins.emplace_back(skin).joints)
            joint += first.node;
    for (const Track& track : animation.tracks) {
        const bool of_object = track.target == Track::Target::kMorphWeights;
        into.tracks.emplace_back(track).index += of_object ? first.object : first.node;
    }
}

void GltfInstances::take_camera(const GltfScene& file, const GltfInstance& instance)
{
    if (has_camera_ || !file.has_camera)
        return;
    has_camera_ = true;
    const auto placed = [&](CameraPose pose) {
        pose.position = moved(instance.world_from_file, pose.position);
        pose.target = moved(instance.world_from_file, pose.target);
        pose.up = turned(instance.world_from_file, pose.up);
        return pose;
    };
    scene_.camera = placed(file.scene.camera);
    if (!whole_scene_)  // which has no paths of its own
        return;
    for (const auto& [name, keyframes] : file.scene.camera_paths)
        for (const CameraKeyframe& keyframe : keyframes)
            scene_.camera_paths[name].push_back({keyframe.frame, placed(keyframe.pose)});
}

}  // namespace farlight
