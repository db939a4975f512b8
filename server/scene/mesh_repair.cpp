// Repairs of a mesh, counted.
#include "server/scene/mesh_repair.h"

#include "server/host_guard.h"
#include "server/scene/mesh_vertices.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>

namespace farlight {

namespace {

const HostGuard repair_drops_no_area("repair_drops_no_area");
const HostGuard least_direction("least_direction");
const HostGuard repair_drops_unbounded("repair_drops_unbounded");

/// Twice the area times the unit normal; zero where the corners lie on a line as far as float
/// positions can tell.
glm::dvec3 area_vector(const Mesh& mesh, const glm::uvec3& triangle)
{
    const glm::dvec3 a = mesh.positions[triangle.x];
    const glm::dvec3 u = glm::dvec3(mesh.positions[triangle.y]) - a;
    const glm::dvec3 v = glm::dvec3(mesh.positions[triangle.z]) - a;
    const glm::dvec3 area = glm::cross(u, v);
    // The cross product's own rounding, with room: its terms are products of two edges.
    const double noise = 16 * std::numeric_limits<double>::epsilon();
    return glm::length(area) > noise * glm::length(u) * glm::length(v) ? area : glm::dvec3(0);
}

/// Sum of the area vectors of the faces around each position.
std::vector<glm::dvec3> face_normals(const Mesh& mesh)
{
    std::vector<glm::dvec3> sums(mesh.positions.size(), glm::dvec3(0));
    for (const glm::uvec3& triangle : mesh.triangles)
        for (int corner = 0; corner < 3; ++corner)
            sums[triangle[corner]] += area_vector(mesh, triangle);
    return sums;
}

/// Whether a vector of floats has a direction: neither zero, nor so short that its components have
/// lost their digits, nor beyond floats.
bool has_direction(double length)
{
    const double least = least_direction ? std::numeric_limits<float>::min() : 0;
    return length > 0 && length >= least && length <= std::numeric_limits<float>::max();
}

std::size_t repair_normals(Mesh& mesh)
{
    std::size_t replaced = 0;
    std::vector<glm::dvec3> around;
    for (std::size_t i = 0; i < mesh.normals.size(); ++i) {
        const double length = glm::length(glm::dvec3(mesh.normals[i]));
        if (has_direction(length)) {
            mesh.normals[i] = glm::dvec3(mesh.normals[i]) / length;
            continue;
        }
        ++replaced;
        if (around.empty())
            around = face_normals(mesh);
        const double faces = glm::length(around[i]);
        mesh.normals[i] = faces > 0 ? around[i] / faces : glm::dvec3(0, 1, 0);
    }
    return replaced;
}

/// Brings tangents to unit length and their signs to +-1; drops all where one has no direction.
std::size_t repair_tangents(Mesh& mesh)
{
    std::size_t bad = 0;
    for (glm::vec4& tangent : mesh.tangents) {
        const double length = glm::length(glm::dvec3(tangent));
        bad += has_direction(length) ? 0 : 1;
        tangent = glm::dvec4(glm::dvec3(tangent) / length, tangent.w < 0 ? -1 : 1);
    }
    if (bad > 0)
        mesh.tangents.clear();
    return bad;
}

std::size_t repair_uvs(Mesh& mesh)
{
    std::size_t replaced = 0;
    for (auto& uvs : mesh.uvs)
        for (glm::vec2& uv : uvs)
            if (!(std::isfinite(uv.x) && std::isfinite(uv.y))) {
                uv = glm::vec2(0);
                ++replaced;
            }
    return replaced;
}

std::size_t repair_colors(Mesh& mesh)
{
    std::size_t changed = 0;
    for (glm::vec4& color : mesh.colors) {
        const glm::vec4 found = color;
        for (int i = 0; i < 4; ++i)
            color[i] = found[i] >= 0 ? std::min(found[i], 1.0F) : 0.0F;  // NaN: 0
        changed += color == found ? 0 : 1;
    }
    return changed;
}

/// Brings each vertex' weights to a sum of 1; a joint without weight becomes joint 0.
std::size_t repair_weights(Mesh& mesh)
{
    std::size_t changed = 0;
    for (std::size_t i = 0; i < mesh.weights.size(); ++i) {
        glm::vec4& weights = mesh.weights[i];
        for (int k = 0; k < 4; ++k)
            if (!(weights[k] > 0 && weights[k] <= kLargestCoordinate)) {
                weights[k] = 0;
                mesh.joints[i][k] = 0;
            }
        const float sum = weights.x + weights.y + weights.z + weights.w;
        changed += sum > 0 ? 0 : 1;
        weights = sum > 0 ? weights / sum : glm::vec4(1, 0, 0, 0);
    }
    return changed;
}

std::size_t repair_displacements(std::vector<glm::vec3>& displacements)
{
    std::size_t dropped = 0;
    for (glm::vec3& displacement : displacements)
        if (!is_bounded(displacement)) {
            displacement = glm::vec3(0);
            ++dropped;
        }
    return dropped;
}

}  // namespace

bool is_bounded(const glm::vec3& p)
{
    return std::abs(p.x) <= kLargestCoordinate && std::abs(p.y) <= kLargestCoordinate
        && std::abs(p.z) <= kLargestCoordinate;  // false for NaN
}

MeshRepairs& MeshRepairs::operator+=(const MeshRepairs& other)
{
    zero_area_triangles += other.zero_area_triangles;
    astray_triangles += other.astray_triangles;
    unbounded_triangles += other.unbounded_triangles;
    replaced_normals += other.replaced_normals;
    dropped_tangents += other.dropped_tangents;
    replaced_uvs += other.replaced_uvs;
    changed_colors += other.changed_colors;
    changed_weights += other.changed_weights;
    vertices_of_fewer_joints += other.vertices_of_fewer_joints;
    unread_morph_attributes += other.unread_morph_attributes;
    dropped_displacements += other.dropped_displacements;
    return *this;
}

std::vector<std::string> MeshRepairs::notes() const
{
    std::vector<std::string> notes;
    const auto note = [&](std::size_t count, const char* one, const char* many, const char* what) {
        if (count > 0)
            notes.push_back(std::to_string(count) + " " + (count == 1 ? one : many) + what);
    };
    note(zero_area_triangles, "triangle", "triangles", " of zero area left out");
    note(astray_triangles, "triangle", "triangles", " with a corner that is no position left out");
    note(unbounded_triangles, "triangle", "triangles",
        " with a corner that is not finite (or beyond 1e11) left out");
    note(replaced_normals, "shading normal", "shading normals",
        " without a direction replaced by the faces around");
    note(dropped_tangents, "tangent", "tangents",
        " without a direction: its mesh gets new ones where it needs any");
    note(replaced_uvs, "texture coordinate", "texture coordinates", " not finite: now 0, 0");
    note(changed_colors, "vertex colour", "vertex colours", " outside [0, 1] clamped");
    note(changed_weights, "vertex", "vertices",
        " without joint weights: the first joint moves them");
    note(vertices_of_fewer_joints, "vertex", "vertices",
        " with more than four joints: the four strongest move them");
    note(unread_morph_attributes, "attribute", "attributes",
        " of morph targets left out: only positions and normals are morphed");
    note(dropped_displacements, "morph displacement", "morph displacements",
        " not finite (or beyond 1e11): now 0");
    return notes;
}

MeshRepairs repair_mesh(Mesh& mesh)
{
    assert(mesh.normals.empty() || mesh.normals.size() == mesh.positions.size());
    MeshRepairs repairs;
    const bool drops_no_area(repair_drops_no_area);
    const bool drops_unbounded(repair_drops_unbounded);
    const auto unbounded = [&](std::uint32_t corner) {
        return !is_bounded(mesh.positions[corner]);
    };
    std::vector<glm::uvec3> kept;
    kept.reserve(mesh.triangles.size());
    for (const glm::uvec3& triangle : mesh.triangles) {
        if (std::max({triangle.x, triangle.y, triangle.z}) >= mesh.positions.size())
            ++repairs.astray_triangles;
        else if (drops_unbounded
            && (unbounded(triangle.x) || unbounded(triangle.y) || unbounded(triangle.z)))
            ++repairs.unbounded_triangles;
        else if (drops_no_area && area_vector(mesh, triangle) == glm::dvec3(0))
            ++repairs.zero_area_triangles;
        else
            kept.push_back(triangle);
    }
    mesh.triangles = std::move(kept);
    drop_unused_vertices(mesh);
    repairs.replaced_normals = repair_normals(mesh);
    repairs.dropped_tangents = repair_tangents(mesh);
    repairs.replaced_uvs = repair_uvs(mesh);
    repairs.changed_colors = repair_colors(mesh);
    repairs.changed_weights = repair_weights(mesh);
    for (MorphTarget& target : mesh.morph_targets)
        repairs.dropped_displacements +=
            repair_displacements(target.positions) + repair_displacements(target.normals);
    return repairs;
}

Mesh unit_cube()
{
    Mesh cube{.name = "cube"};
    for (int i = 0; i < 8; ++i)  // corner i: bit 0 is x, bit 1 y, bit 2 z
        cube.positions.emplace_back((i & 1) - 0.5F, ((i >> 1) & 1) - 0.5F, ((i >> 2) & 1) - 0.5F);
    constexpr std::array<glm::uvec4, 6> kFaces{{
        {0, 4, 6, 2},  // -x
        {1, 3, 7, 5},  // +x
        {0, 1, 5, 4},  // -y
        {2, 6, 7, 3},  // +y
        {0, 2, 3, 1},  // -z
        {4, 5, 7, 6},  // +z
    }};
    for (const glm::uvec4& face : kFaces) {
        cube.triangles.emplace_back(face.x, face.y, face.z);
        cube.triangles.emplace_back(face.x, face.z, face.w);
    }
    return cube;
}

}  // namespace farlight
