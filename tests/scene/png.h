// PNG files for tests, 8 or 16 bits a channel.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace farlight {

/// RGBA samples, row 0 on top, as many bits each as the number says.
std::string png8(std::uint32_t width, std::uint32_t height, const std::vector<std::uint8_t>& rgba);
std::string png16(
    std::uint32_t width, std::uint32_t height, const std::vector<std::uint16_t>& rgba);

}  // namespace farlight
