// Tracks between their keys, nodes through their parents, vertices through joints and targets.
#include "server/scene/deform.h"

#include <array>
#include <glm/gtc/matrix_transform.hpp>
#include <gmock/gmock.h>

namespace farlight {
namespace {

using testing::ElementsAre;

Track ramp(Track::Interpolation interpolation)
{
    Track track;
    track.interpolation = interpolation;
    track.times = {1, 2, 4};
    track.values = {0, 0, 0, 1, 2, 3, 5, 2, 3};
    return track;
}

std::array<double, 3> at(const Track& track, double time)
{
    std::array<double, 3> value{};
    evaluate(track, time, value);
    return value;
}

TEST(TrackTest, StepsAndLinesPassThroughTheirKeysAndStayOutside)
{
    for (const auto kind : {Track::Interpolation::kStep, Track::Interpolation::kLinear}) {
        const Track track = ramp(kind);
        EXPECT_THAT(at(track, -7), ElementsAre(0, 0, 0));
        EXPECT_THAT(at(track, 1), ElementsAre(0, 0, 0));
        EXPECT_THAT(at(track, 2), ElementsAre(1, 2, 3));
        EXPECT_THAT(at(track, 4), ElementsAre(5, 2, 3));
        EXPECT_THAT(at(track, 100), ElementsAre(5, 2, 3));
    }
    EXPECT_THAT(at(ramp(Track::Interpolation::kStep), 3.999), ElementsAre(1, 2, 3));
    EXPECT_THAT(at(ramp(Track::Interpolation::kLinear), 3), ElementsAre(3, 2, 3));
}

TEST(TrackTest, TimeWrapsRoundAtThePeriod)
{
    Track track = ramp(Track::Interpolation::kLinear);
    track.period = 4;
    EXPECT_THAT(at(track, 4e6 + 3), ElementsAre(3, 2, 3));
    EXPECT_THAT(at(track, 4e6), ElementsAre(0, 0, 0));
}

TEST(CourseTest, EndsWithItsLastKeyUnlessATrackBeginsAnew)
{
    Animation animation;
    EXPECT_EQ(course_of(animation).duration, 0);
    EXPECT_FALSE(course_of(animation).all_repeat);
    animation.tracks.push_back(ramp(Track::Interpolation::kLinear));
    EXPECT_EQ(course_of(animation).duration, 4);
    EXPECT_EQ(moment_shown(animation, 3), 3);
    EXPECT_EQ(moment_shown(animation, 9), 4);

    animation.tracks.push_back(ramp(Track::Interpolation::kStep));
    animation.tracks[1].period = 5;
    EXPECT_EQ(course_of(animation).duration, 5);
    EXPECT_TRUE(course_of(animation).any_repeats);
    EXPECT_FALSE(course_of(animation).all_repeat);
    EXPECT_EQ(moment_shown(animation, 9), 9);

    animation.tracks[0].period = 5;
    EXPECT_TRUE(course_of(animation).all_repeat);
    animation.tracks[0].period = 6;
    EXPECT_FALSE(course_of(animation).all_repeat) << "not at the same time";
}

TEST(TrackTest, ACubicIsTheParabolaThatItsTangentsAreOf)
{
    // x = t^2 with the slopes 2 t at its keys.
    Track track;
    track.interpolation = Track::Interpolation::kCubic;
    track.target = Track::Target::kMaterialEmission;
    track.times = {0, 1, 3};
    track.values = {0, 0, 0, 2, 1, 2, 6, 9, 6};
    EXPECT_EQ(width_of(track), 1U);
    for (const double t : {0.0, 0.3, 1.0, 1.7, 2.9, 3.0}) {
        double value = 0;
        evaluate(track, t, std::span(&value, 1));
        EXPECT_NEAR(value, t * t, 1e-12) << t;
    }
}

TEST(TrackTest, RotationsTurnEvenlyTheShorterWay)
{
    Track track;
    track.target = Track::Target::kRotation;
    track.times = {0, 1};
    // From no turn to 90 degrees about y; the second as its negative, which is the same turn.
    const float half = std::sqrt(0.5F);
    track.values = {0, 0, 0, 1, 0, -half, 0, -half};
    std::array<double, 4> q{};
    evaluate(track, 1.0 / 3, q);
    const double angle = glm::radians(30.0) / 2;
    EXPECT_NEAR(std::abs(q[1]), std::sin(angle), 1e-7);
    EXPECT_NEAR(std::abs(q[3]), std::cos(angle), 1e-7);
    EXPECT_GT(q[1] * q[3], 0);
}

TEST(NodeTest, ParentsCarryTheirChildren)
{
    Animation animation;
    animation.nodes.resize(3);
    animation.nodes[0].translation = {10, 0, 0};
    animation.nodes[1].parent = 0;
    animation.nodes[1].rotation = glm::angleAxis(glm::radians(90.0), glm::dvec3(0, 0, 1));
    animation.nodes[2].parent = 1;
    animation.nodes[2].translation = {1, 0, 0};
    animation.nodes[2].scale = {2, 2, 2};
    Track track = ramp(Track::Interpolation::kLinear);
    track.target = Track::Target::kTranslation;
    track.index = 1;
    animation.tracks.push_back(track);

    const auto world = pose_nodes(animation, 2);
    const glm::dvec4 p = world[2] * glm::dvec4(3, 0, 0, 1);
    // (3, 0, 0) doubled, moved by 1, turned to y, moved by (1, 2, 3) and by 10 along x.
    EXPECT_NEAR(p.x, 11, 1e-12);
    EXPECT_NEAR(p.y, 9, 1e-12);
    EXPECT_NEAR(p.z, 3, 1e-12);
    EXPECT_THAT(moving_nodes(animation), ElementsAre(false, true, true));
}

TEST(NodeTest, FactorsMultiplyAndMorphWeightsReplace)
{
    Animation animation;
    Track track = ramp(Track::Interpolation::kLinear);
    track.values = {1, 3, 5};
    track.target = Track::Target::kLightIntensity;
    track.index = 4;
    animation.tracks = {track, track};
    EXPECT_DOUBLE_EQ(factor_at(animation, track.target, 4, 2), 9);
    EXPECT_DOUBLE_EQ(factor_at(animation, track.target, 3, 2), 1);
    EXPECT_THAT(morph_weights_at(animation, 4, {0.5F}, 2), ElementsAre(0.5F));
    animation.tracks[0].target = Track::Target::kMorphWeights;
    EXPECT_THAT(morph_weights_at(animation, 4, {0.5F}, 2), ElementsAre(3));
}

Mesh corner()
{
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.normals = {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}};
    mesh.triangles = {{0, 1, 2}};
    return mesh;
}

TEST(DeformTest, MorphsAddUpBeforeTheCarrierPlacesThem)
{
    Mesh mesh = corner();
    mesh.morph_targets = {{{{0, 0, 0}, {1, 0, 0}, {0, 0, 0}}, {}},
        {{{0, 0, 2}, {0, 0, 2}, {0, 0, 2}}, {{1, 0, 0}, {1, 0, 0}, {1, 0, 0}}}};
    const std::vector<float> weights{0.5F, 1};
    const glm::dmat4 m = glm::scale(glm::dmat4(1), {1, 1, -1});
    const VertexPose pose = pose_vertices(mesh, weights, {}, m);
    EXPECT_EQ(pose.positions[1], glm::vec3(1.5F, 0, -2));
    // The normal (1, 0, 1), mirrored.
    EXPECT_NEAR(pose.normals[0].x, std::sqrt(0.5), 1e-6);
    EXPECT_NEAR(pose.normals[0].z, -std::sqrt(0.5), 1e-6);
}

TEST(DeformTest, NormalsOfASqueezedSkinStayAtRightAngles)
{
    Mesh mesh = corner();
    mesh.positions = {{0, 0, 0}, {1, 0, 1}, {0, 1, 0}};
    const glm::vec3 n = glm::normalize(glm::cross(mesh.positions[1], mesh.positions[2]));
    mesh.normals.assign(3, n);
    mesh.joints.assign(3, {0, 1, 0, 0});
    mesh.weights.assign(3, {0.25F, 0.75F, 0, 0});
    const std::vector<glm::mat4> joints{
        glm::scale(glm::mat4(1), {4, 1, 1}), glm::scale(glm::mat4(1), {2, 3, 0.5F})};
    const VertexPose pose = pose_vertices(mesh, {}, joints, glm::dmat4(1));
    const glm::vec3 edge = pose.positions[1] - pose.positions[0];
    EXPECT_NEAR(edge.x, 0.25 * 4 + 0.75 * 2, 1e-6);
    EXPECT_NEAR(glm::dot(edge, pose.normals[0]), 0, 1e-6);
    EXPECT_GT(glm::dot(pose.normals[0], n), 0);
}

}  // namespace
}  // namespace farlight
