// One call a metric: metric_table.h has the rows, here is what computes each.
#include "client/metrics/compare.h"

#include "client/metrics/ssim.h"

#include <algorithm>
#include <cassert>

namespace farlight::client {
namespace {

using ValueMetric = double (*)(std::span<const float>, std::span<const float>, Mask);

/// Of linear values.
constexpr std::pair<std::string_view, ValueMetric> kOfLight[] = {{"relmse", relative_mse},
    {"relmse999", relative_mse_999}, {"mse", mean_square_error}, {"rmse", root_mean_square_error},
    {"smape", smape}, {"fireflies", count_fireflies}};

constexpr std::string_view kOthers[] = {"psnr", "ssim", "flip", "hdr_flip"};

void expect_alike(const Appearance& test, const Appearance& reference)
{
    const auto size_text = [](ImageSize size) {
        return std::to_string(size.width) + "x" + std::to_string(size.height);
    };
    if (test.size != reference.size)
        throw MetricError("the picture is " + size_text(test.size) + ", the reference "
            + size_text(reference.size));
    if (test.is_light != reference.is_light)
        throw MetricError(std::string("the picture holds ")
            + (test.is_light ? "linear radiance, the reference display values"
                             : "display values, the reference linear radiance"));
}

}  // namespace

Appearance appearance_of(const Picture& picture, const DisplayOptions& options)
{
    const ImageSize size{picture.width, picture.height};
    if (picture.linear.empty())
        return {size, linear_of_bytes(picture.display), display_of_bytes(picture.display), false};
    return {size, picture.linear, display_of_linear(picture.linear, options), true};
}

Comparison compare(
    const Appearance& test, const Appearance& reference, const CompareOptions& options, Mask mask)
{
    expect_alike(test, reference);
    expect_comparable(test.linear, reference.linear, mask);
    Comparison result;
    const double pixels_per_degree = options.pixels_per_degree;
    result.flip_map = ldr_flip(test.display, reference.display, test.size, pixels_per_degree);
    result.flip = pool(result.flip_map, mask);
    if (test.is_light)
        result.hdr_flip =
            pool(hdr_flip(test.linear, reference.linear, test.size, pixels_per_degree), mask);
    for (const Metric& metric : kMetrics) {
        const auto* const of_light = std::find_if(std::begin(kOfLight), std::end(kOfLight),
            [&](const auto& row) { return row.first == metric.name; });
        if (of_light != std::end(kOfLight))
            result.values.push_back(
                {metric.name, of_light->second(test.linear, reference.linear, mask)});
        else if (metric.name == "psnr")
            result.values.push_back(
                {metric.name, peak_signal_to_noise(test.display, reference.display, mask)});
        else if (metric.name == "ssim")
            result.values.push_back({metric.name,
                structural_similarity(test.display, reference.display, test.size, mask)});
        else if (metric.name == "flip")
            result.values.push_back({metric.name, result.flip.mean});
        else if (metric.name == "hdr_flip" && result.hdr_flip)
            result.values.push_back({metric.name, result.hdr_flip->mean});
    }
    return result;
}

bool is_of_two_pictures(std::string_view name)
{
    return std::find(std::begin(kOthers), std::end(kOthers), name) != std::end(kOthers)
        || std::any_of(std::begin(kOfLight), std::end(kOfLight),
            [&](const auto& row) { return row.first == name; });
}

}  // namespace farlight::client
