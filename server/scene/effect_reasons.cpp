// Reasons, from what shapes are made of down to the camera. Each finds the first thing of its kind.
#include "server/scene/effect_reasons.h"

#include "server/host_guard.h"
#include "server/scene/material_response.h"
#include "server/scene/textures.h"

#include <algorithm>
#include <cstdio>

namespace farlight::effect_reasons {
namespace {

const HostGuard only_the_drawn_calls("only_the_drawn_calls");

/// Shortest of the numbers that people read: "0.02", "1e+06".
std::string shown(double value)
{
    char text[32];
    std::snprintf(text, sizeof text, "%g", value);
    return text;
}

std::string shown(const glm::vec3& v)
{
    return v.x == v.y && v.y == v.z ? shown(v.x) : shown(v.x) + " " + shown(v.y) + " " + shown(v.z);
}

std::string quoted(const std::string& name)
{
    return "'" + name + "'";
}

/// The first object left after packing that `wanted` accepts.
template <typename Wanted>
const Object* first_object(const Scene& scene, const SceneContent& content, const Wanted& wanted)
{
    for (std::size_t i = 0; i < scene.objects.size(); ++i)
        if ((content.is_drawn(i) || !only_the_drawn_calls) && wanted(scene.objects[i]))
            return &scene.objects[i];
    return nullptr;
}

/// "N THINGS, first 'name'"; nothing for none.
template <typename Wanted>
Reason counted(const Scene& scene, const SceneContent& content, std::size_t count,
    const char* things, const Wanted& wanted)
{
    if (count == 0)
        return std::nullopt;
    const Object* first = first_object(scene, content, wanted);
    return std::to_string(count) + " " + things
        + (first == nullptr ? "" : ", first " + quoted(first->name));
}

/// "material 'gold' of 'ring', WHAT" of the first object whose material `wanted` accepts.
template <typename Wanted>
Reason by_material(
    const Scene& scene, const SceneContent& content, const std::string& what, const Wanted& wanted)
{
    const Object* first = first_object(scene, content,
        [&](const Object& object) { return wanted(scene.materials[object.material]); });
    if (first == nullptr)
        return std::nullopt;
    return "material " + quoted(scene.materials[first->material].name) + " of "
        + quoted(first->name) + (what.empty() ? "" : ", " + what);
}

bool is_sphere(const Object& object)
{
    return std::holds_alternative<Sphere>(object.shape);
}
bool is_disk(const Object& object)
{
    return std::holds_alternative<Disk>(object.shape);
}
const Mesh* mesh_of(const Scene& scene, const Object& object)
{
    const auto* instance = std::get_if<MeshInstance>(&object.shape);
    return instance == nullptr ? nullptr : &scene.meshes[instance->mesh];
}
bool emits(const Scene& scene, const Object& object)
{
    return !is_black(scene.materials[object.material].emission);
}

/// "object 'name' DOES", of the object that the packer found to do it.
Reason by_object(const Scene& scene, std::optional<std::uint32_t> object, const char* does)
{
    if (!object)
        return std::nullopt;
    return "object " + quoted(scene.objects[*object].name) + " " + does;
}

/// What a texture says is held above the threshold, so a textured roughness is never sharp.
bool is_sharp(const Material& m)
{
    return !m.metallic_roughness_texture.used() && m.roughness <= kMirrorRoughness;
}

}  // namespace

Reason never(const Scene& /*scene*/, const SceneContent& /*content*/)
{
    return std::nullopt;
}

// ---------------------------------------------------------------- shapes

Reason triangles(const Scene& scene, const SceneContent& content)
{
    return counted(scene, content, content.triangles, "triangles",
        [](const Object& object) { return !is_sphere(object) && !is_disk(object); });
}

Reason spheres(const Scene& scene, const SceneContent& content)
{
    return counted(scene, content, content.spheres, "spheres", is_sphere);
}

Reason disks(const Scene& scene, const SceneContent& content)
{
    return counted(scene, content, content.disks, "discs", is_disk);
}

Reason shading_normals(const Scene& scene, const SceneContent& content)
{
    return counted(
        scene, content, content.smooth_triangles, "smooth triangles", [&](const Object& object) {
            const Mesh* mesh = mesh_of(scene, object);
            return mesh != nullptr && !mesh->normals.empty();
        });
}

Reason instances(const Scene& scene, const SceneContent& content)
{
    if (!content.placed)
        return std::nullopt;
    return std::to_string(content.instances) + " placements, first "
        + quoted(scene.objects[*content.placed].name);
}

Reason motion(const Scene& scene, const SceneContent& content)
{
    return by_object(scene, content.moving, "moves");
}

Reason deformation(const Scene& scene, const SceneContent& content)
{
    return by_object(scene, content.deforming, "changes its shape");
}

// ---------------------------------------------------------------- lights

Reason lights(const Scene& scene, const SceneContent& content)
{
    for (const auto& reason : {polygon_lights, sphere_lights, disk_lights, emissive_meshes,
             delta_lights, environment_map})
        if (Reason found = reason(scene, content))
            return found;
    return std::nullopt;
}

Reason polygon_lights(const Scene& scene, const SceneContent& content)
{
    return counted(
        scene, content, content.polygon_lights, "emissive quads", [&](const Object& object) {
            return std::holds_alternative<Quad>(object.shape) && emits(scene, object);
        });
}

Reason sphere_lights(const Scene& scene, const SceneContent& content)
{
    return counted(scene, content, content.sphere_lights, "emissive spheres",
        [&](const Object& object) { return is_sphere(object) && emits(scene, object); });
}

Reason disk_lights(const Scene& scene, const SceneContent& content)
{
    return counted(scene, content, content.disk_lights, "emissive discs",
        [&](const Object& object) { return is_disk(object) && emits(scene, object); });
}

Reason emissive_meshes(const Scene& scene, const SceneContent& content)
{
    return counted(scene, content, content.emissive_triangles, "emissive triangles",
        [&](const Object& object) {
            return mesh_of(scene, object) != nullptr && emits(scene, object);
        });
}

Reason delta_lights(const Scene& scene, const SceneContent& /*content*/)
{
    static constexpr const char* kKinds[] = {"point", "spot", "directional"};
    for (const PunctualLight& light : scene.lights)
        if (!is_black(light.intensity))
            return std::string(kKinds[static_cast<std::size_t>(light.kind)]) + " light "
                + quoted(light.name) + ", intensity " + shown(light.intensity);
    return std::nullopt;
}

Reason light_tree(const Scene& /*scene*/, const SceneContent& content)
{
    if (content.light_tree_nodes == 0)
        return std::nullopt;
    return std::to_string(content.light_tree_nodes) + " nodes over the lights";
}

Reason background(const Scene& scene, const SceneContent& /*content*/)
{
    if (is_black(scene.background))
        return std::nullopt;
    return "background radiance " + shown(scene.background)
        + (scene.environment ? " times a map" : "");
}

Reason environment_map(const Scene& scene, const SceneContent& /*content*/)
{
    if (!scene.environment || is_black(scene.background))
        return std::nullopt;
    return "environment " + quoted(scene.environment->file) + ", "
        + std::to_string(scene.environment->width) + "x"
        + std::to_string(scene.environment->height);
}

// ---------------------------------------------------------------- materials

Reason textures(const Scene& scene, const SceneContent& content)
{
    const Texture* first = nullptr;
    Reason reason = by_material(scene, content, "", [&](const Material& material) {
        each_texture(material, [&](const Texture& texture, TexelSpace /*space*/) {
            if (first == nullptr && texture.used())
                first = &texture;
        });
        return first != nullptr;
    });
    if (reason)
        *reason += ", image " + quoted(scene.images[first->image].name);
    return reason;
}

Reason second_uvs(const Scene& scene, const SceneContent& content)
{
    return by_material(scene, content, "texture of uv set 1", [](const Material& material) {
        bool second = false;
        each_texture(material, [&](const Texture& texture, TexelSpace /*space*/) {
            second = second || (texture.used() && texture.uv_set == 1);
        });
        return second;
    });
}

Reason normal_maps(const Scene& scene, const SceneContent& content)
{
    return by_material(scene, content, "normal map", [](const Material& m) {
        return m.normal_texture.used() || m.clearcoat_normal_texture.used();
    });
}

Reason vertex_colors(const Scene& scene, const SceneContent& content)
{
    const Object* first = first_object(scene, content, [&](const Object& object) {
        const Mesh* mesh = mesh_of(scene, object);
        return mesh != nullptr && !mesh->colors.empty();
    });
    return first == nullptr ? Reason() : "object " + quoted(first->name);
}

Reason rough_reflection(const Scene& scene, const SceneContent& content)
{
    return by_material(scene, content, "rough reflection", [](const Material& m) {
        return !m.unlit && (m.metallic > 0 || m.specular > 0) && !is_sharp(m);
    });
}

Reason mirror(const Scene& scene, const SceneContent& content)
{
    return by_material(scene, content, "sharp reflection", [](const Material& m) {
        return !m.unlit && (m.metallic > 0 || m.specular > 0) && is_sharp(m);
    });
}

Reason clearcoat(const Scene& scene, const SceneContent& content)
{
    return by_material(
        scene, content, "clearcoat", [](const Material& m) { return !m.unlit && m.clearcoat > 0; });
}

Reason dielectric(const Scene& scene, const SceneContent& content)
{
    return by_material(scene, content, "transmits light",
        [](const Material& m) { return !m.unlit && m.transmission > 0; });
}

Reason rough_dielectric(const Scene& scene, const SceneContent& content)
{
    return by_material(scene, content, "transmits light roughly",
        [](const Material& m) { return !m.unlit && m.transmission > 0 && !is_sharp(m); });
}

Reason unlit(const Scene& scene, const SceneContent& content)
{
    return by_material(scene, content, "unlit", [](const Material& m) { return m.unlit; });
}

Reason alpha(const Scene& scene, const SceneContent& content)
{
    return by_material(scene, content, "not opaque",
        [](const Material& m) { return m.alpha_mode != AlphaMode::kOpaque; });
}

Reason specular_signal(const Scene& scene, const SceneContent& content)
{
    return by_material(scene, content, "glossy", is_glossy);
}

// ---------------------------------------------------------------- medium, camera

Reason fog(const Scene& scene, const SceneContent& /*content*/)
{
    const glm::vec3 sigma_t = scene.medium.sigma_a + scene.medium.sigma_s;
    if (is_black(sigma_t))
        return std::nullopt;
    return "medium " + quoted(scene.medium.name) + ", sigma_t " + shown(sigma_t) + " 1/m";
}

Reason lens(const Scene& scene, const SceneContent& /*content*/)
{
    if (!(scene.lens.radius > 0))
        return std::nullopt;
    return "aperture of radius " + shown(scene.lens.radius) + " m";
}

}  // namespace farlight::effect_reasons
