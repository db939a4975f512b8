// Walks the node tree of a glTF file: meshes become instances, the first camera the camera.
#include "server/scene/gltf_file.h"

#include "server/scene/gltf_camera.h"
#include "server/scene/gltf_check.h"
#include "server/scene/gltf_container.h"
#include "server/scene/gltf_draco.h"
#include "server/scene/gltf_extensions.h"
#include "server/scene/gltf_light.h"
#include "server/scene/gltf_material.h"
#include "server/scene/gltf_mesh.h"
#include "server/scene/gltf_node.h"
#include "server/scene/gltf_views.h"
#include "server/scene/mesh_repair.h"
#include "server/scene/mesh_tangents.h"
#include "server/scene/scene_error.h"

#include <algorithm>
#include <map>
#include <optional>

namespace farlight {

namespace {

using Json = nlohmann::json;

/// A primitive as an instance needs it: its mesh, and the mesh with the other winding for
/// instances that mirror, made when one is met.
struct Part {
    std::uint32_t mesh;
    std::optional<std::uint32_t> mirrored_mesh;
    std::uint32_t material;
};

class Reader {
public:
    explicit Reader(GltfContainer& gltf) : gltf_(gltf), root_(gltf.root)
    {
        result_.scene.file = root_.file;
    }

    GltfScene read()
    {
        read_gltf_materials(gltf_, result_.scene);
        read_nodes();
        if (result_.scene.objects.empty())
            refuse(root_ / "scenes", "no mesh of triangles in the scene's nodes", "at least one");
        place_cameras();
        note_the_rest();
        return std::move(result_);
    }

private:
    void read_nodes();
    void read_node(const GltfNode& node);
    void add_part(const GltfNode& node, Part& part, const std::string& name);
    std::vector<Part>& parts_of(std::size_t mesh);
    std::uint32_t default_material();
    void add_light(const GltfNode& node, const Json& index);
    void place_cameras();
    void note_the_rest();

