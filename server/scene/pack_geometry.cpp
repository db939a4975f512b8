// Gathering corners from meshes and quads, in leaf order.
#include "server/scene/pack_geometry.h"

#include "shaders/shared/scene_layout.h"

#include <algorithm>
#include <glm/gtc/matrix_inverse.hpp>

namespace farlight {
namespace {

/// What an object does to the attributes of its mesh.
struct Placement {
    const Mesh* mesh = nullptr;  ///< None: a quad.
    glm::mat3 world_from_tangent{1};
    glm::mat3 world_from_normal{1};
    bool mirrored = false;
    int tangent_set = 0;  ///< The uv set that the normal map is looked up with.
};

Placement placement_of(const Scene& scene, const Object& object)
{
    Placement placement;
    placement.tangent_set = scene.materials[object.material].normal_texture.uv_set;
    if (const auto* instance = std::get_if<MeshInstance>(&object.shape)) {
        const glm::dmat3 linear(instance->world_from_object);
        placement.mesh = &scene.meshes[instance->mesh];
        placement.world_from_tangent = glm::mat3(linear);
        placement.world_from_normal = glm::mat3(glm::inverseTranspose(linear));
        placement.mirrored = glm::determinant(linear) < 0;
    }
    return placement;
}

/// log2 of the square root of a ratio of areas; a face without area on the image stays on level 0.
float log2_uv_per_metre(
    const std::array<glm::vec3, 3>& vertices, const std::array<glm::vec2, 3>& uv)
{
    const glm::dvec2 u(uv[1] - uv[0]);
    const glm::dvec2 v(uv[2] - uv[0]);
    const glm::dvec3 edge_u(vertices[1] - vertices[0]);
    const glm::dvec3 edge_v(vertices[2] - vertices[0]);
    const double ratio = std::abs(u.x * v.y - u.y * v.x) / glm::length(glm::cross(edge_u, edge_v));
    return static_cast<float>(0.5 * std::log2(std::max(ratio, 1e-30)));
}

/// The direction in which u grows, and on which side of it v does (Lengyel 2001, "Computing Tangent
/// Space Basis Vectors for an Arbitrary Mesh"); any direction where the uvs tell none.
glm::vec4 face_tangent(const std::array<glm::vec3, 3>& vertices, const std::array<glm::vec2, 3>& uv)
{
    const glm::vec3 edge_u = vertices[1] - vertices[0];
    const glm::vec3 edge_v = vertices[2] - vertices[0];
    const glm::vec2 u = uv[1] - uv[0];
    const glm::vec2 v = uv[2] - uv[0];
    const float area = u.x * v.y - u.y * v.x;
    const glm::vec3 along = (edge_u * v.y - edge_v * u.y) * (area < 0 ? -1.0F : 1.0F);
    // glTF's v points down an image, its bitangent up: w = +1 for a picture that is not mirrored.
    return {glm::length(along) > 0 ? glm::normalize(along) : glm::normalize(edge_u),
        area < 0 ? 1.0F : -1.0F};
}

class TrianglePacker {
public:
    TrianglePacker(const Scene& scene, const WantedAttributes& wanted, PackedGeometry& packed)
        : scene_(scene)
        , wanted_(wanted)
        , packed_(packed)
    {
        for (const Object& object : scene.objects)
            placements_.push_back(placement_of(scene, object));
    }

    void pack(const FlatTriangle& triangle)
    {
        const auto& [a, b, c] = triangle.vertices;
        packed_.triangles.push_back(texel(a, triangle.object));
        packed_.triangles.push_back(texel(b, scene_.objects[triangle.object].material));
        packed_.triangles.push_back(texel(c, triangle.light));
        placement_ = &placements_[triangle.object];
        for (int k = 0; k < 3; ++k)
            corners_[k] = placement_->mesh == nullptr
                ? 0
                : placement_->mesh->triangles[triangle.face][corner_of(k, placement_->mirrored)];
        if (wanted_.normals)
            packed_.normals.push_back(normals());
        for (int set = 0; set < 2; ++set)
            if (wanted_.uvs[set])
                pack_uvs(triangle, set);
        if (wanted_.tangents)
            packed_.tangents.push_back(tangents(triangle));
        if (wanted_.colors)
            pack_colors();
    }

private:
    glm::uvec4 normals() const
    {
        glm::uvec4 packed(0);
        if (placement_->mesh == nullptr || placement_->mesh->normals.empty())
            return packed;
        for (int k = 0; k < 3; ++k)
            packed[k] = pack_octahedral(
                placement_->world_from_normal * placement_->mesh->normals[corners_[k]]);
        packed.w = 1;
        return packed;
    }

