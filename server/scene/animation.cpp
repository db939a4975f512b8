// Tracks between their keys, and nodes through their parents. Double precision throughout.
#include "server/scene/animation.h"

#include "server/host_guard.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace farlight {
namespace {

const HostGuard moments_in_doubles("moments_in_doubles");

constexpr std::uint32_t kNoParent = 0xffffffff;

/// Where a time lies between two keys.
struct Between {
    std::size_t key = 0;
    double fraction = 0;  ///< Of the way to the next key, in [0, 1]; 0 at and outside the ends.
    double seconds = 0;  ///< From this key to the next.
};

Between find(const Track& track, double time)
{
    if (!moments_in_doubles)
        time = static_cast<float>(time);
    // Any time, however long after the start; the remainder is exact.
    if (track.period > 0)
        time -= track.period * std::floor(time / track.period);
    const auto& times = track.times;
    const auto next = std::upper_bound(times.begin(), times.end(), time);
    if (next == times.begin())
        return {};
    const auto key = static_cast<std::size_t>(next - times.begin()) - 1;
    if (next == times.end())
        return {key, 0, 0};
    const double seconds = times[key + 1] - times[key];
    return {key, (time - times[key]) / seconds, seconds};
}

bool is_rotation(const Track& track)
{
    return track.target == Track::Target::kRotation;
}

/// Source: glTF 2.0 specification, appendix C, "Spherical Linear Interpolation": the shorter way.
void slerp(std::span<const float> a, std::span<const float> b, double t, std::span<double> out)
{
    const glm::dquat from = glm::normalize(glm::dquat(a[3], a[0], a[1], a[2]));
    const glm::dquat to = glm::normalize(glm::dquat(b[3], b[0], b[1], b[2]));
    const glm::dquat q = glm::normalize(glm::slerp(from, to, t));
    out[0] = q.x, out[1] = q.y, out[2] = q.z, out[3] = q.w;
}

void normalize_rotation(std::span<double> value)
{
    const glm::dquat q = glm::normalize(glm::dquat(value[3], value[0], value[1], value[2]));
    value[0] = q.x, value[1] = q.y, value[2] = q.z, value[3] = q.w;
}

/// Hermite spline. Source: glTF 2.0 specification, appendix C, "Cubic Spline Interpolation".
void evaluate_cubic(const Track& track, const Between& at, std::span<double> value)
{
    const std::size_t width = value.size();
    const double t = at.fraction;
    const double t2 = t * t;
    const double t3 = t2 * t;
    // A key is its in-tangent, value and out-tangent, `width` numbers each.
    const float* key = &track.values[at.key * 3 * width];
    const float* next = at.fraction > 0 ? key + 3 * width : key;
    for (std::size_t i = 0; i < width; ++i)
        value[i] = (2 * t3 - 3 * t2 + 1) * static_cast<double>(key[width + i])
            + (t3 - 2 * t2 + t) * at.seconds * static_cast<double>(key[2 * width + i])
            + (3 * t2 - 2 * t3) * static_cast<double>(next[width + i])
            + (t3 - t2) * at.seconds * static_cast<double>(next[i]);
    if (is_rotation(track))
        normalize_rotation(value);
}

glm::dmat4 local_matrix(const Node& node)
{
    glm::dmat4 m = glm::mat4_cast(node.rotation);
    for (int axis = 0; axis < 3; ++axis)
        m[axis] *= node.scale[axis];
    m[3] = glm::dvec4(node.translation, 1);
    return node.local * m;
}

void apply(const Track& track, double time, std::vector<Node>& nodes)
{
    std::array<double, 4> v{};
    switch (track.target) {
    case Track::Target::kTranslation:
        evaluate(track, time, std::span(v).first(3));
        nodes[track.index].translation = {v[0], v[1], v[2]};
        break;
    case Track::Target::kRotation:
        evaluate(track, time, v);
        nodes[track.index].rotation = glm::dquat(v[3], v[0], v[1], v[2]);
        break;
    case Track::Target::kScale:
        evaluate(track, time, std::span(v).first(3));
        nodes[track.index].scale = {v[0], v[1], v[2]};
        break;
    default: break;
    }
}

bool moves_nodes(const Track& track)
{
    return track.target == Track::Target::kTranslation || track.target == Track::Target::kRotation
        || track.target == Track::Target::kScale;
}

}  // namespace

