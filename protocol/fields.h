// What the messages of farlight.v1 are made of: limits, rules, enumerations, camera poses.
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
constexpr int kMaxJsonDepth = 16;  ///< Nested arrays and objects, the message itself included.
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

/// How a scene that follows time goes on after its duration.
enum class Afterwards : std::uint8_t { kRests, kRepeats, kGoesOn };
constexpr std::string_view kAfterwardsNames[] = {"rests", "repeats", "goes_on"};

/// Where a frontier comes from: a report that the server was given, or frames drawn so far.
enum class FrontierSource : std::uint8_t { kReport, kLearnt };
constexpr std::string_view kFrontierSourceNames[] = {"report", "learnt"};

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
    kEditRefused,
};
constexpr std::string_view kErrorCodeNames[] = {"not_json", "unknown_type", "missing_field",
    "wrong_type", "out_of_range", "not_finite", "too_deep", "too_large", "unknown_setting",
    "bad_setting", "no_hello", "second_hello", "queue_full", "too_many_errors", "render_failed",
    "edit_refused"};

constexpr const auto& names_of(Mode)
{
    return kModeNames;
}
constexpr const auto& names_of(Format)
{
    return kFormatNames;
}
constexpr const auto& names_of(Afterwards)
{
    return kAfterwardsNames;
}
constexpr const auto& names_of(FrontierSource)
{
    return kFrontierSourceNames;
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

}  // namespace farlight::protocol
