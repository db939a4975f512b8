// Pictures to and from files: PNG and JPEG for display, PFM and EXR for linear radiance.
#pragma once

#include "client/picture.h"

#include <filesystem>

namespace farlight::client {

/// Writes by the file name's extension: .png and .jpg need `display`, .pfm and .exr need `linear`.
/// Throws PictureError naming the file.
void write_picture(const std::filesystem::path& file, const Picture& picture);

/// Reads .png, .jpg (display) or .pfm, .exr (linear) by extension. Throws PictureError naming the
/// file.
Picture read_picture(const std::filesystem::path& file);

/// Writes bytes as they are. Throws PictureError naming the file.
void write_bytes(const std::filesystem::path& file, std::span<const std::byte> bytes);

}  // namespace farlight::client
