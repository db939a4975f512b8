// See the header.
#include "lab/history_oracle.h"

#include "lab/projection.h"

#include <algorithm>
#include <cmath>

namespace farlight::lab {
namespace {

bool inside(int x, int y)
{
    return x >= 0 && y >= 0 && x < kRemembered.width && y < kRemembered.height;
}

/// Whether pixel (qx, qy) of `before` shows the surface at pixel (x, y) of `now`: same thing, no
/// further from its plane than two pixel footprints, turned by no more than 26 degrees.
bool same_surface(const Seen& now, int x, int y, const Seen& before, int qx, int qy)
{
    if (!inside(qx, qy) || !met(before, qx, qy)
        || pixel(now.object, x, y) != pixel(before.object, qx, qy))
        return false;
    const glm::dvec3 here(pixel(now.position, x, y));
    const glm::dvec3 there(pixel(before.position, qx, qy));
    const double depth = project(before.camera, here, kRemembered).z;
    const double footprint =
        2 * std::tan(glm::radians(before.camera.vertical_fov_degrees) / 2) / kRemembered.height;
    const glm::dvec3 normal(pixel(now.geometric_normal, x, y));
    const double turn = glm::dot(glm::dvec3(pixel(now.shading_normal, x, y)),
        glm::dvec3(pixel(before.shading_normal, qx, qy)));
    return std::abs(glm::dot(normal, there - here)) <= 2 * footprint * depth && turn >= 0.9;
}

}  // namespace

RenderRequest request_of(const Scene& scene, const CameraPose& camera, DebugView which)
{
    RenderSettings settings;
    settings.view = which;
    settings.history_max = kLongest;
    RenderRequest request = linear_request(scene, kRemembered, settings);
    request.camera = camera;
    return request;
}

Seen seen_from(const DeviceScene& scene, const CameraPose& camera)
{
    View view(scene.shared);
    const auto picture = [&](DebugView which) {
        RenderRequest request = request_of(scene.scene, camera, which);
        request.settings.max_depth = 1;
        request.settings.denoiser = Denoiser::kOff;
        return view.render(request).image;
    };
    return {camera, picture(DebugView::kPosition), picture(DebugView::kGeometricNormal),
        picture(DebugView::kShadingNormal), picture(DebugView::kObjectId)};
}

bool met(const Seen& seen, int x, int y)
{
    return pixel(seen.shading_normal, x, y) != glm::vec3(0);
}

int& at(Lengths& lengths, int x, int y)
{
    return lengths[static_cast<std::size_t>(y) * static_cast<std::size_t>(kRemembered.width)
        + static_cast<std::size_t>(x)];
}

int length_of(const Seen& now, const Seen& before, Lengths& old, int x, int y)
{
    const glm::dvec3 past = project(before.camera, pixel(now.position, x, y), kRemembered);
    if (!met(now, x, y) || !(past.z > 0))
        return met(now, x, y) ? 1 : 0;
    if (!(std::abs(past.x) < 1e6 && std::abs(past.y) < 1e6))
        return 1;
    int least = 0;
    const auto take = [&](int qx, int qy) {
        if (same_surface(now, x, y, before, qx, qy) && at(old, qx, qy) >= 1)
            least = least == 0 ? at(old, qx, qy) : std::min(least, at(old, qx, qy));
    };
    const int left = static_cast<int>(std::floor(past.x - 0.5));
    const int top = static_cast<int>(std::floor(past.y - 0.5));
    const double fx = past.x - 0.5 - left;
    const double fy = past.y - 0.5 - top;
    for (int i = 0; i < 4; ++i) {
        const double weight = ((i & 1) != 0 ? fx : 1 - fx) * ((i >> 1) != 0 ? fy : 1 - fy);
        if (weight >= 1e-3)
            take(left + (i & 1), top + (i >> 1));
    }
    if (least == 0)
        for (int i = 0; i < 9; ++i)
            take(static_cast<int>(std::floor(past.x)) + i % 3 - 1,
                static_cast<int>(std::floor(past.y)) + i / 3 - 1);
    return std::min(least + 1, kLongest);
}

bool away_from_edges(const Seen& seen, int x, int y)
{
    for (int i = 0; i < 9; ++i) {
        const int qx = x + i % 3 - 1;
        const int qy = y + i / 3 - 1;
        if (!inside(qx, qy) || pixel(seen.object, qx, qy) != pixel(seen.object, x, y))
            return false;
    }
    return true;
}

}  // namespace farlight::lab
