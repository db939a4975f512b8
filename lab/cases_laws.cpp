// Laws that need no reference: what is done to the scene must be done to the picture, or not be
// seen.
#include "lab/device_scene.h"
#include "lab/groups.h"
#include "lab/meshes.h"
#include "lab/rendering.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

namespace farlight::lab {
namespace {

constexpr Extent kLawExtent{48, 40};

/// A closed room with a bumpy stone, a glossy ball and a lamp: diffuse and specular light, direct
/// and indirect.
Scene room()
{
    Scene scene = room_with(bumpy_sphere(24, 14));
    Material gloss{"gloss", glm::vec3(0.7F, 0.5F, 0.3F)};
    gloss.metallic = 1;
    gloss.roughness = 0.3F;
    scene.materials.push_back(gloss);
    scene.objects.push_back({"ball", static_cast<std::uint32_t>(scene.materials.size() - 1),
        Sphere{{1.3, -1.4, 0.4}, 0.6}});
    return scene;
}

struct Drawn {
    Image image;  ///< Linear.
    double nonfinite = 0;  ///< Values that were not finite, in all frames.
};

/// Frame `frames` of a camera that dollies in.
Drawn draw(const Scene& scene, Denoiser denoiser, int frames, int samples = 1)
{
    const DeviceScene on_device(scene);
    View view(on_device.shared);
    RenderSettings settings;
    settings.denoiser = denoiser;
    settings.samples_per_pixel = samples;
    RenderRequest request = linear_request(scene, kLawExtent, settings);
    const glm::dvec3 way = request.camera.target - request.camera.position;
    const bool moves = denoiser != Denoiser::kAccumulate;
    Drawn drawn;
    for (int i = 0; i < frames; ++i) {
        RenderedFrame frame = view.render(request);
        drawn.image = std::move(frame.image);
        drawn.nonfinite += frame.bad_values.all();
        if (moves)
            request.camera.position += 0.004 * way;
    }
    return drawn;
}

/// Pixels' channels of b that are not `factor` times those of a, bit by bit.
double unlike(const Image& a, const Image& b, float factor = 1)
{
    const std::vector<float> x = values_of(a);
    const std::vector<float> y = values_of(b);
    double count = 0;
    for (std::size_t i = 0; i < x.size(); ++i)
        count += x[i] * factor == y[i] ? 0 : 1;
    return count;
}

void brighter_lamps(Findings& findings, Length /*length*/)
{
    const Scene scene = room();
    const Image picture = draw(scene, Denoiser::kSvgf, 6).image;
    for (const int k : {-20, -10, 10, 20}) {
        Scene brighter = scene;
        for (Material& material : brighter.materials)
            material.emission *= std::ldexp(1.0F, k);
        findings.none("values unlike 2^" + std::to_string(k) + " times those of before",
            unlike(picture, draw(brighter, Denoiser::kSvgf, 6).image, std::ldexp(1.0F, k)));
    }
}

void unused_things(Findings& findings, Length /*length*/)
{
    const Scene scene = room();
    Scene more = scene;
    Material mirror{"unused mirror"};
    mirror.metallic = 1;
    mirror.roughness = 0;
    mirror.transmission = 0.5F;
    more.materials.push_back(mirror);
    // Of the mirror, but there is nothing to draw of it.
    more.meshes.push_back({"nothing", {}, {}, {}});
    more.objects.push_back({"nothing", static_cast<std::uint32_t>(more.materials.size() - 1),
        MeshInstance{static_cast<std::uint32_t>(more.meshes.size() - 1)}});
    more.objects.push_back({"outside", 0, Sphere{{0, 0, -9}, 0.5}});
    const DeviceScene before(scene);
    const DeviceScene after(more);
    findings.none("effects that an unused material calls for",
        before.inputs.defines == after.inputs.defines ? 0 : 1);
    findings.none("values that something outside a closed room changes",
        unlike(draw(scene, Denoiser::kSvgf, 4).image, draw(more, Denoiser::kSvgf, 4).image));
}

/// Everything, the camera too, turned by a quarter about y: exact in floating point.
Scene turned(Scene scene)
{
    const auto turn = [](const glm::dvec3& p) { return glm::dvec3(p.z, p.y, -p.x); };
    glm::dmat4 matrix(0);
    matrix[0] = {0, 0, -1, 0};
    matrix[1] = {0, 1, 0, 0};
    matrix[2] = {1, 0, 0, 0};
    matrix[3] = {0, 0, 0, 1};
    for (Object& object : scene.objects)
        if (auto* instance = std::get_if<MeshInstance>(&object.shape))
            instance->world_from_object = matrix * instance->world_from_object;
        else if (auto* sphere = std::get_if<Sphere>(&object.shape))
            sphere->center = turn(sphere->center);
        else if (auto* quad = std::get_if<Quad>(&object.shape))
            *quad = {turn(quad->corner), turn(quad->edge_u), turn(quad->edge_v)};
    scene.camera.position = turn(scene.camera.position);
    scene.camera.target = turn(scene.camera.target);
    return scene;
}

void expect_the_same_mean(Findings& findings, const Scene& a, const Scene& b)
{
    const Drawn one = draw(a, Denoiser::kAccumulate, 8, 16);
    const Drawn other = draw(b, Denoiser::kAccumulate, 8, 16);
    findings.none("values that are not finite", one.nonfinite + other.nonfinite);
    report_agreement(findings, "of 128 samples: ", agreement_of(one.image, other.image), 0.01);
}

void turned_scene(Findings& findings, Length /*length*/)
{
    expect_the_same_mean(findings, room(), turned(room()));
}

/// The lamp in four parts, beside and behind each other, and the stone's triangles in four each.
Scene split(Scene scene)
{
    std::vector<Object> objects;
    for (const Object& object : scene.objects) {
        const Quad* quad = std::get_if<Quad>(&object.shape);
        if (quad == nullptr || object.name != "light") {
            objects.push_back(object);
            continue;
        }
        for (const glm::dvec2 part :
            {glm::dvec2(0, 0), glm::dvec2(1, 0), glm::dvec2(0, 1), glm::dvec2(1, 1)}) {
            const glm::dvec3 u = quad->edge_u * 0.5;
            const glm::dvec3 v = quad->edge_v * 0.5;
            Object one = object;
            one.shape = Quad{quad->corner + u * part.x + v * part.y, u, v};
            objects.push_back(one);
        }
    }
    scene.objects = std::move(objects);
    for (Mesh& mesh : scene.meshes) {
        std::vector<glm::uvec3> triangles;
        for (const glm::uvec3& t : mesh.triangles) {
            const auto first = static_cast<unsigned>(mesh.positions.size());
            for (int k = 0; k < 3; ++k)
                mesh.positions.push_back(
                    0.5F * (mesh.positions[t[k]] + mesh.positions[t[(k + 1) % 3]]));
            triangles.insert(triangles.end(),
                {{t[0], first, first + 2}, {first, t[1], first + 1}, {first + 2, first + 1, t[2]},
                    {first, first + 1, first + 2}});
        }
        mesh.triangles = std::move(triangles);
    }
    return scene;
}

void split_lamps_and_triangles(Findings& findings, Length /*length*/)
{
    expect_the_same_mean(findings, room(), split(room()));
}

constexpr Case kLawCases[] = {
    {"M3", "laws", "turned scene", Layer::kPicture,
        "A scene that is turned by a quarter with its camera has the same mean.", turned_scene},
    {"M5", "laws", "split lamps and triangles", Layer::kPicture,
        "A lamp in four parts and triangles in four each leave the mean as it is.",
        split_lamps_and_triangles},
    {"M6", "laws", "brighter lamps", Layer::kSequence,
        "Radiance times 2^k makes the denoised, moving picture times 2^k, bit by bit.",
        brighter_lamps},
    {"M8", "laws", "unused things", Layer::kSequence,
        "An unused material, an object of it without a triangle and something outside a closed "
        "room change no bit and call for nothing.",
        unused_things},
};

constexpr Guard kLawGuards[] = {
    {"basis_sign", "M3", "lib/sampling.glsl", "const float s = n.z >= 0.0 ? 1.0 : -1.0;",
        "const float s = 1.0;"},
    {"only_the_drawn_calls", "M8"},
    {"relative_luminance_floor", "M6", "svgf/atrous.comp", "+ 1e-6 * luminance_p + 1e-37)",
        "+ 1e-6)"},
    {"area_in_light_density", "M5", "lights/area.glsl",
        "return distance2 * sqrt(distance2) / (area * abs(dot(normal, way)));",
        "return distance2 * sqrt(distance2) / abs(dot(normal, way));"},
};

}  // namespace

Group laws_group()
{
    return {kLawCases, kLawGuards};
}

}  // namespace farlight::lab
