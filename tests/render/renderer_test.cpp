// The render thread: several clients, refusals that hurt one client only, a device that fails.
#include "lab/meshes.h"
#include "server/render/renderer.h"
#include "tests/support/gl_test.h"

#include <condition_variable>
#include <epoxy/gl.h>
#include <mutex>

namespace farlight {
namespace {

/// Asks for a number of frames, then rests; keeps what comes back.
class CountingSource : public FrameSource {
public:
    CountingSource(Extent extent, int frames) : extent_(extent), wanted_(frames) { }

    std::optional<RenderRequest> next_request() override
    {
        const std::lock_guard lock(mutex_);
        if (asked_ == wanted_)
            return std::nullopt;
        ++asked_;
        if (before_request)
            before_request();
        RenderRequest request;
        request.camera = {{0, 0.3, 1.95}, {0, 0, 0}, {0, 1, 0}, 70};
        request.extent = extent_;
        request.settings = settings;
        return request;
    }
    void frame_done(RenderedFrame frame) override
    {
        const std::lock_guard lock(mutex_);
        frames_.push_back(std::move(frame));
        arrived_.notify_all();
    }
    std::vector<RenderedFrame> wait_for_all()
    {
        std::unique_lock lock(mutex_);
        arrived_.wait_for(lock, std::chrono::seconds(60),
            [&] { return frames_.size() == static_cast<std::size_t>(wanted_); });
        return frames_;
    }

    std::function<void()> before_request;  ///< Runs on the render thread.
    RenderSettings settings;

private:
    const Extent extent_;
    const int wanted_;
    int asked_ = 0;
    std::mutex mutex_;
    std::condition_variable arrived_;
    std::vector<RenderedFrame> frames_;
};

RendererOptions small_options()
{
    RendererOptions options;
    options.device = "software";
    options.extent = Extent{32, 32};
    return options;
}

Scene room()
{
    return room_with(bumpy_sphere(12, 6));
}

std::shared_ptr<CountingSource> attach(Renderer& renderer, Extent extent, int frames)
{
    auto source = std::make_shared<CountingSource>(extent, frames);
    renderer.attach(source);
    return source;
}

TEST(RendererTest, SeveralClientsEachGetTheirFrames)
{
    Renderer renderer(room(), small_options());
    const auto a = attach(renderer, {40, 20}, 5);
    const auto b = attach(renderer, {16, 16}, 3);
    const auto frames_a = a->wait_for_all();
    const auto frames_b = b->wait_for_all();
    ASSERT_EQ(frames_a.size(), 5U);
    ASSERT_EQ(frames_b.size(), 3U);
    EXPECT_TRUE(frames_a[0].history_reset);
    EXPECT_FALSE(frames_a[1].history_reset);
    EXPECT_EQ(frames_a[4].image.extent, (Extent{40, 20}));
    EXPECT_EQ(frames_b[0].error, "");
    EXPECT_GT(frames_b[2].trace_ms, 0);
    EXPECT_EQ(renderer.frames_rendered(), 8U);
    renderer.detach(a);
    EXPECT_EQ(attach(renderer, {8, 8}, 1)->wait_for_all().size(), 1U);
}

/// A picture too large for what is left is refused by name; everybody else goes on.
TEST(RendererTest, MemoryIsBookedPerViewAndFreedWithIt)
{
    RendererOptions options = small_options();
    options.view_memory = kViewBytesPerPixel * 100 * 100;
    Renderer renderer(room(), options);
    const auto first = attach(renderer, {80, 80}, 2);
    EXPECT_EQ(first->wait_for_all().at(1).error, "");
    const auto second = attach(renderer, {80, 80}, 1);
    const auto mebibytes = [](std::size_t pixels) {
        return std::to_string((kViewBytesPerPixel * pixels) >> 20U) + " MiB";
    };
    const std::string error = second->wait_for_all().at(0).error;
    EXPECT_NE(error.find("a picture of 80x80 needs " + mebibytes(6400) + ", but of the "
                  + mebibytes(10000)),
        std::string::npos)
        << error;
    EXPECT_EQ(renderer.failure(), "");
    renderer.detach(first);
    EXPECT_EQ(attach(renderer, {80, 80}, 1)->wait_for_all().at(0).error, "");
}

TEST_F(GlTest, ViewsStayWithinTheMemoryTheyAreBookedFor)
{
    Scene every_signal = room();
    every_signal.materials[0].metallic = 0.5F;
    every_signal.materials[0].roughness = 0.3F;
    every_signal.medium.sigma_s = glm::vec3(0.01F);
    const DeviceScene scene(every_signal);
    View view(scene.shared);
    RenderRequest request = linear_request(scene.scene, {64, 64}, {});
    request.refine = true;
    request.settings.view = DebugView::kSheet;
    request.format = PixelFormat::kRgb8;
    view.render(request);
    view.render(request);
    const std::size_t bytes = view.graph().texture_bytes() + std::size_t{16} * 64 * 64;
    EXPECT_LE(bytes, kViewBytesPerPixel * 64 * 64);
    EXPECT_GT(bytes, kViewBytesPerPixel * 64 * 64 * 3 / 4) << "books much more than it needs";
}

TEST(RendererTest, AFrameOfMoreThanABillionSegmentsIsRefused)
{
    Renderer renderer(room(), small_options());
    auto source = std::make_shared<CountingSource>(Extent{1024, 1024}, 1);
    source->settings.samples_per_pixel = 1024;
    renderer.attach(source);
    EXPECT_NE(
        source->wait_for_all().at(0).error.find("more than 1e9 path segments"), std::string::npos);
    EXPECT_EQ(attach(renderer, {8, 8}, 1)->wait_for_all().at(0).error, "");
}

/// An OpenGL error ends in a message and a renderer that says it failed, never in garbage.
TEST(RendererTest, AnOpenGlErrorIsToldAndNothingMoreIsDrawn)
{
    Renderer renderer(room(), small_options());
    EXPECT_EQ(renderer.failure(), "");
    auto source = std::make_shared<CountingSource>(Extent{16, 16}, 2);
    source->before_request = [] { glEnable(0xffff); };
    renderer.attach(source);
    const auto frames = source->wait_for_all();
    ASSERT_EQ(frames.size(), 2U);
    EXPECT_NE(frames[0].error.find("OpenGL error 0x0500"), std::string::npos) << frames[0].error;
    EXPECT_TRUE(frames[0].image.bytes.empty());
    EXPECT_NE(renderer.failure().find("OpenGL error"), std::string::npos);
    const auto other = attach(renderer, {8, 8}, 1)->wait_for_all();
    EXPECT_EQ(other.at(0).error, renderer.failure());
}

TEST(RendererTest, AnUnknownDeviceIsRefusedWithWhatThereIs)
{
    RendererOptions options = small_options();
    options.device = "gpu:99";
    EXPECT_THROW(Renderer(room(), options), std::runtime_error);
}

}  // namespace
}  // namespace farlight
