// All points share their scales, so that colours can be compared.
#include "client/accuracy/gallery.h"

#include "client/accuracy/picture_text.h"
#include "client/metrics/display.h"
#include "client/metrics/ensemble.h"
#include "client/metrics/flip.h"
#include "client/metrics/heat_map.h"

#include <algorithm>
#include <cmath>

namespace farlight::client {
namespace {

using nlohmann::json;

/// Scales end at what one pixel in a hundred exceeds: a lamp's rim may be wrong by a thousand times
/// its darker side. Logarithmic ones have three decades below that.
constexpr double kBelowEnd = 0.99;
constexpr double kDecades = 1e3;
constexpr int kBarPixels = 128;

/// One point's maps before they are coloured, a value a pixel.
struct Maps {
    std::vector<float> frame;  ///< Linear RGB.
    std::vector<float> absolute;  ///< |x - r|
    std::vector<float> bias;  ///< (mean(x) - r) / (r + 0.01) of luminance.
    std::vector<float> deviation;  ///< Of x over the seeds.
    std::vector<float> flip;
};

Maps maps_of(const std::vector<std::vector<float>>& pictures, const ReferencePicture& reference)
{
    std::vector<std::span<const float>> runs(pictures.begin(), pictures.end());
    Maps maps{.frame = pictures.front()};
    maps.absolute = absolute_differences(maps.frame, reference.mean);
    maps.bias = relative_differences(mean_picture(runs), reference.mean);
    std::vector<float> deviation = variance_picture(runs);
    for (float& value : deviation)
        value = std::sqrt(value);
    maps.deviation = absolute_differences(deviation, std::vector<float>(deviation.size()));
    maps.flip =
        ldr_flip(display_of_linear(maps.frame), display_of_linear(reference.mean), reference.size);
    return maps;
}

/// The value that `share` of the values do not exceed; 0 of none.
double quantile_of(std::vector<float> values, double share)
{
    if (values.empty())
        return 0;
    const auto at = values.begin()
        + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), at, values.end());
    return static_cast<double>(*at);
}

/// Adds the sizes of the values that count.
void append_sizes(std::vector<float>& to, const std::vector<float>& values, Mask counts)
{
    for (std::size_t i = 0; i < values.size(); ++i)
        if (counts.empty() || counts[i] != 0)
            to.push_back(std::abs(values[i]));
}

std::string shown(std::span<const float> linear, ImageSize size)
{
    std::vector<std::uint8_t> bytes;
    for (const float value : display_of_linear(linear))
        bytes.push_back(static_cast<std::uint8_t>(std::lround(255 * value)));
    return png_data_uri(bytes, size);
}

std::string bar(Palette palette)
{
    std::vector<float> shares(kBarPixels);
    for (std::size_t i = 0; i < shares.size(); ++i)
        shares[i] = static_cast<float>(i) / (kBarPixels - 1);
    return png_data_uri(colored(shares, palette), {kBarPixels, 1});
}

}  // namespace

std::vector<std::size_t> spread(std::size_t size, std::size_t count)
{
    std::vector<std::size_t> positions;
    if (size <= count)
        count = size;
    for (std::size_t i = 0; i < count; ++i)
        positions.push_back(count == 1 ? 0 : i * (size - 1) / (count - 1));
    return positions;
}

json draw_gallery(Rig& rig, const std::vector<SweepPoint>& points, const ErrorPlan& plan,
    const ReferencePicture& reference)
{
    std::vector<Maps> all;
    std::vector<float> differences;
    std::vector<float> biases;
    for (const SweepPoint& point : points) {
        all.push_back(maps_of(draw_seeds(rig, point, plan), reference));
        append_sizes(differences, all.back().absolute, reference.counts);
        append_sizes(biases, all.back().bias, reference.counts);
    }
    double top = quantile_of(std::move(differences), kBelowEnd);
    double bound = quantile_of(std::move(biases), kBelowEnd);
    // A scene without any error still has scales.
    top = top > 0 ? top : 1;
    bound = bound > 0 ? bound : 1;
    const double bottom = top / kDecades;
    json gallery{{"reference", shown(reference.mean, reference.size)},
        {"size", {reference.size.width, reference.size.height}},
        {"scales",
            {{"absolute", {{"lower", bottom}, {"upper", top}, {"bar", bar(Palette::kViridis)}}},
                {"flip", {{"lower", 0}, {"upper", 1}, {"bar", bar(Palette::kMagma)}}},
                {"bias", {{"lower", -bound}, {"upper", bound}, {"bar", bar(Palette::kDiverging)}}},
                {"deviation",
                    {{"lower", bottom}, {"upper", top}, {"bar", bar(Palette::kViridis)}}}}},
        {"points", json::array()}};
    const auto map = [&](const std::vector<float>& shares, Palette palette) {
        return png_data_uri(colored(shares, palette), reference.size);
    };
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Maps& maps = all[i];
        gallery["points"].push_back(
            {{"label", points[i].label}, {"frame", shown(maps.frame, reference.size)},
                {"absolute", map(log_shares(maps.absolute, bottom, top), Palette::kViridis)},
                {"flip", map(maps.flip, Palette::kMagma)},
                {"bias", map(signed_shares(maps.bias, bound), Palette::kDiverging)},
                {"deviation", map(log_shares(maps.deviation, bottom, top), Palette::kViridis)}});
    }
    return gallery;
}

}  // namespace farlight::client
