// Findings are worked out from points that are not lost in the reference's noise.
#include "client/accuracy/findings.h"

#include "client/accuracy/fit.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace farlight::client {
namespace {

using nlohmann::json;

json flat(const char* name, const json& estimate)
{
    const std::string key = name;
    return {{key, estimate.at("value")}, {key + "_lower", estimate.at("lower")},
        {key + "_upper", estimate.at("upper")}};
}

/// Figures of an error that are alike for sweep points and averaged frames.
json error_row(const json& error)
{
    json row = flat("relmse", error.at("relmse"));
    row.update(flat("bias", error.at("bias")));
    row.update(flat("variance", error.at("variance")));
    for (const char* key : {"relmse999", "mse", "flip", "fireflies", "reference_limited"})
        row[key] = error.at(key);
    return row;
}

json point_row(const MeasuredPoint& measured)
{
    json row{{"label", measured.point.label}, {"settings", measured.point.settings}};
    row.update(flat("ms", measured.times.at("ms")));
    for (const char* key : {"passes", "encode_ms", "whole_ms"})
        if (measured.times.contains(key))
            row[key] = measured.times.at(key);
    row.update(error_row(measured.error));
    return row;
}

bool is_limited(const json& error)
{
    return error.at("reference_limited").get<bool>();
}

double ms_of(const json& times)
{
    return times.at("ms").at("value").get<double>();
}

/// Light left to chance saves next to nothing where a scene has lights and ruins the picture: it is
/// measured to show what sampling brings, and is nobody's choice.
bool is_choice(const json& settings)
{
    return settings.value("light_sampling", true);
}

/// Both settings alike but for the keys in `but`.
bool alike(const Settings& a, const Settings& b, const std::set<std::string>& but)
{
    return std::all_of(a.begin(), a.end(), [&](const auto& entry) {
        const auto other = b.find(entry.first);
        return but.contains(entry.first) || (other != b.end() && other->second == entry.second);
    });
}

class Findings {
public:
    explicit Findings(const Measurements& measured) : measured_(measured)
    {
        for (const MeasuredPoint& point : measured.points)
            points_.push_back(point_row(point));
    }

    json all()
    {
        json result;
        result["flip_frontier"] = flip_frontier();
        result["frontier"]["points"] = frontier();
        result["points"] = points_;
        result["averaging"] = averaging();
        result["prices"] = prices();
        result["fits"] = fits();
        result["slope"] = slope();
        result["techniques"] = techniques();
        result["classic"] = classic();
        result["timing_check"] = timing_check();
        return result;
    }

private:
    TimedError timed(const json& row, const char* error) const
    {
        const bool counts =
            !row.at("reference_limited").get<bool>() && is_choice(row.at("settings"));
        return {row.at("ms").get<double>(), counts ? row.at(error).get<double>() : 0};
    }

    std::vector<std::size_t> frontier_by(const char* error) const
    {
        std::vector<TimedError> timed_errors;
        for (const json& row : points_)
            timed_errors.push_back(timed(row, error));
        return pareto_frontier(timed_errors);
    }

    json frontier()
    {
        frontier_ = frontier_by("relmse");
        json rows = json::array();
        for (std::size_t i = 0; i < frontier_.size(); ++i) {
            json& point = points_[frontier_[i]];
            point["frontier"] = i + 1;
            json row;
            for (const char* key : {"label", "settings", "ms", "ms_lower", "ms_upper", "relmse",
                     "relmse_lower", "relmse_upper", "flip"})
                row[key] = point[key];
            rows.push_back(row);
        }
        return rows;
    }

    json flip_frontier() { return frontier_by("flip"); }

    /// Averaging is unbiased, so one rate says how its error falls.
    std::optional<ErrorFit> averaging_fit() const
    {
        std::vector<TimedError> errors;
        for (const auto& [frames, error] : measured_.averaging)
            if (!is_limited(error))
                errors.push_back({frames * ms_of(measured_.averaging_times),
                    error.at("relmse").at("value").get<double>()});
        return errors.empty() ? std::nullopt : fit_error(errors, /*floor=*/0);
    }

