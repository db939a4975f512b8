// One call a metric: metric_table.h has the rows, here is what computes each.
#include "client/metrics/compare.h"

#include "client/metrics/ssim.h"

#include <algorithm>

namespace farlight::client {
namespace {

using ValueMetric = double (*)(std::span<const float>, std::span<const float>, Mask);

/// Each is of linear values, or else of display values.
struct PointwiseMetric {
    std::string_view name;
    ValueMetric of;
    bool of_light;
};
constexpr PointwiseMetric kPointwise[] = {{"relmse", relative_mse, true},
    {"relmse999", relative_mse_999, true}, {"mse", mean_square_error, true},
    {"rmse", root_mean_square_error, true}, {"psnr", peak_signal_to_noise, false},
    {"smape", smape, true}, {"fireflies", count_fireflies, true}};

const PointwiseMetric* find_pointwise(std::string_view name)
{
    const auto* const found = std::find_if(std::begin(kPointwise), std::end(kPointwise),
        [&](const PointwiseMetric& metric) { return metric.name == name; });
    return found == std::end(kPointwise) ? nullptr : found;
}

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

double metric_value(std::string_view name, const Appearance& test, const Appearance& reference,
    const CompareOptions& options, Mask mask)
{
    expect_alike(test, reference);
    expect_comparable(test.linear, reference.linear, mask);  // on a display a NaN is black
    if (const PointwiseMetric* metric = find_pointwise(name))
        return metric->of_light ? metric->of(test.linear, reference.linear, mask)
                                : metric->of(test.display, reference.display, mask);
    expect_comparable(test.linear, reference.linear);
    const double pixels_per_degree = options.pixels_per_degree;
    if (name == "ssim")
        return structural_similarity(test.display, reference.display, test.size, mask);
    if (name == "flip")
        return pool(ldr_flip(test.display, reference.display, test.size, pixels_per_degree), mask)
            .mean;
    if (name == "hdr_flip")
        return pool(hdr_flip(test.linear, reference.linear, test.size, pixels_per_degree), mask)
            .mean;
    throw MetricError("'" + std::string(name) + "' is no metric of two pictures");
}

PictureComparison compare(
    const Appearance& test, const Appearance& reference, const CompareOptions& options, Mask mask)
{
    expect_alike(test, reference);
    expect_comparable(test.linear, reference.linear);
    PictureComparison result;
    const double pixels_per_degree = options.pixels_per_degree;
    result.flip_map = ldr_flip(test.display, reference.display, test.size, pixels_per_degree);
    result.flip = pool(result.flip_map, mask);
    if (test.is_light)
        result.hdr_flip =
            pool(hdr_flip(test.linear, reference.linear, test.size, pixels_per_degree), mask);
    for (const Metric& metric : kMetrics) {
        if (metric.name == "flip")
            result.values.push_back({metric.name, result.flip.mean});
        else if (metric.name == "hdr_flip" && result.hdr_flip)
            result.values.push_back({metric.name, result.hdr_flip->mean});
        else if (metric.name == "ssim" || find_pointwise(metric.name) != nullptr)
            result.values.push_back(
                {metric.name, metric_value(metric.name, test, reference, options, mask)});
    }
    return result;
}

}  // namespace farlight::client
