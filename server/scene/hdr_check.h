// Whether a Radiance HDR file holds all of its texels. stb does not end on one that breaks off
// within a run (stb_image 2.27 and before).
#pragma once

#include <span>

namespace farlight {

/// `width` and `height` are what the file's header says.
bool hdr_is_complete(std::span<const unsigned char> file, int width, int height);

}  // namespace farlight
