// What server/scene/scene_file.h promises of every scene, checked one by one.
#include "tests/scene/fuzz/scene_input.h"

#include "server/gl/gl_error.h"
#include "server/scene/camera_limits.h"
#include "server/scene/gltf_file.h"
#include "server/scene/material_textures.h"
#include "server/scene/neutral.h"
#include "server/scene/packed_scene.h"
#include "server/scene/scene_defaults.h"
#include "server/scene/scene_file.h"
#include "server/scene/scene_json.h"

#include <algorithm>
#include <cmath>

namespace farlight {

namespace {

class Promise {
public:
    explicit Promise(const Scene& scene) : scene_(scene) { }

    std::string broken()
    {
        for (const Mesh& mesh : scene_.meshes)
            check_mesh(mesh);
        for (Material material : scene_.materials)
            check_material(material);
        for (const Object& object : scene_.objects)
            check_object(object);
        for (const PunctualLight& light : scene_.lights) {
            expect(below(light.node, scene_.animation.nodes.size(), true), "a light's node");
            expect(finite(light.intensity), "a light's intensity");
            expect(finite(light.position) && finite(light.direction), "a light's place");
        }
        for (const Image8& image : scene_.images)
            expect(image.texels.size() == std::size_t(image.width) * image.height, "an image");
        check_animation(scene_.animation);
        check_pose(scene_.camera);
        for (const auto& [name, path] : scene_.camera_paths) {
            expect(!path.empty(), "a camera path's length");
            for (const CameraKeyframe& keyframe : path)
                check_pose(keyframe.pose);
        }
        return broken_;
    }

private:
    void expect(bool holds, const char* what)
    {
        if (!holds && broken_.empty())
            broken_ = what;
    }

    template <typename Vector> static bool finite(const Vector& v)
    {
        for (int i = 0; i < Vector::length(); ++i)
            if (!std::isfinite(v[i]))
                return false;
        return true;
    }

    static bool finite(const glm::dmat4& m)
    {
        return finite(m[0]) && finite(m[1]) && finite(m[2]) && finite(m[3]);
    }

    static bool below(std::uint32_t index, std::size_t count, bool none_will_do = false)
    {
        return index < count || (none_will_do && index == kNone);
    }

    template <typename T>
    void check_list(const std::vector<T>& list, std::size_t count, const char* what)
    {
        expect(list.empty() || list.size() == count, what);
        expect(std::all_of(list.begin(), list.end(), [](const T& v) { return finite(v); }), what);
    }

    void check_pose(const CameraPose& pose)
    {
        expect(finite(pose.position) && finite(pose.target) && finite(pose.up), "a camera");
        expect(pose.position != pose.target, "a camera's target");
        expect(
            pose.vertical_fov_degrees >= kNarrowestFov && pose.vertical_fov_degrees <= kWidestFov,
            "a camera's field of view");
    }

    void check_mesh(const Mesh& mesh)
    {
        const std::size_t count = mesh.positions.size();
        expect(!mesh.triangles.empty(), "a mesh without triangles");
        for (const glm::uvec3& t : mesh.triangles)
            expect(std::max({t.x, t.y, t.z}) < count, "a triangle's corner");
        check_list(mesh.positions, count, "positions");
        check_list(mesh.normals, count, "normals");
        check_list(mesh.uvs[0], count, "uvs");
        check_list(mesh.uvs[1], count, "uvs of set 1");
        check_list(mesh.tangents, count, "tangents");
        check_list(mesh.colors, count, "colours");
        check_list(mesh.weights, count, "weights");
        expect(mesh.joints.size() == mesh.weights.size(), "joints");
        for (const MorphTarget& target : mesh.morph_targets) {
            check_list(target.positions, count, "a morph target's positions");
            check_list(target.normals, count, "a morph target's normals");
        }
    }

    void check_material(Material& material)
    {
        for (const Texture* texture : textures_of(material)) {
            expect(below(texture->image, scene_.images.size(), true), "a texture's image");
            expect(texture->uv_set <= 1, "a texture's uv set");
            expect(finite(texture->image_from_uv[0]) && finite(texture->image_from_uv[1])
                    && finite(texture->image_from_uv[2]),
                "a texture's transform");
        }
        expect(finite(material.albedo) && finite(material.emission) && finite(material.absorption)
                && finite(material.specular_color),
            "a material's colours");
        expect(
            finite(glm::vec4(material.opacity, material.metallic, material.roughness, material.ior))
                && finite(glm::vec4(material.specular, material.transmission, material.clearcoat,
                    material.normal_scale))
                && std::isfinite(material.clearcoat_normal_scale),
            "a material's factors");
    }

