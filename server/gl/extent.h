// Extent: width and height in pixels, used from textures to the wire.
#pragma once

namespace farlight {

struct Extent {
    int width = 0;
    int height = 0;

    bool operator==(const Extent&) const = default;
};

}  // namespace farlight