    std::array<glm::vec2, 3> uvs(const FlatTriangle& triangle, int set) const
    {
        if (placement_->mesh == nullptr)
            return triangle.face == 0 ? std::array<glm::vec2, 3>{{{0, 1}, {1, 1}, {1, 0}}}
                                      : std::array<glm::vec2, 3>{{{0, 1}, {1, 0}, {0, 0}}};
        std::array<glm::vec2, 3> uv{};
        if (const auto& list = placement_->mesh->uvs[set]; !list.empty())
            for (int k = 0; k < 3; ++k)
                uv[static_cast<std::size_t>(k)] = list[corners_[k]];
        return uv;
    }

    void pack_uvs(const FlatTriangle& triangle, int set)
    {
        const auto uv = uvs(triangle, set);
        packed_.uvs[set].emplace_back(bits(uv[0].x), bits(uv[0].y), bits(uv[1].x), bits(uv[1].y));
        packed_.uvs[set].emplace_back(
            bits(uv[2].x), bits(uv[2].y), bits(log2_uv_per_metre(triangle.vertices, uv)), 0);
    }

    glm::uvec4 tangents(const FlatTriangle& triangle) const
    {
        if (placement_->mesh == nullptr || placement_->mesh->tangents.empty()) {
            const glm::vec4 tangent =
                face_tangent(triangle.vertices, uvs(triangle, placement_->tangent_set));
            const std::uint32_t word = pack_octahedral(glm::vec3(tangent));
            return {word, word, word, tangent.w < 0 ? 7U : 0U};
        }
        glm::uvec4 packed(0);
        for (int k = 0; k < 3; ++k) {
            const glm::vec4& tangent = placement_->mesh->tangents[corners_[k]];
            packed[k] = pack_octahedral(placement_->world_from_tangent * glm::vec3(tangent));
            packed.w |= (tangent.w < 0) != placement_->mirrored ? 1U << k : 0U;
        }
        return packed;
    }

    void pack_colors()
    {
        std::array<glm::uvec2, 3> halves;
        for (int k = 0; k < 3; ++k) {
            const bool colored = placement_->mesh != nullptr && !placement_->mesh->colors.empty();
            const glm::vec4 color = colored ? placement_->mesh->colors[corners_[k]] : glm::vec4(1);
            halves[static_cast<std::size_t>(k)] = {
                glm::packHalf2x16({color.x, color.y}), glm::packHalf2x16({color.z, color.w})};
        }
        packed_.colors.emplace_back(halves[0], halves[1]);
        packed_.colors.emplace_back(halves[2], glm::uvec2(0));
    }

    const Scene& scene_;
    const WantedAttributes& wanted_;
    PackedGeometry& packed_;
    std::vector<Placement> placements_;  ///< One an object.
    const Placement* placement_ = nullptr;  ///< Of the triangle being packed.
    glm::uvec3 corners_{0};
};

void pack_sphere(PackedGeometry& packed, const Scene& scene, const FlatSphere& sphere)
{
    packed.spheres.push_back(texel(sphere.center, bits(sphere.radius)));
    packed.spheres.emplace_back(
        sphere.object, scene.objects[sphere.object].material, sphere.light, 0);
}

void pack_disk(PackedGeometry& packed, const Scene& scene, const FlatDisk& disk)
{
    packed.disks.push_back(texel(disk.center, bits(disk.radius)));
    packed.disks.push_back(texel(disk.normal, 0));
    packed.disks.emplace_back(disk.object, scene.objects[disk.object].material, disk.light, 0);
}

}  // namespace

PackedGeometry pack_geometry(const Scene& scene, const FlatScene& flat,
    std::span<const std::uint32_t> order, const WantedAttributes& wanted)
{
    PackedGeometry packed;
    packed.triangles.reserve(flat.triangles.size() * TRIANGLE_TEXELS);
    TrianglePacker triangles(scene, wanted, packed);
    const std::size_t first_disk = flat.triangles.size() + flat.spheres.size();
    for (const std::uint32_t i : order) {
        if (i < flat.triangles.size())
            triangles.pack(flat.triangles[i]);
        else if (i < first_disk)
            pack_sphere(packed, scene, flat.spheres[i - flat.triangles.size()]);
        else
            pack_disk(packed, scene, flat.disks[i - first_disk]);
    }
    return packed;
}

}  // namespace farlight
