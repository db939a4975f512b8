// Surfaces with holes: how much light a blend lets through in closed form, and which pixels a mask
// cuts out.
//
// Statistical tests use fixed seeds; the bounds are 5 standard errors, which a fresh seed would
// exceed by chance once in 1.7 million.
#include "lab/statistics.h"
#include "tests/support/gl_test.h"
#include "tests/support/moving_scenes.h"

#include <glm/gtc/matrix_transform.hpp>

namespace farlight {
namespace {

constexpr Extent kExtent{48, 32};

/// Black and with holes; it fills the picture from (0, 0, 0) facing +z.
Scene black_veil(float opacity)
{
    Scene scene;
    Material veil{"veil", glm::vec3(0)};
    veil.alpha_mode = AlphaMode::kBlend;
    veil.opacity = opacity;
    scene.materials.push_back(veil);
    scene.background = glm::vec3(1);
    scene.camera = {{0, 0, 2}, {0, 0, 0}, {0, 1, 0}, 45};
    return scene;
}

Estimate mean_picture(const Scene& scene, int frames, double time = 0)
{
    const DeviceScene on_device(scene);
    RenderSettings settings;
    settings.denoiser = Denoiser::kAccumulate;
    settings.antialiasing = false;
    settings.play = false;
    View view(on_device.shared);
    RenderRequest request = linear_request(on_device.scene, kExtent, settings);
    request.time = time;
    RenderedFrame frame;
    for (int i = 0; i < frames; ++i)
        frame = view.render(request);
    EXPECT_EQ(frame.bad_values.all(), 0U);
    return mean_of(frame.image);
}

struct Shape {
    const char* name;
    Object object;
    int sides;  ///< That a ray through the middle crosses.
    bool moves;

