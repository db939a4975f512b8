// Picture files. PFM is written here; the rest by stb, libjpeg-turbo (through decode) and tinyexr.
#include "client/picture_file.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <memory>
#include <sstream>
#include <stb/stb_image.h>
#include <stb/stb_image_write.h>
#include <tinyexr.h>

namespace farlight::client {
namespace {

using Path = std::filesystem::path;

constexpr int kChannels = 3;
constexpr int kJpegQuality = 95;

[[noreturn]] void fail(const Path& file, const std::string& problem)
{
    throw PictureError(file.string() + ": " + problem);
}

std::string extension_of(const Path& file)
{
    std::string extension = file.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
        [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension;
}

/// Portable float map: rows bottom up; a negative scale says little-endian.
void write_pfm(const Path& file, const Picture& picture)
{
    std::ostringstream text;
    text << "PF\n" << picture.width << " " << picture.height << "\n-1.0\n";
    const std::string head = text.str();
    const std::size_t row = static_cast<std::size_t>(picture.width) * kChannels;
    std::vector<std::byte> bytes(head.size() + picture.linear.size() * sizeof(float));
    std::memcpy(bytes.data(), head.data(), head.size());
    for (int y = 0; y < picture.height; ++y)
        std::memcpy(bytes.data() + head.size() + y * row * sizeof(float),
            picture.linear.data() + (picture.height - 1 - y) * row, row * sizeof(float));
    write_bytes(file, bytes);
}

Picture read_pfm(const Path& file)
{
    std::ifstream stream(file, std::ios::binary);
    std::string magic;
    Picture picture;
    double scale = 0;
    if (!stream)
        fail(file, "cannot be read");
    if (!(stream >> magic >> picture.width >> picture.height >> scale) || magic != "PF"
        || picture.width < 1 || picture.width > 65535 || picture.height < 1
        || picture.height > 65535)
        fail(file, "is not a colour PFM file");
    if (!(scale < 0))
        fail(file, "is big-endian, expected a negative scale");
    stream.get();  // the one white space that ends the head
    const std::size_t row = static_cast<std::size_t>(picture.width) * kChannels;
    picture.linear.resize(row * picture.height);
    for (int y = picture.height - 1; y >= 0; --y)
        stream.read(reinterpret_cast<char*>(picture.linear.data() + y * row),
            static_cast<std::streamsize>(row * sizeof(float)));
    if (!stream)
        fail(file, "ends early");
    return picture;
}

void write_exr(const Path& file, const Picture& picture)
{
    constexpr int kFloat32 = 0;
    const char* message = nullptr;
    if (SaveEXR(picture.linear.data(), picture.width, picture.height, kChannels, kFloat32,
            file.c_str(), &message)
        != TINYEXR_SUCCESS) {
        const std::string problem = message != nullptr ? message : "cannot be written";
        FreeEXRErrorMessage(message);
        fail(file, problem);
    }
}

Picture read_exr(const Path& file)
{
    float* rgba = nullptr;
    const char* message = nullptr;
    Picture picture;
    if (LoadEXR(&rgba, &picture.width, &picture.height, file.c_str(), &message)
        != TINYEXR_SUCCESS) {
        const std::string problem = message != nullptr ? message : "cannot be read";
        FreeEXRErrorMessage(message);
        fail(file, problem);
    }
    const std::unique_ptr<float, void (*)(void*)> owner(rgba, &std::free);
    const std::size_t pixels = static_cast<std::size_t>(picture.width) * picture.height;
    picture.linear.resize(pixels * kChannels);
    for (std::size_t i = 0; i < pixels; ++i)
        std::copy_n(
            rgba + i * 4, kChannels, picture.linear.begin() + static_cast<long>(i * kChannels));
    return picture;
}

Picture read_display(const Path& file)
{
    Picture picture;
    int channels = 0;
    const std::unique_ptr<stbi_uc, void (*)(void*)> pixels(
        stbi_load(file.c_str(), &picture.width, &picture.height, &channels, kChannels),
        &stbi_image_free);
    if (!pixels)
        fail(file, stbi_failure_reason());
    picture.display.assign(pixels.get(),
        pixels.get() + static_cast<std::size_t>(picture.width) * picture.height * kChannels);
    return picture;
}

}  // namespace

void write_picture(const Path& file, const Picture& picture)
{
    const std::string extension = extension_of(file);
    const bool linear = extension == ".pfm" || extension == ".exr";
    if (!linear && extension != ".png" && extension != ".jpg")
        fail(file, "found extension '" + extension + "', expected .png, .jpg, .pfm or .exr");
    if ((linear ? picture.linear.empty() : picture.display.empty()))
        fail(file,
            linear ? "holds linear radiance, found display values"
                   : "holds display values, found linear radiance");
    if (extension == ".pfm")
        return write_pfm(file, picture);
    if (extension == ".exr")
        return write_exr(file, picture);
    const int written = extension == ".png"
        ? stbi_write_png(file.c_str(), picture.width, picture.height, kChannels,
            picture.display.data(), picture.width * kChannels)
        : stbi_write_jpg(file.c_str(), picture.width, picture.height, kChannels,
            picture.display.data(), kJpegQuality);
    if (written == 0)
        fail(file, "cannot be written");
}

Picture read_picture(const Path& file)
{
    const std::string extension = extension_of(file);
    if (extension == ".pfm")
        return read_pfm(file);
    if (extension == ".exr")
        return read_exr(file);
    if (extension == ".png" || extension == ".jpg")
        return read_display(file);
    fail(file, "found extension '" + extension + "', expected .png, .jpg, .pfm or .exr");
}

void write_bytes(const Path& file, std::span<const std::byte> bytes)
{
    std::ofstream stream(file, std::ios::binary);
    stream.write(
        reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    stream.close();
    if (!stream)
        fail(file, "cannot be written");
}

}  // namespace farlight::client
