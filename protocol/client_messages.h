// What a client says to a server, as plain structs. PROTOCOL.md section 3 says what they mean.
#pragma once

#include "protocol/fields.h"

namespace farlight::protocol {

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

/// Changes the scene of all sessions.
struct Edit {  // NOLINT(bugprone-exception-escape): as Set
    static constexpr std::string_view kType = "edit";

    std::optional<std::uint32_t> id;  ///< Chosen by the client; the answer echoes it.
    nlohmann::json patch = nlohmann::json::object();  ///< JSON Merge Patch of the scene document.
    bool reset = false;  ///< Back to the scene as it was loaded, before `patch`.

    bool operator==(const Edit&) const = default;

    static void each_field(auto& m, auto&& visit)
    {
        visit("id", m.id, Rule{});
        visit("patch", m.patch, Rule{});
        visit("reset", m.reset, kOptional);
    }
};

/// Asks what is compiled and allocated.
struct Inspect {
    static constexpr std::string_view kType = "inspect";

    bool operator==(const Inspect&) const = default;

    static void each_field(auto&, auto&&) { }
};

struct ClientBye {
    static constexpr std::string_view kType = "bye";

    bool operator==(const ClientBye&) const = default;

    static void each_field(auto&, auto&&) { }
};

using ClientMessage =
    std::variant<Hello, Camera, Set, Resize, SetFormat, Ack, Ping, ClientBye, Edit, Inspect>;

}  // namespace farlight::protocol
