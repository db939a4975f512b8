// GlTest: one software context a process.
#pragma once

#include "lab/device_scene.h"
#include "server/gl/context.h"
#include "server/scene/scene_file.h"

#include <gtest/gtest.h>

namespace farlight {

class GlTest : public testing::Test {
protected:
    static void SetUpTestSuite();

    /// The process-wide one, current on the main thread.
    static const Context& context();

    /// A file of scenes/.
    static Scene shipped_scene(const std::string& name);
};

}  // namespace farlight
