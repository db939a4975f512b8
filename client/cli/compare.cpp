// farlight compare: how far pictures are from their references. No server needed.
#include "client/cli/command.h"
#include "client/cli/compared_files.h"
#include "client/json_input.h"
#include "client/metrics/heat_map.h"
#include "client/metrics/temporal.h"
#include "client/picture_file.h"

#include <cmath>
#include <iostream>
#include <memory>

namespace farlight::client {
namespace {

struct Options {
    std::string test;
    std::string reference;
    CompareOptions compare;
    std::string tonemap = "aces";
    std::string mask_file;  ///< Empty: all pixels count.
    std::vector<std::uint8_t> mask;
    std::string heat_map;  ///< File; empty: none.
    std::string heat = "flip";
    std::vector<std::string> at_most;
    std::vector<std::string> at_least;
    bool json = false;
    bool display_chosen = false;  ///< Exposure or tone curve were given.
};

/// "METRIC=VALUE".
struct Bound {
    std::string metric;
    double value = 0;
    bool upper = true;

    bool holds(double found) const { return upper ? found <= value : found >= value; }
};

Bound bound_of(const std::string& text, bool upper)
{
    const auto equals = text.find('=');
    Bound bound{.metric = text.substr(0, equals), .upper = upper};
    if (find_metric(bound.metric) == nullptr) {
        std::string known;
        for (const Metric& metric : kMetrics)
            known += (known.empty() ? "" : ", ") + std::string(metric.name);
        throw std::invalid_argument(
            "found the metric '" + bound.metric + "', expected one of " + known);
    }
    std::size_t used = 0;
    const std::string number = equals == std::string::npos ? "" : text.substr(equals + 1);
    try {
        bound.value = std::stod(number, &used);
    } catch (const std::logic_error&) {
        used = 0;
    }
    if (used == 0 || used != number.size() || std::isnan(bound.value))
        throw std::invalid_argument("found '" + text + "', expected METRIC=VALUE");
    return bound;
}

std::vector<Bound> bounds_of(const Options& options)
{
    std::vector<Bound> bounds;
    for (const std::string& text : options.at_most)
        bounds.push_back(bound_of(text, true));
    for (const std::string& text : options.at_least)
        bounds.push_back(bound_of(text, false));
    return bounds;
}

void expect_sizes_and_kinds(const FilePair& files, const Appearance& a, const Appearance& b)
{
    const auto told = [](const std::filesystem::path& file, const Appearance& x) {
        return file.string() + " (" + std::to_string(x.size.width) + "x"
            + std::to_string(x.size.height)
            + (x.is_light ? ", linear radiance)" : ", display values)");
    };
    if (a.size != b.size || a.is_light != b.is_light)
        throw InputError("found " + told(files.test, a) + " and " + told(files.reference, b)
            + ", expected one size and one kind");
}

Picture heat_map_of(const Options& options, const Appearance& test, const Appearance& reference,
    const PictureComparison& comparison)
{
    if (options.heat == "absolute")
        return absolute_heat_map(test.linear, reference.linear, test.size);
    if (options.heat == "signed")
        return signed_heat_map(test.linear, reference.linear, test.size);
    return heat_map(comparison.flip_map, test.size);
}

ComparedFile compared(const FilePair& files, const Options& options, FlickerMeter& sequence)
{
    const Appearance test = read_appearance(files.test, options.compare.display);
    const Appearance reference = read_appearance(files.reference, options.compare.display);
    expect_sizes_and_kinds(files, test, reference);
    if (options.display_chosen && !test.is_light)
        throw std::invalid_argument(
            "--exposure and --tonemap are of linear radiance, found " + files.test.string());
    try {
        ComparedFile result{files, test.size, test.is_light,
            compare(test, reference, options.compare, options.mask)};
        if (!options.heat_map.empty())
            write_picture(
                options.heat_map, heat_map_of(options, test, reference, result.comparison));
        result.comparison.flip_map.clear();  // of many files it would be much
        sequence.add(test.linear);
        return result;
    } catch (const MetricError& problem) {
        throw MetricError(files.test.string() + ": " + problem.what());
    }
}

CompareReport compared_all(const std::vector<FilePair>& pairs, const Options& options)
{
    CompareReport report{
        .pixels_per_degree = options.compare.pixels_per_degree, .files = {}, .sequence = {}};
    FlickerMeter sequence;
    for (const FilePair& files : pairs) {
        report.files.push_back(compared(files, options, sequence));
        if (report.files.back().is_light != report.files.front().is_light)
            throw InputError(files.test.string() + ": found display values beside linear radiance");
    }
    if (sequence.frames() > 1)
        report.sequence = ComparedSequence{sequence.frames(),
            {{"flicker", sequence.flicker(options.mask)},
                {"difference", sequence.successive_difference(options.mask)}}};
    return report;
}

/// Says every bound that a file, or the sequence, does not keep.
bool keeps(const CompareReport& report, const Bound& bound)
{
    bool known = false;
    bool kept = true;
    const auto check = [&](const std::vector<MetricValue>& values, const std::string& of) {
        for (const MetricValue& value : values) {
            if (value.name != bound.metric)
                continue;
            known = true;
            if (bound.holds(value.value))
                continue;
            kept = false;
            say("farlight: " + of + ": " + bound.metric + " is " + number_text(value.value)
                + ", expected " + (bound.upper ? "at most " : "at least ")
                + number_text(bound.value));
        }
    };
    for (const ComparedFile& file : report.files)
        check(file.comparison.values, file.files.test.string());
    if (report.sequence)
        check(report.sequence->values, "the sequence");
    if (!known)
        throw std::invalid_argument("these pictures have no '" + bound.metric + "'");
    return kept;
}

/// For --help.
std::string metric_lines()
{
    std::string text = "Metrics:\n";
    for (const Metric& metric : kMetrics) {
        std::string name(metric.name);
        name.resize(12, ' ');
        text += "  " + name + std::string(metric.formula) + ": " + std::string(metric.meaning)
            + (metric.better == Better::kHigher ? "; higher is better\n" : "\n");
    }
    return text + "lag, ghost, bias and variance are of scripted-camera tests, see SCRIPT.md.";
}

int run(const Options& options)
{
    const std::vector<Bound> bounds = bounds_of(options);
    const std::vector<FilePair> pairs = paired(options.test, options.reference);
    if (!options.heat_map.empty() && std::filesystem::is_directory(options.test))
        throw std::invalid_argument("--heat-map is of two pictures, found folders");
    const CompareReport report = compared_all(pairs, options);
    if (options.json)
        print_json(json_of(report));
    else
        std::cout << text_of(report);
    bool kept = true;
    for (const Bound& bound : bounds)
        kept = keeps(report, bound) && kept;
    return kept ? kDone : kFailed;
}

}  // namespace

Command add_compare(CLI::App& farlight)
{
    auto* app = farlight.add_subcommand(
        "compare", "how far a picture, or a folder of them, is from its reference");
    auto options = std::make_shared<Options>();
    app->add_option("--mask", options->mask_file,
        "picture whose black pixels do not count: `record --set view=depth` makes one of the sky");
    app->add_option("test", options->test, "picture (.png, .jpg, .pfm, .exr) or folder")
        ->required();
    app->add_option("reference", options->reference, "what it should be, file by file name")
        ->required();
    auto* exposure = app->add_option("--exposure", options->compare.display.exposure,
        "scale of linear radiance before it is displayed");
    exposure->check(CLI::Range(0.0, 1e6))->capture_default_str();
    auto* tonemap = app->add_option("--tonemap", options->tonemap, "curve it is displayed with");
    tonemap->check(CLI::IsMember({"aces", "linear"}))->capture_default_str();
    app->add_option("--pixels-per-degree", options->compare.pixels_per_degree,
           "of FLIP's screen: 0.7 m, 3840 px, seen from 0.7 m if absent")
        ->check(CLI::Range(1.0, 1000.0));
    app->add_option("--heat-map", options->heat_map, "write where they differ to this PNG");
    app->add_option("--heat", options->heat,
           "of flip (0 to 1), absolute (0.001 to 10, logarithmic) or signed error (blue too dark)")
        ->check(CLI::IsMember({"flip", "absolute", "signed"}))
        ->capture_default_str();
    app->add_option(
           "--max", options->at_most, "METRIC=VALUE: exit status 1 where a file is above it")
        ->allow_extra_args(false);
    app->add_option(
           "--min", options->at_least, "METRIC=VALUE: exit status 1 where a file is below it")
        ->allow_extra_args(false);
    app->add_flag("--json", options->json, "print all as JSON");
    app->footer(metric_lines());
    return {app, [options, exposure, tonemap] {
                options->display_chosen = exposure->count() + tonemap->count() > 0;
                if (!options->mask_file.empty())
                    options->mask = read_mask(options->mask_file);
                options->compare.display.curve =
                    options->tonemap == "aces" ? ToneCurve::kAces : ToneCurve::kLinear;
                return run(*options);
            }};
}

}  // namespace farlight::client
