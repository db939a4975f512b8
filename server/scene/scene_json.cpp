// Reads a document that fits the schema; what a schema cannot say is checked here.
#include "server/scene/scene_json.h"

#include "server/scene/camera_limits.h"
#include "server/scene/json_schema.h"
#include "server/scene/mesh_file_cache.h"
#include "server/scene/mesh_repair.h"
#include "server/scene/scene_defaults.h"
#include "server/scene/scene_error.h"

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <optional>

namespace farlight {

namespace {

using Json = nlohmann::json;

glm::dvec3 vec3(const Json& value)
{
    return {value[0].get<double>(), value[1].get<double>(), value[2].get<double>()};
}

glm::dvec3 vec3_or(const Json& object, const char* key, const glm::dvec3& fallback)
{
    const auto found = object.find(key);
    return found == object.end() ? fallback : vec3(*found);
}

/// Turns about x, then y, then z.
glm::dmat4 rotation(const Json& object)
{
    const glm::dvec3 angles = glm::radians(vec3_or(object, "rotation_degrees", glm::dvec3(0)));
    const glm::dmat4 about_x = glm::rotate(glm::dmat4(1), angles.x, {1, 0, 0});
    const glm::dmat4 about_y = glm::rotate(glm::dmat4(1), angles.y, {0, 1, 0});
    const glm::dmat4 about_z = glm::rotate(glm::dmat4(1), angles.z, {0, 0, 1});
    return about_z * about_y * about_x;
}

/// Scale, then rotation, then translation.
glm::dmat4 world_from_object(const Json& object)
{
    const glm::dmat4 move =
        glm::translate(glm::dmat4(1), vec3_or(object, "translation", glm::dvec3(0)));
    const glm::dmat4 stretch = glm::scale(glm::dmat4(1), vec3_or(object, "scale", glm::dvec3(1)));
    return move * rotation(object) * stretch;
}

CameraPose read_pose(const Json& value, const CameraPose& before, const ScenePlace& place)
{
    CameraPose pose;
    pose.position = vec3_or(value, "position", before.position);
    pose.target = vec3_or(value, "target", before.target);
    pose.up = vec3_or(value, "up", before.up);
    pose.vertical_fov_degrees = value.value("vertical_fov_degrees", before.vertical_fov_degrees);
    if (value.contains("up") && pose.up == glm::dvec3(0))
        refuse(place / "up", describe(value["up"]), "a direction: not all three 0");
    if (!(glm::length(pose.target - pose.position) > nearest_target(pose.position, pose.target)))
        refuse(place / (value.contains("target") ? "target" : "position"),
            "a camera that stands on its target", "a target away from position");
    return pose;
}

class Reader {
public:
    Reader(const Json& document, const std::filesystem::path& base_dir, const std::string& name)
        : document_(document)
        , root_{name, {}}
        , mesh_files_(base_dir)
    {
        scene_.file = name;
    }

    Scene read()
    {
        scene_.name = document_.value("name", "");
        scene_.background = vec3_or(document_, "background", glm::dvec3(0));
        read_materials();
        const Json& objects = document_["objects"];
        for (std::size_t i = 0; i < objects.size(); ++i)
            read_object(objects[i], root_ / "objects" / i);
        for (std::string& note : repairs_.notes())
            scene_.notes.push_back(std::move(note));
        if (document_.contains("camera"))
            scene_.camera = read_pose(document_["camera"], CameraPose{}, root_ / "camera");
        else
            add_framing_camera(scene_);
        if (document_.contains("camera_paths"))
            for (const auto& [name, keyframes] : document_["camera_paths"].items())
                scene_.camera_paths[name] = read_path(keyframes, root_ / "camera_paths" / name);
        return std::move(scene_);
    }

private:
    void read_materials();
    void read_object(const Json& value, const ScenePlace& place);
    std::uint32_t material_of(const Json& object, const ScenePlace& place) const;
    Quad read_quad(const Json& value, const ScenePlace& place) const;
    MeshInstance read_box(const Json& value, const ScenePlace& place);
    MeshInstance read_mesh(const Json& value, const std::string& name, const ScenePlace& place);
    std::vector<CameraKeyframe> read_path(const Json& value, const ScenePlace& place) const;

