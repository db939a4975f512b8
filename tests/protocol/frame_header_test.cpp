// The binary frame: the page's worked example, round trips, and what is refused.
#include "protocol/frame_header.h"
#include "tests/protocol/document.h"

#include <cstring>
#include <gmock/gmock.h>
#include <sstream>
#include <xxhash.h>

namespace farlight {
namespace {

using namespace protocol;
using Bytes = std::vector<std::byte>;

/// The page's hex dump as bytes.
Bytes example_frame()
{
    Bytes bytes;
    std::istringstream lines(read_protocol_document().examples.at("hex frame").at(0));
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line.substr(4));
        for (std::string word; words >> word;)
            bytes.push_back(static_cast<std::byte>(std::stoul(word, nullptr, 16)));
    }
    return bytes;
}

/// Field values by name.
std::map<std::string, double> values_of(FrameHeader header)
{
    std::map<std::string, double> values;
    FrameHeader::each_field(header, [&](std::size_t, std::string_view name, auto member) {
        values[std::string(name)] = static_cast<double>(member);
    });
    return values;
}

TEST(FrameHeader, PageExampleReadsAsThePageSays)
{
    const Bytes bytes = example_frame();
    const auto decoded = decode_frame(bytes);
    const auto* frame = std::get_if<FrameView>(&decoded);
    ASSERT_NE(frame, nullptr) << to_string(*std::get_if<DecodeError>(&decoded));

    const FrameHeader& header = frame->header;
    EXPECT_EQ(header.format, Format::kRaw);
    EXPECT_EQ(header.flags, frame_flags::kLossless | frame_flags::kHistoryReset);
    EXPECT_EQ(header.frame_id, 7U);
    EXPECT_EQ(header.camera_sequence, 41U);
    EXPECT_EQ(header.session_epoch, 1U);
    EXPECT_EQ(header.accumulated_samples, 1U);
    EXPECT_EQ(header.predicted_error, 0.25F);
    EXPECT_EQ(header.predicted_upper, 0.5F);
    EXPECT_TRUE(std::isnan(header.measured_error));
    EXPECT_EQ(header.effective_samples, 2);
    EXPECT_EQ(header.frame_us, 23000U);
    EXPECT_EQ(header.samples_per_pixel, 1U);
    EXPECT_EQ(header.noise_error, 0.0625F);
    EXPECT_EQ(header.wait_us, 850U);
    EXPECT_EQ(header.trace_us, 13750U);
    EXPECT_EQ(header.denoise_us, 9000U);
    EXPECT_EQ(header.encode_us, 40U);
    EXPECT_EQ(header.framebuffer_hash, 0x5bcc63c641b2222dU);
    EXPECT_THAT(header.passes,
        testing::ElementsAre(PassEntry{"gbuffer", 1.5F}, PassEntry{"path_trace", 12.25F}));

    const std::vector<float> pixels{1, 0.5F, 0.25F, 0, 2, 4};
    ASSERT_EQ(frame->payload.size(), pixels.size() * sizeof(float));
    EXPECT_EQ(std::memcmp(frame->payload.data(), pixels.data(), frame->payload.size()), 0);
    EXPECT_EQ(XXH64(frame->payload.data(), frame->payload.size(), 0), header.framebuffer_hash);
}

TEST(FrameHeader, PageExampleIsWhatTheEncoderWrites)
{
    const Bytes bytes = example_frame();
    const auto decoded = decode_frame(bytes);
    const auto& frame = std::get<FrameView>(decoded);
    Bytes written = encode_frame_header(frame.header);
    written.insert(written.end(), frame.payload.begin(), frame.payload.end());
    EXPECT_EQ(written, bytes);
}

TEST(FrameHeader, EveryFieldKeepsItsGreatestValue)
{
    FrameHeader header;
    FrameHeader::each_field(header, [](std::size_t, std::string_view, auto& member) {
        using Member = std::remove_cvref_t<decltype(member)>;
        if constexpr (!std::is_enum_v<Member>)
            member = std::numeric_limits<Member>::max();
    });
    header.payload_size = 3;
    header.format = Format::kPng;
    Bytes bytes = encode_frame_header(header);
    bytes.resize(bytes.size() + header.payload_size);

    const auto decoded = decode_frame(bytes);
    const auto* frame = std::get_if<FrameView>(&decoded);
    ASSERT_NE(frame, nullptr);
    EXPECT_EQ(values_of(frame->header), values_of(header));
}

TEST(FrameHeader, LongPassNamesAreCutAtACharacter)
{
    FrameHeader header;
    header.passes.push_back({std::string(kMaxPassNameBytes - 1, 'a') + "\xC3\xA9", 1});
    const Bytes bytes = encode_frame_header(header);
    const auto decoded = decode_frame(bytes);
    const auto* frame = std::get_if<FrameView>(&decoded);
    ASSERT_NE(frame, nullptr);
    EXPECT_EQ(frame->header.passes.at(0).name, std::string(kMaxPassNameBytes - 1, 'a'));
}