    json averaging() const
    {
        const double frame_ms = ms_of(measured_.averaging_times);
        json rows = json::array();
        for (const auto& [frames, error] : measured_.averaging) {
            json row{{"frames", frames}, {"ms", frames * frame_ms}};
            row.update(error_row(error));
            rows.push_back(row);
        }
        json result{{"frame_ms", frame_ms}, {"points", rows}};
        if (const auto fit = averaging_fit())
            result["rate"] = fit->rate;
        return result;
    }

    json prices() const
    {
        std::vector<TimedError> errors;
        for (const std::size_t i : frontier_)
            errors.push_back(timed(points_[i], "relmse"));
        const auto fit = averaging_fit();
        json rows = json::array();
        for (const Halving& halving : price_list(errors)) {
            const json& from = points_[frontier_[halving.from]];
            json row{{"from", halving.from + 1}, {"label", from["label"]}, {"ms", from["ms"]},
                {"relmse", from["relmse"]}};
            if (fit)
                row["averaging_ms"] = std::max(2 * fit->rate / from["relmse"].get<double>(),
                    ms_of(measured_.averaging_times));  // one frame at least
            if (halving.to) {
                const json& to = points_[frontier_[*halving.to]];
                row["to"] = *halving.to + 1;
                row["extra_ms"] = halving.extra_ms;
                row["factor"] = halving.factor;
                row["by"] = changes_between(
                    from["settings"].get<Settings>(), to["settings"].get<Settings>());
            }
            rows.push_back(row);
        }
        return rows;
    }

    /// Points that differ from the base in their denoiser and samples alone.
    std::vector<const MeasuredPoint*> ladder_of(const std::string& denoiser) const
    {
        std::vector<const MeasuredPoint*> ladder;
        for (const MeasuredPoint& measured : measured_.points)
            if (measured.point.denoiser() == denoiser
                && alike(
                    measured.point.settings, measured_.base, {"denoiser", "samples_per_pixel"}))
                ladder.push_back(&measured);
        std::sort(ladder.begin(), ladder.end(),
            [](const auto* a, const auto* b) { return a->point.samples() < b->point.samples(); });
        return ladder;
    }

    std::vector<std::string> denoisers() const
    {
        std::vector<std::string> names;
        for (const MeasuredPoint& measured : measured_.points)
            if (std::find(names.begin(), names.end(), measured.point.denoiser()) == names.end())
                names.push_back(measured.point.denoiser());
        return names;
    }

    /// The bias of a denoiser at the most samples it was measured with, where seeds show one.
    static std::optional<double> measured_floor(const MeasuredPoint& measured)
    {
        const json& bias = measured.error.at("bias");
        return bias.at("lower") > 0 ? std::optional(bias.at("value").get<double>()) : std::nullopt;
    }

    json fits() const
    {
        const auto averaged = averaging_fit();
        json rows = json::array();
        for (const std::string& denoiser : denoisers()) {
            std::vector<TimedError> errors;
            std::optional<double> floor;
            for (const MeasuredPoint* measured : ladder_of(denoiser)) {
                if (is_limited(measured->error))
                    continue;
                errors.push_back({ms_of(measured->times),
                    measured->error.at("relmse").at("value").get<double>()});
                floor = measured_floor(*measured);
            }
            const auto fit = fit_error(errors, floor);
            if (!fit || denoiser == kRaw)
                continue;
            json row{{"denoiser", denoiser}, {"floor", fit->floor}, {"rate", fit->rate},
                {"floor_is_measured", floor.has_value()}};
            const auto from = averaged ? crossing(*averaged, *fit) : std::optional<double>();
            if (from && *from > 0) {
                row["crossing_ms"] = *from;
                row["crossing_relmse"] = averaged->rate / *from;
            }
            rows.push_back(row);
        }
        return rows;
    }

