// Build: trees over what splits badly, and the same scene by other trees.
#include "lab/device_scene.h"
#include "lab/groups.h"
#include "lab/meshes.h"
#include "lab/ray_probe.h"
#include "lab/tree_walk.h"

#include "server/scene/top_level.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>

namespace farlight::lab {
namespace {

struct SceneTree {
    TreeFacts facts;
    double lost = 0;  ///< Primitives in no leaf, or in two.
    double sticking_out = 0;  ///< Primitives that reach out of their leaf.
    int stack_said = 0;
    double primitives = 0;
};

/// Of a scene of things at rest.
SceneTree tree_of(const Scene& scene)
{
    const PackedScene packed = pack_scene(scene);
    const PackedGeometry& g = packed.geometry;
    std::array<std::vector<int>, kPrimitiveKinds> seen{
        std::vector<int>(g.triangles.size() / TRIANGLE_TEXELS),
        std::vector<int>(g.spheres.size() / SPHERE_TEXELS),
        std::vector<int>(g.disks.size() / DISK_TEXELS)};
    SceneTree tree;
    const auto leaf = [&](std::uint32_t word, const PrimitiveBounds& box) {
        const std::uint32_t kind = word & BVH_KIND_MASK;
        const std::size_t first = word & BVH_FIRST_MASK;
        for (std::size_t i = first; i <= first + ((word >> BVH_COUNT_SHIFT) & 3U); ++i) {
            seen.at(kind / BVH_SPHERES).at(i) += 1;
            const auto [lower, upper] = extremes(g, kind, i);
            tree.sticking_out += holds(box, lower) && holds(box, upper) ? 0 : 1;
        }
    };
    tree.facts = TreeWalk(packed.bvh_nodes, leaf).run();
    for (const std::vector<int>& kind : seen) {
        tree.primitives += static_cast<double>(kind.size());
        tree.lost += static_cast<double>(kind.size())
            - static_cast<double>(std::count(kind.begin(), kind.end(), 1));
    }
    tree.stack_said = packed.stack_depth;
    return tree;
}

void report(Findings& findings, const std::string& name, const SceneTree& tree)
{
    findings.none(name + "primitives not in one leaf, once", tree.lost);
    findings.none(name + "primitives that stick out of their leaf", tree.sticking_out);
    findings.none(name + "boxes outside of their parent's", tree.facts.outside);
    findings.at_most(name + "depth", tree.facts.depth, 64);
    findings.at_most(name + "nodes", tree.facts.nodes, 2 * tree.primitives - 1);
    findings.at_most(name + "stack needed", tree.facts.stack, tree.stack_said);
}

// ---------------------------------------------------------------- what splits badly

/// Triangles of any size about one point: their boxes have one middle.
Mesh concentric_triangles(std::size_t count)
{
    std::mt19937 random(12);
    std::uniform_real_distribution<float> uniform(0.1F, 1);
    Mesh mesh{"concentric", {}, {}, {}};
    for (unsigned i = 0; i < count; ++i) {
        const float size = i % 3 == 0 ? 1 : uniform(random);
        for (const glm::vec3 corner :
            {glm::vec3(-1, -1, -1), glm::vec3(1, 1, -1), glm::vec3(-1, 1, 1)})
            mesh.positions.push_back(size * corner);
        mesh.triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
    }
    return mesh;
}

double seconds_to_build(const Scene& scene)
{
    const auto begun = std::chrono::steady_clock::now();
    pack_scene(scene);
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
}

/// The tree over moving things: all in one place, and each half as far from it as the one before.
void report_top_level(Findings& findings, const std::string& name, std::size_t count, bool halving)
{
    std::vector<TopLevelEntry> entries;
    for (std::size_t i = 0; i < count; ++i) {
        const float at = halving ? std::ldexp(1.0F, 120 - static_cast<int>(i)) : 0;
        entries.push_back({{glm::vec3(at, 0, 0), glm::vec3(at * 1.25F, 1, 1)},
            BVH_LEAF_BIT | BVH_INSTANCES | static_cast<std::uint32_t>(i)});
    }
    std::vector<glm::uvec4> nodes(top_level_texels(count));
    build_top_level(entries, nodes);
    std::vector<int> seen(count);
    const auto leaf = [&](std::uint32_t word, const PrimitiveBounds&) {
        seen.at(word & BVH_FIRST_MASK) += 1;
    };
    const TreeFacts facts = TreeWalk(std::span<const glm::uvec4>(nodes), leaf).run();
    findings.none(name + "things not in one leaf, once",
        static_cast<double>(count) - static_cast<double>(std::count(seen.begin(), seen.end(), 1)));
    findings.at_most(name + "depth", facts.depth, 64);
    findings.at_most(name + "nodes", facts.nodes, 2 * static_cast<double>(count) - 1);
    findings.at_most(name + "stack needed", facts.stack, top_level_stack(count));
}

void middles_in_one_place(Findings& findings, Length length)
{
    const std::size_t count = length == Length::kLong ? 1'000'000 : 100'000;
    const Scene concentric = scene_of(concentric_triangles(count));
    report(findings, "triangles with one middle: ", tree_of(concentric));
    Scene copies = scene_of(triangle_soup(1, 12));
    copies.meshes[0].triangles.resize(count, copies.meshes[0].triangles[0]);
    report(findings, "one triangle many times: ", tree_of(copies));
    report_top_level(findings, "moving things in one place: ", count / 10, false);
    report_top_level(findings, "moving things, each half as far off: ", 240, true);
    if (length == Length::kLong)
        findings.at_most("time to build, of that of random triangles",
            seconds_to_build(concentric) / seconds_to_build(scene_of(triangle_soup(count, 12))), 3);
}

/// Coordinates at which Embree once lost a triangle (its TriangleSplitRegression), in every order.
Mesh triangles_on_split_planes()
{
    std::array<float, 4> values{-6.4000024F, 25.6F, 34, 57.6000022F};
    Mesh mesh{"split planes", {}, {}, {}};
    const auto corner = [&](unsigned i) {
        return glm::vec3(values.at(i % 4), values.at(i / 4 % 4), values.at(i / 16 % 4));
    };
    for (unsigned i = 0; i < 64; ++i)
        for (unsigned step = 1; step < 64; step += 5)
            for (const unsigned k : {i, i + step, i + 2 * step + 1})
                mesh.positions.push_back(corner(k));
    for (unsigned i = 0; i < mesh.positions.size(); i += 3)
        mesh.triangles.emplace_back(i, i + 1, i + 2);
    return mesh;
}

/// Spheres and disks of any size in any place.
Scene round_things(std::size_t count)
{
    std::mt19937 random(14);
    std::uniform_real_distribution<double> uniform(-1, 1);
    Scene scene = scene_of(triangle_soup(count, 14));
    for (std::size_t i = 0; i < count; ++i) {
        const glm::dvec3 at(uniform(random), uniform(random), uniform(random));
        const double radius = std::exp(4 * uniform(random) - 4);
        const glm::dvec3 normal(uniform(random), uniform(random), uniform(random));
        if (i % 2 == 0)
            scene.objects.push_back({"sphere", 0, Sphere{at, radius}});
        else
            scene.objects.push_back({"disk", 0, Disk{at, glm::normalize(normal), radius}});
    }
    return scene;
}

void nothing_is_lost_in_a_split(Findings& findings, Length length)
{
    report(findings, "at Embree's coordinates: ", tree_of(scene_of(triangles_on_split_planes())));
    report(findings,
        "round things: ", tree_of(round_things(length == Length::kLong ? 200'000 : 10'000)));
}

// ---------------------------------------------------------------- other trees

/// A tree over triangles 0 to count - 1 that halves `order`, whatever lies where.
class TreeOfHalves {
public:
    TreeOfHalves(const PackedGeometry& geometry, std::vector<std::uint32_t> order)
        : geometry_(geometry)
        , order_(std::move(order))
    {
    }

