// Limits in path segments and bytes, and the words of a refusal.
#include "server/render/frame_limits.h"

#include <unistd.h>

namespace farlight {
std::string too_much_work(const RenderRequest& request)
{
    const RenderSettings& s = request.settings;
    const double segments = static_cast<double>(request.extent.width) * request.extent.height
        * static_cast<double>(s.resolution_scale) * static_cast<double>(s.resolution_scale)
        * s.samples_per_pixel * s.max_depth;
    if (segments <= kMostSegments)
        return {};
    return "a frame of " + std::to_string(request.extent.width) + "x"
        + std::to_string(request.extent.height) + " with " + std::to_string(s.samples_per_pixel)
        + " samples a pixel and " + std::to_string(s.max_depth)
        + " segments is more than 1e9 path segments: ask for fewer samples a frame";
}

std::size_t memory_for_views(std::size_t chosen, bool software)
{
    if (chosen != 0)
        return chosen;
    const auto physical = static_cast<std::size_t>(sysconf(_SC_PHYS_PAGES))
        * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
    return software ? physical / 2 : std::size_t{8} << 30;
}

std::string too_little_memory(
    Extent extent, std::size_t wanted, std::size_t taken, std::size_t for_all)
{
    return "a picture of " + std::to_string(extent.width) + "x" + std::to_string(extent.height)
        + " needs " + std::to_string(wanted >> 20) + " MiB, but of the "
        + std::to_string(for_all >> 20) + " MiB for all clients only "
        + std::to_string((for_all - taken) >> 20) + " MiB are left";
}

}  // namespace farlight
