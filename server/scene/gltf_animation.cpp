// Reference: glTF 2.0 specification, section 3.11 "Animations".
#include "server/scene/gltf_animation.h"

#include "server/scene/gltf_accessor.h"
#include "server/scene/gltf_component.h"
#include "server/scene/mesh_repair.h"

#include <algorithm>
#include <cmath>

namespace farlight {

namespace {

using Json = nlohmann::json;
using Target = Track::Target;
using Interpolation = Track::Interpolation;

struct Path {
    const char* name;
    const char* type;  // of the output accessor
    Target target;
};
constexpr std::array<Path, 4> kPaths{{
    {"translation", "VEC3", Target::kTranslation},
    {"rotation", "VEC4", Target::kRotation},
    {"scale", "VEC3", Target::kScale},
    {"weights", "SCALAR", Target::kMorphWeights},
}};

class Reader {
public:
    Reader(
        const GltfContainer& gltf, const GltfRig& rig, const ObjectsOfNode& objects, Scene& scene)
        : gltf_(gltf)
        , rig_(rig)
        , objects_(objects)
        , scene_(scene)
    {
    }

    void read();

private:
    void read_clip(const Json& clip, const ScenePlace& place);
    void read_channel(const Json& clip, const Json& channel, const ScenePlace& place);
    std::vector<std::uint32_t> targets_of(const Path& path, std::size_t node) const;
    Track sampled(const Json& sampler, const Path& path, const ScenePlace& place);
    std::vector<float> read_values(const Json& index, const Path& path, const ScenePlace& place);
    void drop_repeated(Track& track, std::size_t width, const ScenePlace& place);
    void repair_rotations(Track& track, const ScenePlace& place);
    void check_width(const Track& track, const ScenePlace& place) const;
    void add_notes() const;

