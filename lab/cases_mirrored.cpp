// A mirrored scene gives the mirrored picture: nothing in a frame knows left from right.
#include "lab/device_scene.h"
#include "lab/groups.h"
#include "lab/meshes.h"

#include <algorithm>
#include <cmath>

namespace farlight::lab {
namespace {

constexpr Extent kMirrored{64, 48};
constexpr int kFramesAlong = 6;

/// A stone, a ball and a post before a wall, lit by a point so that nothing is left to chance.
Scene things_in_a_row()
{
    Scene scene = scene_of(bumpy_sphere(24, 14));
    scene.objects.push_back({"floor", 0, Quad{{-5, -1.3, 3}, {10, 0, 0}, {0, 0, -6}}});
    scene.objects.push_back({"wall", 0, Quad{{-5, -1.3, -2}, {10, 0, 0}, {0, 5, 0}}});
    scene.objects.push_back({"ball", 0, Sphere{{1.5, -0.6, 0.5}, 0.6}});
    scene.objects.push_back({"post", 0, Quad{{-1.7, -1.3, 1}, {0.3, 0, 0}, {0, 2, 0}}});
    PunctualLight lamp;
    lamp.name = "lamp";
    lamp.intensity = glm::vec3(20);
    lamp.position = {1, 3, 3};
    scene.lights.push_back(lamp);
    scene.camera = {{0.3, 0.4, 5}, {0.1, 0, 0}, {0, 1, 0}, 45};
    return scene;
}

glm::dvec3 mirror(const glm::dvec3& p)
{
    return {-p.x, p.y, p.z};
}

/// Left and right exchanged; edges of quads too, so that their normals are mirrored.
Scene mirrored(Scene scene)
{
    glm::dmat4 matrix(1);
    matrix[0][0] = -1;
    for (Object& object : scene.objects)
        if (auto* instance = std::get_if<MeshInstance>(&object.shape))
            instance->world_from_object = matrix * instance->world_from_object;
        else if (auto* sphere = std::get_if<Sphere>(&object.shape))
            sphere->center = mirror(sphere->center);
        else if (auto* quad = std::get_if<Quad>(&object.shape))
            *quad = {mirror(quad->corner), mirror(quad->edge_v), mirror(quad->edge_u)};
    for (PunctualLight& light : scene.lights)
        light.position = mirror(light.position);
    scene.camera.position = mirror(scene.camera.position);
    scene.camera.target = mirror(scene.camera.target);
    return scene;
}

/// The last frame of a camera that goes to its right by `step` a frame.
Image last_frame(const DeviceScene& scene, DebugView which, double step)
{
    View view(scene.shared);
    RenderSettings settings;
    settings.max_depth = 2;
    settings.view = which;
    RenderRequest request = linear_request(scene.scene, kMirrored, settings);
    Image image;
    for (int i = 0; i < kFramesAlong; ++i) {
        image = view.render(request).image;
        request.camera.position.x += step;
        request.camera.target.x += step;
    }
    return image;
}

/// Of every pixel and its mirror image.
template <typename Difference>
double most_apart(const Image& image, const Image& other, const Difference& difference)
{
    double most = 0;
    for (int y = 0; y < kMirrored.height; ++y)
        for (int x = 0; x < kMirrored.width; ++x)
            most = farther(most,
                static_cast<double>(
                    difference(pixel(image, x, y), pixel(other, kMirrored.width - 1 - x, y))));
    return most;
}

void mirrored_scene(Findings& findings, Length /*length*/)
{
    const DeviceScene scene(things_in_a_row());
    const DeviceScene other(mirrored(things_in_a_row()));
    const auto compare = [&](DebugView which, const auto& difference) {
        return most_apart(
            last_frame(scene, which, 0.04), last_frame(other, which, -0.04), difference);
    };
    findings.at_most("depth [of it]",
        compare(DebugView::kDepth,
            [](glm::vec3 a, glm::vec3 b) { return a.x == b.x ? 0 : std::abs(a.x / b.x - 1); }),
        1e-6);
    findings.at_most("motion [px]",
        compare(DebugView::kMotion,
            [](glm::vec3 a, glm::vec3 b) { return glm::length(glm::vec2(a.x + b.x, a.y - b.y)); }),
        1e-4);
    findings.none("frames of history",
        compare(DebugView::kHistoryLength,
            [](glm::vec3 a, glm::vec3 b) { return std::abs(a.x - b.x); }));
    const Image final = last_frame(scene, DebugView::kFinal, 0.04);
    double brightest = 0;
    for (const float value : values_of(final))
        brightest = farther(brightest, value);
    findings.at_most("denoised picture [of its brightest value]",
        compare(DebugView::kFinal, [](glm::vec3 a, glm::vec3 b) { return std::abs(a.y - b.y); })
            / brightest,
        1e-4);
}

constexpr Case kMirroredCases[] = {
    {"M7b", "mirrored", "mirrored scene", Layer::kSequence,
        "A mirrored scene under a mirrored camera that moves has mirrored depths, motion, "
        "histories "
        "and pictures.",
        mirrored_scene},
};

constexpr Guard kMirroredGuards[] = {
    {"edge_of_past", "M7 M7b", "lib/frame.glsl",
        "all(lessThan(px, ivec2(frame.prev_camera.width, frame.prev_camera.height)))",
        "all(lessThan(px + 1, ivec2(frame.prev_camera.width, frame.prev_camera.height)))"},
};

}  // namespace

Group mirrored_group()
{
    return {kMirroredCases, kMirroredGuards};
}

}  // namespace farlight::lab
