// Histories: what a pixel remembers is what it shows, however the camera got there.
#include "lab/device_scene.h"
#include "lab/groups.h"
#include "lab/history_oracle.h"
#include "lab/meshes.h"
#include "lab/projection.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

namespace farlight::lab {
namespace {

struct LengthAgreement {
    int pixels = 0;
    int differ = 0;
    int differ_inside = 0;  ///< Away from edges, in all frames so far that a history goes back.
    int outside_of_range = 0;
    int new_pixels = 0;
};

/// A wall with a ball and a post before it, and sky.
Scene still_life()
{
    Scene scene;
    scene.materials.push_back({"white"});
    scene.objects.push_back({"floor", 0, Quad{{-9, -1, -9}, {0, 0, 18}, {18, 0, 0}}});
    scene.objects.push_back({"wall", 0, Quad{{-3, -1, -4}, {6, 0, 0}, {0, 3, 0}}});
    scene.objects.push_back({"ball", 0, Sphere{{0.3, 0, -1}, 0.8}});
    scene.objects.push_back({"post", 0, Quad{{-1.2, -1, 0}, {0.3, 0, 0}, {0, 2, 0}}});
    scene.background = glm::vec3(1);
    scene.camera = {{0, 0.4, 4}, {0, 0, 0}, {0, 1, 0}, 45};
    return scene;
}

/// Lengths along a script of cameras, beside the oracle's; every frame compared.
LengthAgreement follow_script(const Scene& source, const std::vector<CameraPose>& script)
{
    const DeviceScene scene(source);
    View view(scene.shared);
    LengthAgreement agreement;
    Lengths old;
    Seen before;
    for (std::size_t frame = 0; frame < script.size(); ++frame) {
        const Image drawn =
            view.render(request_of(scene.scene, script[frame], DebugView::kHistoryLength)).image;
        Seen now = seen_from(scene, script[frame]);
        Lengths lengths(old);
        lengths.resize(static_cast<std::size_t>(kRemembered.width)
            * static_cast<std::size_t>(kRemembered.height));
        for (int y = 0; y < kRemembered.height; ++y)
            for (int x = 0; x < kRemembered.width; ++x) {
                const bool first = frame == 0;
                const int expected =
                    first ? (met(now, x, y) ? 1 : 0) : length_of(now, before, old, x, y);
                const float found = pixel(drawn, x, y).x;
                const bool same = found == static_cast<float>(expected);
                agreement.pixels += 1;
                agreement.differ += same ? 0 : 1;
                agreement.differ_inside += same || !away_from_edges(now, x, y) ? 0 : 1;
                agreement.outside_of_range +=
                    found >= (met(now, x, y) ? 1 : 0) && found <= kLongest ? 0 : 1;
                agreement.new_pixels += !first && expected == 1 ? 1 : 0;
                // From what was drawn: a pixel that differs is counted once.
                at(lengths, x, y) = static_cast<int>(found);
            }
        old = lengths;
        before = std::move(now);
    }
    return agreement;
}

void report(Findings& findings, const LengthAgreement& agreement, int least_new)
{
    findings.at_most(
        "share of pixels whose history is not the oracle's, of " + std::to_string(agreement.pixels),
        static_cast<double>(agreement.differ) / agreement.pixels, 0.005);
    findings.none("of these away from edges", agreement.differ_inside);
    findings.none("histories outside of 1 to the longest", agreement.outside_of_range);
    findings.at_least("pixels that came into view", agreement.new_pixels, least_new);
}

void lengths_are_the_oracles(Findings& findings, Length length)
{
    const Scene scene = still_life();
    std::vector<CameraPose> script;
    const int frames = length == Length::kLong ? 60 : 16;
    for (int i = 0; i < frames; ++i) {
        CameraPose pose = scene.camera;
        const double t = std::max(0, i - 7);  // at rest until no history grows, then moving
        pose.position += glm::dvec3(0.21 * t, 0.03 * t, -0.09 * t);
        pose.target.x += 0.05 * t;
        script.push_back(pose);
    }
    report(findings, follow_script(scene, script), 100);
}

/// The point that a camera at `pose` looks at, `degrees` further around.
CameraPose turned(CameraPose pose, double degrees)
{
    const glm::dvec3 way = pose.target - pose.position;
    const double c = std::cos(glm::radians(degrees));
    const double s = std::sin(glm::radians(degrees));
    pose.target = pose.position + glm::dvec3(c * way.x + s * way.z, way.y, c * way.z - s * way.x);
    return pose;
}

/// 90 degrees a frame, tenfold zoom, and back.
void turns_and_zooms(Findings& findings, Length /*length*/)
{
    const Scene scene = room_with(bumpy_sphere(24, 12));
    std::vector<CameraPose> script;
    for (const double degrees : {0, 0, 90, 180, 270, 265, 260, 170})
        script.push_back(turned(scene.camera, degrees));
    for (const double fov : {70.0, 8.0, 7.9, 70.0}) {
        script.push_back(scene.camera);
        script.back().vertical_fov_degrees = fov;
    }
    report(findings, follow_script(scene, script), 5 * kRemembered.width * kRemembered.height);
}

/// Into the ball, out of it, and through the wall: surfaces come as near as they can and are behind
/// a frame later.
void through_things(Findings& findings, Length /*length*/)
{
    const Scene scene = still_life();
    std::vector<CameraPose> script;
    for (double z = 1; z > -6; z -= 0.27) {
        CameraPose pose = scene.camera;
        pose.position = {0.3, 0.05, z};
        pose.target = {0.28, 0, z - 1};
        script.push_back(pose);
    }
    report(findings, follow_script(scene, script), 1000);
}

/// A floor without end, seen after a step back: what is now ahead was behind.
void behind_is_not_ahead(Findings& findings, Length /*length*/)
{
    Scene scene;
    scene.materials.push_back({"white"});
    scene.objects.push_back({"floor", 0, Quad{{-500, -1, -500}, {0, 0, 1000}, {1000, 0, 0}}});
    scene.background = glm::vec3(1);
    scene.camera = {{0, 0, 0}, {0, -0.3, -1}, {0, 1, 0}, 90};
    const DeviceScene on_device(scene);
    int behind = 0;
    int remembered = 0;
    for (const double back : {1.0, 3.0, 10.0}) {
        View view(on_device.shared);
        for (int i = 0; i < 3; ++i)
            view.render(request_of(scene, scene.camera, DebugView::kHistoryLength));
        CameraPose pose = scene.camera;
        pose.position.z += back;
        pose.target.z += back;
        const Image length = view.render(request_of(scene, pose, DebugView::kHistoryLength)).image;
        const Seen now = seen_from(on_device, pose);
        for (int y = 0; y < kRemembered.height; ++y)
            for (int x = 0; x < kRemembered.width; ++x) {
                if (!met(now, x, y)
                    || project(scene.camera, pixel(now.position, x, y), kRemembered).z > 0)
                    continue;
                ++behind;
                remembered += pixel(length, x, y).x == 1 ? 0 : 1;
            }
    }
    findings.at_least("pixels that show what was behind", behind, 500);
    findings.none("of these with a history", remembered);
}

/// Two rooms in a row as one mesh of one material, red and green by their vertices' colours: only
/// where they are tells them apart.
Scene red_and_green_room()
{
    Scene scene;
    Mesh mesh{"rooms", {}, {}, {}};
    const auto add_room = [&](double z, const glm::vec4& color) {
        for (int axis = 0; axis < 3; ++axis)
            for (const float side : {-2.0F, 2.0F}) {
                const auto first = static_cast<unsigned>(mesh.positions.size());
                for (const glm::vec2 corner :
                    {glm::vec2(-2, -2), glm::vec2(2, -2), glm::vec2(2, 2), glm::vec2(-2, 2)}) {
                    glm::vec3 p(0);
                    p[axis] = side;
                    p[(axis + 1) % 3] = corner.x;
                    p[(axis + 2) % 3] = corner.y;
                    mesh.positions.push_back(p + glm::vec3(0, 0, z));
                    mesh.colors.push_back(color);
                }
                mesh.triangles.emplace_back(first, first + 1, first + 2);
                mesh.triangles.emplace_back(first, first + 2, first + 3);
            }
    };
    add_room(0, {1, 0, 0, 1});
    add_room(-4.5, {0, 1, 0, 1});
    scene.meshes.push_back(std::move(mesh));
    scene.materials.push_back({"paint", glm::vec3(0.8F)});
    scene.objects.push_back({"rooms", 0, MeshInstance{}});
    for (const double z : {0.0, -4.5}) {
        PunctualLight lamp;
        lamp.name = "lamp";
        lamp.intensity = glm::vec3(5);
        lamp.position = {0, 1, z};
        scene.lights.push_back(lamp);
    }
    scene.camera = {{0, 0, 1.5}, {0, 0, -1}, {0, 1, 0}, 60};
    return scene;
}

/// White light on a green wall is green; a denoiser works on light without albedo, so what is seen
/// of the wrong room is what its wall gets of the other's brightness: the red room is dark.
void teleports_leave_nothing(Findings& findings, Length /*length*/)
{
    Scene scene = red_and_green_room();
    scene.lights.pop_back();  // the red room is lit, the green one dark
    const DeviceScene on_device(scene);
    double most = 0;
    int shown = 0;
    for (const double to : {-4.5, -4.0, -5.5}) {
        View view(on_device.shared);
        for (int i = 0; i < 6; ++i)
            view.render(request_of(scene, scene.camera, DebugView::kFinal));
        CameraPose pose = scene.camera;
        pose.position.z += to;
        pose.target.z += to;
        for (int i = 0; i < 2; ++i) {
            const RenderedFrame frame = view.render(request_of(scene, pose, DebugView::kFinal));
            for (const float value : values_of(frame.image)) {
                most = value <= most ? most : value;
                shown += value == 0 ? 0 : 1;
            }
        }
    }
    findings.at_most("light of the lit room in the dark one", most, 0);
    findings.none("values that show it", shown);
}

/// Fields of view from next to nothing to half of all, upright along the view.
void strange_cameras(Findings& findings, Length /*length*/)
{
    const DeviceScene on_device(room_with(bumpy_sphere(24, 12)));
    View view(on_device.shared);
    std::uint32_t bad = 0;
    int no_light = 0;
    double skew = 0;
    const auto look = [&](const CameraPose& pose) {
        const CameraBasis basis = camera_basis(pose);
        for (const glm::dvec2 off : {glm::dvec2(glm::dot(basis.right, basis.up), 0),
                 glm::dvec2(glm::dot(basis.right, basis.forward), 0),
                 glm::dvec2(glm::dot(basis.up, basis.forward), 0),
                 glm::dvec2(glm::length(basis.right), 1), glm::dvec2(glm::length(basis.up), 1),
                 glm::dvec2(glm::length(basis.forward), 1)}) {
            skew = farther(skew, std::abs(off.x - off.y));
        }
        const RenderedFrame frame =
            view.render(request_of(on_device.scene, pose, DebugView::kFinal));
        bad += frame.bad_values.all();
        for (const float value : values_of(frame.image))
            no_light += value >= 0 && value < 1e6F ? 0 : 1;
    };
    for (const double fov : {0.1, 1.0, 45.0, 120.0, 170.0, 179.0}) {
        CameraPose pose = on_device.scene.camera;
        pose.vertical_fov_degrees = fov;
        look(pose);
    }
    for (const glm::dvec3 way : {glm::dvec3(0, 1, 0), glm::dvec3(0, -1, 0), glm::dvec3(1e-9, 1, 0),
             glm::dvec3(0, 1, 1e-4), glm::dvec3(0)}) {
        CameraPose pose = on_device.scene.camera;
        pose.target = pose.position + way;
        look(pose);
    }
    for (const double aside : {1.0, 1e-3, 1e-5, 1e-7, 1e-12}) {
        CameraPose pose = on_device.scene.camera;
        const glm::dvec3 way(1, 2, 3);
        pose.target = pose.position + way;
        pose.up = way + aside * glm::dvec3(0.3, -0.2, 0.7);
        look(pose);
    }
    findings.none("values that were no light", bad);
    findings.none("values shown that are no light", no_light);
    findings.at_most("skew of the camera's axes", skew, 1e-6);
}

constexpr Case kHistoryCases[] = {
    {"25", "history", "behind the camera", Layer::kSequence,
        "What was behind last frame's camera has no history.", behind_is_not_ahead},
    {"25b", "history", "through things", Layer::kSequence,
        "A camera that goes through walls and balls keeps the histories that the oracle keeps.",
        through_things},
    {"62", "history", "lengths of histories", Layer::kSequence,
        "A pixel's history is as long as an oracle in double precision says.",
        lengths_are_the_oracles},
    {"63", "history", "from a lit room into a dark one", Layer::kSequence,
        "A teleport takes nothing along.", teleports_leave_nothing},
    {"63b", "history", "strange cameras", Layer::kPicture,
        "Any field of view and any direction give a picture.", strange_cameras},
    {"64", "history", "a quarter turn a frame", Layer::kSequence,
        "What comes into view by turns of 90 degrees and tenfold zooms starts anew, all else goes "
        "on.",
        turns_and_zooms},
};

constexpr Guard kHistoryGuards[] = {
    {"ahead", "25", "svgf/past.glsl",
        "uintBitsToFloat(surface.x);\n    Past p;\n    p.exists = motion.w > 0.0;",
        "uintBitsToFloat(surface.x);\n    Past p;\n    p.exists = true;"},
    {"plane_distance", "25b 63", "svgf/past.glsl", "plane_distance <= p.tolerance",
        "plane_distance <= 1e6 * p.tolerance"},
    {"up_along_the_view", "63b"},
    {"least_of_taps", "62 64", "svgf/temporal.comp",
        "sum.least_length = min(sum.least_length, tap_length);", "sum.least_length = tap_length;"},
};

}  // namespace

Group history_group()
{
    return {kHistoryCases, kHistoryGuards};
}

}  // namespace farlight::lab
