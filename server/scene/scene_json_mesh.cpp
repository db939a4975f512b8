// One list of the document becomes one list of the mesh.
#include "server/scene/scene_json_mesh.h"

#include "server/scene/scene_json_values.h"

#include <array>

namespace farlight {

namespace {

using Json = nlohmann::json;

glm::vec4 vec4(const Json& value)
{
    return {
        value[0].get<float>(), value[1].get<float>(), value[2].get<float>(), value[3].get<float>()};
}

glm::vec2 vec2(const Json& value)
{
    return {value[0].get<float>(), value[1].get<float>()};
}

/// A list that has one element a position, where the document has it.
template <typename T, typename Read>
void read_list(const Json& value, const char* key, std::size_t positions, const ScenePlace& place,
    std::vector<T>& list, Read read)
{
    if (!value.contains(key))
        return;
    for (const Json& element : value[key])
        list.push_back(T(read(element)));
    if (list.size() != positions)
        refuse(place / key, std::to_string(list.size()) + " " + key,
            std::to_string(positions) + ", one a position");
}

void read_triangles(const Json& triangles, const ScenePlace& place, Mesh& mesh)
{
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        for (std::size_t corner = 0; corner < 3; ++corner)
            if (triangles[i][corner].get<std::uint64_t>() >= mesh.positions.size())
                refuse(place / i / corner, "index " + triangles[i][corner].dump(),
                    "less than " + std::to_string(mesh.positions.size())
                        + ", the number of positions");
        mesh.triangles.emplace_back(triangles[i][0].get<std::uint32_t>(),
            triangles[i][1].get<std::uint32_t>(), triangles[i][2].get<std::uint32_t>());
    }
}

}  // namespace

Mesh read_inline_mesh(
    const Json& value, const std::string& name, const ScenePlace& place, MeshRepairs& repairs)
{
    Mesh mesh{.name = name};
    for (const Json& position : value["positions"])
        mesh.positions.emplace_back(vec3(position));
    const std::size_t count = mesh.positions.size();
    read_list(value, "normals", count, place, mesh.normals, vec3);
    read_list(value, "uvs", count, place, mesh.uvs[0], vec2);
    read_list(value, "uvs_1", count, place, mesh.uvs[1], vec2);
    read_list(value, "tangents", count, place, mesh.tangents, vec4);
    read_list(value, "colors", count, place, mesh.colors, vec4);
    read_triangles(value["triangles"], place / "triangles", mesh);
    repairs += repair_mesh(mesh);
    if (mesh.triangles.empty())
        refuse(place / "triangles", "no triangle that has an area", "at least one");
    return mesh;
}

Mesh unit_cube_with_uvs()
{
    struct Face {
        glm::vec3 right;  // the way u grows
        glm::vec3 up;  // against the way v grows
    };
    constexpr std::array<Face, 6> kFaces{{
        {{0, 0, 1}, {0, 1, 0}},  // -x
        {{0, 0, -1}, {0, 1, 0}},  // +x
        {{1, 0, 0}, {0, 0, 1}},  // -y
        {{1, 0, 0}, {0, 0, -1}},  // +y
        {{-1, 0, 0}, {0, 1, 0}},  // -z
        {{1, 0, 0}, {0, 1, 0}},  // +z
    }};
    Mesh cube{.name = "cube with uvs"};
    for (const Face& face : kFaces) {
        const auto first = static_cast<std::uint32_t>(cube.positions.size());
        const glm::vec3 outward = glm::cross(face.right, face.up);
        for (int corner = 0; corner < 4; ++corner) {
            const glm::vec2 uv(corner & 1, corner >> 1);
            cube.positions.push_back(
                0.5F * outward + (uv.x - 0.5F) * face.right + (0.5F - uv.y) * face.up);
            cube.uvs[0].push_back(uv);
            cube.tangents.emplace_back(face.right, 1);
        }
        cube.triangles.emplace_back(first, first + 2, first + 3);
        cube.triangles.emplace_back(first, first + 3, first + 1);
    }
    return cube;
}

}  // namespace farlight
