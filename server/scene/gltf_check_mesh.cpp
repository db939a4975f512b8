// Reference: glTF 2.0 specification, section 3.7.2 "Meshes"; KHR_mesh_quantization.
#include "server/scene/gltf_check.h"
#include "server/scene/gltf_component.h"

#include <algorithm>
#include <array>

namespace farlight {

namespace {

using Json = nlohmann::json;

constexpr const char* kDraco = "KHR_draco_mesh_compression";

struct AttributeRule {
    std::string_view name;
    std::array<std::string_view, 2> types;
    bool integers;  ///< Unsigned bytes or shorts, counted from 0; else anything but unsigned ints.
    const char* expected;
};

constexpr const char* kQuantized = "floats, or of bytes or shorts (KHR_mesh_quantization)";
constexpr std::array<AttributeRule, 10> kRules{{
    {"POSITION", {"VEC3"}, false, "VEC3"},
    {"NORMAL", {"VEC3"}, false, "VEC3"},
    {"TANGENT", {"VEC4"}, false, "VEC4"},
    {"TEXCOORD_0", {"VEC2"}, false, "VEC2"},
    {"TEXCOORD_1", {"VEC2"}, false, "VEC2"},
    {"COLOR_0", {"VEC3", "VEC4"}, false, "VEC3 or VEC4"},
    {"JOINTS_0", {"VEC4"}, true, "VEC4"},
    {"JOINTS_1", {"VEC4"}, true, "VEC4"},
    {"WEIGHTS_0", {"VEC4"}, false, "VEC4"},
    {"WEIGHTS_1", {"VEC4"}, false, "VEC4"},
}};

std::string described(const Json& accessor)
{
    return accessor["type"].get<std::string>() + " of component type "
        + accessor["componentType"].dump();
}

void check_attribute(const GltfContainer& gltf, const AttributeRule& rule, const Json& index,
    const Json& positions, const ScenePlace& place)
{
    const Json& accessor = gltf.item("accessors", index, place);
    const int type = accessor["componentType"].get<int>();
    const bool fits =
        rule.integers ? type == kUnsignedByte || type == kUnsignedShort : type != kUnsignedInt;
    if (!fits
        || std::find(
               rule.types.begin(), rule.types.end(), accessor["type"].get_ref<const std::string&>())
            == rule.types.end())
        refuse(place, described(accessor),
            std::string(rule.expected) + " of "
                + (rule.integers ? "unsigned bytes or shorts" : kQuantized));
    if (accessor["count"] != positions)
        refuse(
            place, accessor["count"].dump() + " elements", positions.dump() + ", one a position");
}

void check_indices(const GltfContainer& gltf, const Json& primitive, const ScenePlace& place)
{
    const Json& accessor = gltf.item("accessors", primitive["indices"], place / "indices");
    const int type = accessor["componentType"].get<int>();
    if (accessor["type"] != "SCALAR"
        || (type != kUnsignedByte && type != kUnsignedShort && type != kUnsignedInt))
        refuse(place / "indices", described(accessor), "SCALAR of unsigned bytes, shorts or ints");
}

/// Attributes of any name, be they read or not.
void check_named(const GltfContainer& gltf, const Json& attributes, const ScenePlace& place)
{
    for (const auto& [name, accessor] : attributes.items())
        gltf.item("accessors", accessor, place / name);
}

void check_primitive(const GltfContainer& gltf, const Json& primitive, const ScenePlace& place)
{
    const Json& attributes = primitive["attributes"];
    if (primitive.contains("material"))
        gltf.item("materials", primitive["material"], place / "material");
    if (!attributes.contains("POSITION"))
        refuse(place / "attributes", "no key \"POSITION\"", "an accessor of positions");
    const Json& positions =
        gltf.item("accessors", attributes["POSITION"], place / "attributes" / "POSITION")["count"];
    for (const AttributeRule& rule : kRules)
        if (const auto found = attributes.find(rule.name); found != attributes.end())
            check_attribute(gltf, rule, *found, positions, place / "attributes" / rule.name);
    const Json targets = primitive.value("targets", Json::array());
    check_named(gltf, attributes, place / "attributes");
    for (std::size_t i = 0; i < targets.size(); ++i) {
        check_named(gltf, targets[i], place / "targets" / i);
        for (std::size_t rule = 0; rule < 2; ++rule)  // POSITION and NORMAL
            if (const auto found = targets[i].find(kRules[rule].name); found != targets[i].end())
                check_attribute(gltf, kRules[rule], *found, positions,
                    place / "targets" / i / kRules[rule].name);
    }
    if (const Json* draco = gltf_extension(primitive, kDraco))
        gltf.item(
            "bufferViews", (*draco)["bufferView"], place / "extensions" / kDraco / "bufferView");
    if (primitive.contains("indices"))
        check_indices(gltf, primitive, place);
}

}  // namespace

void check_gltf_mesh(const GltfContainer& gltf, const Json& mesh, const ScenePlace& place)
{
    const Json& primitives = mesh["primitives"];
    for (std::size_t i = 0; i < primitives.size(); ++i)
        check_primitive(gltf, primitives[i], place / "primitives" / i);
}

}  // namespace farlight
