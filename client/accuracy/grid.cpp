// The ladders of each sweep, and what of them a server offers.
#include "client/accuracy/grid.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace farlight::client {
namespace {

using nlohmann::json;

/// What is swept, in the order in which labels name it.
constexpr const char* kSwept[] = {"denoiser", "samples_per_pixel", "max_depth", "light_sampling",
    "atrous_iterations", "history_max", "resolution_scale"};

struct Ladders {
    std::vector<int> raw_samples, filtered_samples, iterations, histories;
    std::vector<double> scales;
    std::vector<int> mixed_samples, mixed_iterations;  ///< All with all, at each scale.
};

Ladders ladders_of(GridSize size)
{
    switch (size) {
    case GridSize::kTiny: return {{1, 4, 16}, {1, 4}, {2}, {8}, {0.5}, {}, {}};
    case GridSize::kClassic: return {{1, 4, 16, 32}, {1}, {}, {}, {}, {}, {}};
    case GridSize::kQuick:
        return {{1, 2, 4, 8, 16, 32}, {1, 2, 4}, {0, 2, 3}, {1, 8}, {0.5}, {1, 2}, {3}};
    case GridSize::kNormal: break;
    }
    return {{1, 2, 4, 8, 16, 32, 64, 128}, {1, 2, 4, 8, 16, 32}, {0, 1, 2, 3, 4, 6},
        {1, 2, 4, 8, 128}, {0.75, 0.5, 0.25}, {1, 2, 4}, {2, 3, 4}};
}

/// What the server says of its settings, by key.
class Described {
public:
    explicit Described(const json& described)
    {
        for (const json& setting : described)
            if (setting.contains("key"))
                by_key_[setting["key"].get<std::string>()] = setting;
    }

    bool has(const std::string& key) const { return by_key_.contains(key); }
    json value(const std::string& key) const { return by_key_.at(key).at("value"); }
    json choices(const std::string& key) const
    {
        return has(key) ? by_key_.at(key).value("choices", json::array()) : json::array();
    }
    bool allows(const std::string& key, const json& value) const
    {
        if (!has(key))
            return false;
        const json& setting = by_key_.at(key);
        if (setting.contains("choices"))
            return std::find(setting["choices"].begin(), setting["choices"].end(), value)
                != setting["choices"].end();
        if (value.is_boolean() || !setting.contains("lower"))
            return true;
        return setting["lower"] <= value && value <= setting["upper"];
    }

private:
    std::map<std::string, json> by_key_;
};

/// Real settings come back as 32-bit floats: 0.5 and 0.75 exactly, 0.1 not.
std::string number_text(const json& value)
{
    if (!value.is_number_float())
        return value.is_string() ? value.get<std::string>() : value.dump();
    char text[32];
    std::snprintf(text, sizeof text, "%.4g", value.get<double>());
    return text;
}

std::string label_of(const Settings& settings, const Settings& base)
{
    std::string label = settings.at("denoiser").get<std::string>() + ", "
        + number_text(settings.at("samples_per_pixel"))
        + (settings.at("samples_per_pixel") == 1 ? " sample" : " samples");
    for (const char* key : kSwept) {
        if (!settings.contains(key) || settings.at(key) == base.at(key) || key == kSwept[0]
            || key == kSwept[1])
            continue;
        label += ", " + word_for(key) + " " + number_text(settings.at(key));
    }
    return label;
}

class GridBuilder {
public:
    GridBuilder(const json& described, GridSize size)
        : server_(described)
        , size_(size)
        , ladders_(ladders_of(size))
    {
        for (const char* key : {"denoiser", "samples_per_pixel", "max_depth"})
            if (!server_.has(key))
                throw std::invalid_argument(
                    std::string("the server lists no setting '") + key + "', which a sweep needs");
        for (const json& choice : server_.choices("denoiser"))
            if (choice != kAveraging)
                (choice == kRaw ? raw_ : filters_).push_back(choice.get<std::string>());
        for (const char* key : kSwept)
            if (server_.has(key))
                grid_.base[key] = server_.value(key);
        grid_.base["samples_per_pixel"] = 1;
        if (server_.has("light_sampling"))
            grid_.base["light_sampling"] = true;
        if (server_.has("resolution_scale"))
            grid_.base["resolution_scale"] = 1;
        const bool filters =
            std::find(filters_.begin(), filters_.end(), grid_.base["denoiser"]) != filters_.end();
        if (!filters)
            grid_.base["denoiser"] = filters_.empty() ? kRaw : filters_.front();
    }

