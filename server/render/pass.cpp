// Declaring a pass, a variable at a time.
#include "server/render/pass.h"

#include <cassert>

namespace farlight {

Pass& Pass::define(const Defines& more)
{
    defines.insert(defines.end(), more.begin(), more.end());
    return *this;
}

Pass& Pass::read(const char* variable, TextureHandle texture)
{
    assert(texture.index >= 0);
    uses.push_back({variable, texture, false});
    return *this;
}

Pass& Pass::write(const char* variable, TextureHandle texture)
{
    assert(texture.index >= 0);
    uses.push_back({variable, texture, true});
    return *this;
}

Pass& Pass::constant(const char* variable, Constant value)
{
    constants.emplace_back(variable, value);
    return *this;
}

Pass& Pass::scene(const SceneInputs& inputs)
{
    scene_inputs = &inputs;
    return define(inputs.defines);
}

Pass& Pass::wait_for_blocks()
{
    waits = true;
    return *this;
}

Pass& Pass::dispatch(Extent over)
{
    domain = over;
    return *this;
}

// Booleans are ints in our shaders.
GLenum glsl_type(const Constant& value)
{
    static constexpr GLenum kTypes[] = {
        GL_INT, GL_UNSIGNED_INT, GL_FLOAT, GL_FLOAT_VEC2, GL_FLOAT_VEC3};
    return kTypes[value.index()];
}

}  // namespace farlight
