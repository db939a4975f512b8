// Animation: what changes with time, as a pure function of time: nodes, skins, and tracks that
// drive them.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <span>
#include <string>
#include <vector>

namespace farlight {

/// Translation * rotation * scale, as glTF has it; parents come before their children.
struct Node {
    std::string name;
    std::uint32_t parent = 0xffffffff;  ///< Index into Animation::nodes, or none.
    glm::dvec3 translation{0};
    glm::dquat rotation{1, 0, 0, 0};  ///< Unit.
    glm::dvec3 scale{1};
    glm::dmat4 local{
        1};  ///< A fixed matrix under the above (parent * local * TRS); glTF nodes with `matrix`.
};

struct Skin {
    std::vector<std::uint32_t> joints;  ///< Indices into Animation::nodes.
    std::vector<glm::dmat4> joint_from_mesh;  ///< Inverse bind matrices, one a joint.
};

/// Keyframes of one quantity. Before the first and after the last key its value stays.
struct Track {
    enum class Target : std::uint8_t {
        kTranslation,  ///< Of node `index`; 3 numbers.
        kRotation,  ///< Of node `index`; quaternion x, y, z, w; linear means slerp.
        kScale,  ///< Of node `index`; 3 numbers.
        kMorphWeights,  ///< Of object `index`; one number a morph target.
        kMaterialEmission,  ///< Factor on the emission of material `index`; 1 number >= 0.
        kLightIntensity,  ///< Factor on the intensity of Scene::lights[index]; 1 number >= 0.
        kBackground,  ///< Factor on Scene::background; 1 number >= 0.
    };
    enum class Interpolation : std::uint8_t { kStep, kLinear, kCubic };

    Target target = Target::kTranslation;
    std::uint32_t index = 0;
    Interpolation interpolation = Interpolation::kLinear;
    std::vector<double> times;  ///< [s], strictly increasing, >= 0, at least one.
    std::vector<float>
        values;  ///< Width numbers a key; cubic: in-tangent, value, out-tangent a key (glTF).
    double period = 0;  ///< [s]; > 0: time wraps round at it (glTF clips); 0: plays once.
};

struct Animation {
    std::vector<Node> nodes;  ///< Only those that something hangs on.
    std::vector<Skin> skins;
    std::vector<Track> tracks;

    bool empty() const { return tracks.empty(); }
};

/// Numbers a value of the track has.
std::size_t width_of(const Track& track);

/// The track's value at `time` [s], into `width_of(track)` numbers. Rotations come out unit.
void evaluate(const Track& track, double time, std::span<double> value);

/// What becomes of an animation in the long run.
struct Course {
    double duration = 0;  ///< [s] until each track has come to its end or its first repetition.
    bool all_repeat = false;  ///< All together, after `duration`.
    bool any_repeats = false;
};
Course course_of(const Animation& animation);

/// The first moment that looks like `time` and all after it, or `time` itself.
double moment_shown(const Animation& animation, double time);

/// world_from_node of every node at `time`.
std::vector<glm::dmat4> pose_nodes(const Animation& animation, double time);

/// For every node: whether a track moves it or one that carries it.
std::vector<bool> moving_nodes(const Animation& animation);

/// Whether any track drives such a target.
bool drives(const Animation& animation, Track::Target target);

/// The product of the tracks that scale `target` `index` at `time`; 1 without any. For targets of
/// one number.
double factor_at(
    const Animation& animation, Track::Target target, std::uint32_t index, double time);

/// Morph weights of object `object` at `time`: its track's, else `at_rest`.
std::vector<float> morph_weights_at(const Animation& animation, std::uint32_t object,
    const std::vector<float>& at_rest, double time);

}  // namespace farlight
