// The process-wide test context.
#include "tests/support/gl_test.h"

namespace farlight {

const Context& GlTest::context()
{
    static const Context software("software");
    return software;
}

void GlTest::SetUpTestSuite()
{
    context();
}

Scene GlTest::shipped_scene(const std::string& name)
{
    return load_scene(std::string(FARLIGHT_SOURCE_DIR) + "/scenes/" + name);
}

}  // namespace farlight
