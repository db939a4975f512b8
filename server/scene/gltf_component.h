// glTF component and element types: the codes and layouts of the specification, section 3.6.2.
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

/// How an accessor's element lies in bytes: a vector is a matrix of one column.
struct ElementLayout {
    std::size_t columns;
    std::size_t rows;
    std::size_t column_stride;  ///< [byte]; a matrix's columns start at multiples of 4.
    std::size_t size;  ///< [byte]

    constexpr std::size_t lanes() const { return columns * rows; }
};

/// `type` is "SCALAR", "VEC2" to "VEC4" or "MAT2" to "MAT4".
constexpr ElementLayout element_layout(std::string_view type, int component_type)
{
    const std::size_t digit = type == "SCALAR" ? 1 : static_cast<std::size_t>(type.back() - '0');
    const std::size_t column = digit * component_size(component_type);
    if (!type.starts_with("MAT"))
        return {1, digit, column, column};
    const std::size_t stride = (column + 3) / 4 * 4;
    return {digit, digit, stride, stride * (digit - 1) + column};
}

}  // namespace farlight
