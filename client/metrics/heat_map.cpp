// Colour scales and what they are of.
#include "client/metrics/heat_map.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace farlight::client {
namespace {

std::uint8_t byte_of(double x)
{
    return static_cast<std::uint8_t>(std::lround(255 * std::clamp(x, 0.0, 1.0)));
}

/// `shade_of(i)` of each pixel.
template <typename Of> Picture painted(ImageSize size, Of&& shade_of)
{
    Picture picture{.width = size.width, .height = size.height, .linear = {}, .display = {}};
    picture.display.reserve(3 * size.pixels());
    for (std::size_t i = 0; i < size.pixels(); ++i) {
        const Shade shade = shade_of(i);
        for (const double channel : {shade.r, shade.g, shade.b})
            picture.display.push_back(byte_of(channel));
    }
    return picture;
}

void expect_values(std::size_t found, std::size_t expected)
{
    if (found != expected)
        throw MetricError("heat map: found " + std::to_string(found) + " values, expected "
            + std::to_string(expected));
}

}  // namespace

/// Source: Zucker 2019, polynomials fitted to matplotlib's maps (shadertoy.com/view/WlfXRN), in the
/// public domain (CC0) as is matplotlib's magma (Smith, van der Walt 2015).
Shade magma(double x)
{
    constexpr std::array<Shade, 7> kPowers{{{-0.002136485, -0.000749655, -0.005386128},
        {0.251660541, 0.677523244, 2.494026599}, {8.353717279, -3.577719515, 0.314467903},
        {-27.668733086, 14.264730781, -13.649213188}, {52.176139812, -27.943606072, 12.944169442},
        {-50.768525365, 29.046582821, 4.234152994}, {18.655705066, -11.489773520, -5.601961509}}};
    const double t = std::clamp(x, 0.0, 1.0);
    Shade sum;
    for (auto power = kPowers.rbegin(); power != kPowers.rend(); ++power)
        sum = {sum.r * t + power->r, sum.g * t + power->g, sum.b * t + power->b};
    return {std::clamp(sum.r, 0.0, 1.0), std::clamp(sum.g, 0.0, 1.0), std::clamp(sum.b, 0.0, 1.0)};
}

Shade blue_white_red(double x)
{
    const double t = std::clamp(x, -1.0, 1.0);
    constexpr Shade kBlue{0.02, 0.19, 0.55};
    constexpr Shade kRed{0.62, 0.05, 0.05};
    const Shade& end = t < 0 ? kBlue : kRed;
    const auto mix = [share = std::abs(t)](double c) { return 1 + share * (c - 1); };
    return {mix(end.r), mix(end.g), mix(end.b)};
}

Picture heat_map(std::span<const float> values, ImageSize size)
{
    expect_values(values.size(), size.pixels());
    return painted(size, [&](std::size_t i) { return magma(static_cast<double>(values[i])); });
}

Picture absolute_heat_map(
    std::span<const float> test, std::span<const float> reference, ImageSize size)
{
    expect_comparable(test, reference);
    expect_values(test.size(), 3 * size.pixels());
    return painted(size, [&](std::size_t pixel) {
        double sum = 0;
        for (std::size_t i = 3 * pixel; i < 3 * pixel + 3; ++i)
            sum += std::abs(static_cast<double>(test[i]) - static_cast<double>(reference[i]));
        return magma(std::log(std::max(sum / 3, kLeastShownError) / kLeastShownError)
            / std::log(kMostShownError / kLeastShownError));
    });
}

Picture signed_heat_map(
    std::span<const float> test, std::span<const float> reference, ImageSize size)
{
    expect_comparable(test, reference);
    expect_values(test.size(), 3 * size.pixels());
    const std::vector<double> x = luminances(test);
    const std::vector<double> r = luminances(reference);
    return painted(size,
        [&](std::size_t i) { return blue_white_red((x[i] - r[i]) / (std::abs(r[i]) + 0.01)); });
}

}  // namespace farlight::client