    const GltfContainer& gltf_;
    const GltfRig& rig_;
    const ObjectsOfNode& objects_;
    Scene& scene_;
    std::set<std::pair<Target, std::uint32_t>> driven_;
    std::size_t of_other_clips_ = 0;
    std::size_t other_paths_ = 0;
    std::size_t repeated_keys_ = 0;
    std::size_t changed_rotations_ = 0;
};

void Reader::read()
{
    const Json& clips = gltf_.list("animations");
    for (std::size_t i = 0; i < clips.size(); ++i)
        read_clip(clips[i], gltf_.root / "animations" / i);
    add_notes();
}

void Reader::read_clip(const Json& clip, const ScenePlace& place)
{
    std::vector<Track>& tracks = scene_.animation.tracks;
    const std::size_t first = tracks.size();
    const Json& channels = clip["channels"];
    for (std::size_t i = 0; i < channels.size(); ++i)
        read_channel(clip, channels[i], place / "channels" / i);
    double length = 0;
    for (std::size_t i = first; i < tracks.size(); ++i)
        length = std::max(length, tracks[i].times.back());
    for (std::size_t i = first; i < tracks.size(); ++i)
        tracks[i].period = length;
}

void Reader::read_channel(const Json& clip, const Json& channel, const ScenePlace& place)
{
    const Json& target = channel["target"];
    const auto path = std::find_if(kPaths.begin(), kPaths.end(),
        [&](const Path& known) { return target["path"] == known.name; });
    if (path == kPaths.end() || !target.contains("node")) {
        ++other_paths_;
        return;
    }
    const std::vector<std::uint32_t> targets = targets_of(*path, target["node"].get<std::size_t>());
    if (targets.empty())
        return;  // nothing hangs on it
    const Json& samplers = clip["samplers"];
    const auto sampler = channel["sampler"].get<std::size_t>();
    ScenePlace sampler_place = place;
    sampler_place.pointer.resize(place.pointer.rfind("/channels/"));
    sampler_place = sampler_place / "samplers" / sampler;
    Track track = sampled(samplers[sampler], *path, sampler_place);
    for (const std::uint32_t index : targets) {
        track.index = index;
        check_width(track, sampler_place);
        if (driven_.emplace(track.target, index).second)
            scene_.animation.tracks.push_back(track);
        else
            ++of_other_clips_;
    }
}

std::vector<std::uint32_t> Reader::targets_of(const Path& path, std::size_t node) const
{
    if (path.target == Target::kMorphWeights) {
        const auto found = objects_.find(node);
        return found == objects_.end() ? std::vector<std::uint32_t>() : found->second;
    }
    const std::uint32_t kept = rig_.node(node);
    return kept == kNone ? std::vector<std::uint32_t>() : std::vector<std::uint32_t>{kept};
}

std::vector<float> Reader::read_values(const Json& index, const Path& path, const ScenePlace& place)
{
    const Json& accessor = gltf_.item("accessors", index, place);
    if (accessor["type"] != path.type || accessor["componentType"] == kUnsignedInt)
        refuse(place,
            accessor["type"].get<std::string>() + " of component type "
                + accessor["componentType"].dump(),
            std::string(path.type) + " of floats, or of normalized bytes or shorts");
    std::vector<float> values;
    const auto append = [&](const auto& elements, int lanes) {
        for (const auto& element : elements)
            for (int lane = 0; lane < lanes; ++lane)
                values.push_back(element[lane]);
    };
    if (path.target == Target::kMorphWeights)
        values = read_accessor<float>(gltf_, index);
    else if (path.target == Target::kRotation)
        append(read_accessor<glm::vec4>(gltf_, index), 4);
    else
        append(read_accessor<glm::vec3>(gltf_, index), 3);
    for (const float value : values)
        if (!(std::abs(value) <= kLargestCoordinate))
            refuse(place, "a number that is not finite, or beyond 1e11", "finite numbers");
    return values;
}

Track Reader::sampled(const Json& sampler, const Path& path, const ScenePlace& place)
{
    Track track;
    track.target = path.target;
    const std::string interpolation = sampler.value("interpolation", "LINEAR");
    track.interpolation = interpolation == "STEP" ? Interpolation::kStep
        : interpolation == "CUBICSPLINE"          ? Interpolation::kCubic
                                                  : Interpolation::kLinear;
    const Json& input = gltf_.item("accessors", sampler["input"], place / "input");
    if (input["type"] != "SCALAR" || input["componentType"] != kFloat)
        refuse(place / "input",
            input["type"].get<std::string>() + " of component type "
                + input["componentType"].dump(),
            "SCALAR of floats");
    for (const float time : read_accessor<float>(gltf_, sampler["input"]))
        track.times.push_back(time);
    track.values = read_values(sampler["output"], path, place / "output");

    const std::size_t parts = track.interpolation == Interpolation::kCubic ? 3 : 1;
    const std::size_t keys = track.times.size() * parts;
    const std::size_t width = track.values.size() / keys;
    const bool any_width = path.target == Target::kMorphWeights;
    const std::size_t wanted = path.target == Target::kRotation ? 4 : 3;
    if (width == 0 || track.values.size() % keys != 0 || (!any_width && width != wanted))
        refuse(place / "output", std::to_string(track.values.size()) + " numbers",
            any_width ? "a multiple of " + std::to_string(keys)
                      : std::to_string(keys * wanted) + ", a value a key");
    drop_repeated(track, width * parts, place / "input");
    if (track.target == Target::kRotation)
        repair_rotations(track, place / "output");
    return track;
}

/// Of keys at one time the last stays.
void Reader::drop_repeated(Track& track, std::size_t width, const ScenePlace& place)
{
    std::size_t kept = 0;
    for (std::size_t i = 0; i < track.times.size(); ++i) {
        const double time = track.times[i];
        if (!(time >= 0 && std::isfinite(time)))
            refuse(place, "the time " + std::to_string(time), "finite times from 0");
        if (kept > 0 && time < track.times[kept - 1])
            refuse(place, "times that do not increase", "increasing times");
        if (kept > 0 && time == track.times[kept - 1]) {
            --kept;
            ++repeated_keys_;
        }
        track.times[kept] = time;
        std::copy_n(track.values.begin() + static_cast<std::ptrdiff_t>(i * width), width,
            track.values.begin() + static_cast<std::ptrdiff_t>(kept * width));
        ++kept;
    }
    track.times.resize(kept);
    track.values.resize(kept * width);
}

void Reader::repair_rotations(Track& track, const ScenePlace& place)
{
    const bool cubic = track.interpolation == Interpolation::kCubic;
    for (std::size_t i = 0; i < track.times.size(); ++i) {
        float* const q = track.values.data() + (cubic ? 12 * i + 4 : 4 * i);  // between tangents
        const double length = glm::length(glm::dvec4(q[0], q[1], q[2], q[3]));
        if (!(length > 0))
            refuse(place, "a quaternion of no length", "unit quaternions");
        if (std::abs(length - 1) <= kRoundedRotation)
            continue;
        ++changed_rotations_;
        for (int lane = 0; lane < 4; ++lane)
            q[lane] = static_cast<float>(q[lane] / length);
    }
}

void Reader::check_width(const Track& track, const ScenePlace& place) const
{
    if (track.target != Target::kMorphWeights)
        return;
    const auto& instance = std::get<MeshInstance>(scene_.objects[track.index].shape);
    const std::size_t targets = scene_.meshes[instance.mesh].morph_targets.size();
    const std::size_t parts = track.interpolation == Interpolation::kCubic ? 3 : 1;
    const std::size_t width = track.values.size() / (track.times.size() * parts);
    if (width != targets)
        refuse(place / "output", std::to_string(width) + " weights a key",
            std::to_string(targets) + ", one a morph target");
}

void Reader::add_notes() const
{
    const auto note = [&](std::size_t count, const char* what) {
        if (count > 0)
            scene_.notes.push_back(std::to_string(count) + what);
    };
    note(of_other_clips_, " animation channels left out: an earlier clip drives the same");
    note(other_paths_, " animation channels left out: they drive no node's transform or weights");
    note(repeated_keys_, " keyframes at the time of the next left out");
    note(changed_rotations_,
        " keyframes' rotations that were no unit quaternions brought to length 1");
}

}  // namespace

void read_gltf_animations(
    const GltfContainer& gltf, const GltfRig& rig, const ObjectsOfNode& objects, Scene& scene)
{
    Reader(gltf, rig, objects, scene).read();
}

}  // namespace farlight
