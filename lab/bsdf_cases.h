// The materials that every BSDF is tested with, and from where they are seen.
#pragma once

#include "server/scene/scene.h"

#include <string>
#include <vector>

namespace farlight {

/// A material, how it is seen, and what is known of it.
struct BsdfCase {
    std::string name;
    Material material;
    double cosine = 0.7;
    bool inside = false;  ///< Seen from behind: the index of refraction is inverted.
    glm::vec2 tilt{0};  ///< Of the geometric normal against the shading normal.
    glm::vec2 coat_tilt{0};
    bool lossless = true;
    double tolerance = 1e-3;  ///< Of the albedo: interpolation in the tables.
};

/// Cases of one kind, checked in one process: programs and tables are made once.
struct BsdfFamily {
    const char* name;
    std::vector<BsdfCase> cases;
};

std::vector<BsdfFamily> bsdf_families();

/// Materials that one lobe is hardly ever chosen of.
std::vector<BsdfCase> bsdfs_of_rare_lobes();

}  // namespace farlight
