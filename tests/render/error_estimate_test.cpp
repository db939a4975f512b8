// What the server says of its pictures' errors, against what they are.
#include "server/render/error_schedule.h"

#include "lab/meshes.h"
#include "tests/support/gl_test.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace farlight {
namespace {

// ---------------------------------------------------------------- from sums to estimates

/// Sums over the tiles of a picture whose pixels are drawn from an exponential distribution, as
/// squares of noise nearly are; the true mean is 1.
std::vector<glm::vec4> random_tiles(Extent extent, std::uint32_t seed)
{
    std::mt19937 random(seed);
    std::exponential_distribution<float> draw(1);
    const Extent tiles = tiles_of(extent);
    std::vector<glm::vec4> sums;
    for (int y = 0; y < tiles.height; ++y)
        for (int x = 0; x < tiles.width; ++x) {
            const int pixels = std::min(kTileSize, extent.width - x * kTileSize)
                * std::min(kTileSize, extent.height - y * kTileSize);
            glm::vec4 sum(0);
            for (int i = 0; i < pixels; ++i)
                sum += glm::vec4(draw(random), 0, draw(random), 1);
            sums.push_back(sum);
        }
    return sums;
}

TEST(MeanOfTiles, WeighsPixelsEqually)
{
    const Extent extent{9, 8};  // a whole tile and a column of 8 pixels
    const std::vector<glm::vec4> sums{{6, 0, 12, 3}, {0, 0, 0, 0}};
    EXPECT_DOUBLE_EQ(mean_of_tiles(sums, extent, 0).value, 2);
    EXPECT_DOUBLE_EQ(mean_of_tiles(sums, extent, 2).value, 4);
    EXPECT_FALSE(mean_of_tiles(sums, {8, 8}, 0).deviation >= 0) << "one tile has no spread";
}

/// Of 200 seeded pictures of independent pixels; intervals that are right leave the band of 90 to
/// 98 % in 1 of 100 runs.
TEST(MeanOfTiles, IntervalsCoverTheTruth)
{
    int covered = 0;
    for (std::uint32_t seed = 0; seed < 200; ++seed) {
        const Extent extent{250, 190};
        const ErrorEstimate mean = mean_of_tiles(random_tiles(extent, seed), extent, 0);
        covered += mean.lower <= 1 && 1 <= mean.upper ? 1 : 0;
    }
    EXPECT_GE(covered, 180);
    EXPECT_LE(covered, 196);
}

TEST(ErrorRecord, KnowsNothingWithoutSums)
{
    const FrameErrors errors = ErrorRecord().add({.extent = {16, 16}});
    EXPECT_FALSE(errors.predicted.known());
    EXPECT_FALSE(errors.measured.known());
    EXPECT_EQ(errors.reference_samples, 0U);
    EXPECT_TRUE(std::isnan(errors.effective_samples));
}

/// A picture of 30 frames' mean, whose frames are off by 0.6 each, weighs 0.75 in what is shown.
TEST(ErrorRecord, BlendsTheErrorsOfDenoisedPictureAndMean)
{
    const std::vector<glm::vec4> measured(4, glm::vec4(64 * 0.04F, 0, 64 * 0.02F, 64));
    const std::vector<glm::vec4> predicted(4, glm::vec4(64 * 0.01F, 64 * 0.5F, 0, 64));
    const FrameErrors errors = ErrorRecord().add({.predicted = predicted,
        .denoised = true,
        .measured = measured,
        .extent = {16, 16},
        .samples_per_pixel = 2,
        .mean_frames = 30,
        .mean_weight = 0.75,
        .reference_frames = 20});
    EXPECT_NEAR(errors.measured.value, 0.04, 1e-8);
    EXPECT_EQ(errors.reference_samples, 40U);
    EXPECT_NEAR(errors.raw, 0.6, 1e-6);
    EXPECT_NEAR(errors.predicted.value, 0.0625 * 0.04 + 0.5625 * 0.02, 1e-8);
    EXPECT_NEAR(errors.noise, 0.0625 * 0.01 + 0.5625 * 0.02, 1e-8);
    EXPECT_NEAR(errors.effective_samples, 2 * 0.6 / (0.0625 * 0.04 + 0.5625 * 0.02), 1e-4);
}

TEST(ErrorRecord, ForgetsWhatItKnewOfAnotherPicture)
{
    ErrorRecord record;
    const auto add_pair = [&](float half_picture, bool starts_anew) {
        const std::vector<glm::vec4> first(100, glm::vec4(0, 6.4F, 0, 64));
        const std::vector<glm::vec4> second(100, glm::vec4(0, 0, 64 * half_picture, 64));
        record.add(
            {.starts_anew = starts_anew, .predicted = first, .denoised = true, .extent = {80, 80}});
        return record.add(
            {.predicted = second, .second_of_pair = true, .denoised = true, .extent = {80, 80}});
    };
    FrameErrors errors;
    for (int i = 0; i < 10; ++i)
        errors = add_pair(0.5F, false);
    EXPECT_NEAR(errors.predicted.value, 0.5, 1e-6);
    EXPECT_NEAR(errors.raw, 0.1, 1e-6);
    errors = add_pair(0.1F, false);
    EXPECT_GT(errors.predicted.value, 0.4) << "a single pair weighs little";
    errors = add_pair(0.1F, true);
    EXPECT_NEAR(errors.predicted.value, 0.1, 1e-6);
}

TEST(ErrorRecord, KeepsWhatItKnowsBetweenPairs)
{
    const std::vector<glm::vec4> first(4, glm::vec4(0.64F, 6.4F, 0, 64));
    ErrorRecord record;
    record.add({.predicted = first, .denoised = true, .extent = {16, 16}});
    const FrameErrors errors = record.add({.denoised = true, .extent = {16, 16}});
    EXPECT_NEAR(errors.noise, 0.01, 1e-6);
    EXPECT_NEAR(errors.raw, 0.1, 1e-6);
    const FrameErrors plain = record.add({.extent = {16, 16}});
    EXPECT_TRUE(std::isnan(plain.noise)) << "of a picture that is not denoised nothing is known";
}

/// Looks of frames `first` to `last`, P: first of a pair, p: second, -: neither.
std::string looks_of(ErrorSchedule& schedule, int first, int last, bool new_filter = false)
{
    std::string text;
    FramePlan plan;
    for (int i = first; i <= last; ++i) {
        plan.frame_index = static_cast<std::uint32_t>(i);
        const ErrorLooks looks = schedule.next(plan, new_filter && i == first, false);
        EXPECT_TRUE(looks.predicts || !looks.second_of_pair);
        text += !looks.predicts ? '-' : looks.second_of_pair ? 'p' : 'P';
    }
    return text;
}

TEST(ErrorSchedule, PairsFollowEachOtherWhileHistoriesGrowAndThenLeaveGaps)
{
    ErrorSchedule schedule;
    EXPECT_EQ(looks_of(schedule, 0, 23), "PpPpPpPpPpPpPpPpPp--Pp--");
    EXPECT_EQ(looks_of(schedule, 0, 3), "PpPp") << "a cut begins anew";
}

TEST(ErrorSchedule, AnotherFilterLeavesAPairUnfinished)
{
    ErrorSchedule schedule;
    EXPECT_EQ(looks_of(schedule, 0, 20), "PpPpPpPpPpPpPpPpPp--P");
    EXPECT_EQ(looks_of(schedule, 21, 40, true), "-PpPpPpPpPpPpPpPp--P");
}

TEST(ErrorSchedule, PredictsOnlyWhatIsDenoised)
{
    FramePlan plan;
    plan.settings.denoiser = Denoiser::kOff;
    EXPECT_FALSE(ErrorSchedule().next(plan, false, false).predicts);
    plan.settings = {};
    plan.settings.error_estimate = false;
    EXPECT_FALSE(ErrorSchedule().next(plan, false, false).predicts);
}

TEST(FramesToForget, LeaveAThousandth)
{
    EXPECT_EQ(frames_to_forget(1), 1);
    for (const double alpha : {0.5, 0.2, 0.05, 1.0 / 32}) {
        EXPECT_LE(std::pow(1 - alpha, frames_to_forget(alpha)), 1e-3);
        EXPECT_GT(std::pow(1 - alpha, frames_to_forget(alpha) - 1), 1e-3);
    }
}

// ---------------------------------------------------------------- against the truth

double median_of(std::vector<double> values)
{
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

/// Over the pixels in which `depth`, the view, shows a surface.
double rel_mse(const Image& picture, const Image& reference, const Image& depth)
{
    const std::vector<float> x = values_of(picture);
    const std::vector<float> r = values_of(reference);
    const std::vector<float> far = values_of(depth);
    double sum = 0;
    double count = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        if (!(far[i] > 0))
            continue;
        const double truth = static_cast<double>(r[i]);
        const double error = static_cast<double>(x[i]) - truth;
        sum += error * error / (truth * truth + 0.01);
        ++count;
    }
    return sum / count;
}

class ErrorEstimateTest : public GlTest {
protected:
    static RenderRequest request_of(const Scene& scene)
    {
        RenderRequest request = linear_request(scene, {80, 45}, {});
        request.settings.antialiasing = false;  // moving and resting pictures have one truth
        return request;
    }