    GltfContainer& gltf_;
    ScenePlace root_;
    GltfScene result_;
    std::map<std::size_t, std::vector<Part>> parts_;  // by glTF mesh
    std::optional<std::uint32_t> default_material_;
    std::vector<GltfNode> camera_nodes_;
    std::size_t changed_lights_ = 0;
    std::size_t flat_lights_ = 0;  // whose transform leaves no direction
    MeshRepairs repairs_;
    std::size_t skipped_primitives_ = 0;  // points and lines
    std::size_t flat_instances_ = 0;  // whose transform has no volume
};

void Reader::read_nodes()
{
    const auto scene = gltf_.document.value("scene", std::size_t(0));
    result_.scene.name = gltf_.list("scenes")[scene].value("name", "");
    if (result_.scene.name.empty())
        result_.scene.name = std::filesystem::path(root_.file).stem().string();
    for (const GltfNode& node : gltf_nodes(gltf_, scene))
        read_node(node);
}

void Reader::read_node(const GltfNode& node)
{
    const Json& found = gltf_.list("nodes")[node.index];
    if (found.contains("camera"))
        camera_nodes_.push_back(node);
    if (const Json* light = gltf_extension(found, "KHR_lights_punctual"))
        add_light(node, (*light)["light"]);
    if (!found.contains("mesh"))
        return;
    const auto mesh = found["mesh"].get<std::size_t>();
    std::string name = found.value("name", "");
    if (name.empty())
        name = gltf_.list("meshes")[mesh].value("name", "");
    if (name.empty())
        name = "node " + std::to_string(node.index);
    std::vector<Part>& parts = parts_of(mesh);
    for (std::size_t i = 0; i < parts.size(); ++i)
        add_part(node, parts[i],
            parts.size() == 1 ? name : std::string(name).append("/") + std::to_string(i));
}

void Reader::add_part(const GltfNode& node, Part& part, const std::string& name)
{
    const glm::dmat3 linear(node.world_from_node);
    const double volume = glm::determinant(linear);
    // What a float keeps of the axes' lengths: below it, the instance has no inverse on the GPU.
    const double least = std::numeric_limits<float>::epsilon() * glm::length(linear[0])
        * glm::length(linear[1]) * glm::length(linear[2]);
    if (!(std::abs(volume) > least)) {
        ++flat_instances_;
        return;
    }
    std::uint32_t mesh = part.mesh;
    if (volume < 0) {
        if (!part.mirrored_mesh) {
            part.mirrored_mesh = static_cast<std::uint32_t>(result_.scene.meshes.size());
            result_.scene.meshes.push_back(rewound(result_.scene.meshes[part.mesh]));
        }
        mesh = *part.mirrored_mesh;
    }
    result_.scene.objects.push_back(
        {name, part.material, MeshInstance{mesh, node.world_from_node}});
}

std::vector<Part>& Reader::parts_of(std::size_t mesh)
{
    const auto [entry, is_new] = parts_.try_emplace(mesh);
    if (!is_new)
        return entry->second;
    const ScenePlace place = root_ / "meshes" / mesh / "primitives";
    const Json& found = gltf_.list("meshes")[mesh];
    const Json& primitives = found["primitives"];
    for (std::size_t i = 0; i < primitives.size(); ++i) {
        const Json& primitive = primitives[i];
        if (!has_triangles(primitive)) {
            ++skipped_primitives_;
            continue;
        }
        const std::uint32_t material = primitive.contains("material")
            ? primitive["material"].get<std::uint32_t>()
            : default_material();
        unpack_gltf_draco(gltf_, primitive, place / i);
        Mesh read = read_gltf_primitive(gltf_, primitive, place / i, repairs_);
        read.name = found.value("name", "");
        if (const Texture* normals = normal_map(result_.scene.materials[material]);
            normals != nullptr && read.tangents.empty())
            add_tangents(read, normals->uv_set);
        entry->second.push_back(
            {static_cast<std::uint32_t>(result_.scene.meshes.size()), {}, material});
        result_.scene.meshes.push_back(std::move(read));
    }
    return entry->second;
}

std::uint32_t Reader::default_material()
{
    if (!default_material_) {
        default_material_ = static_cast<std::uint32_t>(result_.scene.materials.size());
        result_.scene.materials.push_back(default_gltf_material());
    }
    return *default_material_;
}

void Reader::add_light(const GltfNode& node, const Json& index)
{
    PunctualLight light = read_gltf_light(gltf_, index,
        root_ / "nodes" / node.index / "extensions" / "KHR_lights_punctual" / "light",
        changed_lights_);
    if (light.name.empty())
        light.name = gltf_.list("nodes")[node.index].value("name", "");
    if (light.name.empty())
        light.name = "light " + std::to_string(result_.scene.lights.size());
    if (place_light(light, node.world_from_node))
        result_.scene.lights.push_back(std::move(light));
    else
        ++flat_lights_;
}

/// The first perspective camera is the scene's; the others become paths of one keyframe.
void Reader::place_cameras()
{
    Scene& scene = result_.scene;
    const Bounds bounds = scene_bounds(scene);
    std::size_t orthographic = 0;
    for (const GltfNode& node : camera_nodes_) {
        const Json& found = gltf_.list("nodes")[node.index];
        const Json& camera = gltf_.list("cameras")[found["camera"].get<std::size_t>()];
        if (camera["type"] != "perspective") {
            ++orthographic;
            continue;
        }
        const auto pose = gltf_camera_pose(camera, node.world_from_node, bounds, scene.notes);
        if (!pose)
            continue;
        if (!result_.has_camera) {
            scene.camera = *pose;
            result_.has_camera = true;
            continue;
        }
        std::string name = found.value("name", camera.value("name", "camera"));
        while (scene.camera_paths.contains(name))
            name += "'";
        scene.camera_paths[name] = {{0, *pose}};
    }
    if (orthographic > 0)
        scene.notes.push_back(std::to_string(orthographic) + " orthographic cameras left out");
}

void Reader::note_the_rest()
{
    std::vector<std::string>& notes = result_.scene.notes;
    for (std::string& note : repairs_.notes())
        notes.push_back(std::move(note));
    if (skipped_primitives_ > 0)
        notes.push_back(
            std::to_string(skipped_primitives_) + " primitives of points or lines left out");
    if (flat_instances_ > 0)
        notes.push_back(
            std::to_string(flat_instances_) + " objects left out: a scale of 0 makes them flat");
    if (changed_lights_ > 0)
        notes.push_back(
            std::to_string(changed_lights_) + " lights with numbers outside their range clamped");
    if (flat_lights_ > 0)
        notes.push_back(
            std::to_string(flat_lights_) + " lights left out: a scale of 0 leaves no direction");
    if (default_material_)
        notes.emplace_back("primitives without a material are white rough metal, as glTF has it");
}

std::string joined(const std::vector<std::string>& names)
{
    std::string list;
    for (const std::string& name : names)
        list += (list.empty() ? "" : ", ") + name;
    return list;
}

/// Notes on what the document holds and nobody here reads.
void note_unread(const nlohmann::json& document, std::vector<std::string>& notes)
{
    const auto count = [&](const char* key) {
        return document.contains(key) ? document[key].size() : 0;
    };
    if (count("animations") + count("skins") > 0)
        notes.emplace_back("animations and skins are not read: everything rests");
    const std::vector<std::string> unread = unread_gltf_extensions(document);
    if (!unread.empty())
        notes.push_back("extensions that are not read: " + joined(unread));
}

}  // namespace

bool is_gltf(const std::filesystem::path& file)
{
    std::string extension = file.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
        [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension == ".gltf" || extension == ".glb";
}

GltfScene load_gltf(const std::filesystem::path& file)
{
    GltfContainer gltf = open_gltf_container(file);
    check_gltf(gltf);
    read_gltf_views(gltf);
    GltfScene result = Reader(gltf).read();
    note_unread(gltf.document, result.scene.notes);
    return result;
}

}  // namespace farlight
