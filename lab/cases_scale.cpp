// Scale: scenes of any size and in any place, and rays that start on what they left.
#include "lab/groups.h"
#include "lab/meshes.h"
#include "lab/moved.h"
#include "lab/ray_probe.h"
#include "lab/rendering.h"
#include "server/render/camera.h"

#include <algorithm>
#include <cmath>

namespace farlight::lab {
namespace {

constexpr Extent kSmall{48, 32};

/// A room with a lamp, a mesh, a rough metal ball and a disk in it, `scale` times as large.
Scene furnished_room(double scale)
{
    Scene scene = room_with(bumpy_sphere(24, 12));
    for (Object& object : scene.objects)
        if (auto* quad = std::get_if<Quad>(&object.shape))
            *quad = {scale * quad->corner, scale * quad->edge_u, scale * quad->edge_v};
    std::get<MeshInstance>(scene.objects[0].shape).world_from_object =
        glm::dmat4(glm::dmat3(0.5 * scale));
    scene.materials.push_back({.name = "metal", .metallic = 1, .roughness = 0.3F});
    scene.objects.push_back({"ball", 2, Sphere{scale * glm::dvec3(1, -1.5, 0.5), 0.5 * scale}});
    scene.objects.push_back(
        {"disk", 0, Disk{scale * glm::dvec3(-1, -1, 0.5), {0, 1, 0}, 0.5 * scale}});
    scene.camera.position *= scale;
    scene.camera.target *= scale;
    return scene;
}

/// The last of six frames of a camera that moves, of a room of some size and in some place.
struct Sized {
    std::vector<float> values;
    std::uint32_t nonfinite = 0;  ///< Of all six.
};

Sized last_frame_at(const DeviceScene& scene, double scale, DebugView shown)
{
    View view(scene.shared);
    RenderRequest request = linear_request(scene.scene, kSmall, {});
    request.settings.view = shown;
    Sized sized;
    for (int i = 0; i < 6; ++i) {
        request.camera.position.x += 0.03125 * scale;
        const RenderedFrame frame = view.render(request);
        sized.nonfinite += frame.bad_values.all();
        sized.values = values_of(frame.image);
    }
    return sized;
}

/// `draw(scale)` at all these powers of two against that at 1. Returns the latter.
template <typename Draw>
Sized report_sizes(Findings& findings, const std::vector<int>& powers, const Draw& draw)
{
    Sized at_one = draw(1.0);
    findings.none("non-finite values at 2^0", at_one.nonfinite);
    for (const int power : powers) {
        const Sized sized = draw(std::ldexp(1.0, power));
        const std::string name = "2^" + std::to_string(power) + ": ";
        findings.none(name + "non-finite values", sized.nonfinite);
        findings.none(name + "values of other bits, of " + std::to_string(at_one.values.size()),
            values_unlike(sized.values, at_one.values));
    }
    return at_one;
}

std::vector<int> tiny_and_huge(Length length)
{
    return length == Length::kLong ? std::vector{-20, -13, 17, 24} : std::vector{-13, 17};
}

void size_does_not_show(Findings& findings, Length length)
{
    report_sizes(findings, tiny_and_huge(length), [](double scale) {
        return last_frame_at(DeviceScene(furnished_room(scale)), scale, DebugView::kFinal);
    });
}

void size_is_not_remembered(Findings& findings, Length length)
{
    const Sized at_one = report_sizes(findings, tiny_and_huge(length), [](double scale) {
        return last_frame_at(DeviceScene(furnished_room(scale)), scale, DebugView::kHistoryLength);
    });
    const float longest = *std::max_element(at_one.values.begin(), at_one.values.end());
    findings.at_least("longest history of 6 frames", longest, 6);
}

/// As the server has it, far from the origin: what the scene is counted from scales with it.
void scaled_from_afar(Findings& findings, Length /*length*/)
{
    std::vector<int> powers;
    for (int k = -10; k <= 10; ++k)
        if (k != 0)
            powers.push_back(k);
    report_sizes(findings, powers, [](double scale) {
        const Scene far = moved(furnished_room(scale), scale * glm::dvec3(1e6, -3e5, 12345.678));
        return last_frame_at(DeviceScene(load_onto_device(far)), scale, DebugView::kFinal);
    });
}

/// White surfaces under a white sky vanish: a pixel is below 1 only where a ray was caught on the
/// surface it left, or slipped inside it and stayed there.
Scene white_things(double scale, const glm::dvec3& center)
{
    Scene scene = scene_of(bumpy_sphere(60, 30));
    scene.materials[0].albedo = glm::vec3(1);
    scene.background = glm::vec3(1);
    const auto place = [&](const glm::dvec3& at) { return center + scale * at; };
    glm::dmat4 world_from_object(scale);
    world_from_object[3] = glm::dvec4(place({-1.3, 0, 0}), 1);
    std::get<MeshInstance>(scene.objects[0].shape).world_from_object = world_from_object;
    scene.objects.push_back({"ball", 0, Sphere{place({1.3, 0, 0}), scale}});
    // One plate along the axes with coordinates that are exactly zero, one askew.
    scene.objects.push_back({"plate", 0,
        Quad{place({-4, -1.5, -4}), scale * glm::dvec3(0, 0, 8), scale * glm::dvec3(8, 0, 0)}});
    scene.objects.push_back({"askew", 0,
        Quad{
            place({-3, -1, -3}), scale * glm::dvec3(5, 1, 0.3), scale * glm::dvec3(-0.2, 3, 0.7)}});
    scene.camera = {place({0, 1.5, 5}), center, {0, 1, 0}, 40};
    return scene;
}

struct Placement {
    const char* name;
    double scale;
    glm::dvec3 at;  ///< In units of the scale.
};

constexpr Placement kPlacements[] = {
    {"at the origin", 1, {0, 0, 0}},
    {"plate at exactly 0", 1, {0, 1.5, 0}},
    {"a millimetre large", 1e-3, {0, 1.5, 4}},
    {"a thousandth of that", 1e-6, {0, 0, 0}},
    {"10 km large", 1e4, {0, 0, 0}},
    {"1000 km large", 1e6, {0, 1.5, 0}},
    {"1 km away", 1, {1e3, 500, -250}},
    {"1 km large, 1000 km away", 1e3, {1e3, 500, -250}},
};

void white_things_vanish(Findings& findings, Length length)
{
    constexpr Extent kWide{97, 61};
    for (const Placement& placed : kPlacements) {
        const DeviceScene scene(white_things(placed.scale, placed.scale * placed.at));
        RenderSettings s;
        s.denoiser = Denoiser::kOff;
        s.max_depth = 64;  // a path that has not escaped by then was caught
        s.roulette_depth = 64;
        s.samples_per_pixel = length == Length::kLong ? 64 : 4;
        View view(scene.shared);
        const RenderedFrame frame = view.render(linear_request(scene.scene, kWide, s));
        double off = 0;
        for (const float value : values_of(frame.image))
            off = farther(off, static_cast<double>(std::abs(value - 1)));
        findings.at_most(std::string(placed.name) + ": farthest from the sky", off, 1e-4);
        findings.none(std::string(placed.name) + ": non-finite values", frame.bad_values.all());
    }
}

/// Light on a square of white ground straight below a square lamp of side 1 at height 1, which
/// shines with 1, over its share by the closed form.
double lit_ground(double scale, int samples)
{
    Scene scene;
    scene.materials.push_back({"white", glm::vec3(1)});
    scene.materials.push_back({"lamp", glm::vec3(0), glm::vec3(1)});
    const auto square = [&](double side, double y, bool up) {
        const glm::dvec3 u = scale * glm::dvec3(side, 0, 0);
        const glm::dvec3 v = scale * glm::dvec3(0, 0, side);
        const glm::dvec3 corner = scale * glm::dvec3(-side / 2, y, -side / 2);
        return up ? Quad{corner, v, u} : Quad{corner, u, v};
    };
    scene.objects.push_back({"ground", 0, square(4, 0, true)});
    scene.objects.push_back({"lamp", 1, square(1, 1, false)});
    // From beside the lamp at the point below its middle, through a very small angle.
    scene.camera = {scale * glm::dvec3(1.5, 1, 0), {0, 0, 0}, {0, 1, 0}, 0.2};
    const DeviceScene on_device(scene);
    RenderSettings s;
    s.denoiser = Denoiser::kOff;
    s.samples_per_pixel = samples;
    s.max_depth = 2;
    View view(on_device.shared);
    double sum = 0;
    const std::vector<float> values =
        values_of(view.render(linear_request(on_device.scene, {16, 16}, s)).image);
    for (const float value : values)
        sum += value;
    // Lambert's formula for a polygon: half the sum over edges of angle times cosine.
    constexpr double kIrradiance = 0.75227469;
    return sum / static_cast<double>(values.size()) / (kIrradiance / glm::pi<double>());
}

void lamps_light_what_faces_them(Findings& findings, Length length)
{
    for (const double scale : {1e-6, 1e-3, 1.0, 1e4, 1e7}) {
        char name[64];
        std::snprintf(
            name, sizeof name, "lamp %g m wide: light over the closed form, off by", scale);
        // 8192 samples or more: 0.2 % is one standard error, so that chance breaks this at no scale
        // in a million runs, and all scales draw the same numbers.
        findings.at_most(
            name, std::abs(lit_ground(scale, length == Length::kLong ? 512 : 32) - 1), 0.01);
    }
}

/// Pixels whose geometric normal, if there is one, is not a unit towards the camera.
double normals_turned_away(const Image& normals, const CameraPose& camera)
{
    const CameraBasis basis = camera_basis(camera);
    const double half = std::tan(glm::radians(camera.vertical_fov_degrees) / 2);
    const double size = normals.extent.width;
    double turned = 0;
    for (int y = 0; y < normals.extent.height; ++y)
        for (int x = 0; x < normals.extent.width; ++x) {
            const glm::dvec3 normal(pixel(normals, x, y));
            const glm::dvec3 way = basis.forward + half * ((2 * x + 1) / size - 1) * basis.right
                - half * ((2 * y + 1) / size - 1) * basis.up;
            const bool none = normal == glm::dvec3(0);
            turned +=
                none || (glm::dot(normal, way) < 1e-3 && std::abs(glm::length(normal) - 1) < 1e-3)
                ? 0
                : 1;
        }
    return turned;
}

struct OddPlace {
    const char* name;
    glm::dvec3 at;
};

/// Of the furnished room.
constexpr OddPlace kOddPlaces[] = {{"on the floor", {0, -2, 0}}, {"in a corner", {-2, -2, -2}},
    {"on the ball", {1, -1, 0.5}}, {"in the ball's middle", {1, -1.5, 0.5}},
    {"inside the mesh", {0, 0, 0}}, {"on the lamp", {0, 1.99, 0}}, {"outside", {0, 9, 0}}};

void cameras_in_odd_places(Findings& findings, Length /*length*/)
{
    const glm::dvec3 ways[] = {{0, 0, -1}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}, {-1, -1, 1}};
    const DeviceScene scene(furnished_room(1));
    View view(scene.shared);
    View normals(scene.shared);
    for (const auto& [name, at] : kOddPlaces) {
        double bad = 0;
        double turned = 0;
        std::uint32_t nonfinite = 0;
        for (const glm::dvec3& way : ways) {
            RenderRequest request = linear_request(scene.scene, {17, 17}, {});
            request.camera = {at, at + way, {0, 1, 0}, 90};
            const RenderedFrame frame = view.render(request);
            nonfinite += frame.bad_values.all();
            for (const float value : values_of(frame.image))
                bad += value >= 0 && std::isfinite(value) ? 0 : 1;
            request.settings.view = DebugView::kGeometricNormal;
            turned += normals_turned_away(normals.render(request).image, request.camera);
        }
        findings.none(std::string(name) + ": non-finite values", nonfinite);
        findings.none(std::string(name) + ": values that are no light", bad);
        findings.none(std::string(name) + ": normals turned away", turned);
    }
}

constexpr Case kScaleCases[] = {
    {"19", "scale", "white things vanish", Layer::kPicture,
        "No ray meets again what it has just left, at any size and in any place: white surfaces "
        "under a white sky cannot be seen.",
        white_things_vanish},
    {"20", "scale", "size does not show", Layer::kSequence,
        "A scene 2^k times as large, seen from 2^k times as far, gives the same bits: no epsilon "
        "is absolute.",
        size_does_not_show},
    {"21", "scale", "lamps light what faces them", Layer::kPicture,
        "The ground below a lamp is as bright as the closed form says, from a micrometre to the "
        "size of a planet.",
        lamps_light_what_faces_them},
    {"23", "scale", "size is not remembered", Layer::kSequence,
        "A tenth of a millimetre or a hundred kilometres large, a scene has the same histories.",
        size_is_not_remembered},
    {"24", "scale", "cameras in odd places", Layer::kPicture,
        "A camera on a floor, in a corner, in a ball or in a mesh sees finite light and the sides "
        "of "
        "things that face it.",
        cameras_in_odd_places},
    {"M1", "scale", "scaled from afar", Layer::kSequence,
        "Geometry and camera times 2^k, a million times as far away as they are large, give the "
        "same bits.",
        scaled_from_afar},
};

constexpr Guard kScaleGuards[] = {
    {"offset_by_rounding", "19", "geometry/surface.glsl", "const float POSITION_ULPS = 16.0 *",
        "const float POSITION_ULPS = 1.0 *"},
    {"offset_of_the_scene", "20 M1", "geometry/surface.glsl",
        "{ return POSITION_ULPS * max_component(extent); }", "{ return 3e-4; }"},
    {"depth_in_footprints", "20", "svgf/surface.glsl",
        "0.1 * frame.camera.pixel_footprint * p.depth;", "1e-2;"},
    {"plane_in_footprints", "23", "svgf/past.glsl",
        "reproject_depth * frame.prev_camera.pixel_footprint * (depth + motion.z);",
        "reproject_depth * 1e-3;"},
    {"either_side_faces", "24", "geometry/surface.glsl",
        "s.geometric_normal = s.front ? s.geometric_normal : -s.geometric_normal;", ""},
    {"lamp_end_offset", "21", "path_trace/direct.glsl",
        "offset_origin(light.position, light.normal, light.offset, -light.wi)",
        "light.position + 1e-3 * light.wi"},
};

}  // namespace

Group scale_group()
{
    return {kScaleCases, kScaleGuards};
}

}  // namespace farlight::lab
