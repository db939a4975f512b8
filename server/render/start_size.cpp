// The ladder of start sizes and the measurement that picks one.
#include "server/render/start_size.h"

#include <algorithm>
#include <array>

namespace farlight {

Extent largest_extent_within(double ms_per_pixel, double budget_ms)
{
    // Multiples of 16 wide, exactly 16:9.
    for (int width = 1280; width > 128; width -= 16) {
        const Extent extent{width, width * 9 / 16};
        if (ms_per_pixel * extent.width * extent.height <= budget_ms)
            return extent;
    }
    return {128, 72};
}

Extent start_extent(
    const SharedScene& scene, const CameraPose& camera, const RenderSettings& settings)
{
    constexpr Extent kProbe{192, 108};
    constexpr double kBudgetMs = 80;
    View view(scene);
    RenderRequest request;
    request.camera = camera;
    request.settings = settings;
    request.extent = kProbe;
    view.render(request);  // compiles the shaders
    std::array<double, 5> times{};
    for (double& ms : times) {
        const RenderedFrame frame = view.render(request);
        ms = frame.trace_ms + frame.denoise_ms;
    }
    std::sort(times.begin(),
        times.end());  // the median: other programs may take the machine for a moment
    return largest_extent_within(
        times[times.size() / 2] / (kProbe.width * kProbe.height), kBudgetMs);
}

}  // namespace farlight
