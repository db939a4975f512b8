// Rays a second of our traversal against Embree's single-ray intersector, in one run, interleaved.
//
// farlight-ray-bench [--device D]: a table of primary, diffuse-bounce and shadow rays on three
// scenes. Embree runs rtcIntersect1 / rtcOccluded1 on every core; the ratio is what travels between
// machines, the rates do not.
#include "lab/embree_oracle.h"
#include "lab/meshes.h"
#include "server/gl/context.h"
#include "server/gl/program.h"
#include "server/render/camera.h"
#include "server/scene/scene_file.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <functional>
#include <random>
#include <thread>

namespace farlight {
namespace {

constexpr Extent kExtent{512, 512};
constexpr int kRounds = 7;

constexpr const char* kShader = R"(#version 450
#include "geometry/traverse.glsl"
layout(local_size_x = 8, local_size_y = 8) in;
layout(std430) buffer output_block { float results[]; };
uniform samplerBuffer rays;
void main()
{
    const int i = int(gl_GlobalInvocationID.y * gl_NumWorkGroups.x * gl_WorkGroupSize.x + gl_GlobalInvocationID.x);
    const vec4 origin = texelFetch(rays, 2 * i);
    const Ray ray = Ray(origin.xyz, texelFetch(rays, 2 * i + 1).xyz);
#ifdef SHADOW
    results[i] = any_hit(ray, origin.w) ? 1.0 : 0.0;
#else
    results[i] = closest_hit(ray, origin.w).t;
#endif
}
)";

double seconds_of(const std::function<void()>& work)
{
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double median(std::vector<double> values)
{
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

std::vector<TestRay> primary_rays(const CameraPose& pose)
{
    const auto camera = camera_constants(pose, kExtent);
    std::vector<TestRay> rays;
    for (int y = 0; y < kExtent.height; ++y)
        for (int x = 0; x < kExtent.width; ++x) {
            const glm::vec2 ndc((static_cast<float>(x) + 0.5F) / kExtent.width * 2 - 1,
                (static_cast<float>(y) + 0.5F) / kExtent.height * 2 - 1);
            rays.push_back({camera.position,
                glm::normalize(camera.forward + ndc.x * camera.right - ndc.y * camera.up)});
        }
    return rays;
}

/// From where `rays` hit: cosine-distributed, or towards random points of the light.
std::vector<TestRay> secondary_rays(
    const EmbreeOracle& embree, const std::vector<TestRay>& rays, const Quad* light, unsigned seed)
{
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> uniform(0, 1);
    std::normal_distribution<float> normal_distribution;
    std::vector<TestRay> secondary;
    for (const TestRay& ray : rays) {
        const RTCRayHit hit = embree.closest(ray);
        if (hit.hit.geomID == RTC_INVALID_GEOMETRY_ID) {
            secondary.push_back({glm::vec3(0), glm::vec3(0, 0, 1), 0});
            continue;
        }
        glm::vec3 normal = glm::normalize(glm::vec3(hit.hit.Ng_x, hit.hit.Ng_y, hit.hit.Ng_z));
        normal = glm::dot(normal, ray.direction) < 0 ? normal : -normal;
        const glm::vec3 position = ray.origin + hit.ray.tfar * ray.direction;
        const glm::vec3 from = position + 1e-5F * hit.ray.tfar * normal;
        if (light != nullptr) {
            const glm::vec3 to = glm::vec3(light->corner)
                + uniform(random) * glm::vec3(light->edge_u)
                + uniform(random) * glm::vec3(light->edge_v) - from;
            secondary.push_back({from, glm::normalize(to), 0.999F * glm::length(to)});
        } else {
            const glm::vec3 u(normal_distribution(random), normal_distribution(random),
                normal_distribution(random));
            secondary.push_back({from, glm::normalize(normal + 0.999F * glm::normalize(u))});
        }
    }
    return secondary;
}

/// Both in turn, `kRounds` times; prints rates and the median of the rounds' ratios.
void compare(const char* scene, const char* kind, const EmbreeOracle& embree,
    const GpuScene& gpu_scene, const std::vector<TestRay>& rays, bool shadow)
{
    Defines defines = gpu_scene.defines();
    if (shadow)
        defines.emplace_back("SHADOW", "1");
    const Program program(load_shader_source("bench/rays", defines));
    std::vector<glm::vec4> texels;
    for (const TestRay& ray : rays) {
        texels.emplace_back(ray.origin, ray.t_max);
        texels.emplace_back(ray.direction, 0);
    }
    Buffer buffer("rays", std::as_bytes(std::span<const glm::vec4>(texels)));
    const std::vector<float> zero(rays.size());
    const Buffer output("output", std::as_bytes(std::span<const float>(zero)));
    glUseProgram(program.id());
    for (const auto& [name, variable] : program.uniforms())
        glBindTextureUnit(static_cast<GLuint>(variable.unit),
            name == "rays" ? buffer.texture(GL_RGBA32F) : gpu_scene.textures().at(name));
    glBindBufferBase(
        GL_SHADER_STORAGE_BUFFER, program.storage_blocks().at("output_block"), output.id());

    const unsigned cores = std::max(1U, std::thread::hardware_concurrency());
    const auto on_device = [] {
        glDispatchCompute(kExtent.width / 8, kExtent.height / 8, 1);
        glFinish();
    };
    const auto on_host = [&] {
        std::vector<std::thread> threads;
        for (unsigned t = 0; t < cores; ++t)
            threads.emplace_back([&, t] {
                for (std::size_t i = rays.size() * t / cores; i < rays.size() * (t + 1) / cores;
                     ++i)
                    if (shadow)
                        static_cast<void>(embree.any(rays[i]));
                    else
                        static_cast<void>(embree.closest(rays[i]));
            });
        for (std::thread& thread : threads)
            thread.join();
    };
    on_device();
    std::vector<double> ours;
    std::vector<double> theirs;
    std::vector<double> ratios;
    for (int round = 0; round < kRounds; ++round) {
        const double host = seconds_of(on_host);
        const double device = seconds_of(on_device);
        const double count = static_cast<double>(rays.size()) * 1e-6;
        theirs.push_back(count / host);
        ours.push_back(count / device);
        ratios.push_back(host / device);
    }
    std::printf("%-22s %-15s %8.2f %8.2f %8.2f\n", scene, kind, median(theirs), median(ours),
        median(ratios));
}

void bench(const char* name, const Scene& scene)
{
    const PackedScene packed = pack_scene(scene);
    const EmbreeOracle embree(packed);
    const GpuScene gpu_scene(scene);
    const Quad* light = nullptr;
    for (const Object& object : scene.objects)
        if (const auto* quad = std::get_if<Quad>(&object.shape);
            quad != nullptr && scene.materials[object.material].emission.x > 0)
            light = quad;
    const std::vector<TestRay> primary = primary_rays(scene.camera);
    compare(name, "primary", embree, gpu_scene, primary, false);
    compare(name, "diffuse bounce", embree, gpu_scene, secondary_rays(embree, primary, nullptr, 1),
        false);
    compare(name, "shadow", embree, gpu_scene, secondary_rays(embree, primary, light, 2), true);
}

int run(int argc, char** argv)
{
    const Context context(argc == 3 && std::string_view(argv[1]) == "--device" ? argv[2] : "auto");
    shader_files()["bench/rays"] = kShader;
    std::printf("%s, Embree on %u cores; millions of rays a second, median of %d\n%-22s %-15s %8s "
                "%8s %8s\n",
        context.device().name.c_str(), std::thread::hardware_concurrency(), kRounds, "scene",
        "rays", "Embree", "ours", "ratio");
    bench("Cornell box", load_scene(std::string(FARLIGHT_SOURCE_DIR) + "/scenes/cornell_box.json"));
    bench("70,000 triangles", room_with(bumpy_sphere(250, 141)));
    bench("1,000,000 triangles", room_with(bumpy_sphere(1000, 501)));
    return 0;
}

}  // namespace
}  // namespace farlight

int main(int argc, char** argv)
{
    try {
        return farlight::run(argc, argv);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "farlight-ray-bench: %s\n", error.what());
        return 2;
    }
}
