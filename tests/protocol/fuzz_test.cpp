// Seeded random damage to valid bytes: decoders answer with a value or an error, whatever comes.
#include "protocol/frame_header.h"
#include "tests/protocol/document.h"

#include <cstring>
#include <gtest/gtest.h>
#include <random>

namespace farlight {
namespace {

using namespace protocol;

constexpr int kMutations = 100'000;

/// Overwrites, inserts, deletes or repeats a few bytes.
void damage(std::string& bytes, std::mt19937& random)
{
    constexpr std::string_view kSpecial = "{}[]\",:\\0-.eEnt\x80\xFF";
    for (unsigned count = 1 + random() % 4; count > 0 && !bytes.empty(); --count) {
        const std::size_t at = random() % bytes.size();
        const char byte =
            random() % 2 == 0 ? static_cast<char>(random()) : kSpecial[random() % kSpecial.size()];
        switch (random() % 4) {
        case 0: bytes[at] = byte; break;
        case 1: bytes.insert(at, 1 + random() % 3, byte); break;
        case 2: bytes.erase(at, 1 + random() % 8); break;
        default: bytes.insert(at, bytes.substr(random() % bytes.size(), random() % 16)); break;
        }
    }
}

TEST(Fuzz, DamagedMessagesAreDecodedOrRefused)
{
    const ProtocolDocument page = read_protocol_document();
    std::vector<std::string> seeds = page.examples.at("json client");
    for (const std::string& text : page.examples.at("json server"))
        seeds.push_back(text);

    std::mt19937 random(1);
    int accepted = 0;
    int refused = 0;
    for (int i = 0; i < kMutations; ++i) {
        std::string text = seeds[random() % seeds.size()];
        damage(text, random);
        const auto client = decode_client_message(text);
        const auto server = decode_server_message(text);
        const auto* message = std::get_if<ClientMessage>(&client);
        (message != nullptr || std::holds_alternative<ServerMessage>(server) ? accepted
                                                                             : refused)++;
        if (message == nullptr)
            continue;
        // What is accepted can be said again.
        ASSERT_EQ(std::get<ClientMessage>(decode_client_message(encode(*message))), *message)
            << text;
    }
    EXPECT_GT(accepted, kMutations / 100);
    EXPECT_GT(refused, kMutations / 100);
}

TEST(Fuzz, DamagedFramesAreDecodedOrRefused)
{
    FrameHeader header{.payload_size = 6, .width = 2, .height = 1};
    header.passes = {{"gbuffer", 1}, {"path_trace", 2}, {"svgf a-trous 0", 3}};
    const std::vector<std::byte> head = encode_frame_header(header);
    std::string seed(head.size() + header.payload_size, 'x');
    std::memcpy(seed.data(), head.data(), head.size());

    std::mt19937 random(2);
    int accepted = 0;
    for (int i = 0; i < kMutations; ++i) {
        std::string bytes = seed;
        damage(bytes, random);
        const auto decoded = decode_frame(std::as_bytes(std::span(bytes)));
        if (const auto* frame = std::get_if<FrameView>(&decoded)) {
            ++accepted;
            ASSERT_LE(frame->payload.data() + frame->payload.size(),
                std::as_bytes(std::span(bytes)).data() + bytes.size());
        }
    }
    EXPECT_GT(accepted, kMutations / 100);
}

}  // namespace
}  // namespace farlight
