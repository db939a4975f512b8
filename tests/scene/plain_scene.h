// A scene that calls for next to nothing, and what it takes to change that.
#pragma once

#include "server/scene/neutral.h"
#include "server/scene/packed_scene.h"

namespace farlight {

inline std::uint32_t add_image(Scene& scene, const std::vector<glm::u8vec4>& texels)
{
    scene.images.push_back({"image", static_cast<std::uint32_t>(texels.size()), 1, texels});
    return static_cast<std::uint32_t>(scene.images.size()) - 1;
}

inline Texture texture_of(Scene& scene, const std::vector<glm::u8vec4>& texels)
{
    Texture texture;
    texture.image = add_image(scene, texels);
    return texture;
}

constexpr glm::u8vec4 kBlack{0, 0, 0, 255};
constexpr glm::u8vec4 kWhite{255};
constexpr glm::u8vec4 kFlat{128, 127, 255, 255};
constexpr glm::u8vec4 kTilted{190, 127, 240, 255};

/// A triangle mesh under a node that nothing moves, and a second object; all diffuse and unlit.
inline Scene plain()
{
    Scene scene;
    scene.materials.push_back({.name = "paint"});
    scene.materials.push_back({.name = "spare"});
    Mesh mesh{.name = "triangle"};
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.triangles = {{0, 1, 2}};
    mesh.uvs[0] = {{0, 0}, {1, 0}, {0, 1}};
    scene.meshes.push_back(mesh);
    scene.animation.nodes.push_back({.name = "joint"});
    scene.objects.push_back({.name = "sail", .shape = MeshInstance{}, .node = 0});
    return scene;
}

inline Track moving_track()
{
    Track track;
    track.times = {0, 1};
    track.values = {0, 0, 0, 1, 0, 0};
    return track;
}

inline EffectMask mask_of_scene(Scene scene)
{
    drop_neutral(scene);
    return mask_of(active_effects(scene, pack_scene(scene).content));
}

}  // namespace farlight
