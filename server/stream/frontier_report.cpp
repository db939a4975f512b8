// The report's form is checked by a schema, what a schema cannot say by hand.
#include "server/stream/frontier_report.h"

#include "server/scene/json_schema.h"
#include "server/scene/json_text.h"
#include "server/stream/welcome.h"

#include <algorithm>

namespace farlight {
namespace {

using nlohmann::json;

/// What is read of a report, which holds more than this.
constexpr std::string_view kReportSchema = R"json({
"description": "an object with scene, size and frontier, as farlight accuracy writes it",
"type": "object", "required": ["scene", "size", "frontier"], "properties": {
  "scene": {"description": "an object with name, triangles and lights",
    "type": "object", "required": ["name", "triangles", "lights"], "properties": {
      "name": {"description": "text", "type": "string"},
      "triangles": {"description": "a whole number, 0 or more", "type": "integer", "minimum": 0},
      "lights": {"description": "a whole number, 0 or more", "type": "integer", "minimum": 0}}},
  "gl_renderer": {"description": "text", "type": "string"},
  "size": {"description": "[width, height] in pixels, 1 to 65536",
    "type": "array", "minItems": 2, "maxItems": 2,
    "items": {"description": "an integer from 1 to 65536",
      "type": "integer", "minimum": 1, "maximum": 65536}},
  "frontier": {"description": "an object with points", "type": "object", "required": ["points"],
    "properties": {"points": {"description": "an array of one point or more", "type": "array",
      "minItems": 1, "items": {
        "description": "an object with label, settings, ms and relmse",
        "type": "object", "required": ["label", "settings", "ms", "relmse"], "properties": {
          "label": {"description": "text", "type": "string"},
          "settings": {"description": "an object of settings by key", "type": "object"},
          "ms": {"description": "a number above 0 [ms]",
            "type": "number", "exclusiveMinimum": 0},
          "relmse": {"description": "a number above 0", "type": "number", "exclusiveMinimum": 0},
          "relmse_lower": {"description": "a number, 0 or more, or null",
            "type": ["number", "null"], "minimum": 0},
          "relmse_upper": {"description": "a number, 0 or more, or null",
            "type": ["number", "null"], "minimum": 0}}}}}}}})json";

void check_settings(const json& settings, const ScenePlace& place)
{
    RenderSettings scratch;
    for (const auto& [key, value] : settings.items()) {
        if (!is_setting(key))
            refuse(place / key, "the unknown key " + in_quotes(key), "a setting's key");
        try {
            set_setting(scratch, key, value);
        } catch (const SettingError& problem) {
            refuse(place / key, describe(value), std::string("another value: ") + problem.what());
        }
    }
}

/// Points of a frontier cost more and err less, one after the other.
void check_order(const json& before, const json& point, const ScenePlace& place)
{
    if (!(point.at("ms") > before.at("ms")))
        refuse(place / "ms", describe(point.at("ms")),
            "more than the point before, " + describe(before.at("ms")));
    if (!(point.at("relmse") < before.at("relmse")))
        refuse(place / "relmse", describe(point.at("relmse")),
            "less than the point before, " + describe(before.at("relmse")));
}

FrontierReport::Point point_of(const json& point)
{
    FrontierReport::Point read{point.at("label"), point.at("settings"), point.at("ms"), {}};
    read.error.value = point.at("relmse");
    const auto bound = [&](const char* key, double& member) {
        if (const auto found = point.find(key); found != point.end() && found->is_number())
            member = *found;
    };
    bound("relmse_lower", read.error.lower);
    bound("relmse_upper", read.error.upper);
    return read;
}

std::string to_text(const SceneIdentity& scene)
{
    return in_quotes(scene.name) + " of " + std::to_string(scene.triangles) + " triangles and "
        + std::to_string(scene.lights) + " lights";
}

}  // namespace

FrontierReport read_frontier_report(const std::filesystem::path& file)
{
    return parse_frontier_report(read_file(file, "a report of farlight accuracy"), file.string());
}

FrontierReport parse_frontier_report(std::string_view text, const std::string& name)
{
    const json document = parse_json(text, name);
    check_schema(document, kReportSchema, name);
    FrontierReport report;
    report.file = name;
    const json& scene = document.at("scene");
    report.scene = {scene.at("name"), scene.at("triangles"), scene.at("lights")};
    report.device = document.value("gl_renderer", "");
    report.size = {document.at("size").at(0), document.at("size").at(1)};
    const json& points = document.at("frontier").at("points");
    const ScenePlace place = ScenePlace{name, {}} / "frontier" / "points";
    for (std::size_t i = 0; i < points.size(); ++i) {
        check_settings(points[i].at("settings"), place / i / "settings");
        if (i > 0)
            check_order(points[i - 1], points[i], place / i);
        report.points.push_back(point_of(points[i]));
    }
    return report;
}

FrontierReport report_for(
    FrontierReport report, const SceneIdentity& scene, const std::string& device)
{
    if (report.scene != scene)
        refuse(ScenePlace{report.file, {}} / "scene", to_text(report.scene),
            to_text(scene) + ", which is shown here");
    report.of_this_device = report.device.empty() || report.device == device;
    return report;
}

std::optional<std::string> otherwise_measured(const FrontierReport& report, Extent extent)
{
    if (report.size == extent && report.of_this_device)
        return std::nullopt;
    const std::string size =
        std::to_string(report.size.width) + "x" + std::to_string(report.size.height);
    return "measured at " + size + (report.of_this_device ? "" : " on " + report.device)
        + "; its times are corrected by frames drawn here, its errors are not";
}

std::vector<Rung> rungs_of(const FrontierReport& report, const RenderSettings& wishes)
{
    std::vector<Rung> rungs;
    for (const FrontierReport::Point& point : report.points) {
        RenderSettings settings = wishes;
        for (const auto& [key, value] : point.settings)
            set_setting(settings, key, value);
        settings.seed = wishes.seed;  // of which nothing depends on average
        const Choice choice = choice_of(settings);
        const bool known = std::any_of(
            rungs.begin(), rungs.end(), [&](const Rung& rung) { return rung.choice == choice; });
        if (settings == with_choice(wishes, choice) && !known)
            rungs.push_back({choice, point.label, point.ms, point.error});
    }
    return rungs;
}

}  // namespace farlight
