// RungPrices: which rungs one session has, and what each costs and brings, from a report or from
// the frames drawn so far.
#pragma once

#include "protocol/fields.h"
#include "server/gl/extent.h"
#include "server/stream/cost_model.h"
#include "server/stream/frontier_report.h"
#include "server/stream/ladder.h"

#include <memory>

namespace farlight {

/// A frame of a moving picture, as far as a controller looks at it.
struct DrawnCost {
    Choice choice;
    double trace_ms = 0;
    double denoise_ms = 0;
    RungError error{std::numeric_limits<double>::quiet_NaN()};  ///< Predicted; NaN: none.

    double ms() const { return trace_ms + denoise_ms; }
};

class RungPrices {
public:
    /// `report`: what to choose among; without one, or where none of its points fits the wishes,
    /// that is candidate_choices().
    explicit RungPrices(std::shared_ptr<const FrontierReport> report);

    /// A picture of `extent` is to be drawn as `wishes` say.
    void follow(const RenderSettings& wishes, Extent extent);
    /// Costs are those of the old scene until frames of the new one tell; errors are forgotten.
    void change_scene();
    /// False: it tells nothing, as it was not timed, or a first frame, which also allocates and
    /// compiles.
    bool measure(const DrawnCost& frame);
    /// The choice of the last frame takes this or more [ms], before the average shows it.
    void expect_at_least(double ms);
    /// Leaves out of the ladder what is known by now to be no frontier, and takes in what is.
    void rebuild();

    /// Whether times are known at all.
    bool known() const { return costs_.knows(); }
    protocol::FrontierSource source() const { return source_; }
    /// What it was made with; may be nothing.
    const FrontierReport* report() const { return report_.get(); }
    /// A report is there, but none of its points fits the wishes.
    bool report_unused() const;
    /// From cheap to dear and from large to small error as of the last rebuild(); what rungs cost
    /// and bring is as of the last frame.
    const std::vector<Rung>& ladder() const { return ladder_; }
    /// What frames of a choice take on average [ms]; 0 while not known.
    double ms_of(const Choice& choice) const;
    /// What 98 % of them do not exceed [ms].
    double slow_ms_of(const Choice& choice) const;

private:
    std::vector<Rung> reported_rungs();
    std::vector<Rung> candidates() const;
    double most_samples(double scale) const;
    void refresh(std::vector<Rung>& rungs) const;
    double residual_of(const Choice& choice) const;
    void learn(const DrawnCost& frame);
    void note_scatter(double ms);

    std::shared_ptr<const FrontierReport> report_;
    RenderSettings wishes_;
    Extent extent_;
    protocol::FrontierSource source_ = protocol::FrontierSource::kLearnt;

    CostModel costs_;
    /// Of a report's points: its ms over what a model fitted to it makes of them.
    std::vector<std::pair<Choice, double>> residuals_;
    bool level_known_ = false;  ///< Of the costs: false before frames of this scene are drawn.
    RungErrors errors_;
    Choice lately_;  ///< Drew the last frame,
    double last_ms_ = 0;  ///< which took this,
    int frames_of_choice_ = 0;  ///< and as many in a row.
    double variance_;  ///< Of relative times.
    int frames_to_skip_;
    std::vector<Rung> ladder_;
};

}  // namespace farlight
