// GLB layout: glTF 2.0 specification, chapter 4 "GLB File Format Specification".
#include "server/scene/gltf_container.h"

#include "server/scene/gltf_extensions.h"
#include "server/scene/gltf_uri.h"
#include "server/scene/json_schema.h"
#include "server/scene/json_text.h"
#include "server/scene/scene_error.h"

#include <cstdint>
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

ByteSpan cut_to_length(ByteSpan bytes, std::size_t length, const ScenePlace& place)
{
    if (bytes.size() < length)
        refuse(place / "byteLength", std::to_string(length),
            "at most the " + std::to_string(bytes.size()) + " bytes there are");
    return bytes.first(length);
}

ByteSpan as_bytes(std::string_view text)
{
    return {reinterpret_cast<const unsigned char*>(text.data()), text.size()};
}

ByteSpan read_buffer(GltfContainer& container, const Json& buffer,
    const std::optional<std::string_view>& binary, const ScenePlace& place)
{
    const std::size_t length = buffer.at("byteLength").get<std::size_t>();
    if (buffer.contains("uri"))
        return cut_to_length(container.keep(read_gltf_uri(buffer.at("uri").get<std::string>(),
                                 container.folder, place / "uri")),
            length, place);
    if (const Json* meshopt = gltf_extension(buffer, "EXT_meshopt_compression");
        meshopt != nullptr && meshopt->value("fallback", false))
        return {};
    if (!binary)
        refuse(place, "no key \"uri\"", "a uri, or a GLB with a binary chunk");
    return cut_to_length(as_bytes(*binary), length, place);
}

}  // namespace

const Json& GltfContainer::list(const char* name) const
{
    static const Json empty = Json::array();
    const auto found = document.find(name);
    return found == document.end() ? empty : *found;
}

const Json& GltfContainer::item(const char* name, const Json& index, const ScenePlace& place) const
{
    const Json& all = list(name);
    if (index.get<std::uint64_t>() >= all.size())
        refuse(place, "index " + index.dump(),
            "less than " + std::to_string(all.size()) + ", the number of " + name);
    return all[index.get<std::size_t>()];
}

ByteSpan GltfContainer::keep(std::string bytes)
{
    return as_bytes(storage.emplace_back(std::move(bytes)));
}

const Json* gltf_extension(const Json& object, const char* name)
{
    const auto extensions = object.find("extensions");
    if (extensions == object.end())
        return nullptr;
    const auto found = extensions->find(name);
    return found == extensions->end() ? nullptr : &*found;
}

GltfContainer open_gltf_container(std::string file_bytes, const std::filesystem::path& file)
{
    GltfContainer container;
    container.root = {file.string(), {}};
    container.folder = file.parent_path();
    const std::string& bytes = container.storage.emplace_back(std::move(file_bytes));
    Chunks chunks{bytes, std::nullopt};
    if (bytes.starts_with("glTF"))
        chunks = split_glb(bytes, container.root);

    container.document = parse_json(chunks.json, container.root.file);
    check_schema(container.document, gltf_schema(), container.root.file);
    check_gltf_extensions(container.document, container.root);
    const Json& buffers = container.list("buffers");
    for (std::size_t i = 0; i < buffers.size(); ++i)
        container.buffers.push_back(read_buffer(container, buffers[i],
            i == 0 ? chunks.binary : std::nullopt, container.root / "buffers" / i));
    return container;
}

}  // namespace farlight
