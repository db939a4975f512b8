// CostModel: what a frame costs, learnt from frames as they are drawn.
//
//   tracing   = t0 + t1 * pixels * (samples + gbuffer)
//   denoising = d0 + d1 * pixels * (a-trous iterations + the other passes)
//
// How choices differ in cost is fitted by recursive least squares, to relative residuals because
// times scatter in proportion, when the choice changes. While it stays, a change of times is one of
// the load on the device, which all choices share: a fit could not tell which coefficient it was.
#pragma once

#include "server/stream/choice.h"
#include "server/stream/recursive_fit.h"

#include <optional>
#include <utility>

namespace farlight {

class CostModel {
public:
    /// Observations after which one counts half.
    static constexpr double kMemory = 15;

    bool knows() const { return fit_.has_value(); }

    /// A frame of a picture of `megapixels`, before the choice scales it, took this [ms]; the one
    /// before was of another choice.
    void add_frame(double megapixels, const Choice& choice, double trace_ms, double denoise_ms);
    /// The same where only the sum is known.
    void add_total(double megapixels, const Choice& choice, double ms);
    /// The same where the choice has stayed. `weight` 1 believes it, 0 does not.
    void follow_load(
        double megapixels, const Choice& choice, double trace_ms, double denoise_ms, double weight);
    /// All frames take longer by this factor.
    void scale(double factor);

    /// What a frame takes by what is known [ms]; 0 while nothing is.
    double ms(double megapixels, const Choice& choice) const;

private:
    using Fit = RecursiveFit<4>;  ///< t0, t1, d0, d1.

    void begin(const Fit::Row& regressors, double trace_ms, double denoise_ms);
    /// Of tracing, that of denoising [ms].
    std::pair<double, double> parts_of(const Fit::Row& regressors) const;

    std::optional<Fit> fit_;
};

}  // namespace farlight
