// What each metric is called, what it computes and which way is better: one row a metric, read by
// `farlight compare`, by the functions of scripted-camera tests and by reports.
#pragma once

#include <cstdint>
#include <string_view>

namespace farlight::client {

enum class Better : std::uint8_t { kLower, kHigher };

struct Metric {
    std::string_view name;  ///< As compare prints it and scripts call it.
    std::string_view formula;
    std::string_view meaning;
    std::string_view unit;  ///< Empty: a plain number.
    Better better = Better::kLower;
};

/// x is the picture, r the reference: linear RGB before tone mapping. X, R and their luminance are
/// display values in [0, 1], after exposure, tone curve and sRGB. A mean is over all pixels and
/// channels that count. L is luminance.
constexpr Metric kMetrics[] = {
    {"relmse", "mean((x - r)^2 / (r^2 + 0.01))", "squared error relative to brightness", ""},
    {"relmse999", "relmse without the worst 0.1 % of the pixels",
        "what relmse lacks of it is fireflies", ""},
    {"mse", "mean((x - r)^2)", "squared error", ""},
    {"rmse", "sqrt(mean((x - r)^2))", "error in the unit of the picture", ""},
    {"psnr", "10 log10(1 / mean((X - R)^2))", "peak signal to noise of display values", "dB",
        Better::kHigher},
    {"smape", "mean(2 |x - r| / (|x| + |r| + 0.01))", "share of the brightness, in [0, 2]", ""},
    {"ssim", "mean SSIM of display luminance, 11x11 Gaussian of 1.5 px, K 0.01 and 0.03",
        "likeness of structure (Wang et al. 2004), 1 is equal", "", Better::kHigher},
    {"flip", "mean LDR-FLIP of X and R",
        "difference seen when pictures alternate (Andersson et al. 2020), in [0, 1]", ""},
    {"hdr_flip", "mean over pixels of the largest LDR-FLIP over exposures",
        "the same at every exposure (Andersson et al. 2021), in [0, 1]", ""},
    {"fireflies", "pixels with a channel x > 10 (r + 0.1)", "outliers", "px"},
    {"flicker", "mean over pixels of std_t(L) / (mean_t(L) + 0.01)",
        "unrest of a sequence of frames, camera and lights at rest", ""},
    {"difference", "mean |L_t - L_(t-1)|", "change from frame to frame", ""},
    {"lag", "frames after the step until relmse < 2 times its last value",
        "how long a change takes to show", "frames"},
    {"ghost", "largest |x - r| / (r + 0.01) of the pixels newly revealed",
        "what is left of the old picture", ""},
    {"bias", "mean((E x - r)^2 / (r^2 + 0.01))",
        "relmse that no number of seeded runs averages away", ""},
    {"variance", "mean(Var x / (r^2 + 0.01))", "relmse that averaging seeded runs removes", ""},
};

/// The named row, or nullptr.
constexpr const Metric* find_metric(std::string_view name)
{
    for (const Metric& metric : kMetrics)
        if (metric.name == name)
            return &metric;
    return nullptr;
}

}  // namespace farlight::client
