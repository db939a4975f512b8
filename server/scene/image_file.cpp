// Decoding, with limits checked before anything is allocated.
#include "server/scene/image_file.h"

#include "server/scene/hdr_check.h"
#include "server/scene/json_text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <optional>
#include <stb/stb_image.h>
#include <string_view>
#include <tinyexr.h>
#include <vector>

namespace farlight {

namespace {

/// As in a scene file: the square is still a finite float.
constexpr float kLargestRadiance = 1e18F;

/// A deflated PNG of one bit a texel packs the most: 8 * 1032 texels into a byte (RFC 1951).
constexpr std::int64_t kMostTexelsAByte = 8256;

constexpr std::array<unsigned char, 4> kExrMagic{0x76, 0x2f, 0x31, 0x01};

struct Size {
    int width = 0;
    int height = 0;
};

/// Both ends included; clamped, for a broken file may say anything.
int extent(int first, int last)
{
    const auto size = std::int64_t{last} - first + 1;
    return static_cast<int>(std::clamp<std::int64_t>(size, 0, std::numeric_limits<int>::max()));
}

/// Bytes of a picture, or of a whole file of pictures.
struct Encoded {
    const unsigned char* bytes;
    int length;
};

Encoded encoded(std::span<const unsigned char> bytes, const ScenePlace& place)
{
    if (bytes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max()))
        refuse(place, std::to_string(bytes.size()) + " bytes", "a picture of less than 2 GiB");
    return {bytes.data(), static_cast<int>(bytes.size())};
}

void check_size(const Size& size, const ScenePlace& place)
{
    if (size.width < 1 || size.height < 1 || size.width > kLargestImageSide
        || size.height > kLargestImageSide)
        refuse(place,
            "a picture of " + std::to_string(size.width) + " x " + std::to_string(size.height),
            "at least 1 and at most " + std::to_string(kLargestImageSide) + " texels a side");
}

/// The size that a PNG states, for stb has no size to tell of very large ones. PNG specification,
/// 11.2.2 IHDR.
std::optional<Size> png_size(const Encoded& picture)
{
    constexpr std::string_view kStart("\x89PNG\r\n\x1a\n\0\0\0\x0dIHDR", 16);
    const std::string_view bytes(
        reinterpret_cast<const char*>(picture.bytes), static_cast<std::size_t>(picture.length));
    if (bytes.size() < kStart.size() + 8 || !bytes.starts_with(kStart))
        return std::nullopt;
    const auto big_endian = [&](std::size_t at) {
        std::uint32_t value = 0;
        for (std::size_t i = 0; i < 4; ++i)
            value = value << 8 | picture.bytes[at + i];
        return static_cast<int>(std::min(value, 0x7fffffffU));
    };
    return Size{big_endian(kStart.size()), big_endian(kStart.size() + 4)};
}

Size stb_size(const Encoded& picture, const ScenePlace& place, const char* expected)
{
    if (const std::optional<Size> stated = png_size(picture))
        check_size(*stated, place);
    Size size;
    int channels = 0;
    if (stbi_info_from_memory(picture.bytes, picture.length, &size.width, &size.height, &channels)
        == 0)
        refuse(place, std::string("no picture: ") + stbi_failure_reason(), expected);
    check_size(size, place);
    if (std::int64_t{size.width} * size.height > picture.length * kMostTexelsAByte)
        refuse(place,
            "a picture of " + std::to_string(size.width) + " x " + std::to_string(size.height)
                + " in " + std::to_string(picture.length) + " bytes",
            "bytes for all of it");
    return size;
}

/// r, g, b of texels that lie `stride` floats apart.
EnvironmentFile repaired(const float* texels, int stride, const Size& size)
{
    EnvironmentFile file;
    file.map.width = static_cast<std::uint32_t>(size.width);
    file.map.height = static_cast<std::uint32_t>(size.height);
    file.map.texels.resize(std::size_t{file.map.width} * file.map.height);
    for (std::size_t i = 0; i < file.map.texels.size(); ++i) {
        bool repaired = false;
        for (int channel = 0; channel < 3; ++channel) {
            const float found =
                texels[i * static_cast<std::size_t>(stride) + static_cast<std::size_t>(channel)];
            const bool usable = found >= 0 && found <= kLargestRadiance;  // false for NaN
            const bool bright = std::isfinite(found) && found > kLargestRadiance;
            file.map.texels[i][channel] = usable ? found : bright ? kLargestRadiance : 0;
            repaired = repaired || !usable;
        }
        file.repaired_texels += repaired ? 1 : 0;
    }
    return file;
}

EnvironmentFile read_hdr(const Encoded& picture, const ScenePlace& place)
{
    Size size = stb_size(picture, place, "a Radiance HDR picture");
    const std::span<const unsigned char> bytes(
        picture.bytes, static_cast<std::size_t>(picture.length));
    if (!hdr_is_complete(bytes, size.width, size.height))
        refuse(place, "a picture that breaks off", "a Radiance HDR picture");
    int channels = 0;
    const std::unique_ptr<float, void (*)(void*)> texels(
        stbi_loadf_from_memory(
            picture.bytes, picture.length, &size.width, &size.height, &channels, 3),
        stbi_image_free);
    if (!texels)
        refuse(place, std::string("a broken picture: ") + stbi_failure_reason(),
            "a Radiance HDR picture");
    return repaired(texels.get(), 3, size);
}

/// Frees what tinyexr keeps, whether it succeeds or not; its LoadEXRFromMemory() does not.
struct ExrFile {
    ExrFile()
    {
        InitEXRHeader(&header);
        InitEXRImage(&image);
    }
    ~ExrFile()
    {
        FreeEXRImage(&image);
        FreeEXRHeader(&header);
    }
    ExrFile(const ExrFile&) = delete;
    ExrFile& operator=(const ExrFile&) = delete;

