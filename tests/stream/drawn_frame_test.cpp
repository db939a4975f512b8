// When a resting picture is final.
#include "server/stream/drawn_frame.h"

#include <gtest/gtest.h>
#include <limits>

namespace farlight {
namespace {

/// The `frames`-th frame at rest of 3 samples each, and an error of 0.01 up to `upper`.
bool final_after(int frames, double upper, double target)
{
    Draw draw;
    draw.request.settings.samples_per_pixel = 3;
    draw.request.settings.target_error = static_cast<float>(target);
    RenderedFrame frame;
    frame.accumulated_samples = static_cast<std::uint32_t>(3 * frames);
    frame.errors.predicted.value = 0.01;
    frame.errors.predicted.upper = upper;
    return is_final(frame, draw);
}

TEST(DrawnFrame, IsFinalWhereTheWholeIntervalReachesTheTarget)
{
    EXPECT_TRUE(final_after(8, 0.02, 0.025));
    EXPECT_FALSE(final_after(8, 0.03, 0.025)) << "the value alone may be luck";
    EXPECT_FALSE(final_after(8, std::numeric_limits<double>::quiet_NaN(), 0.025));
    EXPECT_FALSE(final_after(7, 0.02, 0.025)) << "too few frames to believe it";
    EXPECT_FALSE(final_after(8, 0.02, 0)) << "no target";
}

TEST(DrawnFrame, IsFinalWithTheSamplesAskedFor)
{
    RenderedFrame frame;
    EXPECT_FALSE(is_final(frame, Draw()));
    frame.converged = true;
    EXPECT_TRUE(is_final(frame, Draw()));
}

}  // namespace
}  // namespace farlight
