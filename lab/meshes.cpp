// Meshes and rooms by formula.
#include "lab/meshes.h"

#include <glm/gtc/constants.hpp>
#include <random>

namespace farlight {
namespace {

glm::vec3 bumpy_point(int i, int j, int around, int along)
{
    if (j == 0 || j == along)
        return {0, j == 0 ? 1 : -1, 0};
    const double phi = 2 * glm::pi<double>() * i / around;
    const double theta = glm::pi<double>() * j / along;
    const double fade =
        std::sin(theta) * std::sin(theta);  // no bumps at the poles, where all i meet
    const double radius =
        1 + fade * (0.15 * std::sin(7 * phi) * std::sin(9 * theta) + 0.03 * std::sin(40 * phi));
    return {radius * std::sin(theta) * std::cos(phi), radius * std::cos(theta),
        -radius * std::sin(theta) * std::sin(phi)};
}

void add_quad(Scene& scene, const char* name, std::uint32_t material, const Quad& quad)
{
    scene.objects.push_back({name, material, quad});
}

/// Six squares of the first material around [-2, 2]^3 that face inwards, and a camera inside.
void add_box(Scene& scene)
{
    add_quad(scene, "floor", 0, {{-2, -2, -2}, {0, 0, 4}, {4, 0, 0}});
    add_quad(scene, "ceiling", 0, {{-2, 2, -2}, {4, 0, 0}, {0, 0, 4}});
    add_quad(scene, "left", 0, {{-2, -2, -2}, {0, 4, 0}, {0, 0, 4}});
    add_quad(scene, "right", 0, {{2, -2, -2}, {0, 0, 4}, {0, 4, 0}});
    add_quad(scene, "back", 0, {{-2, -2, -2}, {4, 0, 0}, {0, 4, 0}});
    add_quad(scene, "front", 0, {{-2, -2, 2}, {0, 4, 0}, {4, 0, 0}});
    scene.camera.position = {0, 0.3, 1.95};
    scene.camera.target = {0, 0, 0};
    scene.camera.vertical_fov_degrees = 70;
}

}  // namespace

Mesh bumpy_sphere(int around, int along, const glm::vec3& center)
{
    Mesh mesh{"bumpy sphere", {}, {}, {}};
    mesh.positions.push_back(center + bumpy_point(0, 0, around, along));
    for (int j = 1; j < along; ++j)
        for (int i = 0; i < around; ++i)
            mesh.positions.push_back(center + bumpy_point(i, j, around, along));
    mesh.positions.push_back(center + bumpy_point(0, along, around, along));
    const auto at = [&](int i, int j) -> unsigned {
        if (j == 0)
            return 0;
        if (j == along)
            return static_cast<unsigned>(mesh.positions.size()) - 1;
        return static_cast<unsigned>(1 + (j - 1) * around + i % around);
    };
    for (int j = 0; j < along; ++j)
        for (int i = 0; i < around; ++i) {
            if (j + 1 < along)
                mesh.triangles.emplace_back(at(i, j), at(i, j + 1), at(i + 1, j + 1));
            if (j > 0)
                mesh.triangles.emplace_back(at(i, j), at(i + 1, j + 1), at(i + 1, j));
        }
    return mesh;
}

Mesh triangle_soup(std::size_t count, unsigned seed)
{
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> uniform(-1, 1);
    Mesh mesh{"soup", {}, {}, {}};
    for (std::size_t i = 0; i < count; ++i) {
        const glm::vec3 center(uniform(random), uniform(random), uniform(random));
        const float size =
            0.3F * std::abs(uniform(random) * uniform(random) * uniform(random)) + 1e-3F;
        for (int k = 0; k < 3; ++k)
            mesh.positions.push_back(
                center + size * glm::vec3(uniform(random), uniform(random), uniform(random)));
        const auto first = static_cast<unsigned>(3 * i);
        mesh.triangles.emplace_back(first, first + 1, first + 2);
    }
    return mesh;
}

Scene scene_of(Mesh mesh)
{
    Scene scene;
    scene.name = mesh.name;
    scene.materials.push_back({"white"});
    scene.meshes.push_back(std::move(mesh));
    scene.objects.push_back({"mesh", 0, MeshInstance{}});
    scene.camera.position = {0, 0, 4};
    scene.camera.target = {0, 0, 0};
    return scene;
}

Scene box_of(const Material& material)
{
    Scene scene;
    scene.materials.push_back(material);
    add_box(scene);
    return scene;
}

Scene room_with(Mesh mesh)
{
    Scene scene = scene_of(std::move(mesh));
    scene.materials.push_back({"light", glm::vec3(0), glm::vec3(10)});
    add_box(scene);
    add_quad(scene, "light", 1, {{-0.5, 1.99, -0.5}, {1, 0, 0}, {0, 0, 1}});
    return scene;
}

}  // namespace farlight