    EXRVersion version{};
    EXRHeader header{};
    EXRImage image{};
};

/// Where channel R, G or B lies among the file's; a lone channel stands for all three.
int exr_channel(const EXRHeader& header, char name, const ScenePlace& place)
{
    for (int i = 0; i < header.num_channels; ++i)
        if (header.num_channels == 1
            || std::string_view(header.channels[i].name) == std::string_view(&name, 1))
            return i;
    refuse(place, std::string("no channel ") + name, "an OpenEXR picture with channels R, G, B");
}

/// r, g, b of all texels, in rows.
std::vector<float> exr_texels(const ExrFile& file, const Size& size, const ScenePlace& place)
{
    std::vector<float> texels(std::size_t{3} * static_cast<std::size_t>(size.width)
        * static_cast<std::size_t>(size.height));
    const auto copy = [&](unsigned char** planes, const Size& from, const Size& stride, int x,
                          int y) {
        for (int channel = 0; channel < 3; ++channel) {
            const int plane = exr_channel(file.header, "RGB"[channel], place);
            const auto* samples = reinterpret_cast<const float*>(planes[plane]);
            for (int j = 0; j < from.height && y + j < size.height; ++j)
                for (int i = 0; i < from.width && x + i < size.width; ++i)
                    texels[3
                            * (static_cast<std::size_t>(y + j)
                                    * static_cast<std::size_t>(size.width)
                                + static_cast<std::size_t>(x + i))
                        + static_cast<std::size_t>(channel)] =
                        samples[static_cast<std::size_t>(j) * static_cast<std::size_t>(stride.width)
                            + static_cast<std::size_t>(i)];
        }
    };
    if (file.image.images != nullptr)
        copy(file.image.images, size, size, 0, 0);
    const Size tile{file.header.tile_size_x, file.header.tile_size_y};
    for (int i = 0; i < file.image.num_tiles; ++i) {
        const EXRTile& at = file.image.tiles[i];
        if (at.level_x == 0 && at.level_y == 0)
            copy(at.images, {at.width, at.height}, tile, at.offset_x * tile.width,
                at.offset_y * tile.height);
    }
    return texels;
}

EnvironmentFile read_exr(const Encoded& picture, const ScenePlace& place)
{
    const auto length = static_cast<std::size_t>(picture.length);
    ExrFile file;
    const char* error = nullptr;
    const auto check = [&](int result) {
        if (result == TINYEXR_SUCCESS)
            return;
        const std::string reason = error != nullptr ? error : "unknown reason";
        FreeEXRErrorMessage(error);
        refuse(place, "a broken picture: " + reason, "an OpenEXR picture with channels R, G, B");
    };
    EXRHeader& header = file.header;
    check(ParseEXRVersionFromMemory(&file.version, picture.bytes, length));
    check(ParseEXRHeaderFromMemory(&header, &file.version, picture.bytes, length, &error));
    const Size size{extent(header.data_window.min_x, header.data_window.max_x),
        extent(header.data_window.min_y, header.data_window.max_y)};
    check_size(size, place);
    for (int i = 0; i < header.num_channels; ++i) {
        if (header.pixel_types[i] == TINYEXR_PIXELTYPE_UINT)
            refuse(place, "channels of integers", "channels of half or float numbers");
        header.requested_pixel_types[i] = TINYEXR_PIXELTYPE_FLOAT;
    }
    check(LoadEXRImageFromMemory(&file.image, &header, picture.bytes, length, &error));
    return repaired(exr_texels(file, size, place).data(), 3, size);
}

std::span<const unsigned char> bytes_of(const std::string& text)
{
    return {reinterpret_cast<const unsigned char*>(text.data()), text.size()};
}

}  // namespace

Image8 decode_image(std::span<const unsigned char> bytes, const ScenePlace& place)
{
    constexpr const char* kExpected = "a PNG or JPEG picture";
    const Encoded picture = encoded(bytes, place);
    Size size = stb_size(picture, place, kExpected);
    int channels = 0;
    const std::unique_ptr<stbi_uc, void (*)(void*)> texels(
        stbi_load_from_memory(
            picture.bytes, picture.length, &size.width, &size.height, &channels, 4),
        stbi_image_free);
    if (!texels)
        refuse(place, std::string("a broken picture: ") + stbi_failure_reason(), kExpected);
    Image8 image;
    image.width = static_cast<std::uint32_t>(size.width);
    image.height = static_cast<std::uint32_t>(size.height);
    image.texels.resize(std::size_t{image.width} * image.height);
    std::memcpy(image.texels.data(), texels.get(), image.texels.size() * sizeof(glm::u8vec4));
    return image;
}

Image8 read_image(const std::filesystem::path& file)
{
    Image8 image = decode_image(bytes_of(read_file(file, "a picture")), {file.string(), {}});
    image.name = file.filename().string();
    return image;
}

EnvironmentFile read_environment_map(const std::filesystem::path& file)
{
    const std::string text = read_file(file, "a picture");
    const ScenePlace place{file.string(), {}};
    const Encoded picture = encoded(bytes_of(text), place);
    const bool exr = text.size() >= kExrMagic.size()
        && std::memcmp(text.data(), kExrMagic.data(), kExrMagic.size()) == 0;
    if (!exr && stbi_is_hdr_from_memory(picture.bytes, picture.length) == 0)
        refuse(place, "neither of the two", "a Radiance HDR (.hdr) or OpenEXR (.exr) picture");
    EnvironmentFile environment = exr ? read_exr(picture, place) : read_hdr(picture, place);
    environment.map.file = file.string();
    return environment;
}

}  // namespace farlight
