// FrontierReport: what `farlight accuracy` measured, as far as a controller needs it.
#pragma once

#include "server/gl/extent.h"
#include "server/stream/ladder.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace farlight {

/// What tells one scene from another, as `welcome` says it.
struct SceneIdentity {
    std::string name;
    std::uint64_t triangles = 0;
    std::uint64_t lights = 0;

    bool operator==(const SceneIdentity&) const = default;
};

struct FrontierReport {
    struct Point {
        std::string label;
        std::map<std::string, nlohmann::json> settings;  ///< Known keys, values in range.
        double ms = 0;
        RungError error;
    };

    std::string file;  ///< For errors.
    SceneIdentity scene;
    std::string device;  ///< Its name as OpenGL tells it; empty: not known.
    bool of_this_device = true;  ///< Else times are less sure until frames have corrected them.
    Extent size;
    std::vector<Point> points;  ///< Ascending in ms, descending in error; at least one.
};

/// Throws SceneError that names the file, the place in it, what was found and what was expected.
FrontierReport read_frontier_report(const std::filesystem::path& file);

/// The same from text; `name` stands for the file in errors.
FrontierReport parse_frontier_report(std::string_view text, const std::string& name);

/// The report for a server that shows `scene` on `device`. Throws SceneError where it is of another
/// scene; another device only shows.
FrontierReport report_for(
    FrontierReport report, const SceneIdentity& scene, const std::string& device);

/// How it was measured, in words, if that differs from pictures of `extent` drawn here.
std::optional<std::string> otherwise_measured(const FrontierReport& report, Extent extent);

/// The points that a session with these wishes can be moved to, as rungs: those that differ from
/// the wishes in nothing but choices. `ms` is the report's.
std::vector<Rung> rungs_of(const FrontierReport& report, const RenderSettings& wishes);

}  // namespace farlight
