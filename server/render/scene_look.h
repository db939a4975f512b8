// SceneLook: what a frame needs to know of a scene beyond its buffers. Cheap to make anew after a
// live edit.
#pragma once

#include "server/passes/frame_inputs.h"
#include "server/scene/scene.h"

namespace farlight {

struct SceneLook {
    glm::vec3 background{0};
    Fog fog;
    Lens lens;
    glm::dvec3 origin{0};  ///< What is subtracted from cameras: Scene::origin.
    float radius = 1;  ///< Of the scene [m].
    bool holes = false;  ///< Something drawn is not there everywhere.
    bool scatters = true;  ///< Something is lit and can show it; else only emission is seen.
};

SceneLook look_of(const Scene& scene);

}  // namespace farlight
