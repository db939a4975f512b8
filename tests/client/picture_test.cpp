// Pictures survive their files, and payloads that are not what they say are refused.
#include "client/picture_file.h"

#include <cstring>
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <iterator>

namespace farlight {
namespace {

using namespace client;
using protocol::Format;
using protocol::FrameHeader;

/// A fresh folder that goes with the test.
class PictureTest : public testing::Test {
protected:
    PictureTest() { std::filesystem::create_directories(folder_); }
    ~PictureTest() override { std::filesystem::remove_all(folder_); }

    std::filesystem::path file(const std::string& name) const { return folder_ / name; }

private:
    std::filesystem::path folder_ = std::filesystem::path(testing::TempDir())
        / ("farlight_picture_" + std::to_string(::getpid()));
};

/// No two values alike, so that a swapped row, column or channel shows.
Picture linear_picture()
{
    Picture picture{.width = 5, .height = 3, .linear = {}, .display = {}};
    for (int i = 0; i < 5 * 3 * 3; ++i)
        picture.linear.push_back(static_cast<float>(i) * 1.25F - 3);
    picture.linear[7] = 1e30F;
    return picture;
}

Picture display_picture()
{
    Picture picture{.width = 5, .height = 3, .linear = {}, .display = {}};
    for (int i = 0; i < 5 * 3 * 3; ++i)
        picture.display.push_back(static_cast<std::uint8_t>(i * 5));
    return picture;
}

TEST_F(PictureTest, LinearFilesKeepEveryBit)
{
    for (const char* name : {"p.pfm", "p.exr"}) {
        write_picture(file(name), linear_picture());
        const Picture back = read_picture(file(name));
        EXPECT_EQ(back.width, 5);
        EXPECT_EQ(back.height, 3);
        EXPECT_EQ(back.linear, linear_picture().linear) << name;
    }
}

TEST_F(PictureTest, PfmStoresTheBottomRowFirst)
{
    write_picture(file("p.pfm"), linear_picture());
    std::ifstream stream(file("p.pfm"), std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
    const std::string head = "PF\n5 3\n-1.0\n";
    ASSERT_EQ(bytes.substr(0, head.size()), head);
    float first = 0;
    std::memcpy(&first, bytes.data() + head.size(), sizeof first);
    EXPECT_EQ(first, linear_picture().linear[std::size_t{2} * 5 * 3]);
}

TEST_F(PictureTest, PngKeepsEveryByteAndJpegTheLook)
{
    write_picture(file("p.png"), display_picture());
    EXPECT_EQ(read_picture(file("p.png")).display, display_picture().display);

    Picture gray{.width = 16,
        .height = 8,
        .linear = {},
        .display = std::vector<std::uint8_t>(std::size_t{16} * 8 * 3, 90)};
    write_picture(file("p.jpg"), gray);
    for (const int value : read_picture(file("p.jpg")).display)
        EXPECT_NEAR(value, 90, 2);
}

TEST_F(PictureTest, WrongKindsAndPlacesAreErrorsThatNameTheFile)
{
    EXPECT_THROW(write_picture(file("p.png"), linear_picture()), PictureError);
    EXPECT_THROW(write_picture(file("p.exr"), display_picture()), PictureError);
    EXPECT_THROW(write_picture(file("p.gif"), display_picture()), PictureError);
    EXPECT_THROW(write_picture(file("none/p.pfm"), linear_picture()), PictureError);
    EXPECT_THROW(write_picture(file("none/p.png"), display_picture()), PictureError);
    for (const char* name : {"no.pfm", "no.exr", "no.png", "no.jpg"})
        EXPECT_THROW(read_picture(file(name)), PictureError) << name;
    write_bytes(file("bad.pfm"), std::as_bytes(std::span("PF\n5 3\n-1.0\nshort")));
    EXPECT_THROW(read_picture(file("bad.pfm")), PictureError);
}

TEST_F(PictureTest, PayloadsDecodeToThePixelsTheyEncode)
{
    write_picture(file("p.png"), display_picture());
    std::ifstream stream(file("p.png"), std::ios::binary);
    const std::string png{std::istreambuf_iterator<char>(stream), {}};
    const FrameHeader header{.format = Format::kPng, .width = 5, .height = 3};
    const Picture decoded = decode_picture(header, std::as_bytes(std::span(png)));
    EXPECT_EQ(decoded.display, display_picture().display);
    EXPECT_EQ(hash_pixels(decoded), hash_pixels(display_picture()));

    const Picture linear = linear_picture();
    const Picture raw = decode_picture(
        {.format = Format::kRaw, .width = 5, .height = 3}, std::as_bytes(std::span(linear.linear)));
    EXPECT_EQ(raw.linear, linear.linear);
}

TEST_F(PictureTest, BrokenPayloadsAreRefused)
{
    write_picture(file("p.png"), display_picture());
    std::ifstream stream(file("p.png"), std::ios::binary);
    const std::string png{std::istreambuf_iterator<char>(stream), {}};
    const auto bytes = std::as_bytes(std::span(png));
    const std::vector<std::byte> noise(100, std::byte{0x5A});
    for (const Format format : {Format::kJpeg420, Format::kJpeg444, Format::kPng, Format::kRaw}) {
        const FrameHeader header{.format = format, .width = 5, .height = 3};
        EXPECT_THROW(decode_picture(header, noise), PictureError) << name_of(format);
        EXPECT_THROW(decode_picture(header, {}), PictureError) << name_of(format);
    }
    EXPECT_THROW(
        decode_picture({.format = Format::kPng, .width = 3, .height = 5}, bytes), PictureError);
    EXPECT_THROW(decode_picture({.format = Format::kPng, .width = 5, .height = 3}, bytes.first(40)),
        PictureError);
}

}  // namespace
}  // namespace farlight
