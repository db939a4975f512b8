// RayProbe: rays of the caller's choice through a scene on the device, by the tree and by trying
// every primitive.
#pragma once

#include "lab/device_scene.h"
#include "lab/embree_oracle.h"

#include <random>
#include <string>
#include <vector>

namespace farlight {

struct ProbeHit {
    float t = 0;  ///< 1e30 where nothing was met.
    std::uint32_t slot = 0;  ///< Kind and place in leaf order, as in the packed scene.
    glm::vec2 barycentric{0};
    glm::vec3 geometric_normal{0};  ///< Turned to where the ray came from.
    bool any = false;  ///< What any_hit() says.
    int accepted = 0;  ///< Primitives that the ray goes through; only of by_every_primitive().

    bool met() const { return slot != 0xffffffffU; }
};

/// Rays without instances and holes. GL thread only; `scene` must outlive the probe.
class RayProbe {
public:
    /// Throws ShaderError.
    explicit RayProbe(const DeviceScene& scene) : scene_(scene) { }

    std::vector<ProbeHit> by_tree(const std::vector<TestRay>& rays) const;
    /// The same without a tree; t_max of a ray is ignored by both.
    std::vector<ProbeHit> by_every_primitive(const std::vector<TestRay>& rays) const;
    /// Nodes that the ray opened and primitives that it was tested against.
    std::vector<glm::ivec2> work_of(const std::vector<TestRay>& rays) const;

private:
    std::vector<glm::vec4> run(
        const std::string& shader, const std::vector<TestRay>& rays, std::size_t texels) const;

    const DeviceScene& scene_;
};

glm::vec3 random_direction(std::mt19937& random);

/// Half from around the bounds towards them, half from inside anywhere.
std::vector<TestRay> random_rays(const Bounds& bounds, std::size_t count, unsigned seed);

/// Rays of which tree and Embree disagree: another primitive, but for ties, which are hits as far
/// away within 16 ulp of the coordinates involved. `met`: rays that hit anything.
struct Disagreements {
    std::size_t wrong = 0;
    std::size_t met = 0;
};
Disagreements against_embree(const Scene& scene, const std::vector<TestRay>& rays);

}  // namespace farlight
