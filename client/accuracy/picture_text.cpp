// PNG in base64.
#include "client/accuracy/picture_text.h"

#include <stb/stb_image_write.h>
#include <stdexcept>

namespace farlight::client {

std::string base64(std::span<const std::uint8_t> bytes)
{
    constexpr const char* kDigits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const auto byte = [&](std::size_t k) {
            return i + k < bytes.size() ? static_cast<std::uint32_t>(bytes[i + k]) : 0U;
        };
        const std::uint32_t bits = byte(0) << 16U | byte(1) << 8U | byte(2);
        for (unsigned digit = 0; digit < 4; ++digit)
            text += i + digit <= bytes.size() ? kDigits[bits >> (18U - 6U * digit) & 63U] : '=';
    }
    return text;
}

std::string png_data_uri(const std::vector<std::uint8_t>& rgb, ImageSize size)
{
    std::vector<std::uint8_t> png;
    const auto append = [](void* to, void* bytes, int count) {
        const auto* first = static_cast<const std::uint8_t*>(bytes);
        static_cast<std::vector<std::uint8_t>*>(to)->insert(
            static_cast<std::vector<std::uint8_t>*>(to)->end(), first, first + count);
    };
    if (stbi_write_png_to_func(append, &png, size.width, size.height, 3, rgb.data(), 3 * size.width)
        == 0)
        throw std::runtime_error("a picture cannot be encoded as PNG");
    return "data:image/png;base64," + base64(png);
}

}  // namespace farlight::client
