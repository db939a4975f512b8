// Reference: glTF 2.0 specification, sections 3.6 "Binary Data Storage" and 3.7 "Geometry".
#include "server/scene/gltf_check.h"

#include "server/scene/gltf_component.h"
#include "server/scene/gltf_meshopt.h"

#include <algorithm>
#include <cstdint>
#include <set>

namespace farlight {

namespace {

using Json = nlohmann::json;

/// An accessor without a buffer view is all zeros: no bytes of the file back its count. Sparse ones
/// among them have an element for each vertex of a mesh, and no coder spends less than a bit on
/// that: so any file may have a few, and a large one as many as its buffers have bits.
constexpr std::uint64_t kZerosOfAnyFile = 1U << 16U;
constexpr std::uint64_t kZerosOfAByte = 8;

/// Of what Draco unpacks, which holds the count to its bytes before it is used.
constexpr std::uint64_t kMostUnpacked = 1U << 24U;

std::uint64_t number(const Json& object, const char* key, std::uint64_t fallback = 0)
{
    return object.value(key, fallback);
}

std::uint64_t element_size(const Json& accessor)
{
    return element_layout(
        accessor["type"].get_ref<const std::string&>(), accessor["componentType"].get<int>())
        .size;
}

class Checker {
public:
    explicit Checker(const GltfContainer& gltf) : gltf_(gltf), root_(gltf.root)
    {
        std::uint64_t bytes = 0;
        for (const ByteSpan& buffer : gltf.buffers)
            bytes += buffer.size();
        most_zeros_ = std::max(kZerosOfAnyFile, kZerosOfAByte * bytes);
        for (const Json& mesh : gltf.list("meshes"))
            for (const Json& primitive : mesh["primitives"])
                if (gltf_extension(primitive, "KHR_draco_mesh_compression") != nullptr)
                    add_unpacked(primitive);
    }

    void check() const
    {
        if (gltf_.list("scenes").empty())
            refuse(root_ / "scenes", "no scene", "at least one scene");
        each("bufferViews", &Checker::check_buffer_view);
        each("accessors", &Checker::check_accessor);
        each("meshes", &Checker::check_mesh);
        check_gltf_references(gltf_);
    }

private:
    void add_unpacked(const Json& primitive)
    {
        const auto add = [&](const Json& accessor) {
            unpacked_.insert((root_ / "accessors" / accessor.get<std::size_t>()).pointer);
        };
        for (const Json& accessor : primitive["attributes"])
            add(accessor);
        if (primitive.contains("indices"))
            add(primitive["indices"]);
    }

    using Check = void (Checker::*)(const Json&, const ScenePlace&) const;

    void each(const char* name, Check check_one) const
    {
        for (std::size_t i = 0; i < gltf_.list(name).size(); ++i)
            (this->*check_one)(gltf_.list(name)[i], root_ / name / i);
    }

    void check_bytes(const Json& part, const ScenePlace& place) const;
    void check_buffer_view(const Json& view, const ScenePlace& place) const;
    void check_accessor(const Json& accessor, const ScenePlace& place) const;
    void check_sparse(const Json& accessor, const ScenePlace& place) const;
    void check_mesh(const Json& mesh, const ScenePlace& place) const
    {
        check_gltf_mesh(gltf_, mesh, place);
    }

