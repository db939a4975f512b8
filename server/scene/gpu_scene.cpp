// Flattening objects to world space, ordering them by the tree, uploading.
#include "server/scene/gpu_scene.h"

#include "server/gl/gl_error.h"
#include "server/scene/materials.h"
#include "shaders/shared/scene_layout.h"

#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_inverse.hpp>
#include <glm/gtc/packing.hpp>

namespace farlight {
namespace {

glm::uvec4 texel(const glm::vec3& xyz, std::uint32_t w)
{
    return {glm::floatBitsToUint(xyz), w};
}
std::uint32_t bits(float value)
{
    return glm::floatBitsToUint(value);
}

/// Octahedral unit vector in two 16-bit signed normalised numbers; zero vectors become +z.
/// Source: Cigolle et al. 2014, "A Survey of Efficient Representations for Independent Unit
/// Vectors".
std::uint32_t pack_octahedral(const glm::vec3& n)
{
    const float sum = std::abs(n.x) + std::abs(n.y) + std::abs(n.z);
    if (!(sum > 0))
        return glm::packSnorm2x16({0, 0});
    glm::vec2 p = glm::vec2(n) / sum;
    if (n.z < 0)
        p = (1.0F - glm::abs(glm::vec2(p.y, p.x)))
            * glm::vec2(p.x >= 0 ? 1 : -1, p.y >= 0 ? 1 : -1);
    return glm::packSnorm2x16(p);
}

/// A primitive before the tree has put it in order.
struct FlatTriangle {
    std::array<glm::vec3, 3> vertices;
    std::array<glm::vec3, 3> normals;
    std::uint32_t object;
    std::uint32_t light = 0;  ///< Index + 1.
    bool smooth = false;
};

struct FlatSphere {
    glm::vec3 center;
    float radius;
    std::uint32_t object;
    std::uint32_t light = 0;
};

/// Collects what the objects consist of, in world space.
class Flattener {
public:
    explicit Flattener(const Scene& scene) : scene_(scene)
    {
        for (std::uint32_t i = 0; i < scene.objects.size(); ++i) {
            object_ = i;
            std::visit([this](const auto& shape) { add(shape); }, scene.objects[i].shape);
        }
        if (!lights.empty())
            fill_alias_table(lights);
    }

    std::vector<FlatTriangle> triangles;
    std::vector<FlatSphere> spheres;
    std::vector<Light> lights;
    std::size_t dropped = 0;

private:
    void add(const Sphere& sphere)
    {
        const auto radius = static_cast<float>(sphere.radius);
        Light light{.kind = LIGHT_SPHERE, .p0 = glm::vec3(sphere.center), .edge_u = {radius, 0, 0}};
        light.area = static_cast<float>(4 * glm::pi<double>() * sphere.radius * sphere.radius);
        spheres.push_back({glm::vec3(sphere.center), radius, object_, add_light(light)});
    }

    void add(const Quad& quad)
    {
        const auto p0 = glm::vec3(quad.corner);
        const auto u = glm::vec3(quad.corner + quad.edge_u);
        const auto v = glm::vec3(quad.corner + quad.edge_v);
        const auto uv = glm::vec3(quad.corner + quad.edge_u + quad.edge_v);
        Light light{.kind = LIGHT_QUAD, .p0 = p0, .edge_u = u - p0, .edge_v = v - p0};
        light.area = glm::length(glm::cross(light.edge_u, light.edge_v));
        const std::uint32_t index = add_light(light);
        add_triangle({{p0, u, uv}, {}, object_, index});
        add_triangle({{p0, uv, v}, {}, object_, index});
    }

    void add(const Disk& /*disk*/) { }