TEST(FrameHeader, BytesOfALongerHeaderAreSkipped)
{
    Bytes bytes = example_frame();
    bytes[6] = std::byte{kFrameHeaderSize + 8};
    bytes.insert(bytes.begin() + kFrameHeaderSize, 8, std::byte{0xEE});
    const auto decoded = decode_frame(bytes);
    const auto* frame = std::get_if<FrameView>(&decoded);
    ASSERT_NE(frame, nullptr);
    EXPECT_EQ(frame->header.passes.at(1).name, "path_trace");
    EXPECT_EQ(frame->payload.size(), 24U);
}

TEST(FrameHeader, FieldsBeyondAnOlderHeaderAreUnknown)
{
    Bytes bytes = example_frame();
    bytes[6] = std::byte{kSmallestFrameHeaderSize};
    bytes.erase(bytes.begin() + kSmallestFrameHeaderSize, bytes.begin() + kFrameHeaderSize);
    const auto decoded = decode_frame(bytes);
    const auto* frame = std::get_if<FrameView>(&decoded);
    ASSERT_NE(frame, nullptr);
    EXPECT_TRUE(std::isnan(frame->header.raw_error));
    EXPECT_EQ(frame->header.frame_us, 0U);
    EXPECT_EQ(frame->header.passes.at(1).name, "path_trace");
}

TEST(FrameHeader, StagesThatMetBadValuesLieBetweenHeaderAndPasses)
{
    FrameHeader header;
    header.stages = {{"fog", 1, 2, 3, 0xffffffffU}, {std::string(300, 'x'), 0, 0, 0, 4}};
    header.passes = {{"gbuffer", 1.5F}};
    Bytes bytes = encode_frame_header(header);
    const auto decoded = decode_frame(bytes);
    const auto* frame = std::get_if<FrameView>(&decoded);
    ASSERT_NE(frame, nullptr);
    header.stages[1].name.resize(kMaxPassNameBytes);
    EXPECT_EQ(frame->header.stages, header.stages);
    EXPECT_EQ(frame->header.passes, header.passes);

    const auto refused_field = [&](std::size_t at, int value) {
        Bytes bad = bytes;
        bad.at(at) = static_cast<std::byte>(value);
        const auto refused = decode_frame(bad);
        const auto* error = std::get_if<DecodeError>(&refused);
        return error != nullptr ? error->field : "";
    };
    EXPECT_EQ(refused_field(132, 3), "stages") << "a third one";
    EXPECT_EQ(refused_field(133, 2), "stage_count") << "more than 256";
    EXPECT_EQ(refused_field(kFrameHeaderSize, 255), "stages")
        << "a name beyond the second's counts";
}

struct BadFrame {
    const char* name;
    std::size_t at;
    int value;
    const char* field;
};
class FrameRefuses : public testing::TestWithParam<BadFrame> { };

TEST_P(FrameRefuses, NamingTheField)
{
    Bytes bytes = example_frame();
    bytes.at(GetParam().at) = static_cast<std::byte>(GetParam().value);
    const auto decoded = decode_frame(bytes);
    const auto* error = std::get_if<DecodeError>(&decoded);
    ASSERT_NE(error, nullptr);
    EXPECT_EQ(error->field, GetParam().field);
}

INSTANTIATE_TEST_SUITE_P(Frames, FrameRefuses,
    testing::Values(BadFrame{"Magic", 0, 'f', "magic"}, BadFrame{"Version", 4, 2, "version"},
        BadFrame{"Format", 5, 4, "format"}, BadFrame{"ShortHeader", 6, 72, "header_size"},
        BadFrame{"OddHeader", 6, 81, "header_size"}, BadFrame{"LongHeader", 7, 9, "header_size"},
        BadFrame{"OddTable", 12, 33, "passes_size"}, BadFrame{"LongTable", 15, 255, "passes_size"},
        BadFrame{"PassCount", 10, 4, "passes"}, BadFrame{"ManyPasses", 11, 2, "pass_count"},
        BadFrame{"PassName", kFrameHeaderSize, 200, "passes"},
        BadFrame{"Payload", 28, 25, "payload_size"}),
    [](const auto& tested) { return tested.param.name; });

TEST(FrameHeader, EveryTruncationIsRefused)
{
    const Bytes bytes = example_frame();
    for (std::size_t size = 0; size < bytes.size(); ++size) {
        const auto decoded = decode_frame(std::span(bytes).first(size));
        EXPECT_TRUE(std::holds_alternative<DecodeError>(decoded)) << size;
    }
}

}  // namespace
}  // namespace farlight
