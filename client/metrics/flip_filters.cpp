// Equations of FLIP's filters (Andersson et al. 2020, sections 4.1.1 and 4.2), separated.
#include "client/metrics/flip_filters.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace farlight::client {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kFeatureWidth = 0.082;  // w: from peak to trough of an edge detector [degrees]

/// One Gaussian of a contrast sensitivity function: a sqrt(pi / b) exp(-pi^2 d^2 / b), d in
/// degrees.
struct Sensitivity {
    double a;
    double b;
};
// Of brightness, red against green, blue against yellow (table 1).
constexpr Sensitivity kBrightness{1, 0.0047};
constexpr Sensitivity kRedGreen{1, 0.0053};
constexpr std::array<Sensitivity, 2> kBlueYellow{{{34.1, 0.04}, {13.5, 0.025}}};

/// The widest Gaussian to three of its standard deviations [px].
int sensitivity_radius(double pixels_per_degree)
{
    const double deviation = std::sqrt(kBlueYellow[0].b / (2 * kPi * kPi));
    return static_cast<int>(std::ceil(3 * deviation * pixels_per_degree));
}

double sensitivity_sigma(const Sensitivity& s, double pixels_per_degree)
{
    return std::sqrt(s.b / 2) / kPi * pixels_per_degree;
}

/// Positive and negative weights sum to 1 and -1.
Kernel balanced(Kernel kernel)
{
    double positive = 0;
    double negative = 0;
    for (const double weight : kernel)
        (weight > 0 ? positive : negative) += std::abs(weight);
    for (double& weight : kernel)
        weight /= weight > 0 ? positive : negative;
    return kernel;
}

Plane strength(const Plane& brightness, ImageSize size, const Kernel& along, const Kernel& across)
{
    Plane x = filtered(brightness, size, along, across);
    const Plane y = filtered(brightness, size, across, along);
    for (std::size_t i = 0; i < x.size(); ++i)
        x[i] = std::hypot(x[i], y[i]);
    return x;
}

}  // namespace

Planes seen(const Planes& opponent, ImageSize size, double pixels_per_degree)
{
    const int radius = sensitivity_radius(pixels_per_degree);
    const auto blurred = [&](const Plane& plane, const Sensitivity& s) {
        const Kernel kernel = gaussian(sensitivity_sigma(s, pixels_per_degree), radius);
        return filtered(plane, size, kernel, kernel);
    };
    // A sum of Gaussians is normalised as a whole: each counts by the weights it had before.
    const auto weight = [&](const Sensitivity& s) {
        const double sigma = sensitivity_sigma(s, pixels_per_degree);
        double sum = 0;
        for (int i = -radius; i <= radius; ++i)
            sum += std::exp(-i * i / (2 * sigma * sigma));
        return s.a * std::sqrt(kPi / s.b) * sum * sum;
    };
    const double first = weight(kBlueYellow[0]);
    const double second = weight(kBlueYellow[1]);
    Planes result{blurred(opponent.x, kBrightness), blurred(opponent.y, kRedGreen),
        blurred(opponent.z, kBlueYellow[0])};
    const Plane narrow = blurred(opponent.z, kBlueYellow[1]);
    for (std::size_t i = 0; i < narrow.size(); ++i)
        result.z[i] = (first * result.z[i] + second * narrow[i]) / (first + second);
    return result;
}

Features features_of(const Planes& opponent, ImageSize size, double pixels_per_degree)
{
    const double sigma = 0.5 * kFeatureWidth * pixels_per_degree;
    const int radius = static_cast<int>(std::ceil(3 * sigma));
    const Kernel smooth = gaussian(sigma, radius);
    Kernel first = smooth;
    Kernel second = smooth;
    for (int i = -radius; i <= radius; ++i) {
        first[i + radius] *= -i;
        second[i + radius] *= i * i / (sigma * sigma) - 1;
    }
    Plane brightness(opponent.x.size());
    std::transform(opponent.x.begin(), opponent.x.end(), brightness.begin(),
        [](double y) { return (y + 16) / 116; });
    return {strength(brightness, size, balanced(first), smooth),
        strength(brightness, size, balanced(second), smooth)};
}

}  // namespace farlight::client
