// Patches by effect, and turns with and without.
#include "client/accuracy/effect_costs.h"

#include "client/metrics/ensemble.h"
#include "client/metrics/turns.h"

#include <array>
#include <numeric>
#include <optional>

namespace farlight::client {
namespace {

using nlohmann::json;

constexpr std::chrono::seconds kCompileTimeout{30};
constexpr int kPairs = 4;  // of turns with and without
constexpr int kSettlingFrames = 6;  // histories fill; the picture's textures are made anew

/// Takes the keys out of every material that has one of them.
json without_in_materials(const json& document, const std::vector<const char*>& keys)
{
    json patch;
    if (!document.contains("materials"))
        return patch;
    for (const auto& [name, material] : document["materials"].items())
        for (const char* key : keys)
            if (material.contains(key))
                patch["materials"][name][key] = nullptr;
    return patch;
}

json without_member(const json& document, const char* key)
{
    return document.contains(key) ? json{{key, nullptr}} : json();
}

void settle(Rig& rig)
{
    for (int i = 0; i < kSettlingFrames; ++i)
        rig.draw();
}

/// Sums of passes of frames drawn now [ms].
TurnValues take_turn(Rig& rig, int frames)
{
    TurnValues times;
    for (int i = 0; i < frames; ++i) {
        const auto header = rig.draw().header;
        times.push_back(std::accumulate(
            header.passes.begin(), header.passes.end(), 0.0, [](double sum, const auto& pass) {
                return sum + static_cast<double>(pass.milliseconds);
            }));
    }
    return times;
}

/// Two states of scene or settings take turns, A B B A A B B A, without before with.
class Contest {
public:
    Contest(Rig& rig, int frames) : rig_(rig), frames_(frames) { }

    json measure(const std::function<void()>& with, const std::function<void()>& without)
    {
        std::array<std::vector<TurnValues>, 2> turns;
        std::optional<std::size_t> shown;
        for (int i = 0; i < 2 * kPairs; ++i) {
            const std::size_t which = (i + 1) / 2 % 2 == 0 ? 0 : 1;
            if (shown != which) {
                (which == 0 ? without : with)();
                settle(rig_);
                shown = which;
            }
            turns[which].push_back(take_turn(rig_, frames_));
        }
        const Estimate ratio = ratio_of_turns(turns[1], turns[0]);
        return {{"ms_with", median_of_turns(turns[1]).value},
            {"ms_without", median_of_turns(turns[0]).value}, {"ratio", ratio.value},
            {"ratio_lower", ratio.interval.lower}, {"ratio_upper", ratio.interval.upper}};
    }

private:
    Rig& rig_;
    int frames_;
};

json row_of(Rig& rig, const EffectsPlan& plan, const json& patch, Mask counts)
{
    bool own_programs = true;
    const auto show = [&](const json& change) {
        rig.session().edit(change, /*reset=*/true);
        own_programs = own_programs
            && drawn_with_own_programs(
                rig.session().await_own_programs(rig.welcome().camera, kCompileTimeout));
    };
    const auto noise = [&] {
        return relative_noise(
            draw_seeds(rig, plan.raw, {.seeds = plan.seeds, .settings = plan.settings}), counts);
    };
    json row;
    row["noise_with"] = noise();
    rig.choose(plan.filtered.settings);
    row.update(
        Contest(rig, plan.frames).measure([&] { show(json::object()); }, [&] { show(patch); }));
    row["noise_without"] = noise();
    show(json::object());
    if (!own_programs)
        return {{"refused", "its programs were not compiled within 30 s"}};
    return row;
}

}  // namespace

json removal_of(const std::string& effect, const json& document)
{
    static const std::map<std::string, std::vector<const char*>> material_keys{
        {"normal_maps", {"normal_texture", "clearcoat_normal_texture"}},
        {"clearcoat",
            {"clearcoat", "clearcoat_texture", "clearcoat_roughness_texture",
                "clearcoat_normal_texture"}},
        {"alpha", {"alpha_mode", "opacity", "alpha_cutoff"}},
        {"dielectric", {"transmission", "transmission_texture"}}, {"unlit", {"unlit"}},
        {"textures",
            {"albedo_texture", "emission_texture", "metallic_roughness_texture", "normal_texture",
                "specular_texture", "specular_color_texture", "transmission_texture",
                "clearcoat_texture", "clearcoat_roughness_texture", "clearcoat_normal_texture"}}};
    if (!document.is_object())
        return {};
    if (const auto keys = material_keys.find(effect); keys != material_keys.end())
        return without_in_materials(document, keys->second);
    if (effect == "fog")
        return without_member(document, "fog");
    if (effect == "environment_map")
        return without_member(document, "environment");
    if (effect == "delta_lights")
        return without_member(document, "lights");
    if (effect == "lens")
        return {{"camera", {{"lens_radius", 0}}}};
    return {};
}

double relative_noise(const std::vector<std::vector<float>>& pictures, Mask counts)
{
    const std::vector<std::span<const float>> runs(pictures.begin(), pictures.end());
    return Ensemble(runs, mean_picture(runs), {}, counts).variance();
}

json measure_effects(
    Rig& rig, const EffectsPlan& plan, const EffectScene& scene, Progress& progress)
{
    json result{{"rows", json::array()}};
    rig.choose(plan.settings);
    rig.choose(plan.filtered.settings);
    rig.choose({{"effects", "auto"}});
    const protocol::Inspection called =
        rig.session().await_own_programs(rig.welcome().camera, kCompileTimeout);
    progress.phase("effects: own programs against general ones");
    result["general"] = Contest(rig, plan.frames)
                            .measure(
                                [&] {
                                    rig.choose({{"effects", "general"}});
                                },
                                [&] {
                                    rig.choose({{"effects", "auto"}});
                                });
    for (const protocol::CalledEffect& effect : called.effects) {
        if (!effect.setting.empty())
            continue;
        json row{{"effect", effect.name}, {"reason", effect.reason}};
        const json patch = removal_of(effect.name, scene.document);
        if (!patch.is_null() && rig.welcome().edits) {
            progress.phase("effects: with and without " + effect.name);
            try {
                row.update(row_of(rig, plan, patch, scene.counts));
            } catch (const RefusedError& refused) {
                row["refused"] = refused.error.message;  // something else needs it
                rig.session().edit(json::object(), /*reset=*/true);
            }
        }
        result["rows"].push_back(std::move(row));
    }
    return result;
}

}  // namespace farlight::client
