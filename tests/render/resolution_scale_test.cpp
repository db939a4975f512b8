// Pictures drawn smaller than they are shown, and histories that live through the change.
#include "lab/meshes.h"
#include "tests/support/gl_test.h"

#include <algorithm>
#include <cstring>

namespace farlight {
namespace {

class ResolutionScaleTest : public GlTest {
protected:
    ResolutionScaleTest() : scene_(shipped_scene("cornell_box.json")), on_device_(scene_) { }

    RenderRequest request(float scale) const
    {
        RenderRequest request = linear_request(scene_, {96, 54}, {});
        request.settings.resolution_scale = scale;
        return request;
    }

    static double mean_of(const Image& image)
    {
        double sum = 0;
        for (int y = 0; y < image.extent.height; ++y)
            for (int x = 0; x < image.extent.width; ++x)
                sum += static_cast<double>(pixel(image, x, y).x);
        return sum / (image.extent.width * image.extent.height);
    }

    Scene scene_;
    DeviceScene on_device_;
};

TEST_F(ResolutionScaleTest, SidesAreScaledAndNeverVanish)
{
    EXPECT_EQ(scaled_extent({96, 54}, 1), (Extent{96, 54}));
    EXPECT_EQ(scaled_extent({97, 55}, 0.5F), (Extent{49, 28}));
    EXPECT_EQ(scaled_extent({1, 3}, 0.25F), (Extent{1, 1}));
    View view(on_device_.shared);
    const Image image = view.render(request(0.5F)).image;
    EXPECT_EQ(image.extent, (Extent{48, 27}));
    EXPECT_EQ(image.full_extent, (Extent{96, 54}));
}

/// Up and down, between sizes that divide each other and that do not, moving and at rest.
TEST_F(ResolutionScaleTest, HistoriesLiveThroughAChange)
{
    View view(on_device_.shared);
    RenderRequest now = request(1);
    now.settings.view = DebugView::kHistoryLength;
    int frames = 0;
    for (const float scale : {1.0F, 0.5F, 0.71F, 1.0F, 0.25F, 1.0F})
        for (int i = 0; i < 4; ++i) {
            now.settings.resolution_scale = scale;
            now.camera.position.x += i % 2 == 0 ? 0.5 : 0;
            const RenderedFrame frame = view.render(now);
            EXPECT_EQ(frame.history_reset, ++frames == 1);
            EXPECT_EQ(frame.bad_values.all(), 0U);
            // The share of pixels on surfaces whose history is as long as it can be: what is lost
            // lies at silhouettes, where a coarser history is of another surface.
            const Image& image = frame.image;
            int lit = 0;
            int longest = 0;
            for (int y = 0; y < image.extent.height; ++y)
                for (int x = 0; x < image.extent.width; ++x) {
                    const float length = pixel(image, x, y).x;
                    lit += length > 0 ? 1 : 0;
                    longest += length == static_cast<float>(std::min(frames, 32)) ? 1 : 0;
                }
            EXPECT_GT(longest, 0.75 * lit) << "frame " << frames << " at " << scale;
        }
}

/// The light of pictures that change their size is that of pictures which never did.
TEST_F(ResolutionScaleTest, LightStaysTheSame)
{
    View full(on_device_.shared);
    View half(on_device_.shared);
    View changing(on_device_.shared);
    double expected = 0;
    double found = 0;
    for (int i = 0; i < 24; ++i) {
        const bool whole = i % 6 < 3;
        const double of_full = mean_of(full.render(request(1)).image);
        const double of_half = mean_of(half.render(request(0.5F)).image);
        const double other = mean_of(changing.render(request(whole ? 1.0F : 0.5F)).image);
        expected += i >= 8 ? (whole ? of_full : of_half) : 0;
        found += i >= 8 ? other : 0;
    }
    EXPECT_NEAR(found, expected, 0.01 * expected);
}

}  // namespace
}  // namespace farlight
