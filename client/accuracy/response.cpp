// Sequences of frames, before and after an edit.
#include "client/accuracy/response.h"

#include "client/metrics/temporal.h"

namespace farlight::client {
namespace {

using nlohmann::json;

/// What is left of the light: dark enough that the old picture's ghost shows.
constexpr double kDimmed = 0.25;

bool is_color(const json& value)
{
    return value.is_array() && value.size() == 3 && value[0].is_number();
}

json dimmed(const json& color)
{
    json result = json::array();
    for (const json& channel : color)
        result.push_back(kDimmed * channel.get<double>());
    return result;
}

/// A patch that dims the color `key` of each named member of document[section].
json dimmed_members(const json& document, const char* section, const char* key)
{
    json patch;
    if (!document.contains(section) || !document[section].is_object())
        return patch;
    for (const auto& [name, member] : document[section].items())
        if (member.is_object() && member.contains(key) && is_color(member[key]))
            patch[name][key] = dimmed(member[key]);
    return patch;
}

}  // namespace

LightStep dimming(const json& document)
{
    LightStep step{.what = "every light at a quarter", .patch = {}};
    if (!document.is_object())
        return step;
    if (json materials = dimmed_members(document, "materials", "emission"); !materials.is_null())
        step.patch["materials"] = std::move(materials);
    if (json lights = dimmed_members(document, "lights", "intensity"); !lights.is_null())
        step.patch["lights"] = std::move(lights);
    if (document.contains("background") && is_color(document["background"]))
        step.patch["background"] = dimmed(document["background"]);
    if (document.contains("environment") && document["environment"].is_object())
        step.patch["environment"]["scale"] =
            dimmed(document["environment"].value("scale", json::array({1, 1, 1})));
    return step;
}

double work_of_response(const SweepPoint& point, const ResponsePlan& plan)
{
    return work_of(point.settings) * plan.seeds
        * (1 + plan.history + plan.still_frames + plan.after);
}

json measure_response(Rig& rig, const SweepPoint& point, const ResponsePlan& plan,
    const LightStep& step, Mask counts, const ReferencePicture* after_step)
{
    rig.choose(plan.settings);
    rig.choose(point.settings);
    double flicker = 0;
    double difference = 0;
    std::vector<double> errors(after_step == nullptr ? 0 : static_cast<std::size_t>(plan.after));
    for (int seed = 1; seed <= plan.seeds; ++seed) {
        rig.choose({{"seed", seed}});
        rig.draw_after(plan.history);
        FlickerMeter meter;
        for (int i = 0; i < plan.still_frames; ++i)
            meter.add(linear_picture(rig.draw()).linear);
        flicker += meter.flicker(counts) / plan.seeds;
        difference += meter.successive_difference(counts) / plan.seeds;
        if (after_step == nullptr)
            continue;
        rig.session().edit(step.patch);
        for (double& error : errors)
            error += relative_mse(
                         linear_picture(rig.draw()).linear, after_step->mean, after_step->counts)
                / plan.seeds;
        rig.session().edit(json::object(), /*reset=*/true);
    }
    json result{{"flicker", flicker}, {"difference", difference}};
    if (after_step != nullptr) {
        result["errors"] = errors;
        result["lag"] = lag_frames(errors);
    }
    return result;
}

}  // namespace farlight::client
