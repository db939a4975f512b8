// The process-wide test context.
#include "tests/support/gl_test.h"

#include "server/scene/neutral.h"

#include <cstring>

namespace farlight {
namespace {

Scene without_neutral(Scene scene)
{
    drop_neutral(scene);
    return scene;
}

SharedScene share(ProgramCache& programs, const GpuScene& gpu_scene, const Scene& scene)
{
    return {programs, {gpu_scene.textures(), gpu_scene.defines()}, look_of(scene), true, true};
}

}  // namespace

TestScene::TestScene(Scene s)
    : scene(without_neutral(std::move(s)))
    , gpu_scene_(scene)
    , shared(share(programs_, gpu_scene_, scene))
{
}

void GlTest::SetUpTestSuite()
{
    static const Context context("software");
}

Scene GlTest::shipped_scene(const std::string& name)
{
    return load_scene(std::string(FARLIGHT_SOURCE_DIR) + "/scenes/" + name);
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
