// Changes from pairs, then shapes that are posed, then places and motion.
#include "tests/support/random_scene.h"

#include "tests/scene/plain_scene.h"
#include "tests/support/effect_pairs.h"

#include <glm/gtc/matrix_transform.hpp>

namespace farlight {
namespace {

/// In [0, 1), the same with every standard library.
double uniform(std::mt19937& random)
{
    return random() / 4294967296.0;
}

glm::dvec3 direction(std::mt19937& random)
{
    const auto part = [&] { return uniform(random) - 0.5; };
    return glm::normalize(glm::dvec3(part(), part(), part()) + glm::dvec3(0, 0, 1e-3));
}

Track spin(std::uint32_t node, const glm::dvec3& axis)
{
    const glm::dquat half = glm::angleAxis(1.5, axis);
    Track track;
    track.target = Track::Target::kRotation;
    track.index = node;
    track.times = {0, 1};
    track.values = {0, 0, 0, 1, static_cast<float>(half.x), static_cast<float>(half.y),
        static_cast<float>(half.z), static_cast<float>(half.w)};
    return track;
}

/// A mesh of its own with a target, held by no track, by one that never changes, or driven.
std::string add_morph(Scene& scene, std::mt19937& random)
{
    Mesh mesh = scene.meshes[0];
    mesh.morph_targets = {{{{0, 0, 1}, {0.3F, 0, 0}, {0, 0.4F, 0}}, {}}};
    const auto object = static_cast<std::uint32_t>(scene.objects.size());
    scene.objects.push_back({.name = "posed",
        .shape = MeshInstance{
            .mesh = static_cast<std::uint32_t>(scene.meshes.size()), .morph_weights = {0.6F}}});
    scene.meshes.push_back(mesh);
    static constexpr const char* kKinds[] = {"resting morph", "held morph", "driven morph"};
    const auto kind = random() % std::size(kKinds);
    if (kind > 0) {
        Track track;
        track.target = Track::Target::kMorphWeights;
        track.index = object;
        track.times = {0, 1};
        track.values = {0.2F, kind == 1 ? 0.2F : 1};
        scene.animation.tracks.push_back(track);
    }
    return kKinds[kind];
}

/// A mesh of its own on two joints, of which the second turns or not.
std::string add_skin(Scene& scene, std::mt19937& random)
{
    Mesh mesh = scene.meshes[0];
    mesh.joints = {{0, 1, 0, 0}, {0, 1, 0, 0}, {0, 1, 0, 0}};
    mesh.weights = {{1, 0, 0, 0}, {0.5F, 0.5F, 0, 0}, {0, 1, 0, 0}};
    const auto joint = static_cast<std::uint32_t>(scene.animation.nodes.size());
    scene.animation.nodes.push_back({.name = "lower", .translation = {-0.8, 0.2, 0.4}});
    scene.animation.nodes.push_back({.name = "upper", .parent = joint, .translation = {0, 0.3, 0}});
    const auto skin = static_cast<std::uint32_t>(scene.animation.skins.size());
    scene.animation.skins.push_back({{joint, joint + 1}, {glm::dmat4(1), glm::dmat4(1)}});
    scene.objects.push_back({.name = "posed",
        .shape =
            MeshInstance{.mesh = static_cast<std::uint32_t>(scene.meshes.size()), .skin = skin}});
    scene.meshes.push_back(mesh);
    if (random() % 2 == 0)
        return "resting skin";
    scene.animation.tracks.push_back(spin(joint + 1, direction(random)));
    return "bending skin";
}

/// Hangs what hangs on nothing on a node of its own; some of them spin.
std::string scatter(Scene& scene, std::mt19937& random)
{
    std::string spinning;
    for (Object& object : scene.objects) {
        if (object.node != kNone)
            continue;
        object.node = static_cast<std::uint32_t>(scene.animation.nodes.size());
        Node node{.name = "place"};
        node.translation = direction(random) * 1.5;
        node.rotation = glm::angleAxis(uniform(random), direction(random));
        scene.animation.nodes.push_back(node);
        // What has a pose always: it must move as it did with everything compiled.
        if (object.name != "posed" && random() % 2 != 0)
            continue;
        scene.animation.tracks.push_back(spin(object.node, direction(random)));
        spinning += ", " + object.name + " spins";
    }
    return spinning;
}

}  // namespace

Scene random_scene(std::mt19937& random, std::string& what)
{
    Scene scene = lit_scene();
    scene.camera = {{0.4, 0.6, 5}, {0, 0, 0}, {0, 1, 0}, 45};
    const std::vector<EffectPair> pairs = effect_pairs();
    for (int i = 0; i < 4; ++i) {
        const EffectPair& pair = pairs[random() % pairs.size()];
        what += std::string(pair.effect) + ", ";
        // The mesh stays one: what others change of it must be there.
        if (pair.effect != "triangles")
            pair.without(scene);
        pair.with(scene);
    }
    what += random() % 2 == 0 ? add_morph(scene, random) : add_skin(scene, random);
    what += scatter(scene, random);
    return scene;
}

}  // namespace farlight
