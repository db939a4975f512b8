// Scenes somewhere else: what a file counts from its origin, changed. By code of its own, not by
// that of the server (scene_origin.h), which cases look at.
#pragma once

#include "server/scene/scene.h"

namespace farlight::lab {

/// Does `change` to every position that a scene file counts from its origin.
template <typename Change> void each_position(Scene& scene, const Change& change)
{
    for (Object& object : scene.objects) {
        if (object.node != kNone)
            continue;
        if (auto* sphere = std::get_if<Sphere>(&object.shape))
            change(sphere->center);
        else if (auto* disk = std::get_if<Disk>(&object.shape))
            change(disk->center);
        else if (auto* quad = std::get_if<Quad>(&object.shape))
            change(quad->corner);
        else if (auto* mesh = std::get_if<MeshInstance>(&object.shape)) {
            glm::dvec3 place(mesh->world_from_object[3]);
            change(place);
            mesh->world_from_object[3] = glm::dvec4(place, 1);
        }
    }
    for (PunctualLight& light : scene.lights)
        if (light.node == kNone)
            change(light.position);
    for (Node& node : scene.animation.nodes)
        if (node.parent == kNone)
            change(node.translation);
    change(scene.camera.position);
    change(scene.camera.target);
}

inline Scene moved(Scene scene, const glm::dvec3& by)
{
    each_position(scene, [&](glm::dvec3& p) { p += by; });
    return scene;
}

}  // namespace farlight::lab
