// Reading bytes that check_gltf() found in range.
#include "server/scene/gltf_accessor.h"

#include "server/scene/gltf_component.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <limits>
#include <type_traits>

namespace farlight {

namespace {

using Json = nlohmann::json;

template <typename Component> Component load(const unsigned char* bytes)
{
    Component value;
    std::memcpy(&value, bytes, sizeof(value));
    return value;
}

/// Elements lying `stride` apart from `bytes`.
struct Source {
    const unsigned char* bytes;
    std::size_t stride;
    ElementLayout layout;
    int component_type;
    bool normalized;
};

template <typename Element>
inline constexpr bool kOfFloats =
    !std::is_same_v<Element, std::uint32_t> && !std::is_same_v<Element, glm::u16vec4>;

template <typename Element, typename Component>
Element convert(const unsigned char* bytes, const Source& source)
{
    using Lane = std::conditional_t<kOfFloats<Element>, float,
        std::conditional_t<std::is_same_v<Element, std::uint32_t>, std::uint32_t, std::uint16_t>>;
    Element element;
    auto* lane = reinterpret_cast<Lane*>(&element);
    for (std::size_t column = 0; column < source.layout.columns; ++column)
        for (std::size_t row = 0; row < source.layout.rows; ++row, ++lane) {
            const auto value = load<Component>(
                bytes + column * source.layout.column_stride + row * sizeof(Component));
            if constexpr (kOfFloats<Element> && std::is_integral_v<Component>)
                // In double, so that the result is the float nearest to the quotient; the most
                // negative integer stands for -1 too.
                *lane = static_cast<float>(!source.normalized
                        ? value
                        : std::max(-1.0,
                            static_cast<double>(value) / std::numeric_limits<Component>::max()));
            else
                *lane = static_cast<Lane>(value);
        }
    return element;
}

template <typename Element, typename Component>
void read_as(const Source& source, std::vector<Element>& out)
{
    for (std::size_t i = 0; i < out.size(); ++i)
        out[i] = convert<Element, Component>(source.bytes + i * source.stride, source);
}

template <typename Element> void read_all(const Source& source, std::vector<Element>& out)
{
    switch (source.component_type) {
    case kUnsignedByte: return read_as<Element, std::uint8_t>(source, out);
    case kUnsignedShort: return read_as<Element, std::uint16_t>(source, out);
    case kUnsignedInt: return read_as<Element, std::uint32_t>(source, out);
    default: break;
    }
    if constexpr (kOfFloats<Element>) {
        if (source.component_type == kByte)
            return read_as<Element, std::int8_t>(source, out);
        if (source.component_type == kShort)
            return read_as<Element, std::int16_t>(source, out);
        for (std::size_t i = 0; i < out.size(); ++i)  // float lanes have no gaps between
            std::memcpy(&out[i], source.bytes + i * source.stride, sizeof(Element));
    } else {
        assert(!"signed components where unsigned ones were checked");
    }
}

const unsigned char* view_bytes(const GltfContainer& gltf, const Json& part)
{
    return gltf.views[part["bufferView"].get<std::size_t>()].data()
        + part.value("byteOffset", std::size_t(0));
}

void check_places(
    const std::vector<std::uint32_t>& places, std::size_t count, const ScenePlace& place)
{
    for (std::size_t i = 0; i < places.size(); ++i) {
        const std::string found =
            "index " + std::to_string(places[i]) + " as element " + std::to_string(i);
        if (places[i] >= count)
            refuse(place, found, "less than " + std::to_string(count) + ", the accessor's count");
        if (i > 0 && places[i] <= places[i - 1])
            refuse(place, found + " after " + std::to_string(places[i - 1]),
                "indices that strictly increase");
    }
}

template <typename Element>
void overlay_sparse(const GltfContainer& gltf, const Json& sparse, Source source,
    const ScenePlace& place, std::vector<Element>& out)
{
    const auto count = sparse["count"].get<std::size_t>();
    const int index_type = sparse["indices"]["componentType"].get<int>();
    std::vector<std::uint32_t> places(count);
    const ElementLayout scalar = element_layout("SCALAR", index_type);
    read_all(Source{view_bytes(gltf, sparse["indices"]), scalar.size, scalar, index_type, false},
        places);
    check_places(places, out.size(), place / "indices");
    std::vector<Element> values(count);
    source.bytes = view_bytes(gltf, sparse["values"]);
    source.stride = source.layout.size;
    read_all(source, values);
    for (std::size_t i = 0; i < count; ++i)
        out[places[i]] = values[i];
}

}  // namespace

template <typename Element>
std::vector<Element> read_accessor(const GltfContainer& gltf, const Json& index)
{
    const Json& accessor = gltf.list("accessors")[index.get<std::size_t>()];
    const int type = accessor["componentType"].get<int>();
    Source source{nullptr, 0, element_layout(accessor["type"].get_ref<const std::string&>(), type),
        type, accessor.value("normalized", false)};
    std::vector<Element> out(accessor["count"].get<std::size_t>(), Element(0));
    if (const auto unpacked = gltf.unpacked.find(index.get<std::size_t>());
        unpacked != gltf.unpacked.end()) {
        source.bytes = unpacked->second.data();
        source.stride = source.layout.size;
        read_all(source, out);
        return out;
    }
    if (accessor.contains("bufferView")) {
        const Json& view = gltf.list("bufferViews")[accessor["bufferView"].get<std::size_t>()];
        source.bytes = view_bytes(gltf, accessor);
        source.stride = view.value("byteStride", source.layout.size);
        read_all(source, out);
    }
    if (accessor.contains("sparse"))
        overlay_sparse(gltf, accessor["sparse"], source,
            gltf.root / "accessors" / index.get<std::size_t>() / "sparse", out);
    return out;
}

template std::vector<float> read_accessor(const GltfContainer&, const Json&);
template std::vector<glm::vec2> read_accessor(const GltfContainer&, const Json&);
template std::vector<glm::vec3> read_accessor(const GltfContainer&, const Json&);
template std::vector<glm::vec4> read_accessor(const GltfContainer&, const Json&);
template std::vector<glm::mat4> read_accessor(const GltfContainer&, const Json&);
template std::vector<std::uint32_t> read_accessor(const GltfContainer&, const Json&);
template std::vector<glm::u16vec4> read_accessor(const GltfContainer&, const Json&);

}  // namespace farlight