    friend void PrintTo(const Shape& shape, std::ostream* out) { *out << shape.name; }
};

class BlendTest : public GlTest, public testing::WithParamInterface<Shape> { };

/// Each side lets through what its opacity does not stop, independently of every other.
TEST_P(BlendTest, LetsThroughWhatItsOpacityLeaves)
{
    const auto& [name, object, sides, moves] = GetParam();
    Scene scene = black_veil(0.3F);
    scene.objects.push_back(object);
    if (moves) {
        Node node;
        node.scale = {2, 2, 2};
        scene.animation.nodes.push_back(node);
        Track track;
        track.times = {0, 1};
        track.values = {0, 0, 0, 0, 0, -0.5F};
        scene.animation.tracks.push_back(track);
        scene.objects[0].node = 0;
    }
    const Estimate mean = mean_picture(scene, 64, moves ? 0.5 : 0);
    EXPECT_NEAR(mean.mean, std::pow(0.7, sides), 5 * mean.standard_error);
    EXPECT_LT(mean.standard_error, 0.004);
}

const Quad kWide{{-4, -4, 0}, {8, 0, 0}, {0, 8, 0}};

INSTANTIATE_TEST_SUITE_P(Shapes, BlendTest,
    testing::Values(Shape{"Quad", {"quad", 0, kWide}, 1, false},
        Shape{"Disk", {"disk", 0, Disk{{0, 0, 0}, {0, 0, 1}, 4}}, 1, false},
        Shape{"Sphere", {"sphere", 0, Sphere{{0, 0, -9}, 8.5}}, 2, false},
        Shape{"SphereFromInside", {"sphere", 0, Sphere{{0, 0, 0}, 5}}, 1, false},
        Shape{"MovingQuad", {"quad", 0, kWide}, 1, true},
        Shape{"MovingSphere", {"sphere", 0, Sphere{{0, 0, -9}, 8.5}}, 2, true}),
    [](const auto& test) { return test.param.name; });

TEST_F(BlendTest, AMeshThatDeformsLetsThroughAsMuch)
{
    Scene scene = black_veil(0.3F);
    Mesh cloth{
        "cloth", {{-4, -4, 0}, {4, -4, 0}, {4, 4, 0}, {-4, 4, 0}}, {}, {{0, 1, 2}, {0, 2, 3}}};
    cloth.morph_targets.push_back({{{0, 0, 1}, {0, 0, -1}, {0, 0, 1}, {0, 0, -1}}});
    scene.meshes.push_back(cloth);
    scene.objects.push_back({"cloth", 0, MeshInstance{.morph_weights = {0}}});
    Track track;
    track.target = Track::Target::kMorphWeights;
    track.times = {0, 1};
    track.values = {0, 1};
    scene.animation.tracks.push_back(track);
    const Estimate mean = mean_picture(scene, 64, 0.5);
    EXPECT_NEAR(mean.mean, 0.7, 5 * mean.standard_error);
    EXPECT_LT(mean.standard_error, 0.004);
}

TEST_F(BlendTest, TwoVeilsStopIndependently)
{
    Scene scene = black_veil(0.4F);
    scene.objects.push_back({"near", 0, kWide});
    scene.objects.push_back({"far", 0, Quad{{-9, -9, -1}, {18, 0, 0}, {0, 18, 0}}});
    const Estimate mean = mean_picture(scene, 64);
    EXPECT_NEAR(mean.mean, 0.36, 5 * mean.standard_error);
}

/// 240 thin veils over a floor: many samples in one frame are those of many frames, none cut
/// short, though llvmpipe ends all loops of an invocation after 65535 rounds together.
TEST_F(BlendTest, ManyVeilsEndNoLoop)
{
    Scene scene = black_veil(0.005F);
    scene.materials.push_back({"floor", glm::vec3(0.5F)});
    scene.objects.push_back({"floor", 1, Quad{{-20, 0, 20}, {40, 0, 0}, {0, 0, -40}}});
    for (int i = 0; i < 240; ++i)
        scene.objects.push_back(
            {"veil", 0, Quad{{-20, 2 + 0.0025 * i, 20}, {40, 0, 0}, {0, 0, -40}}});
    scene.camera = {{0, 1, 1}, {0, 0, 0}, {0, 1, 0}, 30};
    PunctualLight sun;
    sun.kind = PunctualLight::Kind::kDirectional;
    sun.direction = glm::normalize(glm::dvec3(0.3, -1, 0.1));
    scene.lights.push_back(sun);
    const DeviceScene on_device(scene);
    const auto mean_of_frames = [&](int frames, int samples) {
        RenderRequest request = linear_request(on_device.scene, {16, 16}, {});
        request.settings.denoiser = Denoiser::kAccumulate;
        request.settings.antialiasing = false;
        request.settings.samples_per_pixel = samples;
        View view(on_device.shared);
        RenderedFrame frame;
        for (int i = 0; i < frames; ++i)
            frame = view.render(request);
        return frame.image;
    };
    const Image at_once = mean_of_frames(1, 128);
    const Image in_turn = mean_of_frames(64, 2);
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x) {
            const float expected = pixel(in_turn, x, y).x;
            // 1e-4: sums of 128 numbers in another order.
            ASSERT_NEAR(pixel(at_once, x, y).x, expected, 1e-4F * expected) << x << "," << y;
        }
}

/// A white box full of fog without absorption, a lamp inside; `open_masks` cross it, all hole.
Scene foggy_box(int open_masks)
{
    Scene scene;
    scene.materials.push_back({"white", glm::vec3(0.95F)});
    scene.materials.push_back({"open", glm::vec3(0)});
    scene.materials[1].alpha_mode = AlphaMode::kMask;
    scene.materials[1].albedo_texture.image = 0;
    scene.materials[1].albedo_texture.nearest = true;
    // Everywhere the middle of the texel that is clear.
    scene.materials[1].albedo_texture.image_from_uv = {
        glm::vec3(0), glm::vec3(0), glm::vec3(0.25, 0.5, 1)};
    scene.images.push_back({"hole", 2, 1, {{255, 255, 255, 0}, {255, 255, 255, 255}}});
    for (int axis = 0; axis < 3; ++axis)
        for (const double side : {-1.0, 1.0}) {
            Quad wall{{-1, -1, -1}, {}, {}};
            wall.corner[axis] = side;
            wall.edge_u[(axis + 1) % 3] = 2;
            wall.edge_v[(axis + 2) % 3] = 2;
            scene.objects.push_back({"wall", 0, wall});
        }
    for (int i = 0; i < open_masks; ++i)
        scene.objects.push_back(
            {"mask", 1, Quad{{-1, -0.9 + 1.8 * (i + 0.5) / open_masks, -1}, {2, 0, 0}, {0, 0, 2}}});
    scene.medium = {"milk", glm::vec3(2), glm::vec3(2), 0};
    scene.lights.push_back({.name = "lamp"});
    scene.camera = {{0, 0.02, 0.9}, {0, 0.02, 0}, {0, 1, 0}, 60};
    return scene;
}

/// The longest paths there are, through fog and many holes: not one is cut short, though llvmpipe
/// ends all loops of an invocation after 65535 rounds together. 64 holes on a ray would be too
/// many.
TEST_F(BlendTest, OpenMasksCutNoLongPathShort)
{
    const auto picture = [](const Scene& scene) {
        const DeviceScene on_device(scene);
        RenderRequest request = linear_request(on_device.scene, {16, 16}, {});
        request.settings.denoiser = Denoiser::kAccumulate;
        request.settings.max_depth = request.settings.roulette_depth = 64;
        View view(on_device.shared);
        return view.render(request).image;
    };
    const Image without = picture(foggy_box(0));
    const Image with = picture(foggy_box(48));
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x)
            ASSERT_EQ(pixel(with, x, y), pixel(without, x, y)) << x << "," << y;
}

