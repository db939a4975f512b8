// What a server says to a client, as plain structs. PROTOCOL.md section 4 says what they mean.
#pragma once

#include "protocol/fields.h"

namespace farlight::protocol {

struct Keyframe {
    double frame = 0;  ///< Frames since the path's start, strictly increasing.
    Pose pose;  ///< Its fields lie beside `frame`.

    bool operator==(const Keyframe&) const = default;

    static void each_field(auto& m, auto&& visit)
    {
        visit("frame", m.frame, Rule{.lower = 0, .upper = 1e9});
        Pose::each_field(m.pose, visit);
    }
};

struct BoundingBox {
    std::array<double, 3> lower{};
    std::array<double, 3> upper{};

    bool operator==(const BoundingBox&) const = default;

    static void each_field(auto& m, auto&& visit)
    {
        visit("lower", m.lower, Rule{});
        visit("upper", m.upper, Rule{});
    }
};

struct SceneSummary {
    std::string name;
    std::string file;
    std::vector<std::string> notes;
    std::optional<BoundingBox> bounds;  ///< Absent for an empty scene.
    std::uint64_t triangles = 0;
    std::uint64_t lights = 0;
    std::optional<double> duration;  ///< [s] Absent: nothing follows time.
    Afterwards afterwards = Afterwards::kRests;

    bool operator==(const SceneSummary&) const = default;

    static void each_field(auto& m, auto&& visit)
    {
        visit("name", m.name, Rule{});
        visit("file", m.file, Rule{});
        visit("notes", m.notes, Rule{});
        visit("bounds", m.bounds, Rule{});
        visit("triangles", m.triangles, Rule{});
        visit("lights", m.lights, Rule{});
        visit("duration", m.duration, Rule{});
        visit("afterwards", m.afterwards, kOptional);
    }
};

struct Limits {
    std::uint32_t max_dimension = 0;  ///< [px] largest width or height.
    std::uint32_t max_in_flight = kMaxInFlight;
    std::uint32_t max_message_bytes = kMaxClientTextBytes;

    bool operator==(const Limits&) const = default;

    static void each_field(auto& m, auto&& visit)
    {
        visit("max_dimension", m.max_dimension, Rule{});
        visit("max_in_flight", m.max_in_flight, Rule{});
        visit("max_message_bytes", m.max_message_bytes, Rule{});
    }
};

struct Welcome {
    static constexpr std::string_view kType = "welcome";

    std::string protocol{kSubprotocol};
    std::string server;  ///< Name and version.
    std::string session;
    Mode mode = Mode::kInteractive;
    Format format = Format::kJpeg420;
    Size size{1, 1};
    std::uint32_t max_in_flight = 2;
    std::string device;
    std::string gl_renderer;
    SceneSummary scene;
    Pose camera;
    std::map<std::string, std::vector<Keyframe>> camera_paths;
    std::vector<std::string> effects;
    nlohmann::json settings = nlohmann::json::array();  ///< As describe_settings() writes them.
    Limits limits;
    bool edits = true;  ///< `edit` is taken.

    bool operator==(const Welcome&) const = default;

    static void each_field(auto& m, auto&& visit)
    {
        visit("protocol", m.protocol, Rule{});
        visit("server", m.server, Rule{});
        visit("session", m.session, Rule{});
        visit("mode", m.mode, Rule{});
        visit("format", m.format, Rule{});
        visit("size", m.size, kSizeRule);
        visit("max_in_flight", m.max_in_flight, Rule{.lower = 1, .upper = kMaxInFlight});
        visit("device", m.device, Rule{});
        visit("gl_renderer", m.gl_renderer, Rule{});
        visit("scene", m.scene, Rule{});
        visit("camera", m.camera, Rule{});
        visit("camera_paths", m.camera_paths, Rule{});
        visit("effects", m.effects, Rule{});
        visit("settings", m.settings, Rule{});
        visit("limits", m.limits, Rule{});
        visit("edits", m.edits, kOptional);
    }
};

struct State {
    static constexpr std::string_view kType = "state";

    std::map<std::string, nlohmann::json> settings;  ///< Every setting, not only the changed one.
    Size size{1, 1};
    Format format = Format::kJpeg420;

    bool operator==(const State&) const = default;

    static void each_field(auto& m, auto&& visit)
    {
        visit("settings", m.settings, Rule{});
        visit("size", m.size, kSizeRule);
        visit("format", m.format, Rule{});
    }
};

struct Error {
    static constexpr std::string_view kType = "error";

    ErrorCode code = ErrorCode::kNotJson;
    std::string message;  ///< For people: what was found, what was expected.
    std::optional<std::string> field;  ///< The field or setting at fault.
    bool fatal = false;  ///< The server closes the connection next.

    bool operator==(const Error&) const = default;

