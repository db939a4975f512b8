// A glTF camera looks along its -z; it has no target, so the point nearest to the scene's middle
// stands for it. A camera that an animation moves is sampled at a fixed rate: paths are linear
// between their keyframes, and a glTF file's channels need not be.
#include "server/scene/gltf_camera.h"

#include "server/scene/camera_limits.h"
#include "server/scene/gltf_animation.h"
#include "server/scene/mesh_repair.h"

#include <algorithm>
#include <cmath>

namespace farlight {

namespace {

using Json = nlohmann::json;

/// As the viewer page plays a path, so that it takes as long as the animation.
constexpr double kFramesASecond = 30;
constexpr double kLastFrame = 1e9;  // the protocol's

/// Of all moving cameras together, which is a third of the longest text that a client takes. Longer
/// paths have their keyframes farther apart.
constexpr std::size_t kMostKeyframes = 4096;
constexpr std::size_t kMostCameras = 1024;

/// An orthographic camera is drawn as a perspective one from afar: rays at the picture's edge
/// differ by half this from those in its middle [degrees].
constexpr double kOrthographicFov = 1;

struct FoundCamera {
    std::size_t node;  // in the tree
    const Json* json;
    std::string name;
    bool moves;
};

bool is_orthographic(const Json& camera)
{
    return camera["type"] == "orthographic";
}

double vertical_fov(const Json& camera)
{
    return is_orthographic(camera) ? kOrthographicFov
                                   : glm::degrees(camera["perspective"]["yfov"].get<double>());
}

/// How far a perspective camera steps back from what the orthographic one looks at, to see as much.
double distance_instead(const Json& camera)
{
    const double half_height = std::abs(camera["orthographic"]["ymag"].get<double>());
    return usable_distance(half_height / std::tan(glm::radians(kOrthographicFov / 2)));
}

bool within_reach(const glm::dvec3& p)
{
    const glm::dvec3 reach = glm::abs(p);
    return reach.x <= kLargestCoordinate && reach.y <= kLargestCoordinate
        && reach.z <= kLargestCoordinate;
}

/// Nothing if the transform leaves no direction, or lies too far out.
std::optional<CameraPose> pose_at(
    const Json& camera, const glm::dmat4& world_from_node, const Bounds& bounds)
{
    const glm::dvec3 position(world_from_node[3]);
    const glm::dvec3 view = glm::normalize(-glm::dvec3(world_from_node[2]));
    const glm::dvec3 up = glm::normalize(glm::dvec3(world_from_node[1]));
    if (!(glm::length(view) > 0) || !(glm::length(up) > 0) || !within_reach(position))
        return std::nullopt;
    const double ahead = glm::dot(bounds.center() - position, view);
    if (is_orthographic(camera)) {
        const glm::dvec3 target = position + std::max(ahead, 0.0) * view;
        const CameraPose far{
            target - distance_instead(camera) * view, target, up, kOrthographicFov};
        return within_reach(far.position) ? std::optional(far) : std::nullopt;
    }
    const double nearest = 2 * nearest_target(position, position);
    const double distance =
        usable_distance(ahead > nearest ? ahead : std::max(bounds.radius(), glm::length(position)));
    return CameraPose{.position = position,
        .target = position + distance * view,
        .up = up,
        .vertical_fov_degrees = std::clamp(vertical_fov(camera), kNarrowestFov, kWidestFov)};
}

/// The cameras' nodes alone, and what moves them: a scene whose camera moves does not move itself.
class CameraMotion {
public:
    CameraMotion(const GltfContainer& gltf, const GltfTree& tree)
        : tree_(tree)
        , rig_(gltf, tree_, moving_.animation, GltfRig::Carried::kCameras)
    {
        read_gltf_animations(gltf, rig_, {}, moving_);
        duration_ = course_of(moving_.animation).duration;
        for (Track& track : moving_.animation.tracks)
            if (track.period == duration_)
                track.period = 0;  // its end is an end, not the start again
    }

    double duration() const { return duration_; }
    const std::vector<std::string>& notes() const { return moving_.notes; }

    /// The nodes' transforms at `time` [s], for world_from().
    std::vector<glm::dmat4> at(double time) const { return pose_nodes(moving_.animation, time); }
    glm::dmat4 world_from(std::size_t node, const std::vector<glm::dmat4>& posed) const
    {
        const GltfNode& camera = tree_.nodes[node];
        return camera.carrier == kNone ? camera.carrier_from_node
                                       : posed[camera.carrier] * camera.carrier_from_node;
    }

private:
    GltfTree tree_;
    Scene moving_;
    GltfRig rig_;
    double duration_ = 0;  // [s]
};

/// Frames from 0 to `last`, whole ones but the last, at most `most` of them.
std::vector<double> frames_until(double last, std::size_t most)
{
    const double step = std::max(1.0, std::ceil(last / static_cast<double>(most - 1)));
    std::vector<double> frames;
    const auto before_last = static_cast<std::size_t>(std::ceil(last / step));
    for (std::size_t i = 0; i < before_last; ++i)
        frames.push_back(static_cast<double>(i) * step);
    frames.push_back(last);
    return frames;
}

class CameraReader {
public:
    CameraReader(const GltfContainer& gltf, const GltfTree& tree, const GltfRig& rig, Scene& scene)
        : gltf_(gltf)
        , tree_(tree)
        , rig_(rig)
        , scene_(scene)
        , bounds_(scene_bounds(scene))
    {
    }

