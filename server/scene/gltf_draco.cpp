// Decoding by libdraco; what comes out is laid down as the accessors describe it.
#include "server/scene/gltf_draco.h"

#include "server/scene/gltf_component.h"

#include <array>
#include <cstring>
#include <draco/compression/decode.h>
#include <limits>

namespace farlight {

namespace {

using Json = nlohmann::json;

/// Packed elements of an attribute, one a point.
template <typename Component>
std::string packed_values(const draco::Mesh& mesh, const draco::PointAttribute& attribute)
{
    std::array<Component, 4> values{};
    const std::size_t lanes = static_cast<std::size_t>(attribute.num_components());
    const std::size_t size = lanes * sizeof(Component);
    std::string bytes(mesh.num_points() * size, '\0');
    for (std::uint32_t i = 0; i < mesh.num_points(); ++i) {
        const auto index = attribute.mapped_index(draco::PointIndex(i));
        if (!attribute.ConvertValue(index, static_cast<std::int8_t>(lanes), values.data()))
            return {};
        std::memcpy(bytes.data() + i * size, values.data(), size);
    }
    return bytes;
}

template <typename Component> std::string packed_corners(const draco::Mesh& mesh)
{
    std::string bytes;
    bytes.reserve(std::size_t(mesh.num_faces()) * 3 * sizeof(Component));
    for (std::uint32_t i = 0; i < mesh.num_faces(); ++i)
        for (const draco::PointIndex& corner : mesh.face(draco::FaceIndex(i))) {
            const auto value = static_cast<Component>(corner.value());
            bytes.append(reinterpret_cast<const char*>(&value), sizeof(value));
        }
    return bytes;
}

std::string packed_values(
    const draco::Mesh& mesh, const draco::PointAttribute& attribute, int component_type)
{
    switch (component_type) {
    case kByte: return packed_values<std::int8_t>(mesh, attribute);
    case kUnsignedByte: return packed_values<std::uint8_t>(mesh, attribute);
    case kShort: return packed_values<std::int16_t>(mesh, attribute);
    case kUnsignedShort: return packed_values<std::uint16_t>(mesh, attribute);
    case kUnsignedInt: return packed_values<std::uint32_t>(mesh, attribute);
    default: return packed_values<float>(mesh, attribute);
    }
}

std::string packed_corners(const draco::Mesh& mesh, int component_type)
{
    switch (component_type) {
    case kUnsignedByte: return packed_corners<std::uint8_t>(mesh);
    case kUnsignedShort: return packed_corners<std::uint16_t>(mesh);
    default: return packed_corners<std::uint32_t>(mesh);
    }
}

void check_count(std::size_t found, const Json& accessor, const char* what, const ScenePlace& place)
{
    if (found != accessor["count"].get<std::size_t>())
        refuse(place, std::to_string(found) + " compressed " + what,
            accessor["count"].dump() + ", the accessor's count");
}

/// A decoder of one primitive's bytes.
class Unpacker {
public:
    Unpacker(GltfContainer& gltf, const Json& draco, const ScenePlace& place)
        : gltf_(gltf)
        , draco_(draco)
        , place_(place)
    {
        gltf.item("bufferViews", draco["bufferView"], place / "bufferView");
        const ByteSpan bytes = gltf.views[draco["bufferView"].get<std::size_t>()];
        draco::DecoderBuffer buffer;
        buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
        auto decoded = draco::Decoder().DecodeMeshFromBuffer(&buffer);
        if (!decoded.ok())
            refuse(place, "bytes that cannot be decoded: " + decoded.status().error_msg_string(),
                "a Draco mesh");
        mesh_ = std::move(decoded).value();
    }

    void unpack_attribute(const Json& index, const char* name)
    {
        const ScenePlace place = place_ / "attributes" / name;
        const draco::PointAttribute* attribute =
            mesh_->GetAttributeByUniqueId(draco_["attributes"][name].get<std::uint32_t>());
        if (attribute == nullptr)
            refuse(place, draco_["attributes"][name].dump(),
                "an id that the compressed mesh has an attribute of");
        const Json& accessor = accessor_of(index);
        check_count(mesh_->num_points(), accessor, "elements", place);
        const int type = accessor["componentType"].get<int>();
        const ElementLayout layout =
            element_layout(accessor["type"].get_ref<const std::string&>(), type);
        if (static_cast<std::size_t>(attribute->num_components()) != layout.lanes()
            || layout.columns != 1)
            refuse(place, std::to_string(attribute->num_components()) + " components",
                accessor["type"].get<std::string>() + ", the accessor's type");
        std::string bytes = packed_values(*mesh_, *attribute, type);
        if (bytes.empty())
            refuse(place, "values that do not fit the accessor's component type",
                "values of component type " + std::to_string(type));
        gltf_.unpacked[index.get<std::size_t>()] = gltf_.keep(std::move(bytes));
    }

    void unpack_corners(const Json& index)
    {
        const Json& accessor = accessor_of(index);
        check_count(std::size_t(mesh_->num_faces()) * 3, accessor, "corners", place_);
        const int type = accessor["componentType"].get<int>();
        const std::uint64_t most = std::uint64_t(1) << (8 * component_size(type));
        if (mesh_->num_points() > most)
            refuse(place_, std::to_string(mesh_->num_points()) + " compressed elements",
                "at most " + std::to_string(most) + ", what the indices can count");
        gltf_.unpacked[index.get<std::size_t>()] = gltf_.keep(packed_corners(*mesh_, type));
    }

private:
    const Json& accessor_of(const Json& index) const
    {
        return gltf_.list("accessors")[index.get<std::size_t>()];
    }

    GltfContainer& gltf_;
    const Json& draco_;
    ScenePlace place_;
    std::unique_ptr<draco::Mesh> mesh_;
};

}  // namespace

void unpack_gltf_draco(GltfContainer& gltf, const Json& primitive, const ScenePlace& place)
{
    const Json* draco = gltf_extension(primitive, "KHR_draco_mesh_compression");
    if (draco == nullptr)
        return;
    constexpr int kTriangles = 4;
    if (primitive.value("mode", kTriangles) != kTriangles)
        refuse(place / "mode", primitive["mode"].dump(), "4, triangles, in a compressed primitive");
    const Json& attributes = primitive["attributes"];
    Unpacker unpacker(gltf, *draco, place / "extensions" / "KHR_draco_mesh_compression");
    for (const auto& [name, id] : (*draco)["attributes"].items())
        if (attributes.contains(name))
            unpacker.unpack_attribute(attributes[name], name.c_str());
    if (primitive.contains("indices"))
        unpacker.unpack_corners(primitive["indices"]);
}

}  // namespace farlight
