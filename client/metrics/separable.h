// Separable filters of one channel, for FLIP and SSIM.
#pragma once

#include "client/metrics/metrics.h"

#include <vector>

namespace farlight::client {

/// One channel, rows packed.
using Plane = std::vector<double>;
/// 2 radius + 1 weights; weight i is of the value i - radius pixels away.
using Kernel = std::vector<double>;

/// exp(-i^2 / (2 sigma^2)) for |i| <= radius, summing to 1; sigma [px].
Kernel gaussian(double sigma, int radius);

/// Rows filtered by `across`, then columns by `down`; what is outside repeats the border.
Plane filtered(const Plane& plane, ImageSize size, const Kernel& across, const Kernel& down);

}  // namespace farlight::client
