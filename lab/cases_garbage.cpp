// Garbage: files with numbers that are none, and scenes with nothing in them.
#include "lab/device_scene.h"
#include "lab/groups.h"
#include "lab/meshes.h"
#include "lab/ray_probe.h"

#include "server/scene/mesh_repair.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace farlight::lab {
namespace {

constexpr float kNoNumber = std::numeric_limits<float>::quiet_NaN();
constexpr float kUnbounded = std::numeric_limits<float>::infinity();

// ---------------------------------------------------------------- spoilt meshes

/// Triangles that no position or no number backs, all over a mesh.
struct SpoiltMesh {
    Mesh mesh;
    std::size_t unbounded = 0;
    std::size_t astray = 0;
};

SpoiltMesh spoilt(const Mesh& plain)
{
    constexpr float kSpoilers[] = {kNoNumber, kUnbounded, -kUnbounded, 3e38F, -1e12F};
    std::mt19937 random(6);
    SpoiltMesh spoilt{plain};
    spoilt.mesh.triangles.clear();
    for (const glm::uvec3& triangle : plain.triangles) {
        spoilt.mesh.triangles.push_back(triangle);
        if (random() % 20 == 0) {
            glm::vec3 bad = plain.positions[triangle.x];
            bad[static_cast<int>(random() % 3)] = kSpoilers[random() % std::size(kSpoilers)];
            spoilt.mesh.positions.push_back(bad);
            const auto last = static_cast<std::uint32_t>(spoilt.mesh.positions.size() - 1);
            spoilt.mesh.triangles.emplace_back(last, triangle.y, triangle.z);
            ++spoilt.unbounded;
        }
        if (random() % 20 == 0) {
            const std::uint32_t far = random() % 2 == 0 ? 0xffffffffU : 1U << 20U;
            spoilt.mesh.triangles.emplace_back(triangle.x, far, triangle.z);
            ++spoilt.astray;
        }
    }
    return spoilt;
}

/// Rays that find something else in two scenes.
double unlike_rays(const Scene& a, const Scene& b, std::size_t count)
{
    const DeviceScene one(a);
    const DeviceScene other(b);
    const std::vector<TestRay> rays = random_rays(scene_bounds(a), count, 6);
    const std::vector<ProbeHit> expected = RayProbe(one).by_tree(rays);
    const std::vector<ProbeHit> found = RayProbe(other).by_tree(rays);
    double unlike = 0;
    for (std::size_t i = 0; i < rays.size(); ++i)
        unlike += found[i].t == expected[i].t && found[i].slot == expected[i].slot ? 0 : 1;
    return unlike;
}

/// Any bits as positions, any number as index, a tenth of both sensible.
Mesh garbage(unsigned seed)
{
    std::mt19937 random(seed);
    Mesh mesh{"garbage", {}, {}, {}};
    constexpr std::uint32_t kCount = 1000;
    for (std::uint32_t i = 0; i < kCount; ++i) {
        glm::vec3 p(0);
        for (int axis = 0; axis < 3; ++axis)
            p[axis] = random() % 10 == 0
                ? std::bit_cast<float>(static_cast<std::uint32_t>(random()))
                : static_cast<float>(random() % 1000) / 500 - 1;
        mesh.positions.push_back(p);
        glm::uvec3 t(0);
        for (int k = 0; k < 3; ++k)
            t[k] = static_cast<std::uint32_t>(random() % 20 == 0 ? random() : random() % kCount);
        mesh.triangles.push_back(t);
    }
    return mesh;
}

/// Garbage as the loader leaves it, drawn: what is counted, kept and met adds up.
void report_garbage(Findings& findings, unsigned meshes)
{
    double lost = 0;
    double no_numbers = 0;
    double not_built = 0;
    for (unsigned seed = 1; seed <= meshes; ++seed) {
        Mesh mesh = garbage(seed);
        const std::size_t before = mesh.triangles.size();
        const MeshRepairs repairs = repair_mesh(mesh);
        lost += static_cast<double>(before - mesh.triangles.size() - repairs.zero_area_triangles
            - repairs.unbounded_triangles - repairs.astray_triangles);
        try {
            const DeviceScene scene(scene_of(mesh));
            const std::vector<TestRay> rays = random_rays({{-1, -1, -1}, {1, 1, 1}}, 500, seed);
            for (const ProbeHit& hit : RayProbe(scene).by_tree(rays))
                no_numbers += hit.met() && !(hit.t >= 0 && hit.t <= 1e12F) ? 1 : 0;
        } catch (const std::exception&) {
            not_built += 1;
        }
    }
    findings.none("triangles of garbage neither kept nor counted", lost);
    findings.none("rays that meet garbage nowhere", no_numbers);
    findings.none("garbage that no tree could be built over", not_built);
}

void bad_vertices_are_left_out(Findings& findings, Length length)
{
    const Mesh plain = bumpy_sphere(60, 30);
    SpoiltMesh bad = spoilt(plain);
    const std::size_t rays = length == Length::kLong ? 200'000 : 20'000;
    const MeshRepairs repairs = repair_mesh(bad.mesh);
    const auto off = [](std::size_t found, std::size_t expected) {
        return std::abs(static_cast<double>(found) - static_cast<double>(expected));
    };
    findings.none("triangles of no finite corner miscounted, of " + std::to_string(bad.unbounded),
        off(repairs.unbounded_triangles, bad.unbounded));
    findings.none("triangles of a corner that is none miscounted, of " + std::to_string(bad.astray),
        off(repairs.astray_triangles, bad.astray));
    findings.none(
        "rays that the rest changes for", unlike_rays(scene_of(plain), scene_of(bad.mesh), rays));
    report_garbage(findings, length == Length::kLong ? 1000 : 20);
}

/// What becomes unbounded only on its way to the world.
void numbers_lost_on_the_way(Findings& findings, Length length)
{
    const Scene plain = scene_of(bumpy_sphere(60, 30));
    Scene more = plain;
    more.meshes.push_back({"overflows", {{0, 0, 0}, {1e11F, 1, 1}, {1, 2, 3}}, {}, {{0, 1, 2}}});
    MeshInstance instance;
    instance.mesh = 1;
    instance.world_from_object = glm::dmat4(glm::dmat3(1e30));
    more.objects.push_back({"overflows", 0, instance});
    double refused = 0;
    double dropped = 0;
    double unlike = 0;
    try {
        dropped = static_cast<double>(pack_scene(more).dropped_triangles);
        unlike = unlike_rays(plain, more, length == Length::kLong ? 200'000 : 20'000);
    } catch (const std::exception&) {
        refused = 1;
    }
    findings.none("scenes that no tree could be built over", refused);
    findings.at_least("triangles left out and counted", dropped, 1);
    findings.none("rays that the rest changes for", unlike);
}

// ---------------------------------------------------------------- nothing there

struct Emptiness {
    const char* name;
    Scene scene;
    double seen = 0;  ///< Radiance of every pixel.
};

/// Scenes of which only what surrounds them can be seen.
std::vector<Emptiness> emptinesses()
{
    std::vector<Emptiness> all;
    all.push_back({"nothing", {}, 0});
    Scene sky;
    sky.background = glm::vec3(0.75F);
    all.push_back({"sky alone", sky, 0.75});
    Scene materials = sky;
    materials.materials = {{"white"}, {"lamp", glm::vec3(0), glm::vec3(1)}};
    materials.materials[0].metallic = 1;
    all.push_back({"materials of nothing", materials, 0.75});
    Scene lit = sky;
    lit.lights.push_back({.name = "point"});
    all.push_back({"a lamp that nothing shows", lit, 0.75});
    Scene invisible = materials;
    invisible.objects.push_back({"no area", 1, Sphere{{0, 0, 0}, 1e-25}});
    invisible.meshes.push_back({"no triangle", {}, {}, {}});
    invisible.objects.push_back({"no triangle", 0, MeshInstance{}});
    all.push_back({"things without a size", invisible, 0.75});
    Scene fog = sky;
    fog.medium = {"fog", glm::vec3(0.125F), glm::vec3(0), 0};
    // Fog of a scene without bounds ends 4 m from the origin, where the camera stands.
    all.push_back({"fog alone", fog, 0.75 * std::exp(-0.125 * 4)});
    return all;
}

void nothing_shows_what_is_behind(Findings& findings, Length /*length*/)
{
    for (const auto& [name, scene, seen] : emptinesses()) {
        const DeviceScene on_device(load_onto_device(scene));
        double off = 0;
        double nonfinite = 0;
        for (const Extent extent : {Extent{1, 1}, Extent{1, 33}, Extent{31, 17}}) {
            View view(on_device.shared);
            RenderedFrame frame;
            for (int i = 0; i < 3; ++i) {
                frame = view.render(linear_request(scene, extent, {}));
                nonfinite += frame.bad_values.all();
            }
            for (const float value : values_of(frame.image))
                off = farther(off, std::abs(static_cast<double>(value) - seen));
        }
        findings.at_most(std::string(name) + ": any pixel off what is behind", off, 1e-6);
        findings.none(std::string(name) + ": non-finite values", nonfinite);
        findings.none(std::string(name) + ": GL errors", glGetError() == GL_NO_ERROR ? 0 : 1);
    }
}

constexpr Case kGarbageCases[] = {
    {"6", "garbage", "bad vertices are left out", Layer::kFunction,
        "Triangles with a corner that is no number or no position are left out and counted, the "
        "rest stays to the bit, and twenty meshes of random bits are drawn.",
        bad_vertices_are_left_out},
    {"6b", "garbage", "numbers lost on the way", Layer::kFunction,
        "What overflows when it is placed in the world is left out and counted.",
        numbers_lost_on_the_way},
    {"10", "garbage", "nothing shows what is behind", Layer::kPicture,
        "Scenes without objects, lights or materials show what surrounds them.",
        nothing_shows_what_is_behind},
};

constexpr Guard kGarbageGuards[] = {
    {"repair_drops_unbounded", "6"},
    {"flat_drops_unbounded", "6b"},
    {"radius_of_nothing", "10"},
};

}  // namespace

Group garbage_group()
{
    return {kGarbageCases, kGarbageGuards};
}

}  // namespace farlight::lab