    Texels build()
    {
        add(0, order_.size());
        return std::move(nodes_);
    }

private:
    std::uint32_t add(std::size_t first, std::size_t end)
    {
        const auto at = static_cast<std::uint32_t>(nodes_.size());
        nodes_.resize(at + BVH_NODE_TEXELS, glm::uvec4(BVH_NO_CHILD));
        for (std::size_t i = 0; i < kBvhWidth; ++i) {
            const std::size_t from = first + (end - first) * i / kBvhWidth;
            const std::size_t to = first + (end - first) * (i + 1) / kBvhWidth;
            std::uint32_t word = BVH_NO_CHILD;
            PrimitiveBounds box = kNowhereBounds;
            if (to > from + 1) {
                word = add(from, to);
                box = root_bounds(nodes_, word);
            } else if (to > from) {
                word = BVH_LEAF_BIT | BVH_TRIANGLES | order_[from];
                const auto [lower, upper] = extremes(geometry_, BVH_TRIANGLES, order_[from]);
                box = {glm::vec3(lower), glm::vec3(upper)};
            }
            set_child_bounds(nodes_, at, i, box);
            nodes_[at + 6][static_cast<int>(i)] = word;
        }
        return at;
    }

    const PackedGeometry& geometry_;
    std::vector<std::uint32_t> order_;
    Texels nodes_;
};

/// Rays that find something else by another tree than by the scene's own; ties are of one distance.
struct OtherTree {
    double elsewhere = 0;
    double ties = 0;  ///< Share of rays that see another of two triangles as far away.
};

OtherTree by_another_tree(const Scene& scene, const std::vector<TestRay>& rays, bool shuffled)
{
    const PackedScene packed = pack_scene(scene);
    std::vector<std::uint32_t> order(packed.geometry.triangles.size() / TRIANGLE_TEXELS);
    std::iota(order.begin(), order.end(), 0U);
    if (shuffled)
        std::shuffle(order.begin(), order.end(), std::mt19937(4));
    const Texels nodes = TreeOfHalves(packed.geometry, std::move(order)).build();
    DeviceScene on_device(scene);
    const std::vector<ProbeHit> expected = RayProbe(on_device).by_tree(rays);
    Buffer buffer("other nodes", std::as_bytes(std::span<const glm::uvec4>(nodes)));
    on_device.inputs.buffers["bvh_nodes"] = buffer.texture(GL_RGBA32UI);
    for (auto& [name, value] : on_device.inputs.defines)
        if (name == "BVH_STACK_SIZE")
            value = "40";  // three a level
    const std::vector<ProbeHit> found = RayProbe(on_device).by_tree(rays);
    OtherTree sum;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        sum.elsewhere += found[i].t == expected[i].t && found[i].any == expected[i].any ? 0 : 1;
        sum.ties += found[i].slot == expected[i].slot ? 0 : 1 / static_cast<double>(rays.size());
    }
    return sum;
}

/// From anywhere near it at its vertices and edges, where box and triangle end together.
std::vector<TestRay> rays_at_edges(const Mesh& mesh, std::size_t count)
{
    std::mt19937 random(5);
    std::uniform_real_distribution<float> uniform(0, 1);
    std::vector<TestRay> rays;
    while (rays.size() < count) {
        const glm::uvec3 corners = mesh.triangles[random() % mesh.triangles.size()];
        const glm::vec3 target = glm::mix(mesh.positions[corners.x], mesh.positions[corners.y],
            random() % 3 == 0 ? 0 : uniform(random));
        const glm::vec3 origin = 1.9F * uniform(random) * random_direction(random);
        rays.push_back({origin, glm::normalize(target - origin)});
    }
    return rays;
}

std::vector<float> last_picture(const Scene& scene)
{
    const DeviceScene on_device(scene);
    View view(on_device.shared);
    RenderRequest request = linear_request(scene, {48, 40}, {});
    Image image;
    for (int i = 0; i < 4; ++i) {
        request.camera.position += glm::dvec3(0.03125, 0, -0.03125);
        image = view.render(request).image;
    }
    return values_of(image);
}

void other_trees(Findings& findings, Length length)
{
    const Scene scene = room_with(bumpy_sphere(40, 20));
    const std::size_t count = length == Length::kLong ? 300'000 : 15'000;
    std::vector<TestRay> rays = random_rays(scene_bounds(scene), count, 4);
    const std::vector<TestRay> aimed = rays_at_edges(scene.meshes[0], count);
    rays.insert(rays.end(), aimed.begin(), aimed.end());
    for (const bool shuffled : {false, true}) {
        const OtherTree found = by_another_tree(scene, rays, shuffled);
        const std::string name = shuffled ? "halves of a shuffled list: " : "halves of a list: ";
        findings.none(name + "rays that meet something elsewhere", found.elsewhere);
        // Half of the rays are aimed at edges, where two triangles may be as far away.
        findings.at_most(
            name + "share of rays that meet another of two as far away", found.ties, 0.05);
    }
    Scene mixed = scene;
    std::mt19937 random(4);
    std::shuffle(mixed.meshes[0].triangles.begin(), mixed.meshes[0].triangles.end(), random);
    const std::vector<float> before = last_picture(scene);
    const std::vector<float> after = last_picture(mixed);
    double unlike = 0;
    for (std::size_t i = 0; i < before.size(); ++i)
        unlike += before[i] == after[i] ? 0 : 1;
    findings.none(
        "values that the order of a mesh's triangles changes, of " + std::to_string(before.size()),
        unlike);
}

constexpr Case kBuildCases[] = {
    {"12", "build", "middles in one place", Layer::kFunction,
        "A hundred thousand things that no plane can part, or copies of one, make a shallow tree.",
        middles_in_one_place},
    {"14", "build", "nothing is lost in a split", Layer::kFunction,
        "Every primitive is in one leaf whose box holds it to the last bit, at coordinates that "
        "lay on Embree's bins too.",
        nothing_is_lost_in_a_split},
    {"M4", "build", "other trees", Layer::kSequence,
        "A tree of another builder finds the same to the bit, but for counted ties, and the order "
        "of a mesh's triangles changes no picture.",
        other_trees},
};

constexpr Guard kBuildGuards[] = {
    {"top_level_within_its_stack", "12"},
    {"round_boxes_widened", "14"},
};

}  // namespace

Group build_group()
{
    return {kBuildCases, kBuildGuards};
}

}  // namespace farlight::lab
