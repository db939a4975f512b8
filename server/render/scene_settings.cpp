// The scene's settings go through the table that the command line's go through.
#include "server/render/scene_settings.h"

#include "server/scene/scene_error.h"

#include <cmath>
#include <nlohmann/json.hpp>

namespace farlight {
namespace {

[[noreturn]] void refuse_setting(
    const Scene& scene, const std::string& key, const std::string& problem)
{
    const ScenePlace place = ScenePlace{scene.file, {}} / "settings" / key;
    SceneError error(place.file + ": " + place.pointer + ": " + problem);
    error.pointer = place.pointer;
    throw error;
}

/// A whole number without a point, as the file has it, so that errors show what was written.
nlohmann::json as_written(const SettingValue& value)
{
    const double* const number = std::get_if<double>(&value);
    constexpr double kLargestExact = 9007199254740992;  // 2^53
    if (number != nullptr && std::floor(*number) == *number && std::abs(*number) <= kLargestExact)
        return static_cast<std::int64_t>(*number);
    return std::visit([](const auto& plain) { return nlohmann::json(plain); }, value);
}

void apply(const Scene& scene, RenderSettings& settings)
{
    for (const auto& [key, value] : scene.settings) {
        try {
            set_setting(settings, key, as_written(value));
        } catch (const SettingError& problem) {
            refuse_setting(scene, key, problem.what());
        }
    }
}

}  // namespace

RenderSettings settings_for(
    const Scene& scene, const RenderSettings& base, const std::vector<std::string>& set)
{
    RenderSettings settings = base;
    apply(scene, settings);
    for (const std::string& key_equals_value : set)
        set_setting(settings, key_equals_value);
    return settings;
}

void check_settings(const Scene& scene, const std::vector<ActiveEffect>& effects)
{
    RenderSettings settings;
    apply(scene, settings);
    if (const auto missing = what_is_missing(settings.effects, effects))
        refuse_setting(scene, "effects", "setting 'effects': " + *missing);
}

}  // namespace farlight
