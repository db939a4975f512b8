// See the header.
#include "server/stream/welcome.h"

#include <nlohmann/json.hpp>

namespace farlight {
namespace {

std::array<double, 3> to_array(const glm::dvec3& v)
{
    return {v.x, v.y, v.z};
}

glm::dvec3 to_vector(const std::array<double, 3>& v)
{
    return {v[0], v[1], v[2]};
}

protocol::SceneSummary summary_of(const RendererDescription& description)
{
    protocol::SceneSummary scene;
    scene.name = description.scene_name;
    scene.file = description.scene_file;
    scene.notes = description.scene_notes;
    scene.triangles = description.triangles;
    scene.lights = description.lights;
    if (description.course) {
        using protocol::Afterwards;
        const Course& course = *description.course;
        scene.duration = course.duration;
        scene.afterwards = course.all_repeat ? Afterwards::kRepeats
            : course.any_repeats             ? Afterwards::kGoesOn
                                             : Afterwards::kRests;
    }
    if (!description.bounds.empty())
        scene.bounds = {to_array(description.bounds.lower), to_array(description.bounds.upper)};
    return scene;
}

}  // namespace

CameraPose pose_from_wire(const protocol::Pose& pose)
{
    return {to_vector(pose.position), to_vector(pose.target), to_vector(pose.up),
        pose.vertical_fov_degrees};
}

protocol::Pose pose_to_wire(const CameraPose& pose)
{
    return {to_array(pose.position), to_array(pose.target), to_array(pose.up),
        pose.vertical_fov_degrees};
}

protocol::Welcome describe_server(const RendererDescription& description)
{
    protocol::Welcome welcome;
    welcome.server = "farlight " FARLIGHT_VERSION;
    welcome.device = description.device;
    welcome.gl_renderer = description.gl_renderer;
    welcome.scene = summary_of(description);
    welcome.camera = pose_to_wire(description.camera);
    for (const auto& [name, keyframes] : description.camera_paths)
        for (const CameraKeyframe& keyframe : keyframes)
            welcome.camera_paths[name].push_back({keyframe.frame, pose_to_wire(keyframe.pose)});
    for (const ActiveEffect& effect : description.effects)
        welcome.effects.push_back(std::string(effect.name) + ": " + effect.reason);
    welcome.limits.max_dimension = static_cast<std::uint32_t>(description.max_dimension);
    return welcome;
}

std::map<std::string, nlohmann::json> setting_values(const RenderSettings& settings)
{
    std::map<std::string, nlohmann::json> values;
    for (const nlohmann::json& row : describe_settings(settings, settings))
        values[row.at("key").get<std::string>()] = row.at("value");
    return values;
}

bool is_setting(std::string_view key)
{
    bool found = false;
    RenderSettings settings;
    RenderSettings::each_field(
        settings, [&](const auto&, std::string_view name, const auto&, std::string_view) {
            found = found || name == key;
        });
    return found;
}

}  // namespace farlight