    /// Of the raw samples' error over their number: -1 where nothing but noise is in it.
    json slope() const
    {
        std::vector<TimedError> relative;
        std::vector<TimedError> absolute;
        for (const MeasuredPoint* measured : ladder_of(kRaw)) {
            if (is_limited(measured->error))
                continue;
            const double samples = measured->point.samples();
            relative.push_back({samples, measured->error.at("relmse").at("value").get<double>()});
            absolute.push_back({samples, measured->error.at("mse").get<double>()});
        }
        json result;
        if (const auto value = log_slope(relative))
            result["relmse"] = *value;
        if (const auto value = log_slope(absolute))
            result["mse"] = *value;
        return result;
    }

    std::optional<std::size_t> find(const Settings& changes) const
    {
        Settings wanted = measured_.base;
        for (const auto& [key, value] : changes)
            wanted[key] = value;
        for (std::size_t i = 0; i < measured_.points.size(); ++i)
            if (measured_.points[i].point.settings == wanted)
                return i;
        return std::nullopt;
    }

    void compare(
        json& rows, const std::string& name, const Settings& without, const Settings& with) const
    {
        const auto a = find(without);
        const auto b = find(with);
        if (a && b && *a != *b)
            rows.push_back({{"name", name}, {"without", *a}, {"with", *b},
                {"without_text",
                    changes_between(points_[*b]["settings"].get<Settings>(),
                        points_[*a]["settings"].get<Settings>())}});
    }

    json techniques() const
    {
        json rows = json::array();
        for (const std::string& denoiser : denoisers())
            if (denoiser != kRaw)
                compare(rows, denoiser, {{"denoiser", kRaw}}, {{"denoiser", denoiser}});
        compare(rows, "light sampling, raw", {{"denoiser", kRaw}, {"light_sampling", false}},
            {{"denoiser", kRaw}});
        compare(rows, "light sampling, filtered", {{"light_sampling", false}}, {});
        compare(rows, "a-trous filter", {{"atrous_iterations", 0}}, {});
        compare(rows, "history", {{"history_max", 1}}, {});
        compare(rows, "full resolution", {{"resolution_scale", 0.5}}, {});
        compare(rows, "longer paths", {{"max_depth", 2}}, {});
        return rows;
    }

    json classic() const
    {
        json rows = json::array();
        const auto add = [&](const MeasuredPoint& measured) {
            const auto at = static_cast<std::size_t>(&measured - measured_.points.data());
            rows.push_back({{"point", at}, {"label", measured.point.label},
                {"frames_per_second", 1000 / ms_of(measured.times)}});
            for (const char* key : {"ms", "relmse", "relmse_lower", "relmse_upper", "flip"})
                rows.back()[key] = points_[at][key];
        };
        for (const MeasuredPoint* measured : ladder_of(kRaw))
            add(*measured);
        for (const std::string& denoiser : denoisers())
            if (denoiser != kRaw && !ladder_of(denoiser).empty())
                add(*ladder_of(denoiser).front());
        return rows;
    }

    /// How far the sum of a frame's passes is off the whole frame, by point.
    json timing_check() const
    {
        json check{{"tolerance", kPassSumTolerance}, {"points", 0}, {"beyond", 0}, {"worst", 0.0}};
        for (const MeasuredPoint& measured : measured_.points) {
            if (!measured.times.contains("whole_ms"))
                continue;
            const double off =
                std::abs(ms_of(measured.times) / measured.times["whole_ms"].get<double>() - 1);
            check["points"] = check["points"].get<int>() + 1;
            check["worst"] = std::max(check["worst"].get<double>(), off);
            if (!(off <= kPassSumTolerance))
                check["beyond"] = check["beyond"].get<int>() + 1;
        }
        check["failed"] = !(check["worst"].get<double>() <= kPassSumFailure);
        return check;
    }

    const Measurements& measured_;
    std::vector<json> points_;
    std::vector<std::size_t> frontier_;  ///< By relMSE.
};

}  // namespace

json findings_of(const Measurements& measured)
{
    return Findings(measured).all();
}

}  // namespace farlight::client
