// A scene on the device and ways to render it without a server.
#pragma once

#include "server/render/live_scene.h"
#include "server/render/view.h"

#include <memory>

namespace farlight {

/// A scene on the device, ready for views.
class DeviceScene {
public:
    explicit DeviceScene(Scene s, const DeviceLimits& limits = device_limits());
    /// As the server has it, counted from its origin; `scene` then has no meshes.
    explicit DeviceScene(const LoadedScene& loaded);

    Scene scene;

private:
    std::shared_ptr<const Scene> kept_;  ///< What the device's scene refers to, unless to `scene`.
    ProgramCache programs_;
    std::shared_ptr<GpuScene> gpu_scene_;
    ScenePrograms scene_programs_;

public:
    SceneInputs inputs;  ///< What shaders that see the scene are compiled with and bound to.
    SharedScene shared;  ///< Refers to the members above.
};

/// Of a picture in linear numbers, three a pixel.
std::vector<float> values_of(const Image& image);

/// The pixel (x, y) of a linear image.
glm::vec3 pixel(const Image& image, int x, int y);

/// A request for the scene's own camera with raw linear output.
RenderRequest linear_request(const Scene& scene, Extent extent, const RenderSettings& settings);

}  // namespace farlight
