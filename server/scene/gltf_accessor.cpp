// Reading bytes that check_gltf() found in range.
#include "server/scene/gltf_accessor.h"

#include "server/scene/gltf_component.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <tiny_gltf.h>

namespace farlight {

namespace {

template <typename Component> double component_as(const unsigned char* bytes, bool normalized)
{
    Component value;
    std::memcpy(&value, bytes, sizeof(value));
    if constexpr (std::numeric_limits<Component>::is_integer)
        if (normalized)  // the most negative integer stands for -1 too
            return std::max(
                static_cast<double>(value) / std::numeric_limits<Component>::max(), -1.0);
    return value;
}

double component(const unsigned char* bytes, int type, bool normalized)
{
    switch (type) {
    case kByte: return component_as<std::int8_t>(bytes, normalized);
    case kUnsignedByte: return component_as<std::uint8_t>(bytes, normalized);
    case kShort: return component_as<std::int16_t>(bytes, normalized);
    case kUnsignedShort: return component_as<std::uint16_t>(bytes, normalized);
    case kUnsignedInt: return component_as<std::uint32_t>(bytes, normalized);
    default: return component_as<float>(bytes, normalized);
    }
}

/// Elements of Vector (3 floats or 1 index) lying `stride` apart from `bytes`.
struct Elements {
    const unsigned char* bytes;
    std::size_t stride;
    int component_type;
    bool normalized;

    void read(std::size_t i, glm::vec3& out) const
    {
        const auto size = component_size(component_type);
        for (int lane = 0; lane < 3; ++lane)
            out[lane] = static_cast<float>(
                component(bytes + i * stride + static_cast<std::size_t>(lane) * size,
                    component_type, normalized));
    }
    void read(std::size_t i, std::uint32_t& out) const
    {
        out = static_cast<std::uint32_t>(component(bytes + i * stride, component_type, false));
    }
};

const unsigned char* view_bytes(
    const tinygltf::Model& model, int buffer_view, std::size_t byte_offset)
{
    const auto& view = model.bufferViews[static_cast<std::size_t>(buffer_view)];
    return model.buffers[static_cast<std::size_t>(view.buffer)].data.data() + view.byteOffset
        + byte_offset;
}

template <typename Element>
std::vector<Element> read_elements(const tinygltf::Model& model, int index, std::size_t lanes)
{
    const auto& accessor = model.accessors[static_cast<std::size_t>(index)];
    const std::size_t packed = lanes * component_size(accessor.componentType);
    std::vector<Element> out(accessor.count, Element(0));
    if (accessor.bufferView >= 0) {
        const auto& view = model.bufferViews[static_cast<std::size_t>(accessor.bufferView)];
        const Elements elements{view_bytes(model, accessor.bufferView, accessor.byteOffset),
            view.byteStride == 0 ? packed : view.byteStride, accessor.componentType,
            accessor.normalized};
        for (std::size_t i = 0; i < out.size(); ++i)
            elements.read(i, out[i]);
    }
    if (!accessor.sparse.isSparse)
        return out;
    const auto& sparse = accessor.sparse;
    const Elements places{view_bytes(model, sparse.indices.bufferView,
                              static_cast<std::size_t>(sparse.indices.byteOffset)),
        component_size(sparse.indices.componentType), sparse.indices.componentType, false};
    const Elements values{view_bytes(model, sparse.values.bufferView,
                              static_cast<std::size_t>(sparse.values.byteOffset)),
        packed, accessor.componentType, accessor.normalized};
    for (std::size_t i = 0; i < static_cast<std::size_t>(sparse.count); ++i) {
        std::uint32_t place = 0;
        places.read(i, place);
        if (place < out.size())
            values.read(i, out[place]);
    }
    return out;
}

}  // namespace

std::vector<glm::vec3> read_vectors(const tinygltf::Model& model, int accessor)
{
    return read_elements<glm::vec3>(model, accessor, 3);
}

std::vector<std::uint32_t> read_indices(const tinygltf::Model& model, int accessor)
{
    return read_elements<std::uint32_t>(model, accessor, 1);
}

}  // namespace farlight
