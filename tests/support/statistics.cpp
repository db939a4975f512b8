// Estimates in double precision.
#include "tests/support/statistics.h"

#include <cmath>
#include <cstring>
#include <vector>

namespace farlight {
namespace {

std::vector<float> floats_of(const Image& image)
{
    std::vector<float> values(image.bytes.size() / sizeof(float));
    std::memcpy(values.data(), image.bytes.data(), image.bytes.size());
    return values;
}

}  // namespace

Estimate mean_of(const Image& image)
{
    double mean = 0;
    double m2 = 0;
    double count = 0;
    for (const float value : floats_of(image)) {
        count += 1;
        const double delta = value - mean;
        mean += delta / count;
        m2 += delta * (value - mean);
    }
    // Three channels of a pixel share their noise: count pixels, not channels.
    return {mean, std::sqrt(m2 / count / (count / 3))};
}

Image difference_of(const Image& a, Image b)
{
    for (std::size_t at = 0; at < b.bytes.size(); at += sizeof(float)) {
        float x = 0;
        float y = 0;
        std::memcpy(&x, &a.bytes[at], sizeof x);
        std::memcpy(&y, &b.bytes[at], sizeof y);
        x -= y;
        std::memcpy(&b.bytes[at], &x, sizeof x);
    }
    return b;
}

double relative_mse(const Image& image, const Image& reference)
{
    const std::vector<float> x = floats_of(image);
    const std::vector<float> r = floats_of(reference);
    double sum = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        const double d = static_cast<double>(x[i]) - r[i];
        sum += d * d / (static_cast<double>(r[i]) * r[i] + 0.01);
    }
    return sum / static_cast<double>(x.size());
}

}  // namespace farlight
