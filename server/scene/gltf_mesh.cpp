// Triangle lists, strips and fans: glTF 2.0 specification, section 3.7.2.1.
#include "server/scene/gltf_mesh.h"

#include "server/scene/gltf_accessor.h"

#include <numeric>
#include <tiny_gltf.h>

namespace farlight {

namespace {

/// Winding as the specification says: every second triangle of a strip is turned about.
std::vector<glm::uvec3> assemble(const std::vector<std::uint32_t>& corners, int mode)
{
    std::vector<glm::uvec3> triangles;
    if (mode == TINYGLTF_MODE_TRIANGLES) {
        for (std::size_t i = 0; i + 2 < corners.size(); i += 3)
            triangles.emplace_back(corners[i], corners[i + 1], corners[i + 2]);
        return triangles;
    }
    for (std::size_t i = 0; i + 2 < corners.size(); ++i) {
        if (mode == TINYGLTF_MODE_TRIANGLE_FAN)
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
    if (corners.size() < 3)
        refuse(place, std::to_string(corners.size()) + " corners", "at least one triangle");
    if (mode == TINYGLTF_MODE_TRIANGLES && corners.size() % 3 != 0)
        refuse(place, std::to_string(corners.size()) + " corners", "a multiple of 3");
    for (std::size_t i = 0; i < corners.size(); ++i)
        if (corners[i] >= positions)
            refuse(place,
                "index " + std::to_string(corners[i]) + " as element " + std::to_string(i),
                "less than " + std::to_string(positions) + ", the number of positions");
}

}  // namespace

bool has_triangles(const tinygltf::Primitive& primitive)
{
    return primitive.mode >= TINYGLTF_MODE_TRIANGLES;
}

Mesh read_gltf_primitive(const tinygltf::Model& model, const tinygltf::Primitive& primitive,
    const ScenePlace& place, MeshRepairs& repairs)
{
    Mesh mesh;
    mesh.positions = read_vectors(model, primitive.attributes.at("POSITION"));
    if (const auto normals = primitive.attributes.find("NORMAL");
        normals != primitive.attributes.end())
        mesh.normals = read_vectors(model, normals->second);

    std::vector<std::uint32_t> corners;
    if (primitive.indices >= 0) {
        corners = read_indices(model, primitive.indices);
    } else {
        corners.resize(mesh.positions.size());
        std::iota(corners.begin(), corners.end(), 0U);
    }
    check_corners(corners, mesh.positions.size(), primitive.mode,
        primitive.indices >= 0 ? place / "indices" : place / "attributes" / "POSITION");
    mesh.triangles = assemble(corners, primitive.mode);
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
