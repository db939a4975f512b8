// Reference: glTF 2.0 specification, sections 3.6 "Binary Data Storage" and 3.7 "Geometry".
#include "server/scene/gltf_check.h"

#include "server/scene/gltf_component.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace farlight {

namespace {

using Json = nlohmann::json;

// KHR_texture_* and EXT_texture_* concern textures, which are not read, so requiring them is fine.
constexpr std::array<std::string_view, 5> kSupportedExtensions{"KHR_materials_emissive_strength",
    "KHR_mesh_quantization", "KHR_texture_basisu", "KHR_texture_transform", "EXT_texture_webp"};

// An accessor without a buffer view is all zeros: its count is backed by no bytes of the file.
constexpr std::uint64_t kMostZeros = 1U << 24U;

bool supported(const std::string& extension)
{
    return std::find(kSupportedExtensions.begin(), kSupportedExtensions.end(), extension)
        != kSupportedExtensions.end();
}

std::uint64_t number(const Json& object, const char* key, std::uint64_t fallback = 0)
{
    return object.value(key, fallback);
}

class Checker {
public:
    Checker(const Json& document, const std::string& file)
        : document_(document)
        , root_{file, {}} { }

    void check() const
    {
        check_extensions();
        if (list("scenes").empty())
            refuse(root_ / "scenes", "no scene", "at least one scene");
        if (list("meshes").empty())
            refuse(root_ / "meshes", "no mesh", "at least one mesh");
        each("bufferViews", &Checker::check_buffer_view);
        each("accessors", &Checker::check_accessor);
        each("meshes", &Checker::check_mesh);
        each("nodes", &Checker::check_node);
        each("scenes", &Checker::check_scene);
        check_index(document_, "scene", "scenes", root_);
    }

private:
    using Check = void (Checker::*)(const Json&, const ScenePlace&) const;

    const Json& list(const char* name) const
    {
        static const Json empty = Json::array();
        const auto found = document_.find(name);
        return found == document_.end() ? empty : *found;
    }

    const Json& item(const char* name, const Json& index) const
    {
        return list(name)[index.get<std::size_t>()];
    }

    void each(const char* name, Check check_one) const
    {
        for (std::size_t i = 0; i < list(name).size(); ++i)
            (this->*check_one)(list(name)[i], root_ / name / i);
    }

    void check_index(
        const Json& object, const char* key, const char* into, const ScenePlace& place) const
    {
        if (object.contains(key))
            check_index(object.at(key), into, place / key);
    }

    void check_index(const Json& index, const char* into, const ScenePlace& place) const
    {
        if (index.get<std::uint64_t>() >= list(into).size())
            refuse(place, "index " + index.dump(),
                "less than " + std::to_string(list(into).size()) + ", the number of " + into);
    }

    void check_extensions() const;
    void check_buffer_view(const Json& view, const ScenePlace& place) const;
    void check_accessor(const Json& accessor, const ScenePlace& place) const;
    void check_sparse(const Json& accessor, const ScenePlace& place) const;
    void check_mesh(const Json& mesh, const ScenePlace& place) const;
    void check_primitive(const Json& primitive, const ScenePlace& place) const;
    void check_vectors(const Json& attributes, const char* name, const ScenePlace& place) const;
    void check_node(const Json& node, const ScenePlace& place) const;
    void check_scene(const Json& scene, const ScenePlace& place) const;