    const GltfContainer& gltf_;
    ScenePlace root_;
    std::uint64_t most_zeros_ = 0;  // elements without a buffer view
    std::set<std::string> unpacked_;  // accessors that Draco has the bytes of, by pointer
};

/// Bytes that lie `stride` apart, `count` of `size` each, from byteOffset in a view of `length`.
struct Strided {
    std::uint64_t offset, count, stride, size, length;
};

void check_range(const Strided& range, const ScenePlace& place)
{
    if (range.offset + range.size > range.length)
        refuse(place / "byteOffset", std::to_string(range.offset),
            "room for " + std::to_string(range.size) + " bytes in a buffer view of "
                + std::to_string(range.length));
    if (range.offset + range.stride * (range.count - 1) + range.size > range.length)
        refuse(place / "count", std::to_string(range.count),
            "at most "
                + std::to_string((range.length - range.offset - range.size) / range.stride + 1)
                + ", what the buffer view holds");
}

/// `part` is a buffer view or what stands for it compressed.
void Checker::check_bytes(const Json& part, const ScenePlace& place) const
{
    const Json& buffer = gltf_.item("buffers", part["buffer"], place / "buffer");
    const std::uint64_t length = number(buffer, "byteLength");
    if (gltf_.buffers[part["buffer"].get<std::size_t>()].empty())
        refuse(place / "buffer", "a buffer that stands in for compressed views",
            "a buffer with bytes");
    const std::uint64_t offset = number(part, "byteOffset");
    if (offset >= length)
        refuse(place / "byteOffset", std::to_string(offset),
            "less than " + std::to_string(length) + ", the buffer's byteLength");
    if (number(part, "byteLength") > length - offset)
        refuse(place / "byteLength", part["byteLength"].dump(),
            "at most " + std::to_string(length - offset) + ", what the buffer still holds");
}

void Checker::check_buffer_view(const Json& view, const ScenePlace& place) const
{
    const Json* meshopt = gltf_extension(view, "EXT_meshopt_compression");
    if (meshopt == nullptr)
        return check_bytes(view, place);
    const ScenePlace packed_place = place / "extensions" / "EXT_meshopt_compression";
    check_bytes(*meshopt, packed_place);
    check_gltf_meshopt(*meshopt, packed_place);
    const std::uint64_t unpacked = number(*meshopt, "count") * number(*meshopt, "byteStride");
    if (unpacked != number(view, "byteLength"))
        refuse(place / "byteLength", view["byteLength"].dump(),
            std::to_string(unpacked) + ", what its compressed bytes hold");
}

void Checker::check_accessor(const Json& accessor, const ScenePlace& place) const
{
    const std::uint64_t size = element_size(accessor);
    const std::uint64_t count = number(accessor, "count");
    if (accessor.contains("bufferView")) {
        const Json& view = gltf_.item("bufferViews", accessor["bufferView"], place / "bufferView");
        const std::uint64_t stride = number(view, "byteStride", size);
        if (stride < size)
            refuse(root_ / "bufferViews" / accessor["bufferView"].get<std::size_t>() / "byteStride",
                std::to_string(stride),
                "at least " + std::to_string(size) + ", an element of " + place.pointer);
        check_range(
            {number(accessor, "byteOffset"), count, stride, size, number(view, "byteLength")},
            place);
    } else {
        const std::uint64_t most = unpacked_.contains(place.pointer) ? kMostUnpacked : most_zeros_;
        if (count > most)
            refuse(place / "count", std::to_string(count),
                "at most " + std::to_string(most) + " without a bufferView in a file of this size");
    }
    if (accessor.contains("sparse"))
        check_sparse(accessor, place / "sparse");
}

void Checker::check_sparse(const Json& accessor, const ScenePlace& place) const
{
    const Json& sparse = accessor["sparse"];
    const std::uint64_t count = number(sparse, "count");
    if (count > number(accessor, "count"))
        refuse(place / "count", std::to_string(count),
            "at most " + accessor["count"].dump() + ", the accessor's count");
    const auto check_part = [&](const char* key, std::uint64_t size) {
        const Json& view =
            gltf_.item("bufferViews", sparse[key]["bufferView"], place / key / "bufferView");
        check_range(
            {number(sparse[key], "byteOffset"), count, size, size, number(view, "byteLength")},
            place / key);
    };
    check_part("indices", component_size(sparse["indices"]["componentType"].get<int>()));
    check_part("values", element_size(accessor));
}

}  // namespace

void check_gltf(const GltfContainer& gltf)
{
    Checker(gltf).check();
}

}  // namespace farlight
