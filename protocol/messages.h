// The JSON messages of farlight.v1, as plain structs. PROTOCOL.md says what they mean; a test holds
// the two together.
//
// each_field is the one list of a message's fields: encoder, decoder and the test of the
// documentation use it. A std::optional or a field whose Rule says so may be absent; every other
// field must be there.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace farlight::protocol {

constexpr std::string_view kSubprotocol = "farlight.v1";
constexpr std::string_view kEndpoint = "/ws";
constexpr std::size_t kMaxClientTextBytes = 16'384;  ///< Longest text message a server takes.
constexpr std::size_t kMaxServerTextBytes = 4'194'304;  ///< Longest text message a client takes.
constexpr int kMaxJsonDepth = 8;  ///< Nested arrays and objects, the message itself included.
constexpr std::uint32_t kMaxInFlight = 8;
constexpr std::size_t kLockstepQueue = 64;  ///< Camera messages waiting in lockstep mode.
constexpr double kMaxCoordinate = 1e12;

/// What a field may hold, besides its type. Numbers are always finite.
struct Rule {
    bool required = true;
    double lower = -std::numeric_limits<double>::infinity();  ///< Of a number or of each array
                                                              ///< element, inclusive.
    double upper = std::numeric_limits<double>::infinity();
    std::size_t longest = 65536;  ///< [bytes] of a string.
};

constexpr Rule kOptional{.required = false};
constexpr Rule kCoordinate{.lower = -kMaxCoordinate, .upper = kMaxCoordinate};

enum class Mode : std::uint8_t { kInteractive, kLockstep };
constexpr std::string_view kModeNames[] = {"interactive", "lockstep"};

/// Values are those of the frame header's `format` byte.
enum class Format : std::uint8_t { kJpeg420, kJpeg444, kPng, kRaw };
constexpr std::string_view kFormatNames[] = {"jpeg420", "jpeg444", "png", "raw"};

enum class ErrorCode : std::uint8_t {
    kNotJson,
    kUnknownType,
    kMissingField,
    kWrongType,
    kOutOfRange,
    kNotFinite,
    kTooDeep,
    kTooLarge,
    kUnknownSetting,
    kBadSetting,
    kNoHello,
    kSecondHello,
    kQueueFull,
    kTooManyErrors,
    kRenderFailed,
};
constexpr std::string_view kErrorCodeNames[] = {"not_json", "unknown_type", "missing_field",
    "wrong_type", "out_of_range", "not_finite", "too_deep", "too_large", "unknown_setting",
    "bad_setting", "no_hello", "second_hello", "queue_full", "too_many_errors", "render_failed"};

constexpr const auto& names_of(Mode)
{
    return kModeNames;
}
constexpr const auto& names_of(Format)
{
    return kFormatNames;
}
constexpr const auto& names_of(ErrorCode)
{
    return kErrorCodeNames;
}

/// The wire's word for an enumerator.
template <typename Enum> constexpr std::string_view name_of(Enum value)
{
    return names_of(value)[static_cast<std::size_t>(value)];
}

using Size = std::array<std::uint32_t, 2>;  ///< Width, height [px].
constexpr Rule kSizeRule{.lower = 1, .upper = 65535};

/// Where a camera stands and looks. World space, scene units.
struct Pose {
    std::array<double, 3> position{0, 0, 0};
    std::array<double, 3> target{0, 0, -1};
    std::array<double, 3> up{0, 1, 0};
    double vertical_fov_degrees = 45;

    bool operator==(const Pose&) const = default;

    static void each_field(auto& m, auto&& visit)
    {
        visit("position", m.position, kCoordinate);
        visit("target", m.target, kCoordinate);
        visit("up", m.up, kCoordinate);
        visit("vertical_fov_degrees", m.vertical_fov_degrees, Rule{.lower = 0.001, .upper = 179.0});
    }
};

// ---------------------------------------------------------------- client to server

struct Hello {
    static constexpr std::string_view kType = "hello";

