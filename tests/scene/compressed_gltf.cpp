// Packed by the libraries' own encoders.
#include "tests/scene/compressed_gltf.h"

#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <meshoptimizer.h>

namespace farlight {

namespace {

using Json = nlohmann::json;

/// A square of two triangles in Draco's bytes: positions with id 0, texture coordinates with id 1.
std::string draco_square()
{
    draco::TriangleSoupMeshBuilder builder;
    builder.Start(2);
    const int positions =
        builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
    const int uvs = builder.AddAttribute(draco::GeometryAttribute::TEX_COORD, 2, draco::DT_FLOAT32);
    const float corners[4][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    const int faces[2][3] = {{0, 1, 2}, {0, 2, 3}};
    for (int face = 0; face < 2; ++face) {
        const auto& [a, b, c] = faces[face];
        const draco::FaceIndex index(static_cast<std::uint32_t>(face));
        builder.SetAttributeValuesForFace(positions, index, corners[a], corners[b], corners[c]);
        builder.SetAttributeValuesForFace(uvs, index, corners[a], corners[b], corners[c]);
    }
    const auto mesh = builder.Finalize();
    draco::EncoderBuffer buffer;
    if (!draco::Encoder().EncodeMeshToBuffer(*mesh, &buffer).ok())
        throw std::runtime_error("Draco cannot encode a square");
    return {buffer.data(), buffer.size()};
}

/// A view of `values`, `stride` bytes each, packed; the fallback buffer 1 stands in for its bytes.
template <typename T, typename Encode>
int add_packed(GltfBuilder& gltf, const std::vector<T>& values, std::size_t stride,
    const char* mode, const char* filter, const Encode& encode)
{
    const std::string packed = encode(values);
    const int view = gltf.add_view(packed);
    Json& json = gltf.document["bufferViews"][static_cast<std::size_t>(view)];
    const std::size_t bytes = values.size() * sizeof(T);
    json["extensions"]["EXT_meshopt_compression"] = {{"buffer", 0},
        {"byteOffset", json["byteOffset"]}, {"byteLength", packed.size()}, {"byteStride", stride},
        {"count", bytes / stride}, {"mode", mode}, {"filter", filter}};
    json["buffer"] = 1;
    json["byteOffset"] = 0;
    json["byteLength"] = bytes;
    return view;
}

template <typename T> auto vertex_encoder(std::size_t stride)
{
    return [stride](const std::vector<T>& values) {
        const std::size_t count = values.size() * sizeof(T) / stride;
        std::string packed(meshopt_encodeVertexBufferBound(count, stride), '\0');
        packed.resize(meshopt_encodeVertexBuffer(reinterpret_cast<unsigned char*>(packed.data()),
            packed.size(), values.data(), count, stride));
        return packed;
    };
}

std::string encode_triangles(const std::vector<std::uint32_t>& corners)
{
    std::string packed(meshopt_encodeIndexBufferBound(corners.size(), 4), '\0');
    packed.resize(meshopt_encodeIndexBuffer(reinterpret_cast<unsigned char*>(packed.data()),
        packed.size(), corners.data(), corners.size()));
    return packed;
}

std::string encode_sequence(const std::vector<std::uint32_t>& corners)
{
    std::string packed(meshopt_encodeIndexSequenceBound(corners.size(), 4), '\0');
    packed.resize(meshopt_encodeIndexSequence(reinterpret_cast<unsigned char*>(packed.data()),
        packed.size(), corners.data(), corners.size()));
    return packed;
}

const std::vector<std::uint32_t> kCorners{0, 1, 2, 0, 2, 3};

}  // namespace

GltfBuilder draco_gltf()
{
    GltfBuilder gltf;
    const int view = gltf.add_view(draco_square());
    gltf.document["extensionsRequired"] = {"KHR_draco_mesh_compression"};
    gltf.document["accessors"] = {{{"componentType", 5126}, {"count", 4}, {"type", "VEC3"}},
        {{"componentType", 5126}, {"count", 4}, {"type", "VEC2"}},
        {{"componentType", 5123}, {"count", 6}, {"type", "SCALAR"}}};
    gltf.add_mesh({{"attributes", {{"POSITION", 0}, {"TEXCOORD_0", 1}}}, {"indices", 2},
        {"extensions",
            {{"KHR_draco_mesh_compression",
                {{"bufferView", view}, {"attributes", {{"POSITION", 0}, {"TEXCOORD_0", 1}}}}}}}});
    return gltf;
}

GltfBuilder meshopt_gltf(bool as_sequence)
{
    GltfBuilder gltf;
    const std::vector<float> square{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
    std::vector<std::uint32_t> coded(square.size());
    meshopt_encodeFilterExp(coded.data(), 4, 12, 15, square.data());
    const std::vector<float> normals{0, 0, 1, 0, 1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1, 0};
    std::vector<std::int8_t> octahedral(16);
    meshopt_encodeFilterOct(octahedral.data(), 4, 4, 8, normals.data());
    add_packed(gltf, coded, 12, "ATTRIBUTES", "EXPONENTIAL", vertex_encoder<std::uint32_t>(12));
    add_packed(gltf, octahedral, 4, "ATTRIBUTES", "OCTAHEDRAL", vertex_encoder<std::int8_t>(4));
    gltf.document["bufferViews"][1]["byteStride"] = 4;
    add_packed(gltf, kCorners, 4, as_sequence ? "INDICES" : "TRIANGLES", "NONE",
        as_sequence ? encode_sequence : encode_triangles);
    gltf.document["extensionsRequired"] = {"EXT_meshopt_compression"};
    gltf.document["buffers"].push_back({{"byteLength", 1000},
        {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}});
    gltf.document["accessors"] = {
        {{"bufferView", 0}, {"componentType", 5126}, {"count", 4}, {"type", "VEC3"}},
        {{"bufferView", 1}, {"componentType", 5120}, {"count", 4}, {"type", "VEC3"},
            {"normalized", true}},
        {{"bufferView", 2}, {"componentType", 5125}, {"count", 6}, {"type", "SCALAR"}}};
    gltf.add_mesh({{"attributes", {{"POSITION", 0}, {"NORMAL", 1}}}, {"indices", 2}});
    return gltf;
}

}  // namespace farlight
