// Origin: scenes far from the origin of their coordinates are drawn as if they lay about it.
#include "lab/groups.h"
#include "lab/meshes.h"
#include "lab/moved.h"
#include "lab/rendering.h"
#include "lab/statistics.h"

#include "lab/device_scene.h"

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>

namespace farlight::lab {
namespace {

constexpr Extent kFarExtent{40, 32};

/// A node that goes to and fro within a second, carried by one that stands at `place`.
std::uint32_t add_moving_node(Scene& scene, const glm::dvec3& place)
{
    const auto carrier = static_cast<std::uint32_t>(scene.animation.nodes.size());
    scene.animation.nodes.push_back({.name = "carrier", .translation = place});
    scene.animation.nodes.push_back({.name = "carried", .parent = carrier});
    Track track;
    track.index = carrier + 1;
    track.times = {0, 0.5, 1};
    track.values = {0, 0, 0, 0.5F, 0.25F, 0, 0, 0, 0};
    track.period = 1;
    scene.animation.tracks.push_back(track);
    return carrier + 1;
}

/// A mesh that swells and shrinks, without a node and on one.
void add_deforming_mesh(Scene& scene, std::uint32_t node, const glm::dvec3& place)
{
    Mesh mesh = bumpy_sphere(12, 6);
    mesh.morph_targets.push_back({mesh.positions, {}});
    scene.meshes.push_back(std::move(mesh));
    MeshInstance instance;
    instance.mesh = static_cast<std::uint32_t>(scene.meshes.size() - 1);
    instance.world_from_object = glm::dmat4(glm::dmat3(0.25));
    instance.world_from_object[3] = glm::dvec4(place, 1);
    instance.morph_weights = {0};
    Track track;
    track.target = Track::Target::kMorphWeights;
    track.index = static_cast<std::uint32_t>(scene.objects.size());
    track.times = {0, 1};
    track.values = {0, 0.5F};
    track.period = 2;
    scene.animation.tracks.push_back(track);
    scene.objects.push_back({"swelling", 0, instance, true, node});
}

/// A foggy room with everything in it that has a position.
Scene everything()
{
    Scene scene = room_with(bumpy_sphere(24, 12));
    std::get<MeshInstance>(scene.objects[0].shape).world_from_object =
        glm::dmat4(glm::dmat3(0.625));
    Material metal{"metal", glm::vec3(0.75F)};
    metal.metallic = 1;
    metal.roughness = 0.25F;
    Material glass{"glass", glm::vec3(1)};
    glass.specular = glass.transmission = 1;
    glass.roughness = 0;
    scene.materials.insert(scene.materials.end(), {metal, glass});
    scene.objects.push_back({"ball", 2, Sphere{{1, -1.5, 0.5}, 0.5}});
    scene.objects.push_back({"glass ball", 3, Sphere{{-1, -1.5, 1}, 0.375}});
    scene.objects.push_back({"disk", 2, Disk{{-1, -1, 0.5}, {0, 1, 0}, 0.5}});
    scene.objects.push_back({"lamp", 1, Sphere{{-1.5, 1, -1}, 0.125}});
    scene.lights.push_back({.name = "point", .intensity = glm::vec3(2), .position = {1, 1, 1}});
    const std::uint32_t node = add_moving_node(scene, {0.5, 1, 0.25});
    scene.objects.push_back({"moving", 2, Sphere{{0, 0, 0}, 0.25}, true, node});
    scene.lights.push_back({.name = "moving point", .node = node});
    add_deforming_mesh(scene, kNone, {-1, 0.5, 0.5});
    add_deforming_mesh(scene, node, {1, 0, 0});
    scene.medium = {"fog", glm::vec3(0.01F), glm::vec3(0.03F), 0.25F};
    scene.camera = {{0, 0, 1.75}, {0, 0, 0}, {0, 1, 0}, 75};
    // What is a whole number of 2^-16 stays itself when something large is added and subtracted.
    each_position(scene, [](glm::dvec3& p) { p = glm::round(p * 0x1p16) / 0x1p16; });
    return scene;
}

constexpr DebugView kLookedAt[] = {DebugView::kFinal, DebugView::kObjectId, DebugView::kDepth,
    DebugView::kMotion, DebugView::kHistoryLength, DebugView::kPosition};

/// What each of kLookedAt shows in the last of four frames in which camera and things move.
struct Looks {
    std::array<std::vector<float>, std::size(kLookedAt)> values;
    double nonfinite = 0;

