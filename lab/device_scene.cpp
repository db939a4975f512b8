// See the header.
#include "lab/device_scene.h"

#include "server/scene/neutral.h"

#include <cstring>

namespace farlight {
namespace {

Scene without_neutral(Scene scene)
{
    drop_neutral(scene);
    return scene;
}

}  // namespace

DeviceScene::DeviceScene(Scene s, const DeviceLimits& limits)
    : scene(without_neutral(std::move(s)))
    , gpu_scene_(std::make_shared<GpuScene>(scene, limits))
    , scene_programs_(programs_, nullptr, nullptr, {})
    , inputs{gpu_scene_->textures(), gpu_scene_->defines()}
    , shared{programs_, scene_programs_, look_of(scene),
          static_cast<std::uint32_t>(gpu_scene_->light_count()), true, true}
{
    shared.gpu = gpu_scene_.get();
    scene_programs_.follow(gpu_scene_);
}

DeviceScene::DeviceScene(const LoadedScene& loaded)
    : scene(*loaded.scene)
    , kept_(loaded.scene)
    , gpu_scene_(loaded.gpu)
    , scene_programs_(programs_, nullptr, nullptr, {})
    , inputs{gpu_scene_->textures(), gpu_scene_->defines()}
    , shared{programs_, scene_programs_, loaded.look,
          static_cast<std::uint32_t>(gpu_scene_->light_count()), true, true}
{
    shared.gpu = gpu_scene_.get();
    scene_programs_.follow(gpu_scene_);
}

std::vector<float> values_of(const Image& image)
{
    std::vector<float> values(image.bytes.size() / sizeof(float));
    std::memcpy(values.data(), image.bytes.data(), image.bytes.size());
    return values;
}

glm::vec3 pixel(const Image& image, int x, int y)
{
    glm::vec3 value;
    const auto at = static_cast<std::size_t>(y * image.extent.width + x) * sizeof value;
    std::memcpy(&value, &image.bytes[at], sizeof value);
    return value;
}

RenderRequest linear_request(const Scene& scene, Extent extent, const RenderSettings& settings)
{
    RenderRequest request;
    request.camera = scene.camera;
    request.extent = extent;
    request.settings = settings;
    request.format = PixelFormat::kRgb32f;
    return request;
}

}  // namespace farlight