    const Json& document_;
    ScenePlace root_;
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

void Checker::check_extensions() const
{
    std::string lacking;
    for (const Json& name : document_.value("extensionsRequired", Json::array()))
        if (!supported(name.get<std::string>()))
            lacking += (lacking.empty() ? "" : ", ") + name.get<std::string>();
    if (!lacking.empty())
        refuse(root_ / "extensionsRequired", lacking,
            "none but extensions that Farlight reads: KHR_materials_emissive_strength, "
            "KHR_mesh_quantization");
}

void Checker::check_buffer_view(const Json& view, const ScenePlace& place) const
{
    check_index(view, "buffer", "buffers", place);
    const std::uint64_t length = number(item("buffers", view["buffer"]), "byteLength");
    const std::uint64_t offset = number(view, "byteOffset");
    if (offset >= length)
        refuse(place / "byteOffset", std::to_string(offset),
            "less than " + std::to_string(length) + ", the buffer's byteLength");
    if (number(view, "byteLength") > length - offset)
        refuse(place / "byteLength", view["byteLength"].dump(),
            "at most " + std::to_string(length - offset) + ", what the buffer still holds");
}

void Checker::check_accessor(const Json& accessor, const ScenePlace& place) const
{
    const std::uint64_t lanes = lane_count(accessor["type"].get_ref<const std::string&>());
    if (lanes == 0)
        return;  // a matrix: nothing that is read here
    check_index(accessor, "bufferView", "bufferViews", place);
    const std::uint64_t size = lanes * component_size(accessor["componentType"].get<int>());
    const std::uint64_t count = number(accessor, "count");
    if (accessor.contains("bufferView")) {
        const Json& view = item("bufferViews", accessor["bufferView"]);
        const std::uint64_t stride = number(view, "byteStride", size);
        if (stride < size)
            refuse(root_ / "bufferViews" / accessor["bufferView"].get<std::size_t>() / "byteStride",
                std::to_string(stride),
                "at least " + std::to_string(size) + ", an element of " + place.pointer);
        check_range(
            {number(accessor, "byteOffset"), count, stride, size, number(view, "byteLength")},
            place);
    } else if (count > kMostZeros) {
        refuse(place / "count", std::to_string(count),
            "at most " + std::to_string(kMostZeros) + " without a bufferView");
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
        check_index(sparse[key], "bufferView", "bufferViews", place / key);
        const Json& view = item("bufferViews", sparse[key]["bufferView"]);
        check_range(
            {number(sparse[key], "byteOffset"), count, size, size, number(view, "byteLength")},
            place / key);
    };
    check_part("indices", component_size(sparse["indices"]["componentType"].get<int>()));
    check_part("values",
        lane_count(accessor["type"].get_ref<const std::string&>())
            * component_size(accessor["componentType"].get<int>()));
}

void Checker::check_mesh(const Json& mesh, const ScenePlace& place) const
{
    for (std::size_t i = 0; i < mesh["primitives"].size(); ++i)
        check_primitive(mesh["primitives"][i], place / "primitives" / i);
}

void Checker::check_vectors(const Json& attributes, const char* name, const ScenePlace& place) const
{
    check_index(attributes, name, "accessors", place);
    const Json& accessor = item("accessors", attributes[name]);
    if (accessor["type"] != "VEC3" || accessor["componentType"] == kUnsignedInt)
        refuse(place / name,
            accessor["type"].get<std::string>() + " of component type "
                + accessor["componentType"].dump(),
            "VEC3 of floats, or of bytes or shorts (KHR_mesh_quantization)");
}

void Checker::check_primitive(const Json& primitive, const ScenePlace& place) const
{
    const Json& attributes = primitive["attributes"];
    check_index(primitive, "material", "materials", place);
    if (!attributes.contains("POSITION"))
        refuse(place / "attributes", "no key \"POSITION\"", "an accessor of positions");
    check_vectors(attributes, "POSITION", place / "attributes");
    if (attributes.contains("NORMAL")) {
        check_vectors(attributes, "NORMAL", place / "attributes");
        const Json& normals = item("accessors", attributes["NORMAL"])["count"];
        const Json& positions = item("accessors", attributes["POSITION"])["count"];
        if (normals != positions)
            refuse(place / "attributes" / "NORMAL", normals.dump() + " normals",
                positions.dump() + ", one a position");
    }
    if (!primitive.contains("indices"))
        return;
    check_index(primitive, "indices", "accessors", place);
    const Json& accessor = item("accessors", primitive["indices"]);
    const int type = accessor["componentType"].get<int>();
    if (accessor["type"] != "SCALAR"
        || (type != kUnsignedByte && type != kUnsignedShort && type != kUnsignedInt))
        refuse(place / "indices",
            accessor["type"].get<std::string>() + " of component type " + std::to_string(type),
            "SCALAR of unsigned bytes, shorts or ints");
}

void Checker::check_node(const Json& node, const ScenePlace& place) const
{
    check_index(node, "mesh", "meshes", place);
    check_index(node, "camera", "cameras", place);
    const Json children = node.value("children", Json::array());
    for (std::size_t i = 0; i < children.size(); ++i)
        check_index(children[i], "nodes", place / "children" / i);
}

void Checker::check_scene(const Json& scene, const ScenePlace& place) const
{
    const Json nodes = scene.value("nodes", Json::array());
    for (std::size_t i = 0; i < nodes.size(); ++i)
        check_index(nodes[i], "nodes", place / "nodes" / i);
}

}  // namespace

void check_gltf(const Json& document, const std::string& file)
{
    Checker(document, file).check();
}

std::vector<std::string> unread_gltf_extensions(const Json& document)
{
    std::vector<std::string> unread;
    for (const Json& name : document.value("extensionsUsed", Json::array()))
        if (!supported(name.get<std::string>()))
            unread.push_back(name.get<std::string>());
    return unread;
}

}  // namespace farlight
