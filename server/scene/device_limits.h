// What a device allows a scene to be.
#pragma once

#include "server/scene/textures.h"

namespace farlight {

/// The defaults are what OpenGL 4.5 guarantees.
struct DeviceLimits {
    TextureLimits textures;
    std::size_t buffer_texels = 65536;  ///< In one buffer texture; of ours each has 16 bytes.
};

/// Of the current context.
DeviceLimits device_limits();

}  // namespace farlight