std::size_t width_of(const Track& track)
{
    const std::size_t parts = track.interpolation == Track::Interpolation::kCubic ? 3 : 1;
    return track.values.size() / (track.times.size() * parts);
}

void evaluate(const Track& track, double time, std::span<double> value)
{
    const std::size_t width = value.size();
    assert(width == width_of(track));
    const Between at = find(track, time);
    if (track.interpolation == Track::Interpolation::kCubic)
        return evaluate_cubic(track, at, value);
    const std::span<const float> values(track.values);
    const auto key = values.subspan(at.key * width, width);
    const bool blends = track.interpolation == Track::Interpolation::kLinear && at.fraction > 0;
    const auto next = blends ? values.subspan((at.key + 1) * width, width) : key;
    if (is_rotation(track))
        return slerp(key, next, blends ? at.fraction : 0, value);
    for (std::size_t i = 0; i < width; ++i) {
        const double from = key[i];
        value[i] = blends ? from + at.fraction * (next[i] - from) : from;
    }
}

Course course_of(const Animation& animation)
{
    Course course;
    course.all_repeat = !animation.empty();
    for (const Track& track : animation.tracks) {
        const double seconds = track.period > 0 ? track.period : track.times.back();
        course.any_repeats = course.any_repeats || track.period > 0;
        course.duration = std::max(course.duration, seconds);
    }
    for (const Track& track : animation.tracks)
        course.all_repeat = course.all_repeat && track.period == course.duration;
    return course;
}

double moment_shown(const Animation& animation, double time)
{
    const Course course = course_of(animation);
    return course.any_repeats ? time : std::min(time, course.duration);
}

std::vector<glm::dmat4> pose_nodes(const Animation& animation, double time)
{
    std::vector<Node> nodes = animation.nodes;
    for (const Track& track : animation.tracks)
        apply(track, time, nodes);
    std::vector<glm::dmat4> world;
    for (const Node& node : nodes) {
        assert(node.parent == kNoParent || node.parent < world.size());
        const glm::dmat4 local = local_matrix(node);
        world.push_back(node.parent == kNoParent ? local : world[node.parent] * local);
    }
    return world;
}

std::vector<bool> moving_nodes(const Animation& animation)
{
    std::vector<bool> moving(animation.nodes.size(), false);
    for (const Track& track : animation.tracks)
        if (moves_nodes(track))
            moving[track.index] = true;
    for (std::size_t i = 0; i < moving.size(); ++i) {
        const std::uint32_t parent = animation.nodes[i].parent;
        moving[i] = moving[i] || (parent != kNoParent && moving[parent]);
    }
    return moving;
}

bool drives(const Animation& animation, Track::Target target)
{
    return std::any_of(animation.tracks.begin(), animation.tracks.end(),
        [&](const Track& track) { return track.target == target; });
}

double factor_at(const Animation& animation, Track::Target target, std::uint32_t index, double time)
{
    double factor = 1;
    for (const Track& track : animation.tracks)
        if (track.target == target && track.index == index) {
            double value = 1;
            evaluate(track, time, std::span(&value, 1));
            factor *= value;
        }
    return factor;
}

std::vector<float> morph_weights_at(const Animation& animation, std::uint32_t object,
    const std::vector<float>& at_rest, double time)
{
    for (const Track& track : animation.tracks)
        if (track.target == Track::Target::kMorphWeights && track.index == object) {
            std::vector<double> weights(width_of(track));
            evaluate(track, time, weights);
            return {weights.begin(), weights.end()};
        }
    return at_rest;
}

}  // namespace farlight
