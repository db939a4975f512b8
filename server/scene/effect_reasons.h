// Why a scene calls for an effect: one function a row of the registry, each naming the first thing
// that calls for it, or nothing.
#pragma once

#include "server/scene/effects.h"

namespace farlight::effect_reasons {

using Reason = std::optional<std::string>;

Reason triangles(const Scene& scene, const SceneContent& content);
Reason spheres(const Scene& scene, const SceneContent& content);
Reason disks(const Scene& scene, const SceneContent& content);
Reason shading_normals(const Scene& scene, const SceneContent& content);
Reason instances(const Scene& scene, const SceneContent& content);
Reason motion(const Scene& scene, const SceneContent& content);
Reason deformation(const Scene& scene, const SceneContent& content);
Reason lights(const Scene& scene, const SceneContent& content);
Reason polygon_lights(const Scene& scene, const SceneContent& content);
Reason sphere_lights(const Scene& scene, const SceneContent& content);
Reason disk_lights(const Scene& scene, const SceneContent& content);
Reason emissive_meshes(const Scene& scene, const SceneContent& content);
Reason delta_lights(const Scene& scene, const SceneContent& content);
Reason light_tree(const Scene& scene, const SceneContent& content);
Reason background(const Scene& scene, const SceneContent& content);
Reason environment_map(const Scene& scene, const SceneContent& content);
Reason textures(const Scene& scene, const SceneContent& content);
Reason second_uvs(const Scene& scene, const SceneContent& content);
Reason normal_maps(const Scene& scene, const SceneContent& content);
Reason vertex_colors(const Scene& scene, const SceneContent& content);
Reason rough_reflection(const Scene& scene, const SceneContent& content);
Reason mirror(const Scene& scene, const SceneContent& content);
Reason clearcoat(const Scene& scene, const SceneContent& content);
Reason dielectric(const Scene& scene, const SceneContent& content);
Reason rough_dielectric(const Scene& scene, const SceneContent& content);
Reason unlit(const Scene& scene, const SceneContent& content);
Reason alpha(const Scene& scene, const SceneContent& content);
Reason fog(const Scene& scene, const SceneContent& content);
Reason lens(const Scene& scene, const SceneContent& content);
Reason specular_signal(const Scene& scene, const SceneContent& content);
/// Called for by a setting, not by any scene.
Reason never(const Scene& scene, const SceneContent& content);

}  // namespace farlight::effect_reasons
