// Estimates in double precision.
#include "lab/statistics.h"

#include "lab/device_scene.h"

#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>
#include <cstring>

namespace farlight {

Estimate mean_of(const Image& image)
{
    double mean = 0;
    double m2 = 0;
    double count = 0;
    for (const float value : values_of(image)) {
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
    const std::vector<float> x = values_of(image);
    const std::vector<float> r = values_of(reference);
    double sum = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        const double d = static_cast<double>(x[i]) - r[i];
        sum += d * d / (static_cast<double>(r[i]) * r[i] + 0.01);
    }
    return sum / static_cast<double>(x.size());
}

double chi_squared_p_value(const std::vector<double>& expected, const std::vector<double>& found)
{
    double chi2 = 0;
    int bins = 0;
    double pooled_expected = 0;
    double pooled_found = 0;
    const auto add = [&](double e, double f) { chi2 += (f - e) * (f - e) / e, ++bins; };
    for (std::size_t i = 0; i < expected.size(); ++i) {
        if (expected[i] >= 5) {
            add(expected[i], found[i]);
            continue;
        }
        pooled_expected += expected[i];
        pooled_found += found[i];
        if (pooled_expected >= 5) {
            add(pooled_expected, pooled_found);
            pooled_expected = pooled_found = 0;
        }
    }
    if (pooled_found > pooled_expected + 10)
        return 0;
    return bins < 2
        ? 1
        : boost::math::cdf(boost::math::complement(boost::math::chi_squared(bins - 1), chi2));
}

}  // namespace farlight
