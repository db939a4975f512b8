// Tone curve and sRGB in double.
#include "client/metrics/display.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace farlight::client {
namespace {

constexpr double kLargest = 1e30;  // what infinity becomes, as in the shader

double displayable(double x)
{
    return x > 0 ? std::min(x, kLargest) : 0;
}

}  // namespace

double aces_curve(double x)
{
    const double v = displayable(x);
    return std::clamp(v * (2.51 * v + 0.03) / (v * (2.43 * v + 0.59) + 0.14), 0.0, 1.0);
}

double srgb_encode(double x)
{
    return x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055;
}

double srgb_decode(double x)
{
    return x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
}

std::vector<float> display_of_linear(std::span<const float> linear, const DisplayOptions& options)
{
    std::vector<float> result(linear.size());
    std::transform(linear.begin(), linear.end(), result.begin(), [&](float value) {
        const double x = displayable(static_cast<double>(value) * options.exposure);
        const double curved = options.curve == ToneCurve::kAces ? aces_curve(x) : std::min(x, 1.0);
        return static_cast<float>(srgb_encode(curved));
    });
    return result;
}

std::vector<float> display_of_bytes(std::span<const std::uint8_t> display)
{
    std::vector<float> result(display.size());
    std::transform(display.begin(), display.end(), result.begin(),
        [](std::uint8_t byte) { return static_cast<float>(byte) / 255.0F; });
    return result;
}

std::vector<float> linear_of_bytes(std::span<const std::uint8_t> display)
{
    std::array<float, 256> decoded{};
    for (std::size_t i = 0; i < decoded.size(); ++i)
        decoded[i] = static_cast<float>(srgb_decode(static_cast<double>(i) / 255));
    std::vector<float> result(display.size());
    std::transform(display.begin(), display.end(), result.begin(),
        [&](std::uint8_t byte) { return decoded[byte]; });
    return result;
}

}  // namespace farlight::client
