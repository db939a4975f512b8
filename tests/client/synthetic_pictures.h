// Pictures worked out pixel by pixel in whole numbers, so that another program can make the same.
#pragma once

#include "client/metrics/metrics.h"

#include <algorithm>
#include <cmath>

namespace farlight {

constexpr client::ImageSize kSyntheticSize{96, 64};

/// 0..255, a hash of pixel and channel.
inline int synthetic_noise(int x, int y, int c)
{
    auto h = static_cast<std::uint32_t>(x) * 73856093U ^ static_cast<std::uint32_t>(y) * 19349663U
        ^ static_cast<std::uint32_t>(c) * 83492791U;
    h = (h ^ (h >> 13U)) * 1274126177U;
    return static_cast<int>(((h ^ (h >> 16U)) >> 8U) & 255U);
}

/// 0..255: gradients in red and green, a checkerboard in blue.
inline int synthetic_scene(int x, int y, int c)
{
    if (c == 0)
        return x * 255 / (kSyntheticSize.width - 1);
    if (c == 1)
        return y * 255 / (kSyntheticSize.height - 1);
    return (x / 8 + y / 8) % 2 != 0 ? 220 : 40;
}

/// Linear radiance over 14 stops; every value is exact in float.
inline double synthetic_light(int x, int y, int c)
{
    return (synthetic_scene(x, y, c) + 1) / 64.0 * std::exp2((x / 12 + y / 16) % 7 - 3);
}

/// Values of(x, y, channel) of all pixels.
template <typename Of>
std::vector<float> synthetic_picture(Of&& of, client::ImageSize size = kSyntheticSize)
{
    std::vector<float> values;
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x)
            for (int c = 0; c < 3; ++c)
                values.push_back(static_cast<float>(of(x, y, c)));
    return values;
}

}  // namespace farlight