/// A white floor under a veil: the sun reaches it through the veil, and the camera sees it below.
TEST_F(BlendTest, ShadowsAreAsDeepAsTheVeilIsDense)
{
    const auto lit = [](bool veiled) {
        Scene scene = black_veil(0.6F);
        scene.background = glm::vec3(0);
        scene.materials.push_back({"floor", glm::vec3(0.5F)});
        scene.objects.push_back({"floor", 1, Quad{{-20, 0, 20}, {40, 0, 0}, {0, 0, -40}}});
        if (veiled)
            scene.objects.push_back({"veil", 0, Quad{{-20, 3, 20}, {40, 0, 0}, {0, 0, -40}}});
        PunctualLight sun;
        sun.kind = PunctualLight::Kind::kDirectional;
        sun.intensity = glm::vec3(3);
        sun.direction = glm::normalize(glm::dvec3(0.3, -1, 0.1));
        scene.lights.push_back(sun);
        scene.camera = {{0, 1, 1}, {0, 0, 0}, {0, 1, 0}, 30};
        return mean_picture(scene, 64);
    };
    const Estimate veiled = lit(true);
    EXPECT_NEAR(veiled.mean / lit(false).mean, 0.4, 5 * veiled.standard_error);
    EXPECT_LT(veiled.standard_error, 0.004);
}

/// A checkerboard mask: a pixel is black or white as its point's texel says, in every frame.
TEST_F(BlendTest, AMaskCutsWhereItsTextureSays)
{
    Scene scene = black_veil(1);
    scene.images.push_back({"holes", 2, 2,
        {glm::u8vec4(255, 255, 255, 200), glm::u8vec4(255, 255, 255, 60),
            glm::u8vec4(255, 255, 255, 60), glm::u8vec4(255, 255, 255, 200)}});
    Material& veil = scene.materials[0];
    veil.alpha_mode = AlphaMode::kMask;
    veil.alpha_cutoff = 0.5F;
    veil.albedo_texture.image = 0;
    veil.albedo_texture.nearest = true;
    scene.objects.push_back({"quad", 0, Quad{{-1, -1, 0}, {2, 0, 0}, {0, 2, 0}}});
    const DeviceScene on_device(scene);
    RenderSettings settings;
    settings.denoiser = Denoiser::kOff;
    settings.antialiasing = false;
    View view(on_device.shared);
    const RenderRequest request = linear_request(on_device.scene, kExtent, settings);
    const Image image = view.render(request).image;
    const double half_height = std::tan(glm::radians(22.5)) * 2;
    for (int y = 0; y < kExtent.height; ++y)
        for (int x = 0; x < kExtent.width; ++x) {
            const double py = (1 - 2 * (y + 0.5) / kExtent.height) * half_height;
            const double px =
                (2 * (x + 0.5) / kExtent.width - 1) * half_height * kExtent.width / kExtent.height;
            const bool on_quad = std::abs(px) < 1 && std::abs(py) < 1;
            const bool solid = on_quad && (px < 0) == (py > 0);
            EXPECT_EQ(pixel(image, x, y).x, solid ? 0 : 1) << x << "," << y;
        }
}

