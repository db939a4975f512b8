// Frame header <-> bytes, little-endian whatever the machine.
#include "protocol/frame_header.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <type_traits>

namespace farlight::protocol {
namespace {

constexpr std::size_t kVersionAt = 4;
constexpr std::size_t kHeaderSizeAt = 6;
constexpr std::size_t kPassCountAt = 10;
constexpr std::size_t kPassesSizeAt = 12;
constexpr std::size_t kAlignment = 8;

template <typename T> void put(std::vector<std::byte>& bytes, std::size_t at, T value)
{
    if constexpr (std::is_same_v<T, float>)
        put(bytes, at, std::bit_cast<std::uint32_t>(value));
    else if constexpr (std::is_enum_v<T>)
        put(bytes, at, static_cast<std::underlying_type_t<T>>(value));
    else
        for (std::size_t i = 0; i < sizeof(T); ++i)
            bytes[at + i] =
                static_cast<std::byte>((static_cast<std::uint64_t>(value) >> (8 * i)) & 0xFFU);
}

/// The caller has checked that sizeof(T) bytes are there.
template <typename T> T get(std::span<const std::byte> bytes, std::size_t at)
{
    if constexpr (std::is_same_v<T, float>) {
        return std::bit_cast<float>(get<std::uint32_t>(bytes, at));
    } else if constexpr (std::is_enum_v<T>) {
        return static_cast<T>(get<std::underlying_type_t<T>>(bytes, at));
    } else {
        std::uint64_t value = 0;
        for (std::size_t i = 0; i < sizeof(T); ++i)
            value |= std::to_integer<std::uint64_t>(bytes[at + i]) << (8 * i);
        return static_cast<T>(value);
    }
}

DecodeError refuse(ErrorCode code, std::string field, std::string problem)
{
    return {code, std::move(field), std::move(problem)};
}

/// Length of a pass name when it is cut at a character boundary to at most kMaxPassNameBytes.
std::size_t kept_length(const std::string& name)
{
    if (name.size() <= kMaxPassNameBytes)
        return name.size();
    std::size_t length = kMaxPassNameBytes;
    while (length > 0 && (static_cast<unsigned char>(name[length]) & 0xC0U) == 0x80U)
        --length;
    return length;
}

Decoded<std::vector<PassEntry>> decode_passes(std::span<const std::byte> table, std::size_t count)
{
    std::vector<PassEntry> passes;
    std::size_t at = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t length = at < table.size() ? std::to_integer<std::size_t>(table[at]) : 0;
        if (at + 1 + length + sizeof(float) > table.size())
            return refuse(ErrorCode::kOutOfRange, "passes", "end inside pass " + std::to_string(i));
        PassEntry& pass = passes.emplace_back();
        std::transform(table.begin() + static_cast<std::ptrdiff_t>(at + 1),
            table.begin() + static_cast<std::ptrdiff_t>(at + 1 + length),
            std::back_inserter(pass.name), [](std::byte b) { return std::to_integer<char>(b); });
        pass.milliseconds = get<float>(table, at + 1 + length);
        at += 1 + length + sizeof(float);
    }
    return passes;
}

}  // namespace

std::vector<std::byte> encode_frame_header(const FrameHeader& header)
{
    assert(header.passes.size() <= kMaxPasses);
    std::size_t passes_size = 0;
    for (const PassEntry& pass : header.passes)
        passes_size += 1 + kept_length(pass.name) + sizeof(float);
    passes_size = (passes_size + kAlignment - 1) / kAlignment * kAlignment;

    std::vector<std::byte> bytes(kFrameHeaderSize + passes_size);
    for (std::size_t i = 0; i < kFrameMagic.size(); ++i)
        bytes[i] = static_cast<std::byte>(kFrameMagic[i]);
    put(bytes, kVersionAt, kFrameVersion);
    put(bytes, kHeaderSizeAt, kFrameHeaderSize);
    put(bytes, kPassCountAt, static_cast<std::uint16_t>(header.passes.size()));
    put(bytes, kPassesSizeAt, static_cast<std::uint32_t>(passes_size));
    FrameHeader::each_field(
        header, [&](std::size_t at, std::string_view, auto value) { put(bytes, at, value); });

    std::size_t at = kFrameHeaderSize;
    for (const PassEntry& pass : header.passes) {
        const std::size_t length = kept_length(pass.name);
        put(bytes, at, static_cast<std::uint8_t>(length));
        for (std::size_t i = 0; i < length; ++i)
            bytes[at + 1 + i] = static_cast<std::byte>(pass.name[i]);
        put(bytes, at + 1 + length, pass.milliseconds);
        at += 1 + length + sizeof(float);
    }
    return bytes;
}

Decoded<FrameView> decode_frame(std::span<const std::byte> message)
{
    if (message.size() < kSmallestFrameHeaderSize)
        return refuse(ErrorCode::kOutOfRange, "",
            "has " + std::to_string(message.size()) + " bytes, expected at least "
                + std::to_string(kSmallestFrameHeaderSize));
    for (std::size_t i = 0; i < kFrameMagic.size(); ++i)
        if (std::to_integer<char>(message[i]) != kFrameMagic[i])
            return refuse(ErrorCode::kWrongType, "magic", "is not FARL");
    const auto version = get<std::uint8_t>(message, kVersionAt);
    if (version != kFrameVersion)
        return refuse(ErrorCode::kOutOfRange, "version",
            "is " + std::to_string(version) + ", expected " + std::to_string(kFrameVersion));

    const std::size_t header_size = get<std::uint16_t>(message, kHeaderSizeAt);
    const std::size_t passes_size = get<std::uint32_t>(message, kPassesSizeAt);
    if (header_size < kSmallestFrameHeaderSize || header_size % kAlignment != 0
        || header_size > message.size())
        return refuse(ErrorCode::kOutOfRange, "header_size", "is " + std::to_string(header_size));
    if (passes_size % kAlignment != 0 || passes_size > message.size() - header_size)
        return refuse(ErrorCode::kOutOfRange, "passes_size", "is " + std::to_string(passes_size));

    FrameView view;
    FrameHeader::each_field(view.header, [&](std::size_t at, std::string_view, auto& member) {
        if (at + sizeof member <= header_size)
            member = get<std::remove_cvref_t<decltype(member)>>(message, at);
    });
    if (static_cast<std::size_t>(view.header.format) >= std::size(kFormatNames))
        return refuse(ErrorCode::kOutOfRange, "format", "is unknown");
    view.payload = message.subspan(header_size + passes_size);
    if (view.payload.size() != view.header.payload_size)
        return refuse(ErrorCode::kOutOfRange, "payload_size",
            "is " + std::to_string(view.header.payload_size) + ", found "
                + std::to_string(view.payload.size()) + " bytes");

    const std::size_t pass_count = get<std::uint16_t>(message, kPassCountAt);
    if (pass_count > kMaxPasses)
        return refuse(ErrorCode::kOutOfRange, "pass_count", "is " + std::to_string(pass_count));
    auto passes = decode_passes(message.subspan(header_size, passes_size), pass_count);
    if (const auto* error = std::get_if<DecodeError>(&passes))
        return *error;
    view.header.passes = std::move(*std::get_if<std::vector<PassEntry>>(&passes));
    return view;
}

}  // namespace farlight::protocol
