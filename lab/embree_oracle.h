// Embree's single-ray intersector over a packed scene: the oracle of traversal tests, the yardstick
// of benchmarks.
#pragma once

#include "server/scene/gpu_scene.h"

#include <embree3/rtcore.h>

namespace farlight {

struct TestRay {
    glm::vec3 origin;
    glm::vec3 direction;
    float t_max = 1e30F;  ///< <= 0: no ray.
};

/// Embree's primID is our slot in leaf order. Robust mode.
class EmbreeOracle {
public:
    /// `packed` must outlive the oracle and hold triangles only.
    explicit EmbreeOracle(const PackedScene& packed);
    ~EmbreeOracle();
    EmbreeOracle(const EmbreeOracle&) = delete;
    EmbreeOracle& operator=(const EmbreeOracle&) = delete;

    RTCRayHit closest(const TestRay& ray) const;
    bool any(const TestRay& ray) const;

private:
    RTCDevice device_ = rtcNewDevice(nullptr);
    RTCScene scene_ = rtcNewScene(device_);
};

}  // namespace farlight
