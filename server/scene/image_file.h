// Picture files -> texels: PNG, JPEG (stb) for materials; Radiance HDR (stb), OpenEXR (tinyexr) for
// environments.
#pragma once

#include "server/scene/scene.h"
#include "server/scene/scene_error.h"

#include <filesystem>
#include <span>

namespace farlight {

/// The largest side of a picture: what every OpenGL 4.5 device takes (GL_MAX_TEXTURE_SIZE).
inline constexpr int kLargestImageSide = 16384;

/// PNG or JPEG in memory; 16 bits a channel become 8. Throws SceneError at `place`.
Image8 decode_image(std::span<const unsigned char> bytes, const ScenePlace& place);

/// The same from a file; the image is named after it. Throws SceneError.
Image8 read_image(const std::filesystem::path& file);

struct EnvironmentFile {
    EnvironmentMap map;
    std::size_t repaired_texels = 0;  ///< Not finite or negative: now 0; beyond 1e18: now that.
};

/// .hdr or .exr, told apart by their first bytes. Throws SceneError.
EnvironmentFile read_environment_map(const std::filesystem::path& file);

}  // namespace farlight
