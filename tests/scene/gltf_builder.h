// Writes glTF files for tests: a document to change at will and the bytes of one buffer.
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace farlight {

struct GltfBuilder {
    nlohmann::json document{{"asset", {{"version", "2.0"}}}, {"scene", 0}};
    std::string bytes;  ///< Of /buffers/0.

    /// Appends values and describes them as an accessor of `type`, whose index it returns. Elements
    /// lie `stride` bytes apart; 0 means tightly packed. The component type follows from T.
    template <typename T>
    int add(const std::vector<T>& values, const std::string& type, std::size_t stride = 0,
        bool normalized = false);

    /// Appends bytes as a buffer view, whose index it returns.
    int add_view(std::string_view raw);

    /// Adds a mesh of one primitive and a node with it in scene 0; returns the mesh's index.
    int add_mesh(nlohmann::json primitive);

    void write_glb(const std::filesystem::path& file) const;
    /// With its buffer beside it as FILE.bin, or in a data URI.
    void write_gltf(const std::filesystem::path& file, bool embedded = false) const;

private:
    int add_bytes(std::string_view raw, std::size_t element, std::size_t count, std::size_t stride,
        nlohmann::json accessor);
};

/// A GLB file of a document and the bytes of its first buffer.
std::string glb_container(std::string json, std::string binary);

/// "data:TYPE;base64,...".
std::string data_uri(const std::string& type, std::string_view bytes);

/// One triangle, (0,0,0) (1,0,0) (0,1,0), indexed by unsigned shorts; one node.
GltfBuilder triangle_gltf();

namespace gltf_builder_detail {

template <typename T> constexpr int component_type();
template <> constexpr int component_type<std::int8_t>()
{
    return 5120;
}
template <> constexpr int component_type<std::uint8_t>()
{
    return 5121;
}
template <> constexpr int component_type<std::int16_t>()
{
    return 5122;
}
template <> constexpr int component_type<std::uint16_t>()
{
    return 5123;
}
template <> constexpr int component_type<std::uint32_t>()
{
    return 5125;
}
template <> constexpr int component_type<float>()
{
    return 5126;
}

}  // namespace gltf_builder_detail

template <typename T>
int GltfBuilder::add(
    const std::vector<T>& values, const std::string& type, std::size_t stride, bool normalized)
{
    std::size_t lanes = type == "SCALAR" ? 1 : static_cast<std::size_t>(type.back() - '0');
    lanes *= type.starts_with("MAT") ? lanes : 1;  // columns of 4-byte components have no gaps
    const std::string_view raw(
        reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
    nlohmann::json accessor{
        {"componentType", gltf_builder_detail::component_type<T>()}, {"type", type}};
    if (normalized)
        accessor["normalized"] = true;
    return add_bytes(raw, lanes * sizeof(T), values.size() / lanes, stride, std::move(accessor));
}

}  // namespace farlight
