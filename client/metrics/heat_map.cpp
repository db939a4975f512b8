// Palettes are given at even steps and linear in between.
#include "client/metrics/heat_map.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace farlight::client {
namespace {

using Stop = std::uint32_t;  ///< 0xRRGGBB

constexpr std::array<Stop, 10> kMagmaStops{0x000004, 0x180f3d, 0x440f76, 0x721f81, 0x9e2f7f,
    0xcd4071, 0xf1605d, 0xfd9668, 0xfeca8d, 0xfcfdbf};
constexpr std::array<Stop, 10> kViridisStops{0x440154, 0x482878, 0x3e4989, 0x31688e, 0x26828e,
    0x1f9e89, 0x35b779, 0x6ece58, 0xb5de2b, 0xfde725};
constexpr std::array<Stop, 3> kDivergingStops{0x0072b2, 0xffffff, 0xd55e00};

std::span<const Stop> stops_of(Palette palette)
{
    switch (palette) {
    case Palette::kMagma: return kMagmaStops;
    case Palette::kViridis: return kViridisStops;
    case Palette::kDiverging: break;
    }
    return kDivergingStops;
}

std::uint8_t channel_of(Stop stop, int channel)
{
    return static_cast<std::uint8_t>(stop >> (8U * static_cast<unsigned>(2 - channel)));
}

void expect_values(std::size_t found, std::size_t expected)
{
    if (found != expected)
        throw MetricError("heat map: found " + std::to_string(found) + " values, expected "
            + std::to_string(expected));
}

Picture painted(std::span<const float> shares, Palette palette, ImageSize size)
{
    expect_values(shares.size(), size.pixels());
    return {.width = size.width,
        .height = size.height,
        .linear = {},
        .display = colored(shares, palette)};
}

}  // namespace

std::vector<std::uint8_t> colored(std::span<const float> shares, Palette palette)
{
    const std::span<const Stop> stops = stops_of(palette);
    std::vector<std::uint8_t> rgb;
    rgb.reserve(3 * shares.size());
    for (const float share : shares) {
        const double place =
            (share > 0 ? std::min(share, 1.0F) : 0.0) * static_cast<double>(stops.size() - 1);
        const auto below = std::min(static_cast<std::size_t>(place), stops.size() - 2);
        for (int c = 0; c < 3; ++c) {
            const double a = channel_of(stops[below], c);
            const double b = channel_of(stops[below + 1], c);
            rgb.push_back(static_cast<std::uint8_t>(
                std::lround(a + (b - a) * (place - static_cast<double>(below)))));
        }
    }
    return rgb;
}

std::vector<float> log_shares(std::span<const float> values, double lower, double upper)
{
    assert(lower > 0 && upper > lower);
    std::vector<float> shares;
    shares.reserve(values.size());
    for (const float value : values)
        shares.push_back(value > 0 ? static_cast<float>(
                             std::log(static_cast<double>(value) / lower) / std::log(upper / lower))
                                   : 0.0F);
    return shares;
}

std::vector<float> signed_shares(std::span<const float> values, double bound)
{
    std::vector<float> shares;
    shares.reserve(values.size());
    for (const float value : values)
        shares.push_back(static_cast<float>(0.5 + 0.5 * static_cast<double>(value) / bound));
    return shares;
}

std::vector<float> absolute_differences(
    std::span<const float> test, std::span<const float> reference)
{
    expect_comparable(test, reference);
    std::vector<float> differences(test.size() / 3);
    for (std::size_t i = 0; i < 3 * differences.size(); ++i)
        differences[i / 3] += std::abs(test[i] - reference[i]) / 3;
    return differences;
}

std::vector<float> relative_differences(
    std::span<const float> test, std::span<const float> reference)
{
    expect_comparable(test, reference);
    const std::vector<double> x = luminances(test);
    const std::vector<double> r = luminances(reference);
    std::vector<float> differences(x.size());
    for (std::size_t i = 0; i < x.size(); ++i)
        differences[i] = static_cast<float>((x[i] - r[i]) / (std::abs(r[i]) + 0.01));
    return differences;
}

Picture heat_map(std::span<const float> values, ImageSize size)
{
    return painted(values, Palette::kMagma, size);
}

Picture absolute_heat_map(
    std::span<const float> test, std::span<const float> reference, ImageSize size)
{
    return painted(
        log_shares(absolute_differences(test, reference), kLeastShownError, kMostShownError),
        Palette::kMagma, size);
}

Picture signed_heat_map(
    std::span<const float> test, std::span<const float> reference, ImageSize size)
{
    return painted(
        signed_shares(relative_differences(test, reference), 1), Palette::kDiverging, size);
}

}  // namespace farlight::client
