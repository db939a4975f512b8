// GLB layout: glTF 2.0 specification, chapter 4 "GLB File Format Specification".
#include "server/scene/gltf_container.h"

#include "server/scene/json_schema.h"
#include "server/scene/json_text.h"
#include "server/scene/scene_error.h"

#include <cstdint>
#include <cstring>
#include <optional>

namespace farlight {

namespace {

using Json = nlohmann::json;

constexpr std::uint32_t kJsonChunk = 0x4E4F534A;  // "JSON"
constexpr std::uint32_t kBinaryChunk = 0x004E4942;  // "BIN\0"
constexpr std::size_t kHeaderSize = 12;  // magic, version, length
constexpr std::size_t kChunkHeaderSize = 8;  // length, type

struct Chunks {
    std::string_view json;
    std::optional<std::string_view> binary;
};

std::uint32_t little_endian(std::string_view bytes, std::size_t offset)
{
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i)
        value |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[offset + i]))
            << (8 * i);
    return value;
}

Chunks split_glb(std::string_view bytes, const ScenePlace& place)
{
    if (bytes.size() < kHeaderSize + kChunkHeaderSize)
        refuse(place, std::to_string(bytes.size()) + " bytes", "a GLB header and a chunk");
    const std::uint32_t version = little_endian(bytes, 4);
    if (version != 2)
        refuse(place, "GLB version " + std::to_string(version), "version 2");
    const std::uint32_t length = little_endian(bytes, 8);
    if (length < kHeaderSize || length > bytes.size())
        refuse(place, "a GLB of " + std::to_string(bytes.size()) + " bytes",
            std::to_string(length) + " as its header says");
    bytes = bytes.substr(0, length);

    Chunks chunks;
    for (std::size_t offset = kHeaderSize; offset < bytes.size();) {
        const std::size_t room = bytes.size() - offset;
        if (room < kChunkHeaderSize || little_endian(bytes, offset) > room - kChunkHeaderSize)
            refuse(place, "a chunk at byte " + std::to_string(offset) + " that runs past the end",
                "chunks within the file");
        const std::uint32_t size = little_endian(bytes, offset);
        const std::uint32_t type = little_endian(bytes, offset + 4);
        const std::string_view chunk = bytes.substr(offset + kChunkHeaderSize, size);
        if (chunks.json.empty() && type != kJsonChunk)
            refuse(place, "a first chunk that is not JSON", "the JSON chunk first");
        if (chunks.json.empty())
            chunks.json = chunk;
        else if (type == kBinaryChunk && !chunks.binary)
            chunks.binary = chunk;
        offset += kChunkHeaderSize + size;
    }
    if (chunks.json.empty())
        refuse(place, "no JSON in the GLB", "a JSON chunk");
    return chunks;
}

/// "a%20b" -> "a b"; glTF file names are URIs.
std::string percent_decoded(std::string_view uri)
{
    const auto digit = [](char c) {
        const std::string_view digits = "0123456789abcdef";
        return digits.find(static_cast<char>(c >= 'A' && c <= 'F' ? c - 'A' + 'a' : c));
    };
    std::string path;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        const bool coded = uri[i] == '%' && i + 2 < uri.size()
            && digit(uri[i + 1]) != std::string_view::npos
            && digit(uri[i + 2]) != std::string_view::npos;
        if (!coded) {
            path += uri[i];
            continue;
        }
        path += static_cast<char>(digit(uri[i + 1]) * 16 + digit(uri[i + 2]));
        i += 2;
    }
    return path;
}

std::vector<unsigned char> cut_to_length(
    std::string_view bytes, std::size_t length, const ScenePlace& place)
{
    if (bytes.size() < length)
        refuse(place / "byteLength", std::to_string(length),
            "at most the " + std::to_string(bytes.size()) + " bytes there are");
    return {bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(length)};
}

std::vector<unsigned char> read_buffer(const Json& buffer, const std::filesystem::path& folder,
    const std::optional<std::string_view>& binary, const ScenePlace& place)
{
    const std::size_t length = buffer.at("byteLength").get<std::size_t>();
    if (!buffer.contains("uri")) {
        if (!binary)
            refuse(place, "no key \"uri\"", "a uri, or a GLB with a binary chunk");
        return cut_to_length(*binary, length, place);
    }
    const auto& uri = buffer.at("uri").get_ref<const std::string&>();
    if (is_data_uri(uri))
        return {};
    const std::filesystem::path path = percent_decoded(uri);
    if (uri.empty() || uri.find("://") != std::string::npos || path.is_absolute())
        refuse(place / "uri", in_quotes(uri), "a data URI or a path relative to the file");
    const std::filesystem::path file = folder / path;
    if (!std::filesystem::is_regular_file(file))
        refuse(place / "uri", in_quotes(uri) + ", and no such file", "a file of bytes");
    return cut_to_length(read_file(file), length, place);
}

}  // namespace

bool is_data_uri(std::string_view uri)
{
    return uri.starts_with("data:");
}

GltfContainer open_gltf_container(const std::filesystem::path& file)
{
    const ScenePlace place{file.string(), {}};
    const std::string bytes = read_file(file);
    Chunks chunks{bytes, std::nullopt};
    if (bytes.starts_with("glTF"))
        chunks = split_glb(bytes, place);

    GltfContainer container;
    container.document = parse_json(chunks.json, place.file);
    check_schema(container.document, gltf_schema(), place.file);
    const Json buffers = container.document.value("buffers", Json::array());
    for (std::size_t i = 0; i < buffers.size(); ++i)
        container.buffers.push_back(read_buffer(buffers[i], file.parent_path(),
            i == 0 ? chunks.binary : std::nullopt, place / "buffers" / i));
    return container;
}

}  // namespace farlight