    Grid build()
    {
        add({});
        for (const std::string& denoiser : raw_)
            for (const int samples : ladders_.raw_samples)
                add({{"denoiser", denoiser}, {"samples_per_pixel", samples}});
        for (const std::string& denoiser : filters_)
            for (const int samples : ladders_.filtered_samples)
                add({{"denoiser", denoiser}, {"samples_per_pixel", samples}});
        for (const int iterations : ladders_.iterations)
            add({{"atrous_iterations", iterations}});
        for (const int frames : ladders_.histories)
            add({{"history_max", frames}});
        if (size_ != GridSize::kClassic)
            add_alternatives();
        return std::move(grid_);
    }

private:
    /// Paths, lights and resolutions.
    void add_alternatives()
    {
        add_depths();
        for (const std::string& denoiser : raw_)
            add({{"denoiser", denoiser}, {"light_sampling", false}});
        add({{"light_sampling", false}});
        add_scales_and_mixes();
    }

    void add(const Settings& changes)
    {
        SweepPoint point{.label = "", .settings = grid_.base};
        for (const auto& [key, value] : changes) {
            if (!server_.allows(key, value))
                return;
            point.settings[key] = value;
        }
        point.label = label_of(point.settings, grid_.base);
        const auto same = [&](const SweepPoint& other) { return other.settings == point.settings; };
        if (std::none_of(grid_.points.begin(), grid_.points.end(), same))
            grid_.points.push_back(std::move(point));
    }

    /// Shorter paths than the scene's own, 2 (direct light) first, then each twice as long.
    void add_depths()
    {
        const int own = grid_.base["max_depth"].get<int>();
        for (int depth = 2; depth < own; depth = depth < 4 ? depth + 1 : 2 * depth)
            add({{"max_depth", depth}});
    }

    void add_scales_and_mixes()
    {
        for (const double scale : ladders_.scales) {
            for (const std::string& denoiser : raw_)
                add({{"denoiser", denoiser}, {"resolution_scale", scale}});
            add({{"resolution_scale", scale}});
        }
        std::vector<double> scales{1};
        scales.insert(scales.end(), ladders_.scales.begin(), ladders_.scales.end());
        for (const double scale : scales)
            for (const int samples : ladders_.mixed_samples)
                for (const int iterations : ladders_.mixed_iterations) {
                    Settings mix{{"samples_per_pixel", samples}, {"atrous_iterations", iterations}};
                    if (scale < 1)
                        mix["resolution_scale"] = scale;
                    add(mix);
                }
    }

    Described server_;
    GridSize size_;
    Ladders ladders_;
    std::vector<std::string> raw_, filters_;
    Grid grid_;
};

}  // namespace

std::string SweepPoint::text(const std::string& key) const
{
    const auto found = settings.find(key);
    return found == settings.end() ? "" : number_text(found->second);
}

std::string word_for(const std::string& key)
{
    static const std::map<std::string, std::string> words{{"samples_per_pixel", "samples"},
        {"max_depth", "depth"}, {"atrous_iterations", "a-trous"}, {"history_max", "history"},
        {"resolution_scale", "resolution"}, {"light_sampling", "light sampling"}};
    const auto found = words.find(key);
    return found == words.end() ? key : found->second;
}

std::string changes_between(const Settings& from, const Settings& to)
{
    const auto filters = [](const Settings& settings) {
        const auto denoiser = settings.find("denoiser");
        return denoiser == settings.end() || denoiser->second != kRaw;
    };
    std::string text;
    for (const auto& [key, value] : to) {
        const bool of_filter = key == "atrous_iterations" || key == "history_max";
        const auto before = from.find(key);
        if ((before != from.end() && before->second == value) || (of_filter && !filters(to)))
            continue;
        const bool had_none = before == from.end() || (of_filter && !filters(from));
        text += (text.empty() ? "" : ", ") + word_for(key) + " "
            + (had_none ? "" : number_text(before->second) + " \u2192 ") + number_text(value);
    }
    return text;
}

Grid make_grid(const json& described, GridSize size)
{
    return GridBuilder(described, size).build();
}

std::vector<int> averaged_frames(GridSize size)
{
    switch (size) {
    case GridSize::kTiny:
    case GridSize::kClassic: return {1, 4, 16};
    case GridSize::kQuick: return {1, 2, 4, 8, 16, 32, 64};
    case GridSize::kNormal: break;
    }
    return {1, 2, 4, 8, 16, 32, 64, 128, 256};
}

}  // namespace farlight::client
