// Bytes of glTF files.
#include "tests/scene/gltf_builder.h"

#include <fstream>

namespace farlight {

namespace {

using Json = nlohmann::json;

std::string base64(std::string_view bytes)
{
    constexpr std::string_view kDigits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t bits = 0;
        for (std::size_t k = 0; k < 3; ++k)
            bits =
                bits << 8U | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
        for (std::size_t k = 0; k < 4; ++k)
            text += i + k > bytes.size() ? '=' : kDigits[(bits >> (18 - 6 * k)) & 63U];
    }
    return text;
}

std::string word(std::size_t value)
{
    std::string bytes;
    for (unsigned shift = 0; shift < 32; shift += 8)
        bytes += static_cast<char>((value >> shift) & 255U);
    return bytes;
}

std::string padded(std::string bytes, char filler)
{
    bytes.resize((bytes.size() + 3) / 4 * 4, filler);
    return bytes;
}

}  // namespace

int GltfBuilder::add_bytes(
    std::string_view raw, std::size_t element, std::size_t count, std::size_t stride, Json accessor)
{
    bytes = padded(bytes, '\0');
    const std::size_t offset = bytes.size();
    const std::size_t step = stride == 0 ? element : stride;
    for (std::size_t i = 0; i < count; ++i) {
        bytes.append(raw.substr(i * element, element));
        if (i + 1 < count)
            bytes.append(step - element, '\x7f');  // what lies between must not be read
    }
    Json view{{"buffer", 0}, {"byteOffset", offset}, {"byteLength", bytes.size() - offset}};
    if (stride != 0)
        view["byteStride"] = stride;
    document["bufferViews"].push_back(view);
    document["buffers"] = {{{"byteLength", bytes.size()}}};
    accessor["bufferView"] = document["bufferViews"].size() - 1;
    accessor["count"] = count;
    document["accessors"].push_back(accessor);
    return static_cast<int>(document["accessors"].size()) - 1;
}

int GltfBuilder::add_view(std::string_view raw)
{
    bytes = padded(bytes, '\0');
    document["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", bytes.size()}, {"byteLength", raw.size()}});
    bytes.append(raw);
    document["buffers"] = {{{"byteLength", bytes.size()}}};
    return static_cast<int>(document["bufferViews"].size()) - 1;
}

int GltfBuilder::add_mesh(Json primitive)
{
    document["meshes"].push_back({{"primitives", Json::array({std::move(primitive)})}});
    const int mesh = static_cast<int>(document["meshes"].size()) - 1;
    document["nodes"].push_back({{"mesh", mesh}});
    document["scenes"][0]["nodes"].push_back(document["nodes"].size() - 1);
    return mesh;
}

std::string glb_container(std::string json, std::string binary)
{
    json = padded(std::move(json), ' ');
    binary = padded(std::move(binary), '\0');
    return "glTF" + word(2) + word(12 + 8 + json.size() + 8 + binary.size()) + word(json.size())
        + "JSON" + json + word(binary.size()) + std::string("BIN\0", 4) + binary;
}

void GltfBuilder::write_glb(const std::filesystem::path& file) const
{
    std::ofstream(file, std::ios::binary) << glb_container(document.dump(), bytes);
}

void GltfBuilder::write_gltf(const std::filesystem::path& file, bool embedded) const
{
    Json copy = document;
    const std::string name = file.filename().string() + ".bin";
    copy["buffers"][0]["uri"] = embedded ? data_uri("application/octet-stream", bytes) : name;
    std::ofstream(file) << copy.dump();
    if (!embedded)
        std::ofstream(file.parent_path() / name, std::ios::binary) << bytes;
}

std::string data_uri(const std::string& type, std::string_view bytes)
{
    return "data:" + type + ";base64," + base64(bytes);
}

GltfBuilder triangle_gltf()
{
    GltfBuilder gltf;
    const int positions = gltf.add<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3");
    const int indices = gltf.add<std::uint16_t>({0, 1, 2}, "SCALAR");
    gltf.add_mesh({{"attributes", {{"POSITION", positions}}}, {"indices", indices}});
    return gltf;
}

}  // namespace farlight
