// The top level over random boxes, trees refitted to vertices that moved, and which objects get a
// tree of their own.
#include "server/scene/packed_scene.h"
#include "server/scene/top_level.h"
#include "shaders/shared/scene_layout.h"

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>
#include <gmock/gmock.h>
#include <random>

namespace farlight {
namespace {

using testing::ElementsAre;

bool holds(const PrimitiveBounds& outer, const PrimitiveBounds& inner)
{
    return glm::all(glm::lessThanEqual(outer.lower, inner.lower))
        && glm::all(glm::greaterThanEqual(outer.upper, inner.upper));
}

/// Entries by word; the first is word 0. `clustered`: most share one place, which no plane splits.
std::vector<TopLevelEntry> random_entries(std::size_t count, bool clustered)
{
    std::mt19937 random(5);
    std::uniform_real_distribution<float> uniform(-1, 1);
    std::vector<TopLevelEntry> entries;
    for (std::size_t i = 0; i < count; ++i) {
        const float spread = !clustered ? 1 : std::exp2(-static_cast<float>(i));
        const glm::vec3 at = spread * glm::vec3(uniform(random), uniform(random), uniform(random));
        entries.push_back({{at - 0.01F, at + 0.02F},
            BVH_LEAF_BIT | BVH_INSTANCES | static_cast<std::uint32_t>(i)});
    }
    return entries;
}

/// Walks the tree; every entry must be met once, in a box that holds it. Returns the deepest stack.
int walk(const Texels& nodes, unsigned at, int waiting, const std::vector<TopLevelEntry>& entries,
    std::vector<int>& seen)
{
    int children = 0;
    for (int i = 0; i < kBvhWidth; ++i)
        children += nodes[at + 6][i] != BVH_NO_CHILD ? 1 : 0;
    waiting += std::max(children - 1, 0);
    int deepest = waiting;
    for (int i = 0; i < kBvhWidth; ++i) {
        const std::uint32_t word = nodes[at + 6][i];
        const PrimitiveBounds box = child_bounds(nodes, at, static_cast<std::size_t>(i));
        if (word == BVH_NO_CHILD)
            continue;
        if ((word & BVH_LEAF_BIT) != 0) {
            ++seen[word & BVH_FIRST_MASK];
            EXPECT_TRUE(holds(box, entries[word & BVH_FIRST_MASK].bounds));
            continue;
        }
        EXPECT_TRUE(holds(box, root_bounds(nodes, word)));
        deepest = std::max(deepest, walk(nodes, word, waiting, entries, seen));
    }
    return deepest;
}

TEST(TopLevelTest, HoldsEveryEntryOnceWithinItsStack)
{
    for (const bool clustered : {false, true})
        for (const std::size_t count : {0U, 1U, 2U, 4U, 5U, 17U, 100U, 1000U}) {
            const std::vector<TopLevelEntry> entries = random_entries(count, clustered);
            std::vector<TopLevelEntry> shuffled = entries;
            Texels nodes(top_level_texels(count));
            build_top_level(shuffled, nodes);
            std::vector<int> seen(count, 0);
            EXPECT_LE(walk(nodes, 0, 0, entries, seen), top_level_stack(count)) << count;
            EXPECT_EQ(seen, std::vector<int>(count, 1)) << count;
        }
}

Mesh triangle_fan(int triangles)
{
    Mesh mesh{"fan", {{0, 0, 0}}, {}, {}};
    for (int i = 0; i <= triangles; ++i) {
        const float angle = 0.1F * static_cast<float>(i);
        mesh.positions.emplace_back(
            std::cos(angle), std::sin(angle), 0.02F * static_cast<float>(i));
    }
    for (std::uint32_t i = 1; i <= static_cast<std::uint32_t>(triangles); ++i)
        mesh.triangles.emplace_back(0, i, i + 1);
    return mesh;
}

Track moving_track(std::uint32_t node)
{
    Track track;
    track.index = node;
    track.times = {0, 1};
    track.values = {0, 0, 0, 1, 2, 3};
    return track;
}

Scene scene_of_fans(std::size_t objects, int triangles)
{
    Scene scene;
    scene.materials.push_back({"white"});
    scene.meshes.push_back(triangle_fan(triangles));
    for (std::size_t i = 0; i < objects; ++i)
        scene.objects.push_back({"fan", 0, MeshInstance{}});
    return scene;
}

TEST(PlacementTest, WhatMovesIsAnInstanceAndWhatRestsIsNot)
{
    Scene scene = scene_of_fans(4, 5);
    scene.animation.nodes.resize(3);
    scene.animation.nodes[2].parent = 1;
    scene.animation.nodes[0].scale = {1, 2, 1};
    scene.animation.tracks.push_back(moving_track(1));
    scene.objects[1].node = 0;
    scene.objects[2].node = 1;
    scene.objects[3].node = 2;
    scene.objects.push_back({"ball", 0, Sphere{}});
    scene.objects.push_back({"squeezed ball", 0, Sphere{}, true, 0});
    EXPECT_THAT(placements_of(scene),
        ElementsAre(Placement::kWorld, Placement::kWorld, Placement::kInstance,
            Placement::kInstance, Placement::kWorld, Placement::kInstance));
}

TEST(PlacementTest, AHeavyMeshShownOftenStaysShared)
{
    const auto faces = static_cast<int>(kSharedTriangles / 2);
    EXPECT_THAT(placements_of(scene_of_fans(2, faces)), testing::Each(Placement::kWorld));
    const Scene shared = scene_of_fans(3, faces);
    EXPECT_THAT(placements_of(shared), testing::Each(Placement::kInstance));
    const PackedScene packed = pack_scene(shared);
    EXPECT_EQ(packed.content.triangles, static_cast<std::size_t>(faces));
    EXPECT_EQ(packed.content.instances, 3U);
}

TEST(PlacementTest, InAWideSceneNothingLiesInTheWorldsTree)
{
    Scene scene = scene_of_fans(1, 5);
    scene.objects.push_back({"far", 0, Sphere{{1e7, 0, 0}, 1}});
    scene.objects.push_back({"quad", 0, Quad{{1e7, 5, 0}, {1, 0, 0}, {0, 0, 1}}});
    const FlatScene flat = flatten(scene);
    EXPECT_TRUE(flat.wide);
    EXPECT_EQ(flat.groups[0].size(), 0U);
    ASSERT_EQ(flat.instances.size(), 3U);
    EXPECT_EQ(flat.groups[flat.instances[1].group].spheres[0].center, glm::vec3(0));
    EXPECT_EQ(flat.groups[flat.instances[2].group].triangles[0].vertices[1], glm::vec3(1, 0, 0));
    PackedScene packed = pack_scene(scene);
    packed.moving->pose(0, 0, {1e7 - 2, 0, 0});
    const glm::uvec4& row =
        packed.moving->instances()[INSTANCE_TEXELS + INSTANCE_WORLD_FROM_OBJECT];
    EXPECT_EQ(glm::uintBitsToFloat(row.w), 2);
    // What is squeezed flat has no space of its own, but is seen.
    std::get<MeshInstance>(scene.objects[0].shape).world_from_object[2] = {0, 0, 0, 0};
    EXPECT_FALSE(flatten(scene).wide);
}

TEST(MovingSceneTest, ARefittedTreeHoldsItsVerticesAtAnyTime)
{
    Scene scene = scene_of_fans(1, 300);
    MorphTarget target;
    for (const glm::vec3& p : scene.meshes[0].positions)
        target.positions.push_back(glm::vec3(p.y, 3 * p.x, -p.z));
    scene.meshes[0].morph_targets.push_back(target);
    Track track = moving_track(0);
    track.target = Track::Target::kMorphWeights;
    track.values = {0, 5};
    scene.animation.tracks.push_back(track);
    PackedScene packed = pack_scene(scene);
    MovingScene& moving = *packed.moving;
    for (const double time : {0.0, 0.4, 1.0, 0.2}) {
        moving.pose(time, 0);
        const DeformingTables& tables = moving.deforming();
        PrimitiveBounds all = kNowhereBounds;
        for (std::size_t i = 0; i < tables.triangles.size(); ++i) {
            const auto v = glm::uintBitsToFloat(glm::uvec3(tables.triangles[i]));
            all.lower = i == 0 ? v : glm::min(all.lower, v);
            all.upper = i == 0 ? v : glm::max(all.upper, v);
        }
        const PrimitiveBounds root = root_bounds(tables.bvh_nodes, 0);
        EXPECT_EQ(root.lower, all.lower) << time;
        EXPECT_EQ(root.upper, all.upper) << time;
        for (std::size_t at = 0; at < tables.bvh_nodes.size(); at += BVH_NODE_TEXELS)
            for (std::size_t i = 0; i < kBvhWidth; ++i) {
                const std::uint32_t word = tables.bvh_nodes[at + 6][static_cast<int>(i)];
                if (word == BVH_NO_CHILD || (word & BVH_LEAF_BIT) == 0)
                    continue;
                const PrimitiveBounds box = child_bounds(tables.bvh_nodes, at, i);
                const std::size_t first = (word & BVH_FIRST_MASK) - tables.first_triangle;
                const std::size_t count = ((word >> BVH_COUNT_SHIFT) & 3U) + 1;
                for (std::size_t v = first * 3; v < (first + count) * 3; ++v) {
                    const auto p = glm::uintBitsToFloat(glm::uvec3(tables.triangles[v]));
                    EXPECT_TRUE(holds(box, {p, p}));
                }
            }
        EXPECT_TRUE(holds(root_bounds(moving.top_level(), 0), root));
    }
}

TEST(MovingSceneTest, TakesUpTheLastFrameAndSaysWhatChanged)
{
    Scene scene = scene_of_fans(1, 5);
    scene.animation.nodes.resize(1);
    scene.objects[0].node = 0;
    scene.animation.tracks.push_back(moving_track(0));
    PackedScene packed = pack_scene(scene);
    MovingScene& moving = *packed.moving;
    EXPECT_FALSE(moving.pose(0, 0).now);
    const MovingScene::Changes step = moving.pose(0.5, 0);
    EXPECT_TRUE(step.now);
    EXPECT_FALSE(step.previous);
    const auto first_row = [](const Texels& texels, std::size_t at) {
        return glm::uintBitsToFloat(texels[at]);
    };
    EXPECT_EQ(first_row(moving.instances(), INSTANCE_WORLD_FROM_OBJECT).w, 0.5F);
    EXPECT_EQ(first_row(moving.prev_instances(), 0).w, 0);
    moving.pose(1, 0.5);
    EXPECT_EQ(first_row(moving.prev_instances(), 0).w, 0.5F);
    EXPECT_FALSE(moving.pose(1, 0.5).previous);
}

TEST(MovingSceneTest, WhatIsSqueezedFlatIsNotThere)
{
    Scene scene = scene_of_fans(2, 5);
    scene.animation.nodes.resize(1);
    scene.objects[0].node = 0;
    Track track = moving_track(0);
    track.target = Track::Target::kScale;
    track.values = {1, 1, 1, 1, 0, 1};
    scene.animation.tracks.push_back(track);
    PackedScene packed = pack_scene(scene);
    const auto children = [&] {
        int count = 0;
        for (int i = 0; i < kBvhWidth; ++i)
            count += packed.moving->top_level()[6][i] != BVH_NO_CHILD ? 1 : 0;
        return count;
    };
    EXPECT_EQ(children(), 2);
    packed.moving->pose(1, 0);
    EXPECT_EQ(children(), 1);
}

TEST(MovingSceneTest, LightsGoWithWhatCarriesThem)
{
    Scene scene = scene_of_fans(1, 2);
    scene.materials[0].emission = glm::vec3(1);
    scene.objects.push_back({"plate", 0, Quad{}});
    scene.objects.push_back({"ball", 0, Sphere{}});
    scene.animation.nodes.resize(1);
    for (Object& object : scene.objects)
        object.node = 0;
    scene.animation.tracks.push_back(moving_track(0));
    PackedScene packed = pack_scene(scene);
    const std::vector<Light> before = packed.moving->lights();
    ASSERT_EQ(before.size(), 4U);
    packed.moving->pose(1, 0);
    for (std::size_t i = 0; i < before.size(); ++i) {
        const Light& light = packed.moving->lights()[i];
        EXPECT_LT(glm::distance(light.p0, before[i].p0 + glm::vec3(1, 2, 3)), 1e-6F) << i;
        EXPECT_NEAR(light.area, before[i].area, 1e-6F * before[i].area) << i;
    }
}

}  // namespace
}  // namespace farlight