/// White things under a white sky, half there: metal, plastic, glass, one on a node that moves.
Scene half_there()
{
    Scene scene = black_veil(0.5F);
    Material& cloth = scene.materials[0];
    cloth.albedo = glm::vec3(1);
    Material metal = cloth;
    metal.metallic = 1;
    metal.roughness = 0.4F;
    Material glass = cloth;
    glass.transmission = 1;
    glass.specular = 1;
    glass.roughness = 0;
    scene.materials.push_back(metal);
    scene.materials.push_back(glass);
    scene.objects.push_back({"curtain", 0, Quad{{-3, -2, 0.8}, {6, 0, 0.3}, {0, 4, -0.2}}});
    scene.objects.push_back({"metal", 1, Sphere{{-0.7, 0, 0}, 0.6}});
    scene.objects.push_back({"glass", 2, Sphere{{0.7, 0, 0}, 0.6}});
    scene.objects.push_back({"coin", 1, Disk{{0, -0.9, 0.2}, {0, 0.8, 0.6}, 0.8}});
    scene.camera.position = {0, 0, 4};
    hang_on_nodes(
        scene, [](std::size_t) { return glm::dmat4(1); }, true);
    return scene;
}

/// What holes let through and what is met instead is all the light there is: nothing is lost,
/// counted twice or caught, inside glass that was entered through a hole too.
TEST_F(BlendTest, WhiteThingsThatAreHalfThereVanish)
{
    const DeviceScene on_device(half_there());
    RenderRequest request = linear_request(on_device.scene, kExtent, {});
    request.settings.denoiser = Denoiser::kAccumulate;
    request.settings.max_depth = request.settings.roulette_depth = 48;
    request.settings.samples_per_pixel = 16;
    request.settings.play = false;
    request.time = 1;
    View view(on_device.shared);
    RenderedFrame frame;
    for (int i = 0; i < 4; ++i)
        frame = view.render(request);
    EXPECT_EQ(frame.bad_values.all(), 0U);
    const Estimate mean = mean_of(frame.image);
    // 2e-3: the albedo tables of rough metal.
    EXPECT_NEAR(mean.mean, 1, 5 * mean.standard_error + 2e-3);
    EXPECT_LT(mean.standard_error, 2e-3);
}

/// Through a hole a thing is what it is without anything in front, its motion too.
TEST_F(BlendTest, ThroughHolesThingsAreAsWithNothingInFront)
{
    const auto picture = [](const DeviceScene& on_device, DebugView which) {
        RenderRequest request = linear_request(on_device.scene, kExtent, {});
        request.settings.view = which;
        View view(on_device.shared);
        request.time = 0.3;
        view.render(request);
        request.time = 0.7;
        request.camera.position.x += 0.1;
        return view.render(request).image;
    };
    Scene open = half_there();
    for (Material& material : open.materials)
        material.alpha_mode = AlphaMode::kOpaque;
    open.objects.erase(open.objects.begin());  // the curtain, which is to hang in front
    Scene veiled = open;
    veiled.materials.push_back({"lattice", glm::vec3(0)});
    veiled.materials.back().alpha_mode = AlphaMode::kMask;
    veiled.materials.back().albedo_texture.image = 0;
    veiled.images.push_back({"holes", 2, 1, {{255, 255, 255, 0}, {255, 255, 255, 255}}});
    veiled.objects.push_back({"lattice", 3, Quad{{-3, -2, 1.5}, {6, 0, 0}, {0, 4, 0}}});
    const auto lattice = static_cast<float>(veiled.objects.size() - 1);
    const DeviceScene veiled_things(veiled);
    const DeviceScene things(open);
    const Image objects = picture(veiled_things, DebugView::kObjectId);
    for (const DebugView which :
        {DebugView::kObjectId, DebugView::kPosition, DebugView::kMotion, DebugView::kMaterialId}) {
        const Image with = picture(veiled_things, which);
        const Image without = picture(things, which);
        int seen = 0;
        int hidden = 0;
        for (int y = 0; y < kExtent.height; ++y)
            for (int x = 0; x < kExtent.width; ++x) {
                const bool hole = pixel(objects, x, y).x != lattice;
                hidden += hole ? 0 : 1;
                if (!hole)
                    continue;
                ASSERT_EQ(pixel(with, x, y), pixel(without, x, y)) << x << "," << y;
                seen += pixel(without, x, y) != glm::vec3(0) ? 1 : 0;
            }
        EXPECT_GT(seen, 50) << static_cast<int>(which);  // the first object's number is 0
        EXPECT_GT(hidden, 400);
    }
}

}  // namespace
}  // namespace farlight
