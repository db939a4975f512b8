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
constexpr std::size_t kStageCountAt = 132;
constexpr std::size_t kCountsOfStage = 4 * sizeof(std::uint32_t);
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

std::size_t aligned(std::size_t size)
{
    return (size + kAlignment - 1) / kAlignment * kAlignment;
}

/// Bytes of a table whose entries have `size` bytes after their names.
template <typename Entry>
std::size_t table_size(const std::vector<Entry>& entries, std::size_t size)
{
    std::size_t sum = 0;
    for (const Entry& entry : entries)
        sum += 1 + kept_length(entry.name) + size;
    return aligned(sum);
}

/// Writes a name and its length at `at`, which moves behind it.
void put_name(std::vector<std::byte>& bytes, std::size_t& at, const std::string& name)
{
    const std::size_t length = kept_length(name);
    put(bytes, at++, static_cast<std::uint8_t>(length));
    for (std::size_t i = 0; i < length; ++i)
        bytes[at++] = static_cast<std::byte>(name[i]);
}

/// Entries of `size` bytes after their names, which `read(entry, at)` reads.
template <typename Entry>
Decoded<std::vector<Entry>> decode_table(std::span<const std::byte> table, std::size_t count,
    std::pair<const char*, std::size_t> field_and_size, auto&& read)
{
    const auto [field, size] = field_and_size;
    std::vector<Entry> entries;
    std::size_t at = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t length = at < table.size() ? std::to_integer<std::size_t>(table[at]) : 0;
        if (at + 1 + length + size > table.size())
            return refuse(ErrorCode::kOutOfRange, field, "end inside entry " + std::to_string(i));
        Entry& entry = entries.emplace_back();
        std::transform(table.begin() + static_cast<std::ptrdiff_t>(at + 1),
            table.begin() + static_cast<std::ptrdiff_t>(at + 1 + length),
            std::back_inserter(entry.name), [](std::byte b) { return std::to_integer<char>(b); });
        read(entry, at + 1 + length);
        at += 1 + length + size;
    }
    return entries;
}

Decoded<std::vector<PassEntry>> decode_passes(std::span<const std::byte> table, std::size_t count)
{
    return decode_table<PassEntry>(table, count, {"passes", sizeof(float)},
        [&](PassEntry& pass, std::size_t at) { pass.milliseconds = get<float>(table, at); });
}

/// `header`: all header_size bytes of it.
Decoded<std::vector<StageEntry>> decode_stages(std::span<const std::byte> header)
{
    if (header.size() < kFrameHeaderSize)
        return std::vector<StageEntry>{};
    const std::size_t count = get<std::uint16_t>(header, kStageCountAt);
    if (count > kMaxStages)
        return refuse(ErrorCode::kOutOfRange, "stage_count", "is " + std::to_string(count));
    const std::span<const std::byte> table = header.subspan(kFrameHeaderSize);
    return decode_table<StageEntry>(
        table, count, {"stages", kCountsOfStage}, [&](StageEntry& stage, std::size_t at) {
            StageEntry::each_count(stage, [&](std::uint32_t& value, std::string_view) {
                value = get<std::uint32_t>(table, at);
                at += sizeof value;
            });
        });
}

}  // namespace

std::vector<std::byte> encode_frame_header(const FrameHeader& header)
{
    assert(header.passes.size() <= kMaxPasses);
    assert(header.stages.size() <= kMaxStages);
    const std::size_t header_size = kFrameHeaderSize + table_size(header.stages, kCountsOfStage);
    assert(header_size <= std::numeric_limits<std::uint16_t>::max());
    const std::size_t passes_size = table_size(header.passes, sizeof(float));

    std::vector<std::byte> bytes(header_size + passes_size);
    for (std::size_t i = 0; i < kFrameMagic.size(); ++i)
        bytes[i] = static_cast<std::byte>(kFrameMagic[i]);
    put(bytes, kVersionAt, kFrameVersion);
    put(bytes, kHeaderSizeAt, static_cast<std::uint16_t>(header_size));
    put(bytes, kStageCountAt, static_cast<std::uint16_t>(header.stages.size()));
    put(bytes, kPassCountAt, static_cast<std::uint16_t>(header.passes.size()));
    put(bytes, kPassesSizeAt, static_cast<std::uint32_t>(passes_size));
    FrameHeader::each_field(
        header, [&](std::size_t at, std::string_view, auto value) { put(bytes, at, value); });

    std::size_t at = kFrameHeaderSize;
    for (const StageEntry& stage : header.stages) {
        put_name(bytes, at, stage.name);
        StageEntry::each_count(stage, [&](std::uint32_t value, std::string_view) {
            put(bytes, at, value);
            at += sizeof value;
        });
    }
    at = header_size;
    for (const PassEntry& pass : header.passes) {
        put_name(bytes, at, pass.name);
        put(bytes, at, pass.milliseconds);
        at += sizeof pass.milliseconds;
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

    auto stages = decode_stages(message.first(header_size));
    if (const auto* error = std::get_if<DecodeError>(&stages))
        return *error;
    view.header.stages = std::move(*std::get_if<std::vector<StageEntry>>(&stages));
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
