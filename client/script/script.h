// Script: what a scripted-camera test file says. client/cli/SCRIPT.md explains the format to users.
#pragma once

#include "client/camera_path.h"
#include "client/script/expression.h"

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace farlight::client {

using Settings = std::map<std::string, nlohmann::json>;

/// The scene's own camera, unmoved.
struct RestMove { };
/// Turns about the scene's middle, `degrees` in all, starting `from` degrees off the scene's
/// camera.
struct OrbitMove {
    double degrees = 0;
    double from = 0;
};
/// A camera path of the scene.
struct NamedPathMove {
    std::string name;
};
struct KeyframeMove {
    std::vector<Keyframe> keyframes;
};
using CameraMove = std::variant<RestMove, OrbitMove, NamedPathMove, KeyframeMove>;

/// Happens before frame `frame` is asked for.
struct ScriptEvent {
    int frame = 0;
    Settings set;
    nlohmann::json edit;  ///< Patch of the scene; null: none.
    bool cut = false;
};

struct Reference {
    int samples = 1024;  ///< A pixel, at least.
    Settings settings;
};

struct Script {
    std::filesystem::path file;
    std::filesystem::path scene;  ///< Resolved against the script's folder.
    std::optional<protocol::Size> size;  ///< Absent: the server's.
    int frames = 1;
    CameraMove camera;
    Settings settings;  ///< Of every run and the reference.
    std::vector<ScriptEvent> events;  ///< By ascending frame.
    std::map<std::string, Settings> runs;  ///< At least one.
    std::optional<Reference> reference;
    std::vector<Expectation> expectations;

    bool edits() const;
};

/// Throws InputError.
Script read_script(const std::filesystem::path& file);
Script parse_script(const JsonInput& input);

/// The camera of `frame`, for the scene a server told of. Throws InputError when it lacks the named
/// path.
Pose pose_of(const Script& script, const protocol::Welcome& welcome, int frame);

}  // namespace farlight::client
