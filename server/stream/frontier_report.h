// FrontierReport: what `farlight accuracy` measured, as far as a controller needs it.
#pragma once

#include "server/gl/extent.h"
#include "server/stream/ladder.h"

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace farlight {

struct FrontierReport {
    struct Point {
        std::string label;
        std::map<std::string, nlohmann::json> settings;  ///< Known keys, values in range.
        double ms = 0;
        RungError error;
    };

    Extent size;
    std::vector<Point> points;  ///< Ascending in ms, descending in error; at least one.
};

/// Throws SceneError that names the file, the place in it, what was found and what was expected.
FrontierReport read_frontier_report(const std::filesystem::path& file);

/// The same from text; `name` stands for the file in errors.
FrontierReport parse_frontier_report(std::string_view text, const std::string& name);

/// The points that a session with these wishes can be moved to, as rungs: those that differ from
/// the wishes in nothing but choices. `ms` is the report's.
std::vector<Rung> rungs_of(const FrontierReport& report, const RenderSettings& wishes);

}  // namespace farlight
