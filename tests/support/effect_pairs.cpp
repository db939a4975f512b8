// Rows in the registry's order, by what they are about: shapes, lights, materials, the rest.
#include "tests/support/effect_pairs.h"

#include "server/scene/light_tree.h"
#include "tests/scene/plain_scene.h"

#include <cmath>

namespace farlight {
namespace {

void change_nothing(Scene& /*scene*/) { }

SceneChange material(void (*change)(Material&))
{
    return [change](Scene& scene) { change(scene.materials[0]); };
}

SceneChange object(const char* name, decltype(Object::shape) shape)
{
    return [=](Scene& s) { s.objects.push_back({.name = name, .shape = shape}); };
}

/// One that shines; a mesh is the scene's own.
SceneChange lamp(decltype(Object::shape) shape)
{
    return [=](Scene& s) {
        s.materials[1].emission = glm::vec3(1);
        s.objects.push_back({.name = "lamp", .material = 1, .shape = shape});
    };
}

SceneChange both(SceneChange a, SceneChange b)
{
    return [=](Scene& s) { a(s), b(s); };
}

void add_point_light(Scene& scene)
{
    scene.lights.push_back({.name = "point"});
}

SceneChange bowl(Material of)
{
    return [=](Scene& s) {
        s.materials.push_back(of);
        s.objects.push_back({.name = "bowl", .material = 2, .shape = Sphere{}});
    };
}

const Material kRoughMetal{.name = "tin", .metallic = 1, .roughness = 0.5F};
const Material kMirror{.name = "mirror", .metallic = 1, .roughness = 0};
const Material kGlass{.name = "glass", .roughness = 0, .transmission = 1};

void paint_texture(Scene& scene)
{
    scene.materials[0].albedo_texture = texture_of(scene, {kBlack, kWhite});
}

std::vector<EffectPair> pairs_of_shapes()
{
    const auto ball_on_node = [](const glm::dvec3& scale) {
        return [=](Scene& s) {
            const auto node = static_cast<std::uint32_t>(s.animation.nodes.size());
            s.animation.nodes.push_back({.name = "holder"});
            s.animation.nodes.back().scale = scale;
            s.objects.push_back({.name = "ball", .shape = Sphere{}, .node = node});
        };
    };
    return {
        {"triangles", [](Scene& s) { s.objects[0].shape = Sphere{}; }, object("wall", Quad{}),
            {"uniform triangles", "buffer triangles"}},
        {"spheres", change_nothing, object("ball", Sphere{}),
            {"uniform spheres", "buffer spheres"}},
        {"disks", change_nothing, object("coin", Disk{}), {"uniform disks", "buffer disks"}},
        {"shading_normals", change_nothing,
            [](Scene& s) { s.meshes[0].normals.assign(3, glm::vec3(0, 0, 1)); },
            {"uniform normals", "buffer normals"}},
        {"instances", ball_on_node(glm::dvec3(1)),
            // What no longer is a sphere in the world is one in a space of its own.
            [](Scene& s) { s.animation.nodes.back().scale.x = 2; },
            {"uniform instances", "buffer instances"}},
        {"motion", ball_on_node({1, 2, 1}),
            [](Scene& s) {
                s.animation.tracks.push_back(moving_track());
                s.animation.tracks.back().index =
                    static_cast<std::uint32_t>(s.animation.nodes.size()) - 1;
            },
            {"uniform prev_instances", "buffer prev_instances"}},
        {"deformation", change_nothing,
            [](Scene& s) {
                s.meshes[0].morph_targets = {{{{0, 0, 1}, {0, 0, 0}, {0, 0, 0}}, {}}};
                std::get<MeshInstance>(s.objects[0].shape).morph_weights = {0};
                s.animation.tracks.push_back(moving_track());
                s.animation.tracks.back().target = Track::Target::kMorphWeights;
                s.animation.tracks.back().values = {0, 1};
            },
            {"uniform prev_vertices", "buffer prev_vertices"}},
    };
}

std::vector<EffectPair> pairs_of_lights()
{
    return {
        {"lights", change_nothing, lamp(Quad{}),
            {"uniform lights", "uniform light_sampling", "buffer lights",
                "code sample_polygon_light"},
            {"polygon_lights"}},
        {"polygon_lights", lamp(Sphere{}), lamp(Quad{}), {"code sample_polygon_light"}},
        {"sphere_lights", both(lamp(Quad{}), object("ball", Sphere{})), lamp(Sphere{}),
            {"code sample_sphere_light"}},
        {"disk_lights", both(lamp(Quad{}), object("coin", Disk{})), lamp(Disk{}),
            {"code sample_disk_light"}},
        {"emissive_meshes", lamp(Sphere{}), lamp(MeshInstance{}), {"code sample_polygon_light"}},
        {"delta_lights", lamp(Quad{}), add_point_light, {"code sample_delta_light"}},
        {"light_tree", lamp(Quad{}),
            [](Scene& s) {
                for (std::size_t i = 1; i < kLightTreeFrom; ++i)
                    lamp(Quad{})(s);
            },
            {"uniform light_tree", "buffer light_tree"}},
        {"background",
            [](Scene& s) {
                s.background = glm::vec3(0);
                add_point_light(s);
            },
            [](Scene& s) { s.background = glm::vec3(1); }, {"code frame.background"}},
        {"environment_map", add_point_light,
            [](Scene& s) {
                s.environment = std::make_shared<EnvironmentMap>(
                    EnvironmentMap{"sky.hdr", 2, 1, {glm::vec3(1), glm::vec3(2)}});
            },
            {"uniform environment", "buffer environment"}},
    };
}

std::vector<EffectPair> pairs_of_textures()
{
    return {
        {"textures", change_nothing, paint_texture,
            {"uniform uvs", "uniform texture_array_0", "buffer uvs", "buffer texture_array_0"}},
        {"second_uvs", paint_texture, [](Scene& s) { s.materials[0].albedo_texture.uv_set = 1; },
            {"uniform uvs1", "buffer uvs1"}},
        {"normal_maps", paint_texture,
            [](Scene& s) {
                s.materials[0].normal_texture = texture_of(s, {kFlat, kTilted});
            },
            // Its texels are linear: an array of their own.
            {"uniform tangents", "buffer tangents", "(uniform|buffer) texture_array_1"}},
        {"vertex_colors", change_nothing,
            [](Scene& s) {
                s.meshes[0].colors = {glm::vec4(1), glm::vec4(0.5F), glm::vec4(1)};
            },
            {"uniform colors", "buffer colors"}},
    };
}

std::vector<EffectPair> pairs_of_materials()
{
    return {
        {"rough_reflection", bowl(kMirror),
            material([](Material& m) { m.metallic = 1, m.roughness = 0.3F; }),
            {"(uniform|buffer) reflection_albedo"}},
        {"mirror", bowl(kGlass), material([](Material& m) { m.metallic = 1, m.roughness = 0; }),
            {"code make_reflection"}},
        {"clearcoat", bowl(kRoughMetal), material([](Material& m) { m.clearcoat = 1; }),
            {"code make_clearcoat"}},
        {"dielectric", bowl(kRoughMetal),
            material([](Material& m) { m.transmission = 1, m.roughness = 0; }),
            {"code make_interface"}},
        {"rough_dielectric", both(bowl(kGlass), material([](Material& m) {
             m.clearcoat = m.clearcoat_roughness = 1;
         })),
            material([](Material& m) { m.transmission = 1, m.roughness = 0.5F; }),
            {"(uniform|buffer) dielectric_albedo"}},
        {"unlit", bowl({.name = "clay"}), material([](Material& m) { m.unlit = true; }),
            {"code unlit"}},
        {"alpha", change_nothing,
            material([](Material& m) { m.alpha_mode = AlphaMode::kBlend, m.opacity = 0.5F; }),
            {"code is_covered"}},
    };
}

std::vector<EffectPair> pairs_of_the_rest()
{
    return {
        {"fog", change_nothing,
            [](Scene& s) {
                s.medium = {"haze", glm::vec3(0.02F), glm::vec3(0.01F), 0.5F};
            },
            {"uniform fog_(center|radius|sigma_t|sigma_s|g)", "uniform (in|out|prev)_fog_way",
                "uniform (in|out)_scattered", "texture gbuffer.fog_way",
                "texture path_trace.scattered", "texture svgf.*scattered.*",
                "pass svgf scattered .*", "uniform noisy_scattered"}},
        {"lens", change_nothing, [](Scene& s) { s.lens.radius = 0.1; },
            {"uniform lens_radius", "uniform focus_distance"}},
        {"specular_signal", change_nothing, material([](Material& m) { m.clearcoat = 1; }),
            {"uniform (in|out)_(specular|shown|reflectance)", "uniform in_position",
                "texture gbuffer.reflectance", "texture path_trace.(specular|shown)",
                "texture svgf.*specular.*", "pass svgf specular .*", "uniform reflection_albedo",
                "uniform noisy_specular"},
            {"clearcoat"}},
        {"antialiasing", change_nothing, change_nothing, {"uniform pixel_jitter"}},
        {"denoising", change_nothing, change_nothing,
            {"pass (svgf .*|composite|refine)", "texture (svgf.*|composite|refine)",
                "pass predict error", "texture (accumulate.reference|error_estimate.difference)",
                "uniform (in_picture|noisy_direct|noisy_indirect|tile_offset|second_of_pair)",
                "uniform (prev|out)_difference",
                "uniform (prev_reference|out_reference|takes_reference)",
                "uniform in_(surface|motion|identity|light|light_2|length|moments|denoised|mean)",
                "uniform prev_(surface|identity|light|light_2|length|moments)",
                "uniform out_(light|light_2|length|moments)",
                "uniform sigma_(depth|luminance|normal)", "uniform reproject_(depth|normal)",
                "uniform svgf_(alpha|moments_alpha|spatial_frames)", "uniform history_(max|valid)",
                "uniform step_size", "uniform mean_weight"}},
    };
}

}  // namespace

std::vector<EffectPair> effect_pairs()
{
    std::vector<EffectPair> all;
    for (const auto& part : {pairs_of_shapes(), pairs_of_lights(), pairs_of_textures(),
             pairs_of_materials(), pairs_of_the_rest()})
        all.insert(all.end(), part.begin(), part.end());
    return all;
}

Scene lit_scene()
{
    Scene scene = plain();
    scene.background = glm::vec3(0.5F);
    return scene;
}

}  // namespace farlight
