// Shapes, in world space or around the node that carries them.
#include "server/scene/scene_json_object.h"

#include "server/scene/material_textures.h"
#include "server/scene/mesh_tangents.h"
#include "server/scene/scene_json_mesh.h"
#include "server/scene/scene_json_values.h"

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>

namespace farlight {

namespace {

using Json = nlohmann::json;

Sphere read_sphere(const Json& value)
{
    return {vec3(value["center"]), value["radius"].get<double>()};
}

Disk read_disk(const Json& value, const ScenePlace& place)
{
    return {vec3(value["center"]), direction_or(value, "normal", {0, 0, 1}, place),
        value["radius"].get<double>()};
}

Quad read_quad(const Json& value, const ScenePlace& place)
{
    const Quad quad{vec3(value["corner"]), vec3(value["edge_u"]), vec3(value["edge_v"])};
    const double area = glm::length(glm::cross(quad.edge_u, quad.edge_v));
    // Edges nearer to parallel than a float can tell have no normal on the GPU.
    const double least =
        std::numeric_limits<float>::epsilon() * glm::length(quad.edge_u) * glm::length(quad.edge_v);
    if (!(area > least))
        refuse(place,
            "a quad of no area: edge_u " + describe(value["edge_u"]) + ", edge_v "
                + describe(value["edge_v"]),
            "edges that are not 0 and not parallel");
    return quad;
}

glm::dvec3 center_of(const Sphere& sphere)
{
    return sphere.center;
}
glm::dvec3 center_of(const Disk& disk)
{
    return disk.center;
}
glm::dvec3 center_of(const Quad& quad)
{
    return quad.corner + 0.5 * (quad.edge_u + quad.edge_v);
}
/// The mesh's own origin; a box's middle.
glm::dvec3 center_of(const MeshInstance& instance)
{
    return instance.world_from_object[3];
}

void recenter(Sphere& sphere, const glm::dvec3& origin)
{
    sphere.center -= origin;
}
void recenter(Disk& disk, const glm::dvec3& origin)
{
    disk.center -= origin;
}
void recenter(Quad& quad, const glm::dvec3& origin)
{
    quad.corner -= origin;
}
void recenter(MeshInstance& instance, const glm::dvec3& origin)
{
    instance.world_from_object[3] -= glm::dvec4(origin, 0);
}

bool is_textured(Material material)
{
    const auto textures = textures_of(material);
    return std::any_of(
        textures.begin(), textures.end(), [](const Texture* texture) { return texture->used(); });
}

/// A normal map lies along tangents: a mesh without any gets those of its uvs.
void prepare(Mesh& mesh, const Material& material)
{
    const Texture* map = normal_map(material);
    if (map != nullptr && mesh.tangents.empty())
        add_tangents(mesh, map->uv_set);
}

}  // namespace

SceneObjects::SceneObjects(
    Scene& scene, const SceneMaterials& materials, SceneMotion& motion, GltfInstances& files)
    : scene_(scene)
    , materials_(materials)
    , motion_(motion)
    , files_(files)
{
}

std::uint32_t SceneObjects::add_mesh(Mesh mesh)
{
    scene_.meshes.push_back(std::move(mesh));
    return static_cast<std::uint32_t>(scene_.meshes.size() - 1);
}

void SceneObjects::read_meshes(const Json& meshes, const ScenePlace& place)
{
    for (const auto& [name, value] : meshes.items())
        mesh_by_name_[name] = add_mesh(read_inline_mesh(value, name, place / name, repairs_));
}

void SceneObjects::read(const Json& objects, const ScenePlace& place)
{
    std::size_t index = 0;
    for (const auto& [key, value] : objects.items()) {
        const std::string fallback = objects.is_array() ? "object " + std::to_string(index) : key;
        const ScenePlace here = objects.is_array() ? place / index : place / key;
        const std::string name = value.value("name", fallback);
        if (value.contains("mesh") && value["mesh"].contains("file"))
            read_file(value, objects.is_array() ? value.value("name", "") : name, here);
        else
            read_object(value, name, here);
        ++index;
    }
}

std::uint32_t SceneObjects::material_of(const Json& object, const ScenePlace& place) const
{
    if (!object.contains("material"))
        refuse(place, "no key \"material\"", "the name of one of /materials");
    return materials_.at(object["material"].get<std::string>(), place / "material");
}

void SceneObjects::read_object(const Json& value, const std::string& name, const ScenePlace& place)
{
    if (value.contains("materials"))
        refuse(place / "materials", "materials for a shape that has one", "a mesh of a file");
    Object object{name, material_of(value, place), {}};
    if (value.contains("sphere"))
        object.shape = read_sphere(value["sphere"]);
    else if (value.contains("disk"))
        object.shape = read_disk(value["disk"], place / "disk");
    else if (value.contains("quad"))
        object.shape = read_quad(value["quad"], place / "quad");
    else if (value.contains("box"))
        object.shape = read_box(value["box"], object.material, place / "box");
    else
        object.shape = read_mesh(value["mesh"], name, place / "mesh");
    if (const auto* instance = std::get_if<MeshInstance>(&object.shape))
        prepare(scene_.meshes[instance->mesh], scene_.materials[object.material]);
    const glm::dvec3 center =
        std::visit([](const auto& shape) { return center_of(shape); }, object.shape);
    const Carrier carrier = motion_.carrier_of({"object", name}, value, center, place);
    if (carrier.node != kNone)
        std::visit([&](auto& shape) { recenter(shape, carrier.origin); }, object.shape);
    object.node = carrier.node;
    scene_.objects.push_back(std::move(object));
}

void SceneObjects::read_file(const Json& value, const std::string& name, const ScenePlace& place)
{
    const Json& mesh = value["mesh"];
    GltfInstance instance{.name = name, .path = mesh["file"].get<std::string>()};
    if (value.contains("material"))
        instance.material = material_of(value, place);
    if (value.contains("materials"))
        for (const auto& [theirs, ours] : value["materials"].items())
            instance.material_by_name[theirs] =
                materials_.at(ours.get<std::string>(), place / "materials" / theirs);
    instance.world_from_file = world_from_object(mesh);
    instance.carrier =
        motion_.carrier_of({"object", name}, value, glm::dvec3(instance.world_from_file[3]), place);
    files_.add(instance, place);
}

MeshInstance SceneObjects::read_box(
    const Json& value, std::uint32_t material, const ScenePlace& place)
{
    glm::dvec3 center;
    glm::dvec3 size;
    if (value.contains("center")) {
        center = vec3(value["center"]);
        size = vec3(value["size"]);
    } else {
        const glm::dvec3 lower = vec3(value["lower"]);
        const glm::dvec3 upper = vec3(value["upper"]);
        if (!glm::all(glm::lessThan(lower, upper)))
            refuse(place / "upper", describe(value["upper"]),
                "more than lower " + describe(value["lower"]) + " on each axis");
        center = 0.5 * (lower + upper);
        size = upper - lower;
    }
    const bool textured = is_textured(scene_.materials[material]);
    std::optional<std::uint32_t>& cube = textured ? cube_with_uvs_ : cube_;
    if (!cube)
        cube = add_mesh(textured ? unit_cube_with_uvs() : unit_cube());
    const glm::dmat4 move = glm::translate(glm::dmat4(1), center);
    return {*cube, glm::scale(move * rotation(value), size)};
}

MeshInstance SceneObjects::read_mesh(
    const Json& value, const std::string& name, const ScenePlace& place)
{
    if (!value.contains("instance_of"))
        return {add_mesh(read_inline_mesh(value, name, place, repairs_)), world_from_object(value)};
    const auto& shared = value["instance_of"].get_ref<const std::string&>();
    const auto known = mesh_by_name_.find(shared);
    if (known != mesh_by_name_.end())
        return {known->second, world_from_object(value)};
    std::vector<std::string> names;
    for (const auto& [declared, index] : mesh_by_name_)
        names.push_back(declared);
    refuse(
        place / "instance_of", "the unknown mesh " + in_quotes(shared), one_of(names, "/meshes"));
}

}  // namespace farlight
