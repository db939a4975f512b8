// Orbit geometry and interpolation of keyframes.
#include "client/camera_path.h"

#include <cmath>
#include <gmock/gmock.h>

namespace farlight {
namespace {

using namespace client;
using testing::DoubleNear;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr Pose kPose{
    .position = {0, 1, 5}, .target = {0, 1, 0}, .up = {0, 1, 0}, .vertical_fov_degrees = 40};

auto near(double x, double y, double z)
{
    constexpr double kTolerance = 1e-12;  // a few roundings of values up to 10
    return ElementsAre(
        DoubleNear(x, kTolerance), DoubleNear(y, kTolerance), DoubleNear(z, kTolerance));
}

TEST(Orbit, AQuarterTurnSeenFromAboveIsCounterClockwise)
{
    const Pose turned = orbit(kPose, {0, 0, 0}, 90);
    EXPECT_THAT(turned.position, near(5, 1, 0));
    EXPECT_THAT(turned.target, near(0, 1, 0));
    EXPECT_EQ(turned.vertical_fov_degrees, 40);
}

TEST(Orbit, TurnsEverythingAboutTheCenter)
{
    Pose pose = kPose;
    pose.up = {1, 2, 0};
    const Pose turned = orbit(pose, {1, 7, 2}, 180);
    EXPECT_THAT(turned.position, near(2, 1, -1));
    EXPECT_THAT(turned.target, near(2, 1, 4));
    EXPECT_THAT(turned.up, near(-1, 2, 0));
}

TEST(Orbit, WholeTurnsChangeNothing)
{
    EXPECT_THAT(orbit(kPose, {3, 1, -2}, 720).position, near(0, 1, 5));
    EXPECT_EQ(orbit(kPose, {0, 0, 0}, 0), kPose);
}

TEST(OrbitAngle, GoesEvenlyFromNothingToAll)
{
    EXPECT_EQ(orbit_angle(60, 0, 31), 0);
    EXPECT_EQ(orbit_angle(60, 1, 31), 2);
    EXPECT_EQ(orbit_angle(60, 30, 31), 60);
    EXPECT_EQ(orbit_angle(60, 0, 1), 0);
}

TEST(PoseAt, InterpolatesBetweenKeyframesAndHoldsTheEnds)
{
    std::vector<Keyframe> path{
        {.frame = 2, .pose = kPose}, {.frame = 6, .pose = kPose}, {.frame = 8, .pose = kPose}};
    path[1].pose.position = {4, 1, 1};
    path[1].pose.vertical_fov_degrees = 80;
    EXPECT_EQ(pose_at(path, 0), kPose);
    EXPECT_EQ(pose_at(path, 2), kPose);
    EXPECT_THAT(pose_at(path, 3).position, near(1, 1, 4));
    EXPECT_EQ(pose_at(path, 3).vertical_fov_degrees, 50);
    EXPECT_EQ(pose_at(path, 6), path[1].pose);
    EXPECT_THAT(pose_at(path, 7).position, near(2, 1, 3));
    EXPECT_EQ(pose_at(path, 100), kPose);
}

TEST(MiddleOf, IsTheBoundsCenterOrTheOrigin)
{
    EXPECT_THAT(middle_of({.bounds = protocol::BoundingBox{{-1, 0, 2}, {3, 0, 8}}}), near(1, 0, 5));
    EXPECT_THAT(middle_of({}), near(0, 0, 0));
}

struct BadKeyframes {
    const char* name;
    const char* json;
    const char* complaint;
};
class ReadKeyframesRefuses : public testing::TestWithParam<BadKeyframes> { };

TEST_P(ReadKeyframesRefuses, NamingThePlace)
{
    const JsonInput input(nlohmann::json::parse(GetParam().json), "path.json");
    EXPECT_THAT(
        [&] { read_keyframes(input); }, ThrowsMessage<InputError>(HasSubstr(GetParam().complaint)));
}

INSTANTIATE_TEST_SUITE_P(Paths, ReadKeyframesRefuses,
    testing::Values(BadKeyframes{"NoArray", R"({})", "path.json: /: found {}, expected an array"},
        BadKeyframes{"Empty", "[]", "path.json: /: found [], expected at least one keyframe"},
        BadKeyframes{"UnknownKey", R"([{"time":0}])",
            "path.json: /0: found unknown key 'time', expected one of frame,"},
        BadKeyframes{"NoFrame", R"([{"position":[0,0,1]}])", "path.json: /0: found no key 'frame'"},
        BadKeyframes{"ShortPoint", R"([{"frame":0,"position":[0,0]}])",
            "path.json: /0/position: found [0,0], expected an array of 3 numbers"},
        BadKeyframes{"NotANumber", R"([{"frame":0,"position":[0,"x",0]}])",
            "path.json: /0/position/1: found \"x\", expected a number"},
        BadKeyframes{"LooksNowhere",
            R"([{"frame":0,"position":[0,0,1],"target":[0,0,1],"vertical_fov_degrees":40}])",
            "path.json: /0/target: found [0,0,1], expected another point than position"},
        BadKeyframes{"Backwards",
            R"([{"frame":5,"position":[0,0,1],"target":[0,0,0],"vertical_fov_degrees":40},
                {"frame":5,"position":[0,0,1],"target":[0,0,0],"vertical_fov_degrees":40}])",
            "path.json: /1/frame: found 5, expected more than the keyframe before, 5.0"}),
    [](const auto& tested) { return tested.param.name; });

}  // namespace
}  // namespace farlight
