// Triangle lists, strips and fans: glTF 2.0 specification, section 3.7.2.1.
#include "server/scene/gltf_mesh.h"

#include "server/scene/gltf_accessor.h"
#include "server/scene/gltf_strokes.h"

#include <algorithm>
#include <array>
#include <functional>
#include <numeric>
#include <tuple>

namespace farlight {

namespace {

using Json = nlohmann::json;

constexpr int kTriangles = 4;
constexpr int kFan = 6;

/// Winding as the specification says: every second triangle of a strip is turned about.
std::vector<glm::uvec3> assemble(const std::vector<std::uint32_t>& corners, int mode)
{
    std::vector<glm::uvec3> triangles;
    if (mode == kTriangles) {
        for (std::size_t i = 0; i + 2 < corners.size(); i += 3)
            triangles.emplace_back(corners[i], corners[i + 1], corners[i + 2]);
        return triangles;
    }
    for (std::size_t i = 0; i + 2 < corners.size(); ++i) {
        if (mode == kFan)
            triangles.emplace_back(corners[0], corners[i + 1], corners[i + 2]);
        else if (i % 2 == 0)
            triangles.emplace_back(corners[i], corners[i + 1], corners[i + 2]);
        else
            triangles.emplace_back(corners[i], corners[i + 2], corners[i + 1]);
    }
    return triangles;
}

void check_corners(const std::vector<std::uint32_t>& corners, std::size_t positions, int mode,
    const ScenePlace& place)
{
    if (corners.size() < 3 && !is_strokes(mode))
        refuse(place, std::to_string(corners.size()) + " corners", "at least one triangle");
    if (mode == kTriangles && corners.size() % 3 != 0)
        refuse(place, std::to_string(corners.size()) + " corners", "a multiple of 3");
    // Triangles with such corners are left out, counted (mesh_repair.h); a line cannot be.
    for (std::size_t i = 0; is_strokes(mode) && i < corners.size(); ++i)
        if (corners[i] >= positions)
            refuse(place,
                "index " + std::to_string(corners[i]) + " as element " + std::to_string(i),
                "less than " + std::to_string(positions) + ", the number of positions");
}

/// The attribute's elements; none if the primitive has none of that name.
template <typename Element>
std::vector<Element> attribute(const GltfContainer& gltf, const Json& attributes, const char* name)
{
    const auto found = attributes.find(name);
    return found == attributes.end() ? std::vector<Element>()
                                     : read_accessor<Element>(gltf, *found);
}

std::vector<glm::vec4> read_colors(const GltfContainer& gltf, const Json& attributes)
{
    const auto found = attributes.find("COLOR_0");
    if (found == attributes.end())
        return {};
    if (gltf.list("accessors")[found->get<std::size_t>()]["type"] == "VEC4")
        return read_accessor<glm::vec4>(gltf, *found);
    std::vector<glm::vec4> colors;
    for (const glm::vec3& color : read_accessor<glm::vec3>(gltf, *found))
        colors.emplace_back(color, 1);
    return colors;
}

Mesh read_attributes(const GltfContainer& gltf, const Json& attributes)
{
    Mesh mesh;
    mesh.positions = attribute<glm::vec3>(gltf, attributes, "POSITION");
    mesh.normals = attribute<glm::vec3>(gltf, attributes, "NORMAL");
    if (!mesh.normals.empty())  // without normals, given tangents have no meaning (glTF)
        mesh.tangents = attribute<glm::vec4>(gltf, attributes, "TANGENT");
    mesh.uvs[0] = attribute<glm::vec2>(gltf, attributes, "TEXCOORD_0");
    mesh.uvs[1] = attribute<glm::vec2>(gltf, attributes, "TEXCOORD_1");
    mesh.colors = read_colors(gltf, attributes);
    mesh.joints = attribute<glm::u16vec4>(gltf, attributes, "JOINTS_0");
    mesh.weights = attribute<glm::vec4>(gltf, attributes, "WEIGHTS_0");
    if (mesh.joints.size() != mesh.weights.size()) {  // one without the other says nothing
        mesh.joints.clear();
        mesh.weights.clear();
    }
    return mesh;
}

/// Displacements; none for an accessor of zeros.
std::vector<glm::vec3> displacements(
    const GltfContainer& gltf, const Json& target, const char* name)
{
    const auto found = target.find(name);
    if (found == target.end())
        return {};
    const Json& accessor = gltf.list("accessors")[found->get<std::size_t>()];
    if (!accessor.contains("bufferView") && !accessor.contains("sparse"))
        return {};
    return read_accessor<glm::vec3>(gltf, *found);
}

std::vector<MorphTarget> read_targets(
    const GltfContainer& gltf, const Json& primitive, bool has_normals, MeshRepairs& repairs)
{
    std::vector<MorphTarget> targets;
    for (const Json& target : primitive.value("targets", Json::array())) {
        MorphTarget& read = targets.emplace_back();
        read.positions = displacements(gltf, target, "POSITION");
        if (has_normals)
            read.normals = displacements(gltf, target, "NORMAL");
        for (const auto& [name, accessor] : target.items())
            repairs.unread_morph_attributes += name != "POSITION" && name != "NORMAL" ? 1 : 0;
    }
    return targets;
}

/// Of eight joints a vertex, the four with the largest weights.
void keep_strongest_joints(
    const GltfContainer& gltf, const Json& attributes, Mesh& mesh, MeshRepairs& repairs)
{
    const auto joints = attribute<glm::u16vec4>(gltf, attributes, "JOINTS_1");
    const auto weights = attribute<glm::vec4>(gltf, attributes, "WEIGHTS_1");
    if (joints.size() != mesh.joints.size() || weights.size() != joints.size())
        return;
    for (std::size_t i = 0; i < joints.size(); ++i) {
        std::array<std::pair<float, std::uint16_t>, 8> all;
        for (int k = 0; k < 4; ++k) {
            const auto place = static_cast<std::size_t>(k);
            all[place] = {mesh.weights[i][k], mesh.joints[i][k]};
            all[place + 4] = {weights[i][k], joints[i][k]};
        }
        // A NaN counts as nothing: comparisons with it would be no order.
        for (auto& [weight, joint] : all)
            weight = weight > 0 ? weight : 0;
        std::sort(all.begin(), all.end(), std::greater<>());
        for (int k = 0; k < 4; ++k)
            std::tie(mesh.weights[i][k], mesh.joints[i][k]) = all[static_cast<std::size_t>(k)];
        repairs.vertices_of_fewer_joints += all[4].first > 0 ? 1 : 0;
    }
}

}  // namespace

bool has_strokes(const Json& primitive)
{
    return is_strokes(primitive.value("mode", kTriangles));
}

Mesh read_gltf_primitive(
    const GltfContainer& gltf, const Json& primitive, const ScenePlace& place, MeshRepairs& repairs)
{
    Mesh mesh = read_attributes(gltf, primitive["attributes"]);
    mesh.morph_targets = read_targets(gltf, primitive, !mesh.normals.empty(), repairs);
    if (primitive["attributes"].contains("JOINTS_1"))
        keep_strongest_joints(gltf, primitive["attributes"], mesh, repairs);
    const int mode = primitive.value("mode", kTriangles);
    const bool indexed = primitive.contains("indices");
    std::vector<std::uint32_t> corners;
    if (indexed) {
        corners = read_accessor<std::uint32_t>(gltf, primitive["indices"]);
    } else {
        corners.resize(mesh.positions.size());
        std::iota(corners.begin(), corners.end(), 0U);
    }
    check_corners(corners, mesh.positions.size(), mode,
        indexed ? place / "indices" : place / "attributes" / "POSITION");
    if (is_strokes(mode))
        mesh = strokes_as_solids(mesh, corners, mode);
    else
        mesh.triangles = assemble(corners, mode);
    const MeshRepairs made = repair_mesh(mesh);
    if (mesh.triangles.empty()) {
        std::string found = "no triangle that is left";
        for (const std::string& note : made.notes())
            found += "; " + note;
        refuse(place, found, "at least one triangle that has an area");
    }
    repairs += made;
    return mesh;
}

}  // namespace farlight