    static void each_field(auto& m, auto&& visit)
    {
        visit("code", m.code, Rule{});
        visit("message", m.message, Rule{});
        visit("field", m.field, Rule{});
        visit("fatal", m.fatal, Rule{});
    }
};

struct Pong {
    static constexpr std::string_view kType = "pong";

    double t = 0;

    bool operator==(const Pong&) const = default;

    static void each_field(auto& m, auto&& visit) { visit("t", m.t, Rule{}); }
};

/// The scene is another from the next frame on.
struct SceneChanged {
    static constexpr std::string_view kType = "scene_changed";

    std::optional<std::uint32_t> edit;  ///< Id of this session's edit that did it.
    SceneSummary scene;
    std::vector<std::string> effects;

    bool operator==(const SceneChanged&) const = default;

    static void each_field(auto& m, auto&& visit)
    {
        visit("edit", m.edit, Rule{});
        visit("scene", m.scene, Rule{});
        visit("effects", m.effects, Rule{});
    }
};

struct CalledEffect {
    std::string name;
    std::string reason;
    std::string setting;  ///< That calls for it; empty: the scene does.

    bool operator==(const CalledEffect&) const = default;

    static void each_field(auto& m, auto&& visit)
    {
        visit("name", m.name, Rule{});
        visit("reason", m.reason, Rule{});
        visit("setting", m.setting, kOptional);
    }
};

struct MemoryUse {
    std::string name;
    std::uint64_t bytes = 0;

    bool operator==(const MemoryUse&) const = default;

    static void each_field(auto& m, auto&& visit)
    {
        visit("name", m.name, Rule{});
        visit("bytes", m.bytes, Rule{});
    }
};

/// A number that programs are compiled with.
struct ProgramConstant {
    std::string name;
    std::uint64_t value = 0;

    bool operator==(const ProgramConstant&) const = default;

    static void each_field(auto& m, auto&& visit)
    {
        visit("name", m.name, Rule{});
        visit("value", m.value, Rule{});
    }
};

/// What the scene calls for, and what this session's last frame was drawn with.
struct Inspection {
    static constexpr std::string_view kType = "inspection";

    std::vector<CalledEffect> effects;
    std::vector<std::string> program;
    std::vector<ProgramConstant> constants;
    bool general = false;  ///< `program` is the one that holds everything.
    std::vector<std::string> passes;
    std::vector<MemoryUse> scene_memory;
    std::vector<MemoryUse> view_memory;
    double compile_ms = 0;  ///< Of the scene's own programs; 0: not yet compiled.

    bool operator==(const Inspection&) const = default;

    static void each_field(auto& m, auto&& visit)
    {
        visit("effects", m.effects, Rule{});
        visit("program", m.program, Rule{});
        visit("constants", m.constants, Rule{});
        visit("general", m.general, kOptional);
        visit("passes", m.passes, Rule{});
        visit("scene_memory", m.scene_memory, Rule{});
        visit("view_memory", m.view_memory, Rule{});
        visit("compile_ms", m.compile_ms, Rule{});
    }
};

/// A choice of settings, and what it costs and brings while the camera moves.
struct FrontierPoint {
    std::string label;
    std::map<std::string, nlohmann::json> settings;  ///< That tell it from the others.
    double ms = 0;  ///< A frame, without encoding.
    std::optional<double> error;  ///< relMSE; absent: not known yet.
    std::optional<double> lower;  ///< 95 % interval of `error`.
    std::optional<double> upper;

    bool operator==(const FrontierPoint&) const = default;

    static void each_field(auto& m, auto&& visit)
    {
        visit("label", m.label, Rule{});
        visit("settings", m.settings, Rule{});
        visit("ms", m.ms, Rule{});
        visit("error", m.error, Rule{});
        visit("lower", m.lower, Rule{});
        visit("upper", m.upper, Rule{});
    }
};

/// What the server may choose among to keep a budget, at this session's size.
struct Frontier {
    static constexpr std::string_view kType = "frontier";

    FrontierSource source = FrontierSource::kLearnt;
    std::vector<FrontierPoint> points;  ///< Ascending in `ms`, descending in error.
    std::optional<std::string> reason;  ///< Why the server's report is not used, or differs.

    bool operator==(const Frontier&) const = default;

    static void each_field(auto& m, auto&& visit)
    {
        visit("source", m.source, Rule{});
        visit("points", m.points, Rule{});
        visit("reason", m.reason, Rule{});
    }
};

struct ServerBye {
    static constexpr std::string_view kType = "bye";

    std::string reason;
    std::uint32_t reconnect_ms = 0;  ///< Wait this long before connecting again.

    bool operator==(const ServerBye&) const = default;

    static void each_field(auto& m, auto&& visit)
    {
        visit("reason", m.reason, Rule{});
        visit("reconnect_ms", m.reconnect_ms, Rule{});
    }
};

using ServerMessage =
    std::variant<Welcome, State, Error, Pong, ServerBye, SceneChanged, Inspection, Frontier>;

}  // namespace farlight::protocol