    const Json& document_;
    ScenePlace root_;
    Scene scene_;
    std::map<std::string, std::uint32_t> material_by_name_;  // those of the document itself
    MeshFileCache mesh_files_;
    MeshRepairs repairs_;
    std::optional<std::uint32_t> cube_;  // the mesh that all boxes share
};

void Reader::read_materials()
{
    if (!document_.contains("materials"))
        return;
    for (const auto& [name, value] : document_["materials"].items()) {
        material_by_name_[name] = static_cast<std::uint32_t>(scene_.materials.size());
        Material& material = scene_.materials.emplace_back();
        material.name = name;
        material.albedo = vec3_or(value, "albedo", material.albedo);
        material.emission = vec3_or(value, "emission", material.emission);
        material.emits_both_sides = value.value("emits_both_sides", false);
    }
}

std::uint32_t Reader::material_of(const Json& object, const ScenePlace& place) const
{
    if (!object.contains("material"))
        refuse(place, "no key \"material\"", "the name of one of /materials");
    const auto& name = object["material"].get_ref<const std::string&>();
    const auto known = material_by_name_.find(name);
    if (known != material_by_name_.end())
        return known->second;
    std::string names;
    for (const auto& [declared, index] : material_by_name_)
        names += (names.empty() ? "" : ", ") + declared;
    refuse(place / "material", "the unknown material " + in_quotes(name),
        names.empty() ? "one of /materials, which has none" : "one of " + names);
}

void Reader::read_object(const Json& value, const ScenePlace& place)
{
    const std::size_t index = scene_.objects.size();
    const std::string name = value.value("name", "object " + std::to_string(index));
    if (value.contains("mesh") && value["mesh"].contains("file")) {
        const Json& mesh = value["mesh"];
        std::optional<std::uint32_t> material;
        if (value.contains("material"))
            material = material_of(value, place);
        mesh_files_.add_instances(scene_,
            {name, mesh["file"].get<std::string>(), material, world_from_object(mesh)},
            place / "mesh" / "file");
        return;
    }
    Object object{name, material_of(value, place), {}};
    if (value.contains("sphere"))
        object.shape =
            Sphere{vec3(value["sphere"]["center"]), value["sphere"]["radius"].get<double>()};
    else if (value.contains("quad"))
        object.shape = read_quad(value["quad"], place / "quad");
    else if (value.contains("box"))
        object.shape = read_box(value["box"], place / "box");
    else
        object.shape = read_mesh(value["mesh"], name, place / "mesh");
    scene_.objects.push_back(std::move(object));
}

Quad Reader::read_quad(const Json& value, const ScenePlace& place) const
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

MeshInstance Reader::read_box(const Json& value, const ScenePlace& place)
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
    if (!cube_) {
        cube_ = static_cast<std::uint32_t>(scene_.meshes.size());
        scene_.meshes.push_back(unit_cube());
    }
    const glm::dmat4 move = glm::translate(glm::dmat4(1), center);
    return {*cube_, glm::scale(move * rotation(value), size)};
}

MeshInstance Reader::read_mesh(const Json& value, const std::string& name, const ScenePlace& place)
{
    Mesh mesh{.name = name};
    for (const Json& position : value["positions"])
        mesh.positions.emplace_back(vec3(position));
    if (value.contains("normals")) {
        for (const Json& normal : value["normals"])
            mesh.normals.emplace_back(vec3(normal));
        if (mesh.normals.size() != mesh.positions.size())
            refuse(place / "normals", std::to_string(mesh.normals.size()) + " normals",
                std::to_string(mesh.positions.size()) + ", one a position");
    }
    const Json& triangles = value["triangles"];
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        for (std::size_t corner = 0; corner < 3; ++corner)
            if (triangles[i][corner].get<std::uint64_t>() >= mesh.positions.size())
                refuse(place / "triangles" / i / corner, "index " + triangles[i][corner].dump(),
                    "less than " + std::to_string(mesh.positions.size())
                        + ", the number of positions");
        mesh.triangles.emplace_back(triangles[i][0].get<std::uint32_t>(),
            triangles[i][1].get<std::uint32_t>(), triangles[i][2].get<std::uint32_t>());
    }
    repairs_ += repair_mesh(mesh);
    if (mesh.triangles.empty())
        refuse(place / "triangles", "no triangle that has an area", "at least one");
    const auto index = static_cast<std::uint32_t>(scene_.meshes.size());
    scene_.meshes.push_back(std::move(mesh));
    return {index, world_from_object(value)};
}

std::vector<CameraKeyframe> Reader::read_path(const Json& value, const ScenePlace& place) const
{
    std::vector<CameraKeyframe> path;
    CameraPose pose = scene_.camera;
    for (std::size_t i = 0; i < value.size(); ++i) {
        const double frame = value[i]["frame"].get<double>();
        if (!path.empty() && !(frame > path.back().frame))
            refuse(place / i / "frame", "frame " + value[i]["frame"].dump(),
                "more than the keyframe before, " + value[i - 1]["frame"].dump());
        pose = read_pose(value[i], pose, place / i);
        path.push_back({frame, pose});
    }
    return path;
}

}  // namespace

Scene scene_from_json(
    const Json& document, const std::filesystem::path& base_dir, const std::string& name)
{
    check_schema(document, farlight_scene_schema(), name);
    return Reader(document, base_dir, name).read();
}

}  // namespace farlight