    void add(const MeshInstance& instance)
    {
        const Mesh& mesh = scene_.meshes[instance.mesh];
        const glm::dmat3 normal_matrix =
            glm::inverseTranspose(glm::dmat3(instance.world_from_object));
        const bool flipped = glm::determinant(glm::dmat3(instance.world_from_object)) < 0;
        for (const glm::uvec3& corners : mesh.triangles) {
            FlatTriangle triangle{{}, {}, object_};
            triangle.smooth = !mesh.normals.empty();
            for (int k = 0; k < 3; ++k) {
                // A mirroring transform turns the winding round: swap it back so that outside stays
                // outside.
                const std::uint32_t corner = corners[flipped && k > 0 ? 3 - k : k];
                const auto at = static_cast<std::size_t>(k);
                triangle.vertices[at] =
                    glm::vec3(instance.world_from_object * glm::dvec4(mesh.positions[corner], 1));
                if (triangle.smooth)
                    triangle.normals[at] =
                        glm::vec3(glm::normalize(normal_matrix * glm::dvec3(mesh.normals[corner])));
            }
            if (!drop_if_degenerate(triangle)) {
                const auto& [a, b, c] = triangle.vertices;
                Light light{.kind = LIGHT_TRIANGLE, .p0 = a, .edge_u = b - a, .edge_v = c - a};
                light.area = 0.5F * glm::length(glm::cross(light.edge_u, light.edge_v));
                triangle.light = add_light(light);
                triangles.push_back(triangle);
            }
        }
    }

    void add_triangle(const FlatTriangle& triangle)
    {
        if (!drop_if_degenerate(triangle))
            triangles.push_back(triangle);
    }

    bool drop_if_degenerate(const FlatTriangle& triangle)
    {
        const auto& [a, b, c] = triangle.vertices;
        const double area =
            glm::length(glm::cross(glm::dvec3(b) - glm::dvec3(a), glm::dvec3(c) - glm::dvec3(a)));
        const bool usable = area > 0 && std::isfinite(area);
        dropped += usable ? 0 : 1;
        return !usable;
    }

    /// Index + 1 of the light, or 0 when this emits nothing worth choosing.
    std::uint32_t add_light(Light light)
    {
        light.material = scene_.objects[object_].material;
        light.radiance = scene_.materials[light.material].emission;
        light.emits_both_sides = scene_.materials[light.material].emits_both_sides;
        light.power = light_power(light, scene_.materials[light.material]);
        if (!(light.power > 0))
            return 0;
        lights.push_back(light);
        return static_cast<std::uint32_t>(lights.size());
    }

