// Primitives as texels in leaf order, and what the corners of triangles carry besides their
// position. Each attribute has its own buffer, filled only when an effect of the scene reads it.
#pragma once

#include "server/scene/flatten.h"
#include "server/scene/texels.h"

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
    Texels uvs[2];
    Texels tangents;
    Texels colors;
};

/// `order`: as Bvh::order over the triangles, then the spheres, then the disks of `flat`.
PackedGeometry pack_geometry(const Scene& scene, const FlatScene& flat,
    std::span<const std::uint32_t> order, const WantedAttributes& wanted);

}  // namespace farlight
