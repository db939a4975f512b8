// Decoding by libmeshoptimizer, which asserts what is checked here first.
#include "server/scene/gltf_meshopt.h"

#include <meshoptimizer.h>

namespace farlight {

namespace {

using Json = nlohmann::json;

/// A vertex stream of equal vertices takes 2 bits for 16 bytes; nothing packs more.
constexpr std::uint64_t kMostPacked = 64;
/// For the codec's own header and tail, which small streams are mostly made of.
constexpr std::uint64_t kSmall = 1U << 16U;

bool stride_fits(std::uint64_t stride, const std::string& mode, const std::string& filter)
{
    if (mode != "ATTRIBUTES")
        return stride == 2 || stride == 4;
    if (filter == "OCTAHEDRAL")
        return stride == 4 || stride == 8;
    if (filter == "QUATERNION")
        return stride == 8;
    return stride % 4 == 0 && stride >= 4 && stride <= 256;
}

}  // namespace

void check_gltf_meshopt(const Json& meshopt, const ScenePlace& place)
{
    const auto stride = meshopt["byteStride"].get<std::uint64_t>();
    const auto count = meshopt["count"].get<std::uint64_t>();
    const auto packed = meshopt["byteLength"].get<std::uint64_t>();
    const auto mode = meshopt["mode"].get<std::string>();
    const std::string filter = meshopt.value("filter", "NONE");
    if (!stride_fits(stride, mode, filter))
        refuse(place / "byteStride", std::to_string(stride),
            "a stride that mode " + mode + " with filter " + filter + " has");
    if (mode == "TRIANGLES" && count % 3 != 0)
        refuse(place / "count", std::to_string(count), "a multiple of 3");
    if (count * stride > packed * kMostPacked + kSmall)
        refuse(place / "count",
            std::to_string(count) + " elements in " + std::to_string(packed) + " bytes",
            "bytes for all of them");
}

std::string unpack_gltf_meshopt(
    const Json& meshopt, std::span<const unsigned char> packed, const ScenePlace& place)
{
    const auto stride = meshopt["byteStride"].get<std::size_t>();
    const auto count = meshopt["count"].get<std::size_t>();
    const auto mode = meshopt["mode"].get<std::string>();
    const std::string filter = meshopt.value("filter", "NONE");
    std::string bytes(count * stride, '\0');
    int failed = 0;
    if (mode == "ATTRIBUTES")
        failed =
            meshopt_decodeVertexBuffer(bytes.data(), count, stride, packed.data(), packed.size());
    else if (mode == "TRIANGLES")
        failed =
            meshopt_decodeIndexBuffer(bytes.data(), count, stride, packed.data(), packed.size());
    else
        failed =
            meshopt_decodeIndexSequence(bytes.data(), count, stride, packed.data(), packed.size());
    if (failed != 0)
        refuse(place, "bytes that cannot be decoded", "a " + mode + " stream of meshoptimizer");
    if (filter == "OCTAHEDRAL")
        meshopt_decodeFilterOct(bytes.data(), count, stride);
    else if (filter == "QUATERNION")
        meshopt_decodeFilterQuat(bytes.data(), count, stride);
    else if (filter == "EXPONENTIAL")
        meshopt_decodeFilterExp(bytes.data(), count, stride);
    return bytes;
}

}  // namespace farlight
