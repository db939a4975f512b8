// Motion by formula.
#include "tests/support/moving_scenes.h"

#include "lab/meshes.h"

#include <glm/gtc/matrix_transform.hpp>

namespace farlight {
namespace {

Track track(Track::Target target, std::uint32_t index, std::vector<float> values)
{
    Track t;
    t.target = target;
    t.index = index;
    t.times = {0, 1};
    t.values = std::move(values);
    return t;
}

void turn(Scene& scene, std::uint32_t node, double radians, const glm::dvec3& axis)
{
    const glm::dquat from = glm::angleAxis(radians, glm::normalize(axis));
    scene.animation.tracks.push_back(track(Track::Target::kRotation, node,
        {static_cast<float>(from.x), static_cast<float>(from.y), static_cast<float>(from.z),
            static_cast<float>(from.w), 0, 0, 0, 1}));
}

}  // namespace

void hang_on_nodes(
    Scene& scene, const std::function<glm::dmat4(std::size_t)>& world_from_node, bool moving)
{
    for (std::uint32_t i = 0; i < scene.objects.size(); ++i) {
        Node node;
        node.local = world_from_node(i);
        scene.objects[i].node = static_cast<std::uint32_t>(scene.animation.nodes.size());
        scene.animation.nodes.push_back(node);
        if (!moving)
            continue;
        scene.animation.tracks.push_back(track(
            Track::Target::kTranslation, scene.objects[i].node, {0.07F, -0.04F, 0.05F, 0, 0, 0}));
        turn(scene, scene.objects[i].node, 0.1 + 0.05 * i, {1.0 + i, 2, -1});
    }
}

Scene bending_bar(int around, int along)
{
    Scene scene = scene_of(bumpy_sphere(around, along));
    Mesh& mesh = scene.meshes[0];
    for (glm::vec3& p : mesh.positions) {
        p = glm::vec3(0.4F, 1, 0.4F) * p + glm::vec3(0, 1, 0);
        const float upper = glm::smoothstep(0.6F, 1.4F, p.y);
        mesh.joints.emplace_back(0, 1, 0, 0);
        mesh.weights.emplace_back(1 - upper, upper, 0, 0);
    }
    scene.animation.nodes.resize(2);
    scene.animation.nodes[1].parent = 0;
    scene.animation.nodes[1].translation = {0, 1, 0};
    scene.animation.skins.push_back(
        {{0, 1}, {glm::dmat4(1), glm::translate(glm::dmat4(1), glm::dvec3(0, -1, 0))}});
    std::get<MeshInstance>(scene.objects[0].shape).skin = 0;
    scene.animation.tracks.push_back(track(Track::Target::kRotation, 1,
        {0, 0, 0, 1, 0, 0, static_cast<float>(std::sin(0.5)), static_cast<float>(std::cos(0.5))}));
    scene.camera = {{0.5, 1.2, 4}, {0, 1, 0}, {0, 1, 0}, 40};
    return scene;
}

Scene swelling_sphere(int around, int along)
{
    Scene scene = scene_of(bumpy_sphere(around, along));
    MorphTarget target;
    for (const glm::vec3& p : scene.meshes[0].positions)
        target.positions.push_back(glm::vec3(0.5F, 0.2F, 0) * p + glm::vec3(0, 0.1F * p.x, 0));
    scene.meshes[0].morph_targets.push_back(target);
    std::get<MeshInstance>(scene.objects[0].shape).morph_weights = {0};
    scene.animation.tracks.push_back(track(Track::Target::kMorphWeights, 0, {0, 1}));
    hang_on_nodes(
        scene,
        [](std::size_t) {
            return glm::scale(glm::dmat4(1), {0.9, 1.1, 0.8});
        },
        true);
    scene.camera = {{0.5, 1.2, 4}, {0, 0, 0}, {0, 1, 0}, 40};
    return scene;
}

std::vector<NamedScene> resting_shapes()
{
    Scene morph = swelling_sphere(24, 16);
    auto& tracks = morph.animation.tracks;
    tracks.erase(tracks.begin());
    std::get<MeshInstance>(morph.objects[0].shape).morph_weights = {kRestingWeight};
    Scene held = morph;
    held.animation.tracks.push_back(
        track(Track::Target::kMorphWeights, 0, {kRestingWeight, kRestingWeight}));
    std::get<MeshInstance>(held.objects[0].shape).morph_weights = {0};
    Scene skin = bending_bar(24, 16);
    skin.animation.tracks.clear();
    hang_on_nodes(
        skin, [](std::size_t) { return glm::dmat4(1); }, true);
    return {{"a morph at rest", morph}, {"a morph under a constant track", held},
        {"a skin at rest", skin}};
}

}  // namespace farlight
