// The client's display values (client/metrics/display.h) are those of lib/display.glsl.
#include "client/metrics/display.h"
#include "lab/compute.h"
#include "server/gl/buffer.h"
#include "tests/support/gl_test.h"

#include <cmath>
#include <limits>

namespace farlight {
namespace {

using DisplayValues = GlTest;

/// 40 stops, and what no picture should hold.
std::vector<float> probed_radiances()
{
    constexpr float kInfinite = std::numeric_limits<float>::infinity();
    std::vector<float> values{0, -1, 1e30F, 3e38F, 1e-40F, kInfinite, -kInfinite, std::nanf("")};
    for (int i = 0; i < 2040; ++i)
        values.push_back(std::exp2(static_cast<float>(i) / 51 - 20));
    return values;
}

/// Within half of what tells two 12-bit values apart: pow() of a GPU is good for that and no more.
TEST_F(DisplayValues, OfClientAndServerAreTheSame)
{
    add_shader_file(
        "tests/display_probe", read_text(FARLIGHT_SOURCE_DIR "/tests/shaders/display_probe.comp"));
    const Program program(load_shader_source("tests/display_probe"));
    const std::vector<float> radiances = probed_radiances();
    Buffer probe("probe", std::as_bytes(std::span<const float>(radiances)));
    const auto shown = run_compute(
        program, {{"probe", probe.texture(GL_R32F)}}, radiances.size(), radiances.size());
    const auto curved = client::display_of_linear(radiances);
    const auto plain = client::display_of_linear(radiances, {.curve = client::ToneCurve::kLinear});
    for (std::size_t i = 0; i < radiances.size(); ++i) {
        EXPECT_NEAR(curved[i], shown[i].x, 1.0 / 8192) << radiances[i];
        EXPECT_NEAR(plain[i], shown[i].y, 1.0 / 8192) << radiances[i];
    }
}

}  // namespace
}  // namespace farlight
