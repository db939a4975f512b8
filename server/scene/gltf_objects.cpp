// Instances share meshes; a mesh becomes as many objects as it has primitives.
#include "server/scene/gltf_objects.h"

#include "server/scene/gltf_draco.h"
#include "server/scene/gltf_material.h"
#include "server/scene/gltf_mesh.h"
#include "server/scene/gltf_strokes.h"
#include "server/scene/mesh_tangents.h"

#include <algorithm>
#include <limits>

namespace farlight {

namespace {

using Json = nlohmann::json;

/// Of all points and lines of a file. Each takes some 200 bytes here and again as many on the
/// device: 3 GiB, while their file may be of a hundredth of that.
constexpr std::uint64_t kMostStrokeTriangles = 1U << 24U;

/// False where a float cannot tell the matrix from one without inverse.
bool keeps_volume(const glm::dmat4& matrix)
{
    const glm::dmat3 linear(matrix);
    const double volume = glm::determinant(linear);
    const double least = std::numeric_limits<float>::epsilon() * glm::length(linear[0])
        * glm::length(linear[1]) * glm::length(linear[2]);
    return std::abs(volume) > least;
}

std::uint32_t joints_of(const Mesh& mesh)
{
    std::uint32_t most = 0;
    for (const glm::u16vec4& joints : mesh.joints)
        for (int i = 0; i < 4; ++i)
            most = std::max<std::uint32_t>(most, joints[i]);
    return mesh.joints.empty() ? 0 : most + 1;
}

}  // namespace

GltfObjects::GltfObjects(GltfContainer& gltf, GltfRig& rig, Scene& scene)
    : gltf_(gltf)
    , rig_(rig)
    , scene_(scene)
{
}

void GltfObjects::add(const GltfNode& node)
{
    const Json& json = gltf_.list("nodes")[node.index];
    if (!json.contains("mesh"))
        return;
    const auto mesh = json["mesh"].get<std::size_t>();
    std::string name = json.value("name", "");
    if (name.empty())
        name = gltf_.list("meshes")[mesh].value("name", "");
    if (name.empty())
        name = "node " + std::to_string(node.index);
    const std::vector<Part>& parts = parts_of(mesh);
    for (std::size_t i = 0; i < parts.size(); ++i) {
        std::optional<MeshInstance> instance = placed(node, parts[i]);
        if (!instance)
            continue;
        instance->morph_weights = weights_of(json, *instance, node.index);
        by_node_[node.index].push_back(static_cast<std::uint32_t>(scene_.objects.size()));
        Object object{parts.size() == 1 ? name : std::string(name).append("/") + std::to_string(i),
            parts[i].material, std::move(*instance)};
        if (!json.contains("skin"))
            object.node = node.carrier;
        scene_.objects.push_back(std::move(object));
    }
}

std::optional<MeshInstance> GltfObjects::placed(const GltfNode& node, const Part& part)
{
    MeshInstance instance{part.mesh, glm::dmat4(1)};
    if (gltf_.list("nodes")[node.index].contains("skin")) {
        attach_skin(node, part, instance);
        return instance;
    }
    instance.world_from_object = node.carrier_from_node;
    const bool may_unfold =  // by an animation
        node.carrier != kNone && keeps_volume(node.carrier_from_node);
    if (!keeps_volume(node.world_from_node) && !may_unfold) {
        ++flat_instances_;
        return std::nullopt;
    }
    return instance;
}

void GltfObjects::attach_skin(const GltfNode& node, const Part& part, MeshInstance& instance)
{
    const ScenePlace place = gltf_.root / "nodes" / node.index / "skin";
    const Json& index = gltf_.list("nodes")[node.index]["skin"];
    if (part.joints == 0)
        refuse(place, "a skin on a mesh without JOINTS_0 and WEIGHTS_0", "both, or no skin");
    instance.skin = rig_.skin(index, place);
    const std::size_t joints = scene_.animation.skins[instance.skin].joints.size();
    if (part.joints > joints)
        refuse(place, "a mesh with joint " + std::to_string(part.joints - 1),
            "joints less than " + std::to_string(joints) + ", the skin's number of them");
}

std::vector<float> GltfObjects::weights_of(
    const Json& node, const MeshInstance& instance, std::size_t node_index) const
{
    const std::size_t targets = scene_.meshes[instance.mesh].morph_targets.size();
    const auto mesh_index = node["mesh"].get<std::size_t>();
    const Json& mesh = gltf_.list("meshes")[mesh_index];
    const Json& owner = node.contains("weights") ? node : mesh;
    const ScenePlace place = (node.contains("weights") ? gltf_.root / "nodes" / node_index
                                                       : gltf_.root / "meshes" / mesh_index)
        / "weights";
    std::vector<float> weights;
    for (const Json& weight : owner.value("weights", Json::array())) {
        if (!(std::abs(weight.get<double>()) <= kLargestCoordinate))
            refuse(place, weight.dump(), "numbers of at most 1e11 in magnitude");
        weights.push_back(weight.get<float>());
    }
    if (!weights.empty() && weights.size() != targets)
        refuse(place, std::to_string(weights.size()) + " weights",
            std::to_string(targets) + ", one a morph target");
    weights.resize(targets, 0.0F);
    return weights;
}

const std::vector<GltfObjects::Part>& GltfObjects::parts_of(std::size_t mesh)
{
    const auto [entry, is_new] = parts_.try_emplace(mesh);
    if (!is_new)
        return entry->second;
    const Json& found = gltf_.list("meshes")[mesh];
    const Json& primitives = found["primitives"];
    const ScenePlace place = gltf_.root / "meshes" / mesh;
    for (std::size_t i = 0; i < primitives.size(); ++i)  // all, before any of them is made
        if (has_strokes(primitives[i]))
            count_strokes(primitives[i], place / "primitives" / i);
    for (std::size_t i = 0; i < primitives.size(); ++i)
        entry->second.push_back(read_part(found, i, place));
    return entry->second;
}

void GltfObjects::count_strokes(const Json& primitive, const ScenePlace& place)
{
    const Json& corners =
        primitive.contains("indices") ? primitive["indices"] : primitive["attributes"]["POSITION"];
    const auto count =
        gltf_.list("accessors")[corners.get<std::size_t>()]["count"].get<std::uint64_t>();
    const std::uint64_t triangles = triangles_of_strokes(count, primitive["mode"].get<int>());
    ++strokes_;
    stroke_triangles_ += triangles;
    if (stroke_triangles_ > kMostStrokeTriangles)
        refuse(place,
            "points or lines that take " + std::to_string(triangles) + " triangles, "
                + std::to_string(stroke_triangles_) + " with those before",
            "at most " + std::to_string(kMostStrokeTriangles) + " in a file");
}

GltfObjects::Part GltfObjects::read_part(
    const Json& mesh, std::size_t primitive, const ScenePlace& place)
{
    const Json& json = mesh["primitives"][primitive];
    const ScenePlace here = place / "primitives" / primitive;
    const std::uint32_t material =
        json.contains("material") ? json["material"].get<std::uint32_t>() : default_material();
    unpack_gltf_draco(gltf_, json, here);
    Mesh read = read_gltf_primitive(gltf_, json, here, repairs_);
    read.name = mesh.value("name", "");
    if (const Texture* normals = normal_map(scene_.materials[material]);
        normals != nullptr && read.tangents.empty())
        add_tangents(read, normals->uv_set);
    const Part part{static_cast<std::uint32_t>(scene_.meshes.size()), material, joints_of(read)};
    scene_.meshes.push_back(std::move(read));
    return part;
}

std::uint32_t GltfObjects::default_material()
{
    if (!default_material_) {
        default_material_ = static_cast<std::uint32_t>(scene_.materials.size());
        scene_.materials.push_back(default_gltf_material());
    }
    return *default_material_;
}

void GltfObjects::add_notes() const
{
    for (std::string& note : repairs_.notes())
        scene_.notes.push_back(std::move(note));
    if (strokes_ > 0)
        scene_.notes.push_back(
            std::to_string(strokes_) + " primitives of points or lines drawn as thin solids");
    if (flat_instances_ > 0)
        scene_.notes.push_back(
            std::to_string(flat_instances_) + " objects left out: a scale of 0 makes them flat");
    if (default_material_)
        scene_.notes.emplace_back(
            "primitives without a material are white rough metal, as glTF has it");
}

}  // namespace farlight
