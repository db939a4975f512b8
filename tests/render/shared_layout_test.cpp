// Structs that both compilers read lie alike: the driver is asked for every member's offset.
#include "lab/compute.h"
#include "shaders/shared/frame_constants.h"
#include "tests/support/gl_test.h"

namespace farlight {
namespace {

class SharedLayoutTest : public GlTest { };

std::map<std::string, GLint> member_offsets(GLuint program)
{
    GLint count = 0;
    glGetProgramInterfaceiv(program, GL_UNIFORM, GL_ACTIVE_RESOURCES, &count);
    std::map<std::string, GLint> offsets;
    for (GLuint i = 0; i < static_cast<GLuint>(count); ++i) {
        char name[128];
        glGetProgramResourceName(program, GL_UNIFORM, i, sizeof name, nullptr, name);
        const GLenum property = GL_OFFSET;
        GLint offset = -1;
        glGetProgramResourceiv(program, GL_UNIFORM, i, 1, &property, 1, nullptr, &offset);
        if (offset >= 0)
            offsets[name] = offset;
    }
    return offsets;
}

TEST_F(SharedLayoutTest, FrameConstantsLieAlikeInCppAndGlsl)
{
    using shared::CameraConstants;
    using shared::FrameConstants;
    // std140 blocks are active as a whole, so one use shows every member.
    add_shader_file("tests/layout", R"(#version 450
#include "lib/frame.glsl"
layout(local_size_x = 1) in;
layout(std430) buffer output_block { vec4 results[]; };
void main() { results[0] = vec4(frame.camera.position, 0.0); }
)");
    const Program program(load_shader_source("tests/layout"));
    std::map<std::string, GLint> expected;
    for (const auto& [camera, base] : {std::pair{"camera", offsetof(FrameConstants, camera)},
             std::pair{"prev_camera", offsetof(FrameConstants, prev_camera)}})
        for (const auto& [member, offset] :
            std::map<std::string, std::size_t>{{"position", offsetof(CameraConstants, position)},
                {"pixel_footprint", offsetof(CameraConstants, pixel_footprint)},
                {"forward", offsetof(CameraConstants, forward)},
                {"width", offsetof(CameraConstants, width)},
                {"right", offsetof(CameraConstants, right)},
                {"height", offsetof(CameraConstants, height)},
                {"up", offsetof(CameraConstants, up)}, {"pad0", offsetof(CameraConstants, pad0)}})
            expected["frame." + std::string(camera) + "." + member] =
                static_cast<GLint>(base + offset);
    expected["frame.background"] = offsetof(FrameConstants, background);
    expected["frame.first_sample"] = offsetof(FrameConstants, first_sample);
    expected["frame.extent"] = offsetof(FrameConstants, extent);
    expected["frame.seed"] = offsetof(FrameConstants, seed);
    expected["frame.light_count"] = offsetof(FrameConstants, light_count);
    expected["frame.frame_index"] = offsetof(FrameConstants, frame_index);
    expected["frame.camera_inside"] = offsetof(FrameConstants, camera_inside);
    expected["frame.camera_absorption"] = offsetof(FrameConstants, camera_absorption);
    EXPECT_EQ(member_offsets(program.id()), expected);
    EXPECT_EQ(sizeof(FrameConstants) % 16, 0U);
}

}  // namespace
}  // namespace farlight
