// Local means, variances and covariance by Gaussian windows.
#include "client/metrics/ssim.h"

#include "client/metrics/separable.h"

namespace farlight::client {
namespace {

constexpr double kWindowSigma = 1.5;  // [px]
constexpr double kLuminanceConstant = 0.01 * 0.01;  // (K1 * range)^2
constexpr double kContrastConstant = 0.03 * 0.03;  // (K2 * range)^2

Plane product(const Plane& a, const Plane& b)
{
    Plane result(a.size());
    for (std::size_t i = 0; i < a.size(); ++i)
        result[i] = a[i] * b[i];
    return result;
}

/// Moments of the windows around each pixel.
struct Moments {
    Plane mean_x, mean_r, xx, rr, xr;
};

double similarity(const Moments& m, std::size_t i)
{
    const double x = m.mean_x[i];
    const double r = m.mean_r[i];
    const double variance_x = m.xx[i] - x * x;
    const double variance_r = m.rr[i] - r * r;
    const double covariance = m.xr[i] - x * r;
    return (2 * x * r + kLuminanceConstant) * (2 * covariance + kContrastConstant)
        / ((x * x + r * r + kLuminanceConstant) * (variance_x + variance_r + kContrastConstant));
}

}  // namespace

double structural_similarity(
    std::span<const float> test, std::span<const float> reference, ImageSize size, Mask mask)
{
    expect_comparable(test, reference);
    expect_comparable(test, reference, mask);
    if (test.size() != 3 * size.pixels())
        throw MetricError("the picture has " + std::to_string(test.size()) + " values, expected "
            + std::to_string(3 * size.pixels()));
    if (size.width < kSsimWindow || size.height < kSsimWindow)
        throw MetricError("SSIM: found " + std::to_string(size.width) + "x"
            + std::to_string(size.height) + " pixels, expected at least 11x11");
    expect_fitting(mask, test.size() / 3);
    constexpr int kRadius = kSsimWindow / 2;
    const Kernel window = gaussian(kWindowSigma, kRadius);
    const auto mean = [&](const Plane& p) { return filtered(p, size, window, window); };
    const Plane x = luminances(test);
    const Plane r = luminances(reference);
    const Moments moments{
        mean(x), mean(r), mean(product(x, x)), mean(product(r, r)), mean(product(x, r))};

    double sum = 0;
    std::size_t count = 0;
    for (int row = kRadius; row < size.height - kRadius; ++row)
        for (int column = kRadius; column < size.width - kRadius; ++column) {
            const std::size_t i = static_cast<std::size_t>(row) * size.width + column;
            if (!mask.empty() && mask[i] == 0)
                continue;
            sum += similarity(moments, i);
            ++count;
        }
    if (count == 0)
        throw MetricError("SSIM: the mask leaves no window to compare");
    return sum / static_cast<double>(count);
}

}  // namespace farlight::client
