// Palettes are given at even steps and linear in between.
#include "client/accuracy/heat_map.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <stb/stb_image_write.h>
#include <stdexcept>

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

std::vector<float> channel_means(std::span<const float> rgb)
{
    std::vector<float> means;
    means.reserve(rgb.size() / 3);
    for (std::size_t i = 0; i + 2 < rgb.size(); i += 3)
        means.push_back((rgb[i] + rgb[i + 1] + rgb[i + 2]) / 3);
    return means;
}

double quantile_of(std::vector<float> values, double share)
{
    assert(!values.empty());
    const auto at = values.begin()
        + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), at, values.end());
    return static_cast<double>(*at);
}

std::string base64(std::span<const std::uint8_t> bytes)
{
    constexpr const char* kDigits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const auto byte = [&](std::size_t k) {
            return i + k < bytes.size() ? static_cast<std::uint32_t>(bytes[i + k]) : 0U;
        };
        const std::uint32_t bits = byte(0) << 16U | byte(1) << 8U | byte(2);
        for (unsigned digit = 0; digit < 4; ++digit)
            text += i + digit <= bytes.size() ? kDigits[bits >> (18U - 6U * digit) & 63U] : '=';
    }
    return text;
}

std::string png_data_uri(const std::vector<std::uint8_t>& rgb, ImageSize size)
{
    std::vector<std::uint8_t> png;
    const auto append = [](void* to, void* bytes, int count) {
        const auto* first = static_cast<const std::uint8_t*>(bytes);
        static_cast<std::vector<std::uint8_t>*>(to)->insert(
            static_cast<std::vector<std::uint8_t>*>(to)->end(), first, first + count);
    };
    if (stbi_write_png_to_func(append, &png, size.width, size.height, 3, rgb.data(), 3 * size.width)
        == 0)
        throw std::runtime_error("a picture cannot be encoded as PNG");
    return "data:image/png;base64," + base64(png);
}

}  // namespace farlight::client
