// Two passes of one dimension; the second runs along rows too, so that it reads memory in order.
#include "client/metrics/separable.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace farlight::client {
namespace {

Plane filtered_rows(const Plane& plane, ImageSize size, const Kernel& kernel)
{
    const int radius = static_cast<int>(kernel.size() / 2);
    Plane result(plane.size());
    std::vector<double> row(static_cast<std::size_t>(size.width + 2 * radius));
    for (int y = 0; y < size.height; ++y) {
        const double* in = plane.data() + static_cast<std::size_t>(y) * size.width;
        for (int x = -radius; x < size.width + radius; ++x)
            row[x + radius] = in[std::clamp(x, 0, size.width - 1)];
        double* out = result.data() + static_cast<std::size_t>(y) * size.width;
        for (int x = 0; x < size.width; ++x) {
            double sum = 0;
            for (std::size_t i = 0; i < kernel.size(); ++i)
                sum += kernel[i] * row[x + i];
            out[x] = sum;
        }
    }
    return result;
}

Plane filtered_columns(const Plane& plane, ImageSize size, const Kernel& kernel)
{
    const int radius = static_cast<int>(kernel.size() / 2);
    Plane result(plane.size());
    std::vector<double> sums(static_cast<std::size_t>(size.width));
    for (int y = 0; y < size.height; ++y) {
        std::fill(sums.begin(), sums.end(), 0.0);
        for (int i = -radius; i <= radius; ++i) {
            const double* in = plane.data()
                + static_cast<std::size_t>(std::clamp(y + i, 0, size.height - 1)) * size.width;
            for (int x = 0; x < size.width; ++x)
                sums[x] += kernel[i + radius] * in[x];
        }
        std::copy(
            sums.begin(), sums.end(), result.begin() + static_cast<std::ptrdiff_t>(y) * size.width);
    }
    return result;
}

}  // namespace

Kernel gaussian(double sigma, int radius)
{
    Kernel kernel(2 * static_cast<std::size_t>(radius) + 1);
    double sum = 0;
    for (int i = -radius; i <= radius; ++i)
        sum += kernel[i + radius] = std::exp(-i * i / (2 * sigma * sigma));
    for (double& weight : kernel)
        weight /= sum;
    return kernel;
}

Plane filtered(const Plane& plane, ImageSize size, const Kernel& across, const Kernel& down)
{
    assert(plane.size() == size.pixels() && across.size() % 2 == 1 && down.size() % 2 == 1);
    return filtered_columns(filtered_rows(plane, size, across), size, down);
}

}  // namespace farlight::client
