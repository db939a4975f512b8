// Finds every *_test.comp beside this file and runs it as one test.
#include "lab/compute.h"
#include "server/gl/buffer.h"
#include "shaders/shared/frame_constants.h"
#include "tests/support/gl_test.h"

#include <filesystem>

namespace farlight {
namespace {

const std::string kFolder = std::string(FARLIGHT_SOURCE_DIR) + "/tests/shaders/";

std::vector<std::string> shader_tests()
{
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(kFolder))
        if (entry.path().string().ends_with("_test.comp"))
            names.push_back(entry.path().stem().string());
    std::sort(names.begin(), names.end());
    return names;
}

class ShaderTest : public GlTest, public testing::WithParamInterface<std::string> { };

/// A camera at the origin looking down -z, 90 degrees high, 64x64 pixels: what shader tests may
/// assume.
shared::FrameConstants test_frame()
{
    shared::FrameConstants frame{};
    frame.camera.pixel_footprint = 2.0F / 64;
    frame.camera.forward = {0, 0, -1};
    frame.camera.right = {1, 0, 0};
    frame.camera.up = {0, 1, 0};
    frame.camera.width = frame.camera.height = 64;
    frame.prev_camera = frame.camera;
    frame.extent = {64, 64};
    return frame;
}

TEST_P(ShaderTest, EveryExpectationHolds)
{
    add_shader_file("expect.glsl", read_text(kFolder + "expect.glsl"));
    add_shader_file("tests/" + GetParam(), read_text(kFolder + GetParam() + ".comp"));
    const Program program(load_shader_source("tests/" + GetParam()));
    const shared::FrameConstants frame = test_frame();
    const Buffer block(
        "frame", std::as_bytes(std::span<const shared::FrameConstants, 1>(&frame, 1)));
    if (const auto found = program.uniform_blocks().find("frame_block");
        found != program.uniform_blocks().end())
        glBindBufferBase(GL_UNIFORM_BUFFER, found->second, block.id());

    const std::vector<glm::vec4> results = run_compute(program, {}, 2, 1);
    EXPECT_GT(results[0].x, 0) << "no expectation ran";
    EXPECT_EQ(results[0].y, 0) << "tests/shaders/" << GetParam() << ".comp:" << results[0].z
                               << ": found " << results[1].x << ", expected " << results[1].y
                               << " within " << results[1].z;
}

INSTANTIATE_TEST_SUITE_P(Shaders, ShaderTest, testing::ValuesIn(shader_tests()),
    [](const auto& test) { return test.param; });

}  // namespace
}  // namespace farlight
