// glTF component and element types: the codes of the specification, section 3.6.2.2.
#pragma once

#include <cstddef>
#include <string_view>

namespace farlight {

inline constexpr int kByte = 5120;
inline constexpr int kUnsignedByte = 5121;
inline constexpr int kShort = 5122;
inline constexpr int kUnsignedShort = 5123;
inline constexpr int kUnsignedInt = 5125;
inline constexpr int kFloat = 5126;

/// Bytes of one component.
constexpr std::size_t component_size(int component_type)
{
    switch (component_type) {
    case kByte:
    case kUnsignedByte: return 1;
    case kShort:
    case kUnsignedShort: return 2;
    default: return 4;
    }
}

/// Components of an element: 1 for "SCALAR", 2 to 4 for vectors, 0 for matrices.
constexpr std::size_t lane_count(std::string_view type)
{
    if (type == "SCALAR")
        return 1;
    return type.starts_with("VEC") ? static_cast<std::size_t>(type.back() - '0') : 0;
}

}  // namespace farlight
