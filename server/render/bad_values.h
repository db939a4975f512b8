// Values that no healthy frame has, counted before anything cleans them: the stages that meet them,
// their kinds, and how many pixels of a frame they were met in.
#pragma once

#include "shaders/shared/bad_values.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace farlight {

enum class BadKind : std::uint8_t {
    kNan = KIND_NAN,
    kInfinite = KIND_INFINITE,
    kNegative = KIND_NEGATIVE,  ///< Of what may not be: light and variances. -0 is not.
    kClamped = KIND_CLAMPED,  ///< Cut at a limit.
};

struct BadKindRow {
    BadKind kind;
    std::string_view name;
};

constexpr std::array<BadKindRow, KIND_COUNT> kBadKinds{{
    {BadKind::kNan, "nan"},
    {BadKind::kInfinite, "infinite"},
    {BadKind::kNegative, "negative"},
    {BadKind::kClamped, "clamped"},
}};

struct CountedStage {
    std::size_t index;  ///< In shaders/shared/bad_values.h.
    std::string_view name;
    std::string_view looks_at;
};

/// In the order of a frame.
constexpr std::array<CountedStage, STAGE_COUNT> kCountedStages{{
    {STAGE_PRIMARY_RAY, "primary_ray", "origin and direction of the ray through a pixel"},
    {STAGE_GBUFFER, "gbuffer",
        "what that ray meets: place, depth, motion, albedo, emission; loops that the device ended"},
    {STAGE_HIT, "hit",
        "what a path's rays meet: way and normal; loops that the device ended, a fifth inside"},
    {STAGE_LIGHT, "light", "a sampled light, and what the surface makes of it"},
    {STAGE_THROUGHPUT, "throughput", "what is left of a path's light after a bounce"},
    {STAGE_FOG, "fog", "weights of events in fog, and the light that fog scatters"},
    {STAGE_RADIANCE, "radiance", "a pixel's samples by signal"},
    {STAGE_HISTORY, "history", "what is found of the frame before"},
    {STAGE_TEMPORAL, "temporal", "light blended over time"},
    {STAGE_MOMENTS, "moments", "mean and variance of its luminance"},
    {STAGE_VARIANCE, "variance", "variance estimated over neighbours"},
    {STAGE_ATROUS_1, "atrous_1", "light and variance after a pass of the wavelet filter"},
    {STAGE_ATROUS_1 + 1, "atrous_2", "after its second pass"},
    {STAGE_ATROUS_1 + 2, "atrous_3", "after its third"},
    {STAGE_ATROUS_1 + 3, "atrous_4", "after its fourth"},
    {STAGE_ATROUS_1 + 4, "atrous_5", "after its fifth"},
    {STAGE_ATROUS_1 + 5, "atrous_6", "after its sixth"},
    {STAGE_ATROUS_1 + 6, "atrous_7", "after its seventh"},
    {STAGE_ATROUS_1 + 7, "atrous_8", "after its eighth"},
    {STAGE_COMPOSITE, "composite", "the signals put together"},
    {STAGE_ACCUMULATE, "accumulate",
        "the mean of a resting picture, and the picture that turns into it"},
    {STAGE_ERROR_ESTIMATE, "error_estimate", "a pixel's part in the error that is estimated"},
    {STAGE_TONEMAP, "tonemap", "the picture as it goes to the screen"},
}};

/// Pixels by stage and kind, each counted once a pass. Laid out as lib/counters.glsl counts them.
template <typename Count> class BadValueCounts {
public:
    Count of(const CountedStage& stage, BadKind kind) const
    {
        return counts_[stage.index * KIND_COUNT + static_cast<std::size_t>(kind)];
    }
    Count of(BadKind kind) const
    {
        Count sum = 0;
        for (const CountedStage& stage : kCountedStages)
            sum += of(stage, kind);
        return sum;
    }
    Count of(const CountedStage& stage) const
    {
        Count sum = 0;
        for (const BadKindRow& row : kBadKinds)
            sum += of(stage, row.kind);
        return sum;
    }
    Count nonfinite() const { return of(BadKind::kNan) + of(BadKind::kInfinite); }
    Count all() const { return nonfinite() + of(BadKind::kNegative) + of(BadKind::kClamped); }

    template <typename Other> void add(const BadValueCounts<Other>& more)
    {
        for (std::size_t i = 0; i < counts_.size(); ++i)
            counts_[i] += more.counts()[i];
    }

    using Counts = std::array<Count, std::size_t{STAGE_COUNT} * KIND_COUNT>;
    Counts& counts() { return counts_; }
    const Counts& counts() const { return counts_; }

private:
    Counts counts_{};
};

/// Of a frame.
using BadValues = BadValueCounts<std::uint32_t>;
/// Of many.
using BadValueTotals = BadValueCounts<std::uint64_t>;

namespace bad_values_check {

/// Rows stand at their indices, so that a table may be asked by index.
consteval bool rows_in_order()
{
    for (std::size_t i = 0; i < kCountedStages.size(); ++i)
        if (kCountedStages[i].index != i || kCountedStages[i].name.empty())
            return false;
    for (std::size_t i = 0; i < kBadKinds.size(); ++i)
        if (static_cast<std::size_t>(kBadKinds[i].kind) != i)
            return false;
    return true;
}
static_assert(rows_in_order());

}  // namespace bad_values_check

}  // namespace farlight
