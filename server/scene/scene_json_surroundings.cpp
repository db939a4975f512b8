// What is around the objects, and who looks at them.
#include "server/scene/scene_json_surroundings.h"

#include "server/scene/camera_limits.h"
#include "server/scene/scene_json_values.h"

namespace farlight {

namespace {

using Json = nlohmann::json;

CameraPose read_pose(const Json& value, const CameraPose& before, const ScenePlace& place)
{
    CameraPose pose;
    pose.position = vec3_or(value, "position", before.position);
    pose.target = vec3_or(value, "target", before.target);
    pose.up = vec3_or(value, "up", before.up);
    pose.vertical_fov_degrees = value.value("vertical_fov_degrees", before.vertical_fov_degrees);
    if (value.contains("up") && pose.up == glm::dvec3(0))
        refuse(place / "up", describe(value["up"]), "a direction: not all three 0");
    if (!(glm::length(pose.target - pose.position) > nearest_target(pose.position, pose.target)))
        refuse(place / (value.contains("target") ? "target" : "position"),
            "a camera that stands on its target", "a target away from position");
    return pose;
}

std::vector<CameraKeyframe> read_path(
    const Json& value, const CameraPose& start, const ScenePlace& place)
{
    std::vector<CameraKeyframe> path;
    CameraPose pose = start;
    for (std::size_t i = 0; i < value.size(); ++i) {
        const double frame = value[i]["frame"].get<double>();
        if (!path.empty() && !(frame > path.back().frame))
            refuse(place / i / "frame", "frame " + value[i]["frame"].dump(),
                "more than the keyframe before, " + value[i - 1]["frame"].dump());
        pose = read_pose(value[i], pose, place / i);
        path.push_back({frame, pose});
    }
    return path;
}

}  // namespace

void read_environment(const Json& document, const ScenePlace& root, SceneFiles& files, Scene& scene)
{
    scene.background = vec3_or(document, "background", glm::dvec3(0));
    if (!document.contains("environment"))
        return;
    if (document.contains("background"))
        refuse(root / "background", "a background beside an environment", "one of the two");
    const Json& value = document["environment"];
    const auto& name = value["file"].get_ref<const std::string&>();
    const auto file = files.environment(name, root / "environment" / "file");
    if (file->repaired_texels > 0)
        scene.notes.push_back(name + ": " + std::to_string(file->repaired_texels)
            + " texels that are not finite or negative are black, those beyond 1e18 that bright");
    scene.environment = {file, &file->map};
    scene.background = vec3_or(value, "scale", glm::dvec3(1));
    scene.map_from_world = glm::transpose(glm::dmat3(rotation(value)));
}

void read_fog(const Json& document, Scene& scene)
{
    if (!document.contains("fog"))
        return;
    const Json& value = document["fog"];
    scene.medium.name = value.value("name", "fog");
    scene.medium.sigma_a = vec3_or(value, "absorption", glm::dvec3(0));
    scene.medium.sigma_s = vec3_or(value, "scattering", glm::dvec3(0));
    scene.medium.g = value.value("g", 0.0F);
}

void read_camera(const Json& document, const ScenePlace& root, Scene& scene)
{
    if (!document.contains("camera"))
        return;
    const Json& value = document["camera"];
    scene.camera = read_pose(value, CameraPose{}, root / "camera");
    scene.lens.radius = value.value("lens_radius", 0.0);
    scene.lens.focus_distance = value.value("focus_distance", 0.0);
}

void read_camera_paths(const Json& document, const ScenePlace& root, Scene& scene)
{
    if (!document.contains("camera_paths"))
        return;
    for (const auto& [name, keyframes] : document["camera_paths"].items())
        scene.camera_paths[name] = read_path(keyframes, scene.camera, root / "camera_paths" / name);
}

void read_settings(const Json& document, Scene& scene)
{
    if (!document.contains("settings"))
        return;
    for (const auto& [key, value] : document["settings"].items()) {
        if (value.is_boolean())
            scene.settings[key] = value.get<bool>();
        else if (value.is_number())
            scene.settings[key] = value.get<double>();
        else
            scene.settings[key] = value.get<std::string>();
    }
}

}  // namespace farlight
