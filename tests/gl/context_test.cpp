// Devices: what is listed, what is chosen, what a wrong selector is told.
#include "server/gl/context.h"
#include "server/gl/gl_error.h"

#include <algorithm>
#include <epoxy/gl.h>
#include <gtest/gtest.h>

namespace farlight {
namespace {

TEST(ContextTest, ListEndsWithTheSoftwareDevice)
{
    const auto devices = list_devices();
    ASSERT_FALSE(devices.empty());
    EXPECT_EQ(devices.back().selector, "software");
    EXPECT_TRUE(devices.back().software);
    EXPECT_EQ(devices.back().problem, "");
}

TEST(ContextTest, AutoTakesTheFirstUsableDevice)
{
    const auto devices = list_devices();
    const auto usable = std::find_if(
        devices.begin(), devices.end(), [](const auto& device) { return device.problem.empty(); });
    ASSERT_NE(usable, devices.end());
    EXPECT_EQ(Context("auto").device().selector, usable->selector);
}

TEST(ContextTest, SoftwareIsOpenGl45)
{
    const Context context("software");
    GLint major = 0;
    GLint minor = 0;
    glGetIntegerv(GL_MAJOR_VERSION, &major);
    glGetIntegerv(GL_MINOR_VERSION, &minor);
    EXPECT_GE(10 * major + minor, 45);
    EXPECT_NO_THROW(check_gl("test"));
    glEnable(0xffff);
    EXPECT_THROW(check_gl("test"), GlError);
    EXPECT_NO_THROW(check_gl("test"));
}

TEST(ContextTest, AnUnknownSelectorIsToldWhatThereIs)
{
    try {
        const Context context("gpu:17");
        FAIL() << "accepted";
    } catch (const DeviceError& error) {
        EXPECT_STREQ(error.what(),
            "device 'gpu:17': no such device, expected auto, software, gpu or gpu:N (see "
            "--list-devices)");
    }
    EXPECT_THROW(Context("teapot"), DeviceError);
}

}  // namespace
}  // namespace farlight
