// Poses along a path.
#include "client/camera_path.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace farlight::client {
namespace {

using Point = std::array<double, 3>;

Point interpolated(const Point& a, const Point& b, double t)
{
    return {std::lerp(a[0], b[0], t), std::lerp(a[1], b[1], t), std::lerp(a[2], b[2], t)};
}

Point point_in(const JsonInput& input)
{
    const auto elements = input.elements();
    if (elements.size() != 3)
        input.fail("an array of 3 numbers");
    Point point{};
    for (std::size_t i = 0; i < 3; ++i)
        point[i] = elements[i].number(-protocol::kMaxCoordinate, protocol::kMaxCoordinate);
    return point;
}

}  // namespace

Pose orbit(const Pose& pose, const Point& center, double degrees)
{
    const double radians = degrees * std::numbers::pi / 180;
    const double c = std::cos(radians);
    const double s = std::sin(radians);
    const auto turned = [&](const Point& p, const Point& about) {
        const double x = p[0] - about[0];
        const double z = p[2] - about[2];
        return Point{about[0] + c * x + s * z, p[1], about[2] - s * x + c * z};
    };
    Pose result = pose;
    result.position = turned(pose.position, center);
    result.target = turned(pose.target, center);
    result.up = turned(pose.up, {0, 0, 0});
    return result;
}

double orbit_angle(double total, int frame, int frames)
{
    return frames > 1 ? total * frame / (frames - 1) : 0;
}

Pose pose_at(const std::vector<Keyframe>& path, double frame)
{
    assert(!path.empty());
    const auto next = std::upper_bound(path.begin(), path.end(), frame,
        [](double at, const Keyframe& keyframe) { return at < keyframe.frame; });
    if (next == path.begin())
        return path.front().pose;
    if (next == path.end())
        return path.back().pose;
    const Keyframe& a = *(next - 1);
    const Keyframe& b = *next;
    const double t = (frame - a.frame) / (b.frame - a.frame);
    return {.position = interpolated(a.pose.position, b.pose.position, t),
        .target = interpolated(a.pose.target, b.pose.target, t),
        .up = interpolated(a.pose.up, b.pose.up, t),
        .vertical_fov_degrees =
            std::lerp(a.pose.vertical_fov_degrees, b.pose.vertical_fov_degrees, t)};
}

std::vector<Keyframe> read_keyframes(const JsonInput& input)
{
    std::vector<Keyframe> path;
    for (const JsonInput& element : input.elements()) {
        element.expect_object({"frame", "position", "target", "up", "vertical_fov_degrees"});
        Keyframe keyframe;
        keyframe.frame = element.at("frame").number(0, 1e9);
        keyframe.pose.position = point_in(element.at("position"));
        keyframe.pose.target = point_in(element.at("target"));
        if (const auto up = element.find("up"))
            keyframe.pose.up = point_in(*up);
        keyframe.pose.vertical_fov_degrees = element.at("vertical_fov_degrees").number(0.001, 179);
        if (!path.empty() && keyframe.frame <= path.back().frame)
            element.at("frame").fail(
                "more than the keyframe before, " + nlohmann::json(path.back().frame).dump());
        if (keyframe.pose.position == keyframe.pose.target)
            element.at("target").fail("another point than position");
        path.push_back(keyframe);
    }
    if (path.empty())
        input.fail("at least one keyframe");
    return path;
}

Point middle_of(const protocol::SceneSummary& scene)
{
    return scene.bounds ? interpolated(scene.bounds->lower, scene.bounds->upper, 0.5) : Point{};
}

}  // namespace farlight::client
