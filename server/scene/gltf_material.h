// glTF materials and their KHR extensions -> Material.
#pragma once

#include "server/scene/gltf_container.h"
#include "server/scene/scene.h"

namespace farlight {

/// One Material for each of the document's, in its order, into scene.materials, and what their
/// textures need into scene.images. What had to be changed goes to scene.notes. Throws SceneError.
void read_gltf_materials(const GltfContainer& gltf, Scene& scene);

/// What a primitive without a material is made of (glTF 2.0, section 3.7.2.1).
Material default_gltf_material();

}  // namespace farlight
