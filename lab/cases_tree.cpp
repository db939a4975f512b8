// Tree: what traversal finds is what trying every primitive finds, and it always ends.
#include "lab/groups.h"
#include "lab/meshes.h"
#include "lab/ray_probe.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace farlight::lab {
namespace {

/// How hits by the tree differ from hits without.
struct Differences {
    double found = 0;  ///< Rays that meet something by one way and nothing by the other.
    double elsewhere = 0;  ///< Met, but at other bits of distance.
    double ties = 0;  ///< Met at the same distance, but another primitive, of those met.
    double met = 0;  ///< Share of rays that meet anything.
};

Differences differences(const std::vector<ProbeHit>& by_tree, const std::vector<ProbeHit>& by_every)
{
    Differences sum;
    for (std::size_t i = 0; i < by_tree.size(); ++i) {
        const ProbeHit& a = by_tree[i];
        const ProbeHit& b = by_every[i];
        sum.found += a.met() == b.met() && a.any == b.any ? 0 : 1;
        sum.elsewhere += a.met() && b.met() && !(a.t == b.t) ? 1 : 0;
        sum.ties += a.met() && a.t == b.t && a.slot != b.slot ? 1 : 0;
        sum.met += b.met() ? 1 : 0;
    }
    sum.ties /= std::max(sum.met, 1.0);
    sum.met /= static_cast<double>(by_tree.size());
    return sum;
}

/// `ties`: share of rays that may meet another primitive at the same bits of distance, as those in
/// edges do.
void report(Findings& findings, const std::string& name, const Differences& found, double ties = 0)
{
    findings.none(name + "rays that meet something only by tree or only without", found.found);
    findings.none(name + "rays that meet something elsewhere", found.elsewhere);
    findings.at_most(name + "share that meet another primitive as far away", found.ties, ties);
    findings.at_least(name + "share of rays that meet anything", found.met, 0.02);
}

/// Triangles, spheres and disks.
Scene mixed_soup(std::size_t triangles, unsigned seed)
{
    Scene scene = scene_of(triangle_soup(triangles, seed));
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(-1, 1);
    const auto anywhere = [&] {
        return glm::dvec3(uniform(random), uniform(random), uniform(random));
    };
    for (std::size_t i = 0; i < triangles / 10; ++i) {
        scene.objects.push_back(
            {"sphere", 0, Sphere{anywhere(), 0.1 * std::abs(uniform(random)) + 1e-3}});
        scene.objects.push_back({"disk", 0,
            Disk{anywhere(), glm::normalize(anywhere()), 0.1 * std::abs(uniform(random)) + 1e-3}});
    }
    return scene;
}

void soups_equal_brute_force(Findings& findings, Length length)
{
    const bool all = length == Length::kLong;
    Differences sum;
    const unsigned seeds = all ? 20 : 4;
    for (unsigned seed = 1; seed <= seeds; ++seed) {
        const DeviceScene scene(mixed_soup(200, seed));
        const RayProbe probe(scene);
        const std::vector<TestRay> rays =
            random_rays(scene_bounds(scene.scene), all ? 100'000 : 10'000, seed);
        const Differences found = differences(probe.by_tree(rays), probe.by_every_primitive(rays));
        sum.found += found.found;
        sum.elsewhere += found.elsewhere;
        sum.ties = std::max(sum.ties, found.ties);
        sum.met += found.met / seeds;
    }
    report(findings, "", sum);
}

void soups_equal_embree(Findings& findings, Length length)
{
    const std::size_t count = length == Length::kLong ? 1'000'000 : 50'000;
    for (const Scene& scene :
        {scene_of(triangle_soup(20'000, 5)), scene_of(bumpy_sphere(250, 140))}) {
        const Disagreements found =
            against_embree(scene, random_rays(scene_bounds(scene), count, 17));
        findings.none(
            scene.name + ": rays that Embree disagrees with", static_cast<double>(found.wrong));
        findings.at_least(scene.name + ": share of rays that meet anything",
            static_cast<double>(found.met) / static_cast<double>(count), 0.1);
    }
}

/// Small squares along the axes on the points of a lattice with whole coordinates: boxes are flat
/// and end on whole numbers.
Mesh lattice_of_squares()
{
    Mesh mesh{"lattice", {}, {}, {}};
    for (int i = 0; i < 4 * 4 * 4; ++i) {
        const glm::vec3 at(i % 4, i / 4 % 4, i / 16);
        const int axis = i % 3;
        const auto first = static_cast<unsigned>(mesh.positions.size());
        for (int k = 0; k < 4; ++k) {
            glm::vec3 corner = at;
            corner[(axis + 1) % 3] += static_cast<float>(k & 1);
            corner[(axis + 2) % 3] += static_cast<float>(k >> 1);
            mesh.positions.push_back(corner);
        }
        mesh.triangles.emplace_back(first, first + 1, first + 3);
        mesh.triangles.emplace_back(first, first + 3, first + 2);
    }
    return mesh;
}

/// From every lattice point and every middle between two, and from an ulp beside them, into the 26
/// directions of its neighbours. `zero`: what stands for a component that is zero.
std::vector<TestRay> rays_along_the_lattice(float zero)
{
    constexpr int kSide = 10;
    std::vector<TestRay> rays;
    for (int i = 0; i < kSide * kSide * kSide * 27 * 3; ++i) {
        const int point = i / (27 * 3);
        const int towards = i / 3 % 27;
        glm::vec3 origin(point % kSide, point / kSide % kSide, point / (kSide * kSide));
        origin = 0.5F * (origin - 1.0F);
        glm::vec3 way(towards % 3 - 1, towards / 3 % 3 - 1, towards / 9 - 1);
        if (way == glm::vec3(0))
            continue;
        way = glm::normalize(way);
        for (int axis = 0; axis < 3; ++axis) {
            // 0 has denormals beside it, which no picture is drawn from.
            origin[axis] +=
                static_cast<float>(i % 3 - 1) * std::max(1.0F, std::abs(origin[axis])) * 1.2e-7F;
            way[axis] = way[axis] == 0 ? zero : way[axis];
        }
        rays.push_back({origin, way});
    }
    return rays;
}

void rays_in_planes(Findings& findings, const std::string& name, float zero)
{
    const DeviceScene scene(scene_of(lattice_of_squares()));
    const RayProbe probe(scene);
    const std::vector<TestRay> rays = rays_along_the_lattice(zero);
    report(findings, name, differences(probe.by_tree(rays), probe.by_every_primitive(rays)), 0.05);
}

void rays_in_box_planes(Findings& findings, Length /*length*/)
{
    rays_in_planes(findings, "", 0.0F);
}

void negative_zero_directions(Findings& findings, Length /*length*/)
{
    rays_in_planes(findings, "-0: ", -0.0F);
    // The smallest there are: what 1 / d cannot represent.
    rays_in_planes(findings, "1.4e-45: ", std::numeric_limits<float>::denorm_min());
    rays_in_planes(findings, "-1e-38: ", -1e-38F);
}

/// With corners anywhere in a cube.
Mesh large_triangles(std::size_t count)
{
    std::mt19937 random(11);
    std::uniform_real_distribution<float> uniform(-1, 1);
    Mesh mesh{"large", {}, {}, {}};
    for (unsigned i = 0; i < count; ++i) {
        for (int k = 0; k < 3; ++k)
            mesh.positions.emplace_back(uniform(random), uniform(random), uniform(random));
        mesh.triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
    }
    return mesh;
}

/// As few primitives as a node or a leaf can hold, and none.
void hardly_a_tree(Findings& findings, Length /*length*/)
{
    for (std::size_t count = 0; count <= 6; ++count) {
        const DeviceScene scene(scene_of(large_triangles(count)));
        const RayProbe probe(scene);
        const std::vector<TestRay> rays = random_rays({{-1, -1, -1}, {1, 1, 1}}, 20'000, 11);
        const Differences found = differences(probe.by_tree(rays), probe.by_every_primitive(rays));
        const std::string name = std::to_string(count) + " triangles: ";
        findings.none(name + "rays that find something else", found.found + found.elsewhere);
        if (count == 0)
            findings.none(name + "share of rays that meet anything", found.met);
        else
            findings.at_least(name + "share of rays that meet anything", found.met, 0.02);
    }
}

/// Each sphere twice as large as the one before and beyond it: every split peels off a few. The
/// deepest tree there is, for coordinates end.
Scene chain_of_spheres()
{
    Scene scene;
    scene.name = "chain";
    scene.materials.push_back({"white"});
    for (int i = -40; i < 36; ++i)
        for (int side = -1; side <= 1; side += 2)
            scene.objects.push_back({"link", 0,
                Sphere{{side * std::ldexp(1.0, i), std::ldexp(0.3, i), 0}, std::ldexp(0.3, i)}});
    return scene;
}

void deep_trees(Findings& findings, Length length)
{
    const Scene chain = chain_of_spheres();
    const DeviceScene scene(chain);
    findings.at_least("stack entries that its tree may need", pack_scene(chain).stack_depth, 20);
    std::mt19937 random(13);
    std::uniform_real_distribution<float> uniform(-1, 1);
    std::vector<TestRay> rays;
    for (int i = 0; i < (length == Length::kLong ? 500'000 : 30'000); ++i) {
        // Along the chain from its middle or its ends, at a random link.
        const auto& link = std::get<Sphere>(chain.objects[random() % chain.objects.size()].shape);
        const float reach = 1.2F * static_cast<float>(link.radius);
        const glm::vec3 target = glm::vec3(link.center)
            + reach * glm::vec3(uniform(random), uniform(random), uniform(random));
        const glm::vec3 origin = i % 2 == 0
            ? glm::vec3(0)
            : glm::vec3(link.center) * -std::ldexp(1.0F, static_cast<int>(random() % 20));
        rays.push_back({origin, glm::normalize(target - origin)});
    }
    const RayProbe probe(scene);
    report(findings, "", differences(probe.by_tree(rays), probe.by_every_primitive(rays)));
}

/// Objects that share every triangle, of which each ray must see the same one.
void duplicates_do_not_flicker(Findings& findings, Length length)
{
    const std::size_t count = length == Length::kLong ? 500'000 : 50'000;
    Scene scene = scene_of(bumpy_sphere(60, 30));
    scene.objects.push_back(scene.objects[0]);
    scene.objects.push_back({"quad", 0, Quad{{-3, -1, -3}, {0, 0, 6}, {6, 0, 0}}});
    scene.objects.push_back({"quad", 0, Quad{{-3, -1, -3}, {0, 0, 6}, {6, 0, 0}}});
    const PackedScene packed = pack_scene(scene);
    const DeviceScene on_device(scene);
    const std::vector<TestRay> rays = random_rays(scene_bounds(scene), count, 15);
    std::array<double, 4> seen{};
    for (const ProbeHit& hit : RayProbe(on_device).by_tree(rays))
        if (hit.met())
            seen.at(packed.geometry.triangles[std::size_t{3} * hit.slot].w) += 1;
    findings.at_least("rays that see the first of two meshes", seen[0], 1000);
    findings.at_least("rays that see the first of two squares", seen[2], 1000);
    findings.none("rays that see the second mesh", seen[1]);
    findings.none("rays that see the second square", seen[3]);
}

void rays_without_a_number(Findings& findings, Length /*length*/)
{
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    constexpr float kInf = std::numeric_limits<float>::infinity();
    const DeviceScene scene(scene_of(triangle_soup(20'000, 7)));
    const RayProbe probe(scene);
    std::vector<TestRay> good = random_rays(scene_bounds(scene.scene), 2'000, 7);
    std::vector<TestRay> bad;
    for (std::size_t i = 0; i < good.size(); ++i) {
        TestRay ray = good[i];
        const float spoiler = i % 3 == 0 ? kNan : i % 3 == 1 ? kInf : -kInf;
        const int axis = static_cast<int>(i / 3 % 3);
        (i / 9 % 2 == 0 ? ray.origin : ray.direction)[axis] = spoiler;
        if (i % 5 == 0)
            ray.direction = glm::vec3(i % 2 == 0 ? kNan : 0.0F);
        bad.push_back(ray);
    }
    double met = 0;
    for (const ProbeHit& hit : probe.by_tree(bad))
        met += hit.met() || hit.any ? 1 : 0;
    const auto most = [&](const std::vector<TestRay>& rays) {
        int nodes = 0;
        for (const glm::ivec2& work : probe.work_of(rays))
            nodes = std::max(nodes, work.x + work.y);
        return static_cast<double>(nodes);
    };
    findings.none("rays of NaN or infinity that meet something", met);
    findings.at_most("most work of such a ray, in that of a good one", most(bad) / most(good), 2.5);
}

constexpr Case kTreeCases[] = {
    {"7", "tree", "rays without a number", Layer::kFunction,
        "A ray with NaN or infinity in it meets nothing and is no more work than a good one.",
        rays_without_a_number},
    {"8", "tree", "rays in the planes of boxes", Layer::kFunction,
        "Rays along the axes and diagonals from points on box planes meet what trying every "
        "triangle meets.",
        rays_in_box_planes},
    {"9", "tree", "directions of negative zero", Layer::kFunction,
        "The same with -0 and with the smallest numbers for the zeros of the direction.",
        negative_zero_directions},
    {"11", "tree", "hardly a tree", Layer::kFunction,
        "None to six triangles: the root alone, one leaf, two.", hardly_a_tree},
    {"13", "tree", "deep trees", Layer::kFunction,
        "The deepest tree that coordinates allow fits the stack and meets what trying every sphere "
        "meets.",
        deep_trees},
    {"15", "tree", "duplicates do not flicker", Layer::kFunction,
        "Of things in the same place every ray sees the one that the scene names first.",
        duplicates_do_not_flicker},
    {"18", "tree", "soups equal brute force", Layer::kFunction,
        "Random triangles, spheres and disks: the tree finds the same distances to the bit as "
        "trying them all.",
        soups_equal_brute_force},
    {"18b", "tree", "soups equal Embree", Layer::kFunction,
        "Random rays through soups and a bumpy sphere meet what Embree's robust mode meets.",
        soups_equal_embree},
};

constexpr Guard kTreeGuards[] = {
    {"boxes_as_wide_as_triangles", "8 9 M4", "geometry/traverse.glsl",
        "5.0 * 5.9604645e-8 * (reach + permute(reach, ray.axis).z)", "vec3(0.0)"},
    {"tiny_is_none", "9", "geometry/ray.glsl", "mix(vec3(0.0), ray.direction, moves)",
        "ray.direction"},
    {"finite_rays", "7", "geometry/traverse.glsl", " && is_finite(dot(r.origin, r.direction))", ""},
    {"leaf_of_several", "11 18b", "geometry/traverse.glsl", "((leaf >> BVH_COUNT_SHIFT) & 3u) + 1u",
        "1u"},
    {"stack_of_need", "13", "geometry/traverse.glsl", "uint stack[BVH_STACK_SIZE];",
        "uint stack[8];"},
    {"first_named", "15", "geometry/traverse.glsl",
        "(t < hit.t || rank < candidate.nearest) && kind == BVH_TRIANGLES",
        "t < hit.t && kind == BVH_TRIANGLES"},
    {"nearest_stays", "18", "geometry/traverse.glsl", "swap ? t_b : t_a;", "t_a;"},
};

}  // namespace

Group tree_group()
{
    return {kTreeCases, kTreeGuards};
}

}  // namespace farlight::lab