    const std::vector<float>& of(DebugView view) const
    {
        return values.at(static_cast<std::size_t>(
            std::find(std::begin(kLookedAt), std::end(kLookedAt), view) - kLookedAt));
    }
};

RenderedFrame last_frame(const DeviceScene& scene, const CameraPose& camera, DebugView shown)
{
    View view(scene.shared);
    RenderRequest request = linear_request(scene.scene, kFarExtent, {});
    request.camera = camera;
    request.settings.view = shown;
    RenderedFrame frame;
    BadValues met;
    for (int i = 0; i < 4; ++i) {
        request.camera.position += glm::dvec3(0.03125, 0.015625, -0.03125);
        request.time = 0.0625 * i;
        frame = view.render(request);
        met.add(frame.bad_values);
    }
    frame.bad_values = met;
    return frame;
}

Looks looks_of(const Scene& source, const CameraPose& camera)
{
    const DeviceScene scene(load_onto_device(source));
    Looks looks;
    for (std::size_t i = 0; i < looks.values.size(); ++i) {
        const RenderedFrame frame = last_frame(scene, camera, kLookedAt[i]);
        looks.values.at(i) = values_of(frame.image);
        looks.nonfinite += frame.bad_values.all();
    }
    return looks;
}

/// Positions shown, less `by`, against those of before, in roundings of the largest coordinate.
double positions_off(const Looks& looks, const Looks& before, const glm::dvec3& by)
{
    const std::vector<float>& now = looks.of(DebugView::kPosition);
    const std::vector<float>& then = before.of(DebugView::kPosition);
    const double ulp = 0x1p-23 * std::max({std::abs(by.x), std::abs(by.y), std::abs(by.z)});
    double off = 0;
    for (std::size_t i = 0; i < now.size(); ++i)
        off = farther(off,
            std::abs(static_cast<double>(now[i]) - by[static_cast<int>(i % 3)]
                - static_cast<double>(then[i]))
                / ulp);
    return off;
}

void far_is_as_near(Findings& findings, Length length)
{
    const Scene scene = everything();
    const Looks near = looks_of(scene, scene.camera);
    findings.none("non-finite values about the origin", near.nonfinite);
    // Of the grid that origins lie on.
    std::vector<glm::dvec3> places{{0x1p20, -0x1p17, 0x1p18}};
    if (length == Length::kLong)
        places.insert(places.end(), {{-0x1p17, 0, 0}, {0x1p24, 0x1p24, -0x1p22}, {0, 0x1p30, 0}});
    for (const glm::dvec3& place : places) {
        const Scene there = moved(scene, place);
        const Looks far = looks_of(there, there.camera);
        const std::string name = std::to_string(std::lround(glm::length(place))) + " away: ";
        findings.none(name + "non-finite values", far.nonfinite);
        for (std::size_t i = 0; i < far.values.size(); ++i)
            if (kLookedAt[i] != DebugView::kPosition)
                findings.none(name + "values of other bits in the view "
                        + std::string(kDebugViewNames[static_cast<std::size_t>(kLookedAt[i])]),
                    values_unlike(far.values.at(i), near.values.at(i)));
        findings.at_most(name + "positions shown off [ulp]", positions_off(far, near, place), 1);
    }
}

/// Mean of each tile of 8x8 pixels.
std::vector<double> tile_means(const Image& image)
{
    const auto across = static_cast<std::size_t>(image.extent.width / 8);
    std::vector<double> tiles(across * static_cast<std::size_t>(image.extent.height / 8));
    for (int y = 0; y < image.extent.height; ++y)
        for (int x = 0; x < image.extent.width; ++x) {
            const glm::dvec3 value(pixel(image, x, y));
            const auto row = static_cast<std::size_t>(y / 8);
            tiles[row * across + static_cast<std::size_t>(x / 8)] +=
                (value.x + value.y + value.z) / (3 * 64);
        }
    return tiles;
}

struct TileSamples {
    std::vector<double> mean;
    std::vector<double> variance;  ///< Of the mean.
};

constexpr int kSeeds = 12;

TileSamples sampled_tiles(const Scene& source, const CameraPose& camera, std::uint32_t first_seed)
{
    const DeviceScene scene(load_onto_device(source));
    RenderSettings settings;
    settings.denoiser = Denoiser::kOff;
    TileSamples samples;
    std::vector<double> m2;
    for (int n = 1; n <= kSeeds; ++n) {
        settings.seed = first_seed + static_cast<std::uint32_t>(n);
        View view(scene.shared);
        RenderRequest request = linear_request(scene.scene, kFarExtent, settings);
        request.camera = camera;
        const std::vector<double> tiles = tile_means(view.render(request).image);
        samples.mean.resize(tiles.size());
        m2.resize(tiles.size());
        for (std::size_t i = 0; i < tiles.size(); ++i) {
            const double delta = tiles[i] - samples.mean[i];
            samples.mean[i] += delta / n;
            m2[i] += delta * (tiles[i] - samples.mean[i]);
        }
    }
    for (const double sum : m2)
        samples.variance.push_back(sum / (kSeeds - 1) / kSeeds);
    return samples;
}

/// Welch's t of the tile where the two differ most.
double tiles_apart(const TileSamples& a, const TileSamples& b)
{
    double most = 0;
    for (std::size_t i = 0; i < a.mean.size(); ++i)
        most = farther(
            most, std::abs(a.mean[i] - b.mean[i]) / std::sqrt(a.variance[i] + b.variance[i]));
    return most;
}

/// Of so many tiles with the same mean, one is farther apart in one of a hundred runs (Sidak).
/// Degrees of freedom: the least that Welch's formula can give.
double bound_of_tiles(std::size_t tiles)
{
    const double one = 1 - std::pow(0.99, 1.0 / static_cast<double>(tiles));
    return boost::math::quantile(
        boost::math::complement(boost::math::students_t(kSeeds - 1), one / 2));
}

/// How two frames of one scene differ where both show the same thing.
struct SurfaceDifference {
    double elsewhere = 0;  ///< Share of pixels that show another object.
    double depth = 0;  ///< Relative.
    double motion = 0;  ///< [px]
    double lengths = 0;  ///< Share of pixels whose histories are of another length.
};

SurfaceDifference difference(const Looks& a, const Looks& b)
{
    SurfaceDifference sum;
    const auto value = [](const Looks& looks, DebugView view, std::size_t i, std::size_t c) {
        return static_cast<double>(looks.of(view)[3 * i + c]);
    };
    const std::size_t pixels = a.of(DebugView::kDepth).size() / 3;
    const double share = 1 / static_cast<double>(pixels);
    for (std::size_t i = 0; i < pixels; ++i) {
        if (value(a, DebugView::kObjectId, i, 0) != value(b, DebugView::kObjectId, i, 0)) {
            sum.elsewhere += share;
            continue;
        }
        const auto off = [&](DebugView view, std::size_t c) {
            return std::abs(value(a, view, i, c) - value(b, view, i, c));
        };
        sum.depth =
            farther(sum.depth, off(DebugView::kDepth, 0) / value(b, DebugView::kDepth, i, 0));
        sum.motion =
            farther(sum.motion, std::hypot(off(DebugView::kMotion, 0), off(DebugView::kMotion, 1)));
        sum.lengths += off(DebugView::kHistoryLength, 0) == 0 ? 0 : share;
    }
    return sum;
}

/// A scene seen at some place against what is to be seen there.
class Expected {
public:
    explicit Expected(const Scene& scene)
        : looks_(looks_of(scene, scene.camera))
        , tiles_(sampled_tiles(scene, scene.camera, 0))
    {
    }