    bool read()
    {
        find();
        std::vector<std::vector<CameraKeyframe>> paths(cameras_.size());
        sample_moving(paths);
        bool has_camera = false;
        for (std::size_t i = 0; i < cameras_.size(); ++i) {
            if (!cameras_[i].moves)
                add_keyframe(i, 0, tree_.nodes[cameras_[i].node].world_from_node, paths[i]);
            if (paths[i].empty()) {
                ++without_direction_;
                continue;
            }
            if (cameras_[i].moves || has_camera)
                scene_.camera_paths[free_name(cameras_[i])] = paths[i];
            if (!has_camera)
                scene_.camera = paths[i].front().pose;
            has_camera = true;
            note_fov(*cameras_[i].json);
        }
        add_notes();
        return has_camera;
    }

private:
    void find();
    void sample_moving(std::vector<std::vector<CameraKeyframe>>& paths);
    void add_keyframe(std::size_t camera, double frame, const glm::dmat4& world_from_node,
        std::vector<CameraKeyframe>& path) const;
    std::string free_name(const FoundCamera& camera) const;
    void note_fov(const Json& camera);
    void add_notes() const;

    const GltfContainer& gltf_;
    const GltfTree& tree_;
    const GltfRig& rig_;
    Scene& scene_;
    Bounds bounds_;
    std::vector<FoundCamera> cameras_;
    std::size_t orthographic_ = 0;
    std::size_t too_many_ = 0;
    std::size_t without_direction_ = 0;
};

void CameraReader::find()
{
    for (std::size_t i = 0; i < tree_.nodes.size(); ++i) {
        const GltfNode& node = tree_.nodes[i];
        const Json& json = gltf_.list("nodes")[node.index];
        if (!json.contains("camera"))
            continue;
        const auto index = json["camera"].get<std::size_t>();
        const Json& camera = gltf_.list("cameras")[index];
        if (cameras_.size() == kMostCameras) {
            ++too_many_;
            continue;
        }
        std::string name = camera.value("name", "");
        if (name.empty())
            name = json.value("name", "");
        if (name.empty())
            name = "camera " + std::to_string(index);
        orthographic_ += is_orthographic(camera) ? 1 : 0;
        cameras_.push_back({i, &camera, std::move(name), rig_.moves(node)});
    }
    std::stable_partition(cameras_.begin(), cameras_.end(),
        [](const FoundCamera& camera) { return !is_orthographic(*camera.json); });
}

void CameraReader::sample_moving(std::vector<std::vector<CameraKeyframe>>& paths)
{
    const auto moving = static_cast<std::size_t>(std::count_if(
        cameras_.begin(), cameras_.end(), [](const FoundCamera& camera) { return camera.moves; }));
    if (moving == 0)
        return;
    const CameraMotion motion(gltf_, tree_);
    for (const std::string& note : motion.notes())  // said already where something else moves too
        if (std::find(scene_.notes.begin(), scene_.notes.end(), note) == scene_.notes.end())
            scene_.notes.push_back(note);
    const double last = std::min(motion.duration() * kFramesASecond, kLastFrame);
    for (const double frame : frames_until(last, kMostKeyframes / moving)) {
        const std::vector<glm::dmat4> posed = motion.at(frame / kFramesASecond);
        for (std::size_t i = 0; i < cameras_.size(); ++i)
            if (cameras_[i].moves)
                add_keyframe(i, frame, motion.world_from(cameras_[i].node, posed), paths[i]);
    }
}

void CameraReader::add_keyframe(std::size_t camera, double frame, const glm::dmat4& world_from_node,
    std::vector<CameraKeyframe>& path) const
{
    if (const auto pose = pose_at(*cameras_[camera].json, world_from_node, bounds_))
        path.push_back({frame, *pose});
}

std::string CameraReader::free_name(const FoundCamera& camera) const
{
    std::string name = camera.name;
    while (scene_.camera_paths.contains(name))
        name += " (node " + std::to_string(tree_.nodes[camera.node].index) + ")";
    return name;
}

void CameraReader::note_fov(const Json& camera)
{
    const double wanted = vertical_fov(camera);
    const double drawn = std::clamp(wanted, kNarrowestFov, kWidestFov);
    if (drawn != wanted)
        scene_.notes.push_back("the camera's yfov of " + Json(wanted).dump()
            + " degrees is drawn as " + Json(drawn).dump());
}

void CameraReader::add_notes() const
{
    const auto note = [&](std::size_t count, const std::string& what) {
        if (count > 0)
            scene_.notes.push_back(std::to_string(count) + what);
    };
    note(orthographic_, " orthographic cameras are perspective ones of 1 degree, seen from afar");
    note(too_many_, " cameras left out: at most " + std::to_string(kMostCameras) + " are read");
    note(without_direction_,
        " cameras left out: a scale of 0 leaves no direction, or they lie beyond 1e11");
}

}  // namespace

bool read_gltf_cameras(
    const GltfContainer& gltf, const GltfTree& tree, const GltfRig& rig, Scene& scene)
{
    return CameraReader(gltf, tree, rig, scene).read();
}

}  // namespace farlight