    std::string client;  ///< Name and version of the program, for logs.
    Mode mode = Mode::kInteractive;
    Format format = Format::kJpeg420;
    std::optional<Size> size;  ///< Absent: the server's default.
    std::uint32_t max_in_flight = 2;
    std::map<std::string, nlohmann::json>
        settings;  ///< Start values that differ from the server's.

    bool operator==(const Hello&) const = default;

    static void each_field(auto& m, auto&& visit)
    {
        visit("client", m.client, Rule{.longest = 128});
        visit("mode", m.mode, kOptional);
        visit("format", m.format, kOptional);
        visit("size", m.size, kSizeRule);
        visit("max_in_flight", m.max_in_flight,
            Rule{.required = false, .lower = 1, .upper = kMaxInFlight});
        visit("settings", m.settings, kOptional);
    }
};

struct Camera {
    static constexpr std::string_view kType = "camera";

    std::uint32_t sequence = 0;  ///< Echoed in the header of the frames that show this camera.
    Pose pose;  ///< Its fields lie in the message itself, not in an object of their own.
    bool cut = false;  ///< Forget history: this is a jump, not a move.

    bool operator==(const Camera&) const = default;

    static void each_field(auto& m, auto&& visit)
    {
        visit("sequence", m.sequence, Rule{});
        Pose::each_field(m.pose, visit);
        visit("cut", m.cut, kOptional);
    }
};

// nlohmann's move constructor checks itself by code that the analyzer thinks may throw.
struct Set {  // NOLINT(bugprone-exception-escape)
    static constexpr std::string_view kType = "set";

    std::string key;
    nlohmann::json value;  ///< String, number or boolean.

    bool operator==(const Set&) const = default;

    static void each_field(auto& m, auto&& visit)
    {
        visit("key", m.key, Rule{.longest = 64});
        visit("value", m.value, Rule{});
    }
};

struct Resize {
    static constexpr std::string_view kType = "resize";

    std::uint32_t width = 1;  ///< [px]
    std::uint32_t height = 1;  ///< [px]

    bool operator==(const Resize&) const = default;

    static void each_field(auto& m, auto&& visit)
    {
        visit("width", m.width, kSizeRule);
        visit("height", m.height, kSizeRule);
    }
};

struct SetFormat {
    static constexpr std::string_view kType = "format";

    Format format = Format::kJpeg420;

    bool operator==(const SetFormat&) const = default;

    static void each_field(auto& m, auto&& visit) { visit("format", m.format, Rule{}); }
};

/// Frame `frame_id` and all before it have been decoded and shown.
struct Ack {
    static constexpr std::string_view kType = "ack";

    std::uint32_t frame_id = 0;
    std::optional<std::uint32_t> decode_us;
    std::optional<std::uint32_t> shown_us;

    bool operator==(const Ack&) const = default;

    static void each_field(auto& m, auto&& visit)
    {
        visit("frame_id", m.frame_id, Rule{});
        visit("decode_us", m.decode_us, Rule{});
        visit("shown_us", m.shown_us, Rule{});
    }
};

struct Ping {
    static constexpr std::string_view kType = "ping";

    double t = 0;  ///< The sender's clock, returned unread.

    bool operator==(const Ping&) const = default;

    static void each_field(auto& m, auto&& visit) { visit("t", m.t, Rule{}); }
};

struct ClientBye {
    static constexpr std::string_view kType = "bye";

    bool operator==(const ClientBye&) const = default;

    static void each_field(auto&, auto&&) { }
};

using ClientMessage = std::variant<Hello, Camera, Set, Resize, SetFormat, Ack, Ping, ClientBye>;

// ---------------------------------------------------------------- server to client

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

    bool operator==(const SceneSummary&) const = default;

    static void each_field(auto& m, auto&& visit)
    {
        visit("name", m.name, Rule{});
        visit("file", m.file, Rule{});
        visit("notes", m.notes, Rule{});
        visit("bounds", m.bounds, Rule{});
        visit("triangles", m.triangles, Rule{});
        visit("lights", m.lights, Rule{});
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

using ServerMessage = std::variant<Welcome, State, Error, Pong, ServerBye>;

}  // namespace farlight::protocol