    const Scene& scene_;
    std::uint32_t object_ = 0;
};

Bvh tree_over(const Flattener& flat)
{
    std::vector<PrimitiveBounds> bounds;
    std::vector<std::uint8_t> kinds;
    bounds.reserve(flat.triangles.size() + flat.spheres.size());
    for (const FlatTriangle& triangle : flat.triangles) {
        const auto& [a, b, c] = triangle.vertices;
        bounds.push_back({glm::min(a, glm::min(b, c)), glm::max(a, glm::max(b, c))});
        kinds.push_back(0);
    }
    for (const FlatSphere& sphere : flat.spheres) {
        bounds.push_back({sphere.center - sphere.radius, sphere.center + sphere.radius});
        kinds.push_back(1);
    }
    return build_bvh(bounds, kinds);
}

void pack_triangle(PackedScene& packed, const Scene& scene, const FlatTriangle& triangle)
{
    const auto index = static_cast<std::uint32_t>(packed.primitives.size() / PRIMITIVE_TEXELS);
    packed.triangles.push_back(texel(triangle.vertices[0], index));
    packed.triangles.push_back(texel(triangle.vertices[1], 0));
    packed.triangles.push_back(texel(triangle.vertices[2], 0));
    const std::uint32_t material = scene.objects[triangle.object].material;
    packed.primitives.emplace_back(
        triangle.object, material, triangle.light, triangle.smooth ? 1 : 0);
    packed.primitives.emplace_back(pack_octahedral(triangle.normals[0]),
        pack_octahedral(triangle.normals[1]), pack_octahedral(triangle.normals[2]), 0);
}

void pack_sphere(PackedScene& packed, const Scene& scene, const FlatSphere& sphere)
{
    const auto index = static_cast<std::uint32_t>(packed.primitives.size() / PRIMITIVE_TEXELS);
    packed.spheres.push_back(texel(sphere.center, bits(sphere.radius)));
    packed.spheres.emplace_back(index, 0, 0, 0);
    packed.primitives.emplace_back(
        sphere.object, scene.objects[sphere.object].material, sphere.light, 0);
    packed.primitives.emplace_back(0);
}

void pack_lights(PackedScene& packed, const std::vector<Light>& lights)
{
    for (const Light& light : lights) {
        packed.lights.emplace_back(
            light.kind | (light.emits_both_sides ? LIGHT_EMITS_BOTH_SIDES : 0), 0, bits(light.pmf),
            bits(light.area));
        packed.lights.push_back(texel(light.p0, bits(light.alias_threshold)));
        packed.lights.push_back(texel(light.edge_u, light.alias));
        packed.lights.push_back(texel(light.edge_v, 0));
        packed.lights.push_back(texel(light.radiance, 0));
    }
}

SceneContent content_of(const Flattener& flat, std::size_t objects)
{
    SceneContent content;
    content.drawn.assign(objects, 0);
    for (const FlatTriangle& triangle : flat.triangles)
        content.drawn[triangle.object] = 1;
    for (const FlatSphere& sphere : flat.spheres)
        content.drawn[sphere.object] = 1;
    content.triangles = flat.triangles.size();
    content.spheres = flat.spheres.size();
    for (const FlatTriangle& triangle : flat.triangles)
        content.smooth_triangles += triangle.smooth ? 1 : 0;
    for (const Light& light : flat.lights)
        (light.kind == LIGHT_SPHERE ? content.sphere_lights : content.polygon_lights) += 1;
    return content;
}

}  // namespace

PackedScene pack_scene(const Scene& scene)
{
    const Flattener flat(scene);
    const Bvh bvh = tree_over(flat);
    PackedScene packed;
    packed.bvh_nodes = bvh.nodes;
    packed.stack_depth = bvh.stack_depth;
    for (const std::uint32_t i : bvh.order) {
        if (i < flat.triangles.size())
            pack_triangle(packed, scene, flat.triangles[i]);
        else
            pack_sphere(packed, scene, flat.spheres[i - flat.triangles.size()]);
    }
    packed.materials = pack_materials(scene.materials);
    pack_lights(packed, flat.lights);
    packed.content = content_of(flat, scene.objects.size());
    packed.dropped_triangles = flat.dropped;
    return packed;
}

GpuScene::GpuScene(const Scene& scene)
{
    const PackedScene packed = pack_scene(scene);
    effects_ = active_effects(scene, packed.content);
    triangle_count_ = packed.content.triangles;
    light_count_ = packed.light_count();
    dropped_triangles_ = packed.dropped_triangles;
    for (const std::string_view macro : mask_of(effects_).macros())
        defines_.emplace_back(macro, "1");
    defines_.emplace_back("BVH_STACK_SIZE", std::to_string(packed.stack_depth + 1));
    defines_.emplace_back("LIGHT_COUNT", std::to_string(packed.light_count()) + "u");
    upload("bvh_nodes", packed.bvh_nodes);
    upload("triangles", packed.triangles);
    upload("spheres", packed.spheres);
    upload("primitives", packed.primitives);
    upload("materials", packed.materials);
    upload("lights", packed.lights);
}

void GpuScene::upload(const std::string& name, const std::vector<glm::uvec4>& texels)
{
    if (texels.empty())
        return;
    GLint limit = 0;
    glGetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &limit);
    if (texels.size() > static_cast<std::size_t>(limit))
        throw GlError("the scene needs " + std::to_string(texels.size()) + " texels for '" + name
            + "', but this device allows " + std::to_string(limit) + " in a buffer texture");
    buffers_.emplace_back(name, std::as_bytes(std::span<const glm::uvec4>(texels)));
    textures_[name] = buffers_.back().texture(GL_RGBA32UI);
    check_gl("uploading '" + name + "'");
}

std::size_t GpuScene::bytes() const
{
    std::size_t sum = 0;
    for (const Buffer& buffer : buffers_)
        sum += buffer.size();
    return sum;
}

}  // namespace farlight