    void report(Findings& findings, const std::string& name, const Scene& scene,
        const CameraPose& camera) const
    {
        const SurfaceDifference off = difference(looks_of(scene, camera), looks_);
        findings.at_most(name + "share of pixels that show something else", off.elsewhere, 0.002);
        findings.at_most(name + "depth off, relative", off.depth, 1e-5);
        findings.at_most(name + "motion vectors off [px]", off.motion, 1e-3);
        findings.at_most(name + "share of histories of another length", off.lengths, 0.002);
        const TileSamples tiles = sampled_tiles(scene, camera, 1000);
        findings.at_most(name + "tiles apart [standard errors]", tiles_apart(tiles, tiles_),
            bound_of_tiles(tiles.mean.size()));
    }

private:
    Looks looks_;
    TileSamples tiles_;
};

std::string distance_named(double distance)
{
    char name[40];
    std::snprintf(name, sizeof name, "%g away: ", distance);
    return name;
}

void moved_anywhere(Findings& findings, Length length)
{
    const Scene scene = everything();
    const Expected near(scene);
    // At the first it is not wide, so that the scene's own origin alone keeps it.
    std::vector<double> distances{1e4, 1e6};
    if (length == Length::kLong)
        distances = {10, 1e3, 1e4, 1e5, 1e6, 1e7, 1e9};
    for (const double distance : distances) {
        const Scene there = moved(scene, distance * glm::dvec3(0.7, -0.3, 0.648074));
        near.report(findings, distance_named(distance), there, there.camera);
    }
}

/// The camera flies past a line of the grid that origins of wide scenes lie on.
void a_camera_in_a_wide_scene(Findings& findings, Length length)
{
    Scene scene = everything();
    std::vector<double> powers{20};
    if (length != Length::kLong)
        scene.medium = {};  // three times the work
    const Expected near(scene);
    if (length == Length::kLong)
        powers = {17, 20, 24, 30};
    for (const double power : powers) {
        const double step = std::exp2(power - 10);
        const double distance = 976.5 * step - 0.078125;
        Scene wide = moved(scene, {distance, 0, 0});
        const CameraPose camera = wide.camera;
        // The scene's own camera looks at its other end.
        wide.objects.push_back({"other end", 0, Sphere{{-distance, 0, 0}, 1}});
        wide.camera = {{-distance, 0, 4}, {-distance, 0, 0}, {0, 1, 0}, 45};
        near.report(findings, distance_named(2 * distance), wide, camera);
    }
}

constexpr Case kOriginCases[] = {
    {"22", "origin", "far is as near", Layer::kSequence,
        "A scene with everything that has a position, moved by a million, gives the same bits: "
        "pictures, depths, motion, histories.",
        far_is_as_near},
    {"22b", "origin", "a camera in a wide scene", Layer::kSequence,
        "A camera two million away from where the scene's own camera stands sees what is there as "
        "if there were nothing else.",
        a_camera_in_a_wide_scene},
    {"M2", "origin", "moved anywhere", Layer::kSequence,
        "Moved by any vector a scene is the same within rounding, and its picture by tiles.",
        moved_anywhere},
};

constexpr Guard kOriginGuards[] = {
    {"counts_from_near", "22 M2"},
    {"follows_the_camera", "22b"},
};

}  // namespace

Group origin_group()
{
    return {kOriginCases, kOriginGuards};
}

}  // namespace farlight::lab
