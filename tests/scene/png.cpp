// Layout: ISO/IEC 15948, "Portable Network Graphics".
#include "tests/scene/png.h"

#include <string_view>
#include <zlib.h>

namespace farlight {

namespace {

std::string big_endian(std::uint32_t value)
{
    std::string bytes;
    for (int shift = 24; shift >= 0; shift -= 8)
        bytes += static_cast<char>((value >> static_cast<unsigned>(shift)) & 255U);
    return bytes;
}

std::string chunk(std::string_view type, std::string_view content)
{
    const std::string body = std::string(type).append(content);
    const auto crc =
        crc32(0, reinterpret_cast<const Bytef*>(body.data()), static_cast<uInt>(body.size()));
    return big_endian(static_cast<std::uint32_t>(content.size())) + body
        + big_endian(static_cast<std::uint32_t>(crc));
}

std::string png(std::uint32_t width, std::uint32_t height, char bits, std::string_view rows)
{
    const std::size_t row = rows.size() / height;
    std::string filtered;
    for (std::uint32_t y = 0; y < height; ++y)
        filtered.append(1, '\0').append(rows.substr(y * row, row));  // filter 0: as it is
    uLongf size = compressBound(filtered.size());
    std::string packed(size, '\0');
    compress(reinterpret_cast<Bytef*>(packed.data()), &size,
        reinterpret_cast<const Bytef*>(filtered.data()), filtered.size());
    packed.resize(size);
    constexpr char kRgba = 6;
    return "\x89PNG\r\n\x1a\n"
        + chunk("IHDR",
            big_endian(width) + big_endian(height) + std::string{bits, kRgba, '\0', '\0', '\0'})
        + chunk("IDAT", packed) + chunk("IEND", "");
}

}  // namespace

std::string png8(std::uint32_t width, std::uint32_t height, const std::vector<std::uint8_t>& rgba)
{
    return png(width, height, 8, std::string(rgba.begin(), rgba.end()));
}

std::string png16(std::uint32_t width, std::uint32_t height, const std::vector<std::uint16_t>& rgba)
{
    std::string rows;
    for (const std::uint16_t sample : rgba)
        rows.append({static_cast<char>(sample >> 8U), static_cast<char>(sample & 255U)});
    return png(width, height, 16, rows);
}

}  // namespace farlight