    void check_object(const Object& object)
    {
        expect(below(object.material, scene_.materials.size()), "an object's material");
        expect(below(object.node, scene_.animation.nodes.size(), true), "an object's node");
        const auto* instance = std::get_if<MeshInstance>(&object.shape);
        if (instance == nullptr)
            return;
        expect(below(instance->mesh, scene_.meshes.size()), "an instance's mesh");
        expect(below(instance->skin, scene_.animation.skins.size(), true), "an instance's skin");
        expect(finite(instance->world_from_object), "an instance's transform");
        if (!broken_.empty())
            return;
        const Mesh& mesh = scene_.meshes[instance->mesh];
        expect(instance->morph_weights.size() == mesh.morph_targets.size(), "morph weights");
        if (instance->skin == kNone)
            return;
        const std::size_t joints = scene_.animation.skins[instance->skin].joints.size();
        expect(!mesh.joints.empty(), "a skinned mesh's joints");
        for (const glm::u16vec4& vertex : mesh.joints)
            expect(std::max({vertex.x, vertex.y, vertex.z, vertex.w}) < joints, "a joint");
    }

    void check_animation(const Animation& animation)
    {
        for (std::size_t i = 0; i < animation.nodes.size(); ++i) {
            expect(below(animation.nodes[i].parent, i, true), "a node's parent");
            expect(finite(animation.nodes[i].local), "a node's matrix");
        }
        for (const Skin& skin : animation.skins) {
            expect(skin.joint_from_mesh.size() == skin.joints.size(), "a skin's matrices");
            for (const std::uint32_t joint : skin.joints)
                expect(below(joint, animation.nodes.size()), "a skin's joint");
        }
        for (const Track& track : animation.tracks) {
            expect(!track.times.empty() && track.times.front() >= 0, "a track's times");
            expect(
                std::adjacent_find(track.times.begin(), track.times.end(), std::greater_equal<>())
                    == track.times.end(),
                "a track's order");
            expect(!track.values.empty() && track.values.size() % track.times.size() == 0
                    && std::all_of(track.values.begin(), track.values.end(),
                        [](float value) { return std::isfinite(value); }),
                "a track's values");
        }
    }

    const Scene& scene_;
    std::string broken_;
};

/// Corners of all instances, and texels; keyframes, which are gone through for each track.
std::size_t work_in(const Scene& scene)
{
    std::size_t work = 0;
    for (const Object& object : scene.objects)
        if (const auto* instance = std::get_if<MeshInstance>(&object.shape))
            work += 3 * scene.meshes[instance->mesh].triangles.size();
    for (const Image8& image : scene.images)
        work += image.texels.size();
    for (const Track& track : scene.animation.tracks)
        work += track.times.size();
    return work;
}

/// All that is done with a scene before a device is asked for. What breaks there is an assertion's.
std::string packed(Scene scene)
{
    constexpr std::size_t kMostWork = 100'000;  // of which fuzzing does many a second
    if (work_in(scene) > kMostWork)
        return "loaded";
    drop_neutral(scene);
    try {
        PackedScene packed = pack_scene(scene, {.size = 2048, .layers = 64});
        packed.moving->pose(0.5, 0.25);
        packed.lights->update(
            packed.moving->lights(), {.world_from_node = packed.moving->world_from_node()});
        return "loaded";
    } catch (const GlError&) {
        return "refused";  // more than a device's limits
    }
}

/// As a scene that is nothing but this file.
Scene shown(GltfScene file)
{
    check_extent(file.scene);
    if (!file.has_camera)
        add_framing_camera(file.scene);
    add_default_light(file.scene);
    return std::move(file.scene);
}

}  // namespace

std::string broken_promise(const Scene& scene)
{
    return Promise(scene).broken();
}

std::string load_input(SceneFormat format, std::string_view bytes)
{
    const std::filesystem::path folder = std::filesystem::path(FARLIGHT_SOURCE_DIR) / "scenes";
    try {
        const Scene scene = format == SceneFormat::kJson
            ? parse_scene(bytes, folder, "input.json")
            : shown(parse_gltf(std::string(bytes), folder / "input.glb"));
        const std::string broken = broken_promise(scene);
        return broken.empty() ? packed(scene) : broken;
    } catch (const SceneError&) {
        return "refused";
    }
}

}  // namespace farlight
