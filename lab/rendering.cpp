// See the header.
#include "lab/rendering.h"

#include "lab/statistics.h"
#include "server/gl/shader_source.h"

#include <algorithm>
#include <bit>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>

namespace farlight::lab {
namespace {

constexpr int kTile = 8;

/// That the pixels of a tile have the mean 0 (Student 1908): pixels of one picture less those of
/// another, so that what both show does not count as noise.
double tile_p_value(const Image& difference, int left, int top, double rounding)
{
    double sum = 0;
    double squares = 0;
    for (int y = top; y < top + kTile; ++y)
        for (int x = left; x < left + kTile; ++x) {
            const glm::dvec3 p = pixel(difference, x, y);
            const double value = (p.x + p.y + p.z) / 3;
            sum += value;
            squares += value * value;
        }
    constexpr double kCount = kTile * kTile;
    const double mean = sum / kCount;
    const double variance = std::max(squares / kCount - mean * mean, 0.0) / (kCount - 1);
    const double t = std::abs(mean) / std::sqrt(variance + rounding * rounding);
    if (!(t <= 1e6))
        return 0;
    return 2 * boost::math::cdf(boost::math::complement(boost::math::students_t(kCount - 1), t));
}

}  // namespace

Rendering averaged(int samples, bool light_sampling, int max_depth)
{
    Rendering how;
    how.settings.denoiser = Denoiser::kAccumulate;
    how.settings.samples_per_pixel = samples;
    how.settings.light_sampling = light_sampling;
    how.settings.max_depth = max_depth;
    how.settings.roulette_depth = 64;
    how.frames = 4;
    return how;
}

Drawn drawn(const DeviceScene& scene, const Rendering& how)
{
    View view(scene.shared);
    Drawn all;
    for (int i = 0; i < how.frames; ++i) {
        RenderedFrame frame = view.render(linear_request(scene.scene, how.extent, how.settings));
        all.counted.add(frame.bad_values);
        all.image = std::move(frame.image);
    }
    return all;
}

Drawn drawn(const Scene& scene, const Rendering& how)
{
    return drawn(DeviceScene(scene), how);
}

Image rendered(const DeviceScene& scene, const Rendering& how)
{
    Drawn all = drawn(scene, how);
    if (all.counted.all() > 0)
        std::fill(all.image.bytes.begin(), all.image.bytes.end(), std::byte{0xff});
    return std::move(all.image);
}

Image rendered(const Scene& scene, const Rendering& how)
{
    return rendered(DeviceScene(scene), how);
}

double largest_off(const Image& image, double expected)
{
    double off = 0;
    for (const float value : values_of(image))
        off = farther(off, std::abs(static_cast<double>(value) - expected));
    return off;
}

double standard_errors_off(const Image& image, double expected)
{
    const Estimate estimate = mean_of(image);
    return std::abs(estimate.mean - expected) / (estimate.standard_error + 1e-6 * expected);
}

double values_unlike(const std::vector<float>& a, const std::vector<float>& b)
{
    double unlike = std::abs(static_cast<double>(a.size()) - static_cast<double>(b.size()));
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
        unlike +=
            a[i] == b[i] && std::bit_cast<std::uint32_t>(a[i]) == std::bit_cast<std::uint32_t>(b[i])
            ? 0
            : 1;
    return unlike;
}

double values_unlike(const Image& a, const Image& b)
{
    return values_unlike(values_of(a), values_of(b));
}

Agreement agreement_of(const Image& a, const Image& b)
{
    const Image difference = difference_of(a, b);
    const Estimate estimate = mean_of(difference);
    const double mean = mean_of(a).mean;
    Agreement found;
    found.standard_errors = std::abs(estimate.mean) / estimate.standard_error;
    found.standard_error = estimate.standard_error / mean;
    for (int y = 0; y + kTile <= a.extent.height; y += kTile)
        for (int x = 0; x + kTile <= a.extent.width; x += kTile) {
            const double p = tile_p_value(difference, x, y, 1e-6 * mean);
            found.least_p_value = p >= found.least_p_value ? found.least_p_value : p;
            ++found.tiles;
        }
    return found;
}

void report_agreement(
    Findings& findings, const std::string& which, const Agreement& agreement, double most_error)
{
    findings.at_most(which + "means differ [standard errors]", agreement.standard_errors, 5);
    findings.at_most(
        which + "standard error of that, over the mean", agreement.standard_error, most_error);
    findings.at_least(which + "least p-value of a tile", agreement.least_p_value,
        1 - std::pow(0.99, 1.0 / static_cast<double>(agreement.tiles)));
}

ChangedShader::ChangedShader(
    const std::string& file, const std::string& text, const std::string& instead)
    : file_(file)
    , before_(shader_files().at(file))
{
    take_out({"changed for a while", "", file, text, instead});
}

ChangedShader::~ChangedShader()
{
    shader_files().at(file_) = before_;
}

}  // namespace farlight::lab
