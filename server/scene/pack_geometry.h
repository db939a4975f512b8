// Primitives as texels in leaf order, and what the corners of triangles carry besides their
// position. Each attribute has its own buffer, filled only when an effect of the scene reads it.
#pragma once

#include "server/scene/flatten.h"
#include "server/scene/texels.h"

#include <array>
#include <span>

namespace farlight {

/// Which attributes are wanted.
struct WantedAttributes {
    bool normals = false;
    bool uvs[2]{};
    bool tangents = false;
    bool colors = false;
};

/// Layout: shaders/shared/scene_layout.h.
struct PackedGeometry {
    Texels triangles;
    Texels spheres;
    Texels disks;
    Texels normals;
    std::array<Texels, 2> uvs;
    Texels tangents;
    Texels colors;
};

/// Fills the tables group by group.
class GeometryPacker {
public:
    /// Both must outlive the packer.
    GeometryPacker(const Scene& scene, const FlatScene& flat, const WantedAttributes& wanted);

    /// `order`: as Bvh::order over the triangles, then the spheres, then the disks of `group`.
    void pack(const FlatGroup& group, std::span<const std::uint32_t> order);
    PackedGeometry& packed() { return packed_; }

private:
    void pack_triangle(const FlatTriangle& triangle);
    void pack_sphere(const FlatSphere& sphere);
    void pack_disk(const FlatDisk& disk);
    void pack_attributes(const FlatTriangle& triangle);

    const Scene& scene_;
    const FlatScene& flat_;
    WantedAttributes wanted_;
    PackedGeometry packed_;
};

/// What names the object's material in the tables: its index, and MATERIAL_HAS_HOLES.
std::uint32_t material_word(const Scene& scene, std::uint32_t object);

/// One texel: a triangle's shading normals in its group's space.
glm::uvec4 pack_normals(const std::vector<glm::vec3>& normals, const glm::uvec3& corners,
    const glm::mat3& group_from_normal);

/// One texel: a triangle's tangents in its group's space.
glm::uvec4 pack_tangents(const std::vector<glm::vec4>& tangents, const glm::uvec3& corners,
    const glm::mat3& group_from_mesh, bool mirrored);

}  // namespace farlight
