// Walks the runs without keeping what they say.
// Source: Ward, "Real Pixels", Graphics Gems II, 1991; the run-length format of Radiance 2.0.
#include "server/scene/hdr_check.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace farlight {

namespace {

using Bytes = std::span<const unsigned char>;

/// What follows the empty line after the header and the line of the resolution.
Bytes texels_of(Bytes file)
{
    constexpr std::array<unsigned char, 2> kEmptyLine{'\n', '\n'};
    const auto header = std::search(file.begin(), file.end(), kEmptyLine.begin(), kEmptyLine.end());
    if (header == file.end())
        return {};
    const auto line = std::find(header + 2, file.end(), '\n');
    return line == file.end() ? Bytes{} : Bytes(line + 1, file.end());
}

/// Takes the runs of one channel of a scanline off the front.
bool skip_channel(Bytes& rest, int width)
{
    while (width > 0) {
        if (rest.empty())
            return false;
        const int code = rest[0];
        const int count = code > 128 ? code - 128 : code;
        const std::size_t bytes = code > 128 ? 2 : 1 + static_cast<std::size_t>(count);
        if (count == 0 || count > width || bytes > rest.size())
            return false;
        rest = rest.subspan(bytes);
        width -= count;
    }
    return true;
}

bool is_run_length_coded(Bytes scanline, int width)
{
    constexpr int kLeast = 8;
    constexpr int kMost = 32767;  // of the format
    return width >= kLeast && width <= kMost && scanline.size() >= 4 && scanline[0] == 2
        && scanline[1] == 2 && scanline[2] < 128;
}

}  // namespace

bool hdr_is_complete(Bytes file, int width, int height)
{
    Bytes rest = texels_of(file);
    if (!is_run_length_coded(rest, width))
        return rest.size() / 4 / static_cast<std::size_t>(width)
            >= static_cast<std::size_t>(height);
    for (int line = 0; line < height; ++line) {
        if (!is_run_length_coded(rest, width))
            return false;
        rest = rest.subspan(4);
        for (int channel = 0; channel < 4; ++channel)
            if (!skip_channel(rest, width))
                return false;
    }
    return true;
}

}  // namespace farlight
