// Asking the context.
#include "server/scene/device_limits.h"

#include <algorithm>
#include <epoxy/gl.h>

namespace farlight {

DeviceLimits device_limits()
{
    GLint size = 0;
    GLint layers = 0;
    GLint texels = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &size);
    glGetIntegerv(GL_MAX_ARRAY_TEXTURE_LAYERS, &layers);
    glGetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &texels);
    // A texture reference keeps sizes and layers in 16 bits.
    return {{std::min(static_cast<std::uint32_t>(size), 0xffffU),
                std::min(static_cast<std::uint32_t>(layers), 0xffffU)},
        static_cast<std::size_t>(texels)};
}

}  // namespace farlight
