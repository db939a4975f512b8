// The view `flip`: that the device's FLIP is the client's, and which frame it is of.
#include "server/passes/flip.h"

#include "client/metrics/display.h"
#include "client/metrics/flip.h"
#include "lab/compute.h"
#include "server/passes/debug_view.h"
#include "server/render/readback.h"
#include "tests/support/gl_test.h"

#include <algorithm>

namespace farlight {
namespace {

constexpr Extent kFlipExtent{67, 45};

float largest_of(const Image& map)
{
    const std::vector<float> values = values_of(map);
    return *std::max_element(values.begin(), values.end());
}

bool has_pass(const RenderedFrame& frame, std::string_view name)
{
    return std::any_of(frame.pass_times.begin(), frame.pass_times.end(),
        [&](const PassTime& time) { return time.pass == name; });
}

/// Room for a resting camera; moving and resting frames have the same samples.
class FlipViewTest : public GlTest {
protected:
    RenderRequest request_of(DebugView shown) const
    {
        RenderRequest request = linear_request(on_device.scene, kFlipExtent, {});
        request.settings.antialiasing = false;
        request.settings.view = shown;
        request.refine = true;
        return request;
    }
    RenderedFrame draw(const RenderRequest& request, int frames) const
    {
        View view(on_device.shared);
        RenderedFrame frame;
        for (int i = 0; i < frames; ++i)
            frame = view.render(request);
        return frame;
    }

    DeviceScene on_device{shipped_scene("cornell_box.json")};
};

TEST_F(FlipViewTest, IsTheClientsFlipOfDenoisedPictureAndMean)
{
    for (const Tonemap curve : {Tonemap::kAces, Tonemap::kLinear}) {
        constexpr int kFrames = 6;
        RenderRequest request = request_of(DebugView::kFlip);
        request.settings.tonemap = curve;
        request.settings.exposure = 0.5F;
        const Image map = draw(request, kFrames).image;
        request.settings.view = DebugView::kFinal;
        request.refine = false;
        const std::vector<float> denoised = values_of(draw(request, kFrames).image);
        request.settings.denoiser = Denoiser::kAccumulate;
        const std::vector<float> mean = values_of(draw(request, kFrames).image);

        const client::DisplayOptions shown{.exposure = 0.5,
            .curve =
                curve == Tonemap::kAces ? client::ToneCurve::kAces : client::ToneCurve::kLinear};
        const std::vector<float> expected =
            client::ldr_flip(client::display_of_linear(denoised, shown),
                client::display_of_linear(mean, shown), {kFlipExtent.width, kFlipExtent.height});
        ASSERT_EQ(values_of(map).size(), 3 * expected.size());
        float off = 0;
        double sum = 0;
        for (std::size_t i = 0; i < expected.size(); ++i) {
            sum += static_cast<double>(expected[i]);
            for (const std::size_t channel : {0U, 1U, 2U})
                off = std::max(off, std::abs(values_of(map)[3 * i + channel] - expected[i]));
        }
        // Four times what single precision leaves; one more in the last digit of any constant of
        // the filters is twice this or more.
        EXPECT_LE(off, 2e-5F);
        EXPECT_GT(sum, 0.02 * static_cast<double>(expected.size())) << "nothing to compare";
    }
}

/// Two pictures of sharp detail, and one with itself.
TEST_F(FlipViewTest, OfAPictureAndItselfIsZero)
{
    add_shader_file("tests/stripes", R"(#version 450
layout(local_size_x = 8, local_size_y = 8) in;
uniform writeonly image2D out_value;
uniform int width;
void main()
{
    const ivec2 px = ivec2(gl_GlobalInvocationID.xy);
    imageStore(out_value, px, vec4((px / width) % 2, (px.x * px.y) % 3, 1.0));
}
)");
    shared::FrameConstants constants{};
    constants.extent = {kFlipExtent.width, kFlipExtent.height};
    const Buffer block("frame constants", std::as_bytes(std::span(&constants, 1)));
    const auto difference = [&](int width, int other) {
        FrameGraph graph(on_device.shared.programs, true, true);
        graph.begin_frame(kFlipExtent, {{"frame_block", block.id()}});
        const auto stripes = [&](int wide) {
            const TextureHandle picture = graph.create("stripes", GL_RGBA32F);
            graph.add_pass("stripes", "tests/stripes")
                .write("out_value", picture)
                .constant("width", wide);
            return picture;
        };
        const TextureHandle map = add_flip(graph, stripes(width), stripes(other), {}, false);
        const TextureHandle value =
            add_debug_value(graph, "map", {map, "VIEW_RED", "SHOW_MAGMA", 1});
        graph.keep(value);
        graph.execute();
        Readback readback;
        readback.begin(graph.texture(value));
        return largest_of(readback.finish());
    };
    EXPECT_EQ(difference(3, 3), 0);
    EXPECT_GT(difference(3, 4), 0.3F);
}

TEST_F(FlipViewTest, IsZeroWithoutAMeanOrADenoiser)
{
    RenderRequest request = request_of(DebugView::kFlip);
    EXPECT_GT(largest_of(draw(request, 3).image), 0);
    request.refine = false;
    EXPECT_EQ(largest_of(draw(request, 3).image), 0) << "it moves";
    for (const Denoiser without : {Denoiser::kOff, Denoiser::kAccumulate}) {
        request.refine = true;
        request.settings.denoiser = without;
        EXPECT_EQ(largest_of(draw(request, 3).image), 0);
    }
}

/// Whichever frames are worth a new map: it is of that frame, or the one before is shown again. The
/// final picture's is its own.
TEST_F(FlipViewTest, LiveShowsMapsOfBeforeUntilThePictureIsFinal)
{
    RenderRequest request = request_of(DebugView::kFlip);
    request.settings.still_samples = 8;
    View every(on_device.shared);
    View live(on_device.shared);
    RenderRequest watched = request;
    watched.live = true;
    std::vector<std::byte> before;
    for (int i = 1; i <= 8; ++i) {
        const RenderedFrame own = every.render(request);
        EXPECT_TRUE(has_pass(own, "flip compare"));
        const RenderedFrame frame = live.render(watched);
        const bool kept = has_pass(frame, "flip keep");
        EXPECT_NE(kept, has_pass(frame, "flip compare"));
        EXPECT_TRUE(frame.image.bytes == (kept ? before : own.image.bytes)) << i;
        EXPECT_FALSE(kept && (i == 1 || i == 8));
        before = frame.image.bytes;
    }
    request.camera.position.x += 0.1;
    watched.camera = request.camera;
    EXPECT_TRUE(live.render(watched).image.bytes == every.render(request).image.bytes);
}

TEST_F(FlipViewTest, StaysWithinTheMemoryThatViewsAreBookedFor)
{
    Scene every_signal = shipped_scene("cornell_box.json");
    every_signal.materials[0].metallic = 0.5F;
    every_signal.materials[0].roughness = 0.3F;
    every_signal.medium.sigma_s = glm::vec3(0.01F);
    const DeviceScene scene(every_signal);
    View view(scene.shared);
    RenderRequest request = request_of(DebugView::kFlip);
    request.format = PixelFormat::kRgb8;
    view.render(request);
    view.render(request);
    const std::size_t pixels = std::size_t{67} * 45;
    EXPECT_LE(view.graph().texture_bytes() + 16 * pixels, kViewBytesPerPixel * pixels);
}

}  // namespace
}  // namespace farlight