    /// Frame number `frames` of a camera that dollies in, or rests.
    static RenderedFrame draw(View& view, RenderRequest request, int frames, double step)
    {
        const glm::dvec3 way = request.camera.target - request.camera.position;
        const glm::dvec3 end = request.camera.position;
        RenderedFrame frame;
        for (int i = 1; i <= frames; ++i) {
            request.camera.position = end - way * (step * (frames - i));
            frame = view.render(request);
        }
        return frame;
    }

    static Image depth_of(const DeviceScene& on_device, RenderRequest request)
    {
        request.settings.view = DebugView::kDepth;
        return View(on_device.shared).render(request).image;
    }

    static Image reference(const DeviceScene& on_device, RenderRequest request, int frames)
    {
        View view(on_device.shared);
        request.settings.denoiser = Denoiser::kAccumulate;
        request.settings.seed = 4711;
        request.settings.samples_per_pixel = 8;
        return draw(view, request, frames, 0).image;
    }
};

TEST_F(ErrorEstimateTest, ChangesNoPixel)
{
    Scene scene = shipped_scene("still_life.json");
    const DeviceScene on_device(scene);
    for (const bool refine : {false, true}) {
        std::vector<Image> pictures;
        for (const bool estimate : {false, true}) {
            View view(on_device.shared);
            RenderRequest request = request_of(scene);
            request.settings.error_estimate = estimate;
            request.refine = refine;
            const RenderedFrame frame = draw(view, request, 6, refine ? 0 : 0.002);
            EXPECT_EQ(frame.errors.predicted.known(), estimate);
            pictures.push_back(frame.image);
        }
        EXPECT_EQ(pictures[0].bytes, pictures[1].bytes) << "refine " << refine;
    }
}

/// What is predicted of a moving picture, over what is measured when it rests.
TEST_F(ErrorEstimateTest, PredictedOverMeasuredIsCalibrated)
{
    std::vector<double> ratios;
    for (const char* name : {"cornell_box", "four_spheres", "mirror", "glass", "environment",
             "many_lights", "textures", "lantern", "roughness_row"}) {
        Scene scene = shipped_scene(std::string(name) + ".json");
        const DeviceScene on_device(scene);
        RenderRequest request = request_of(scene);
        View moving(on_device.shared);
        const FrameErrors predicted = draw(moving, request, 32, 0.002).errors;
        EXPECT_FALSE(predicted.measured.known()) << "nothing to measure against while it moves";
        View resting(on_device.shared);
        request.refine = true;
        FrameErrors measured;
        for (int i = 0; i < 270 && !measured.measured.known(); ++i)
            measured = resting.render(request).errors;
        ASSERT_TRUE(measured.measured.known()) << name;
        ratios.push_back(predicted.predicted.value / measured.measured.value);
        EXPECT_GT(predicted.noise, 0) << name;
        EXPECT_GT(predicted.effective_samples, 1) << name;
    }
    EXPECT_GE(median_of(ratios), 0.5) << testing::PrintToString(ratios);
    EXPECT_LE(median_of(ratios), 2) << testing::PrintToString(ratios);
}

TEST_F(ErrorEstimateTest, MeasuredIsTheErrorOfTheDenoisedPicture)
{
    Scene scene = shipped_scene("cornell_box.json");
    const DeviceScene on_device(scene);
    RenderRequest request = request_of(scene);
    const Image truth = reference(on_device, request, 128);
    View denoised(on_device.shared);
    const double actual =
        rel_mse(draw(denoised, request, 64, 0).image, truth, depth_of(on_device, request));
    View resting(on_device.shared);
    request.refine = true;
    const RenderedFrame frame = draw(resting, request, 270, 0);
    EXPECT_NEAR(frame.errors.measured.value, actual, 0.25 * actual);
    EXPECT_LE(frame.errors.measured.lower, actual);
    EXPECT_GE(frame.errors.measured.upper, actual);
    const double shown = rel_mse(frame.image, truth, depth_of(on_device, request));
    EXPECT_NEAR(frame.errors.predicted.value, shown, 0.4 * shown) << "of the refined picture";
    EXPECT_EQ(frame.errors.reference_samples, 217U) << "7 stretches of 31 frames, of 8";
    request.camera.position.x += 1;
    request.refine = false;
    EXPECT_FALSE(resting.render(request).errors.measured.known()) << "it is another picture now";
}

/// A mean's error is its noise, which falls with the samples in it.
TEST_F(ErrorEstimateTest, PlainMeansKnowTheirNoise)
{
    Scene scene = shipped_scene("cornell_box.json");
    const DeviceScene on_device(scene);
    RenderRequest request = request_of(scene);
    const Image truth = reference(on_device, request, 256);
    request.settings.denoiser = Denoiser::kAccumulate;
    View view(on_device.shared);
    const RenderedFrame frame = draw(view, request, 128, 0);
    const double actual = rel_mse(frame.image, truth, depth_of(on_device, request));
    EXPECT_NEAR(frame.errors.predicted.value, actual, 0.2 * actual);
    EXPECT_NEAR(frame.errors.effective_samples, 128, 1);
    EXPECT_FALSE(frame.errors.measured.known());
}

/// What was measured with another filter, or against a mean that was not kept meanwhile, is not
/// told, and what is measured afterwards is right.
TEST_F(ErrorEstimateTest, AChangedFilterIsMeasuredAnew)
{
    Scene scene = shipped_scene("cornell_box.json");
    const DeviceScene on_device(scene);
    View view(on_device.shared);
    RenderRequest request = request_of(scene);
    request.refine = true;
    const double before = draw(view, request, 70, 0).errors.measured.value;
    request.settings.exposure = 2;
    EXPECT_EQ(view.render(request).errors.measured.value, before) << "the picture is the same";
    request.settings.atrous_iterations = 1;
    EXPECT_FALSE(view.render(request).errors.measured.known());
    request.settings.atrous_iterations = 5;
    for (const bool estimate : {false, true}) {
        request.settings.error_estimate = estimate;
        EXPECT_FALSE(draw(view, request, 12, 0).errors.measured.known());
    }
    const ErrorEstimate after = draw(view, request, 62, 0).errors.measured;
    EXPECT_LT(after.value, 2 * before);
    EXPECT_GT(after.value, 0.5 * before);
}

class ErrorEstimateLongTest : public ErrorEstimateTest { };

/// Of 200 seeded pictures of a real scene: intervals of 95 % hold the error that the picture has in
/// 90 % or more. They come from how parts of one picture differ, which is more than seeds do: the
/// measured ones hold it in all 200, the predicted ones in 185.
TEST_F(ErrorEstimateLongTest, IntervalsCoverTheTruth)
{
    Scene scene = shipped_scene("cornell_box.json");
    const DeviceScene on_device(scene);
    RenderRequest request = request_of(scene);
    const Image truth = reference(on_device, request, 512);
    const Image depth = depth_of(on_device, request);
    int covered = 0;
    int predicted = 0;
    for (std::uint32_t seed = 0; seed < 200; ++seed) {
        const auto holds = [](const ErrorEstimate& estimate, double error) {
            return estimate.lower <= error && error <= estimate.upper ? 1 : 0;
        };
        View view(on_device.shared);
        request.settings.seed = seed;
        request.refine = false;
        RenderedFrame frame = draw(view, request, 40, 0);
        const double actual = rel_mse(frame.image, truth, depth);
        predicted += holds(frame.errors.predicted, actual);
        request.refine = true;
        covered += holds(draw(view, request, 124, 0).errors.measured, actual);
    }
    EXPECT_GE(covered, 180);
    EXPECT_GE(predicted, 180);
}

}  // namespace
}  // namespace farlight
