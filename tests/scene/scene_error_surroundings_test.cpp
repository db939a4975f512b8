// Every way lights, surroundings and the timeline of a Farlight scene can be wrong.
#include "tests/scene/bad_scene.h"

namespace farlight {
namespace {

class BadSurroundingsTest : public testing::TestWithParam<BadScene> { };

TEST_P(BadSurroundingsTest, SaysWhereAndWhy)
{
    EXPECT_EQ(refusal_of_patch(GetParam().patch), GetParam().error);
}

INSTANTIATE_TEST_SUITE_P(Surroundings, BadSurroundingsTest,
    testing::Values(
        BadScene{"BackgroundAndEnvironment",
            R"({"background": [1, 1, 1], "environment": {"file": "sky.hdr"}})",
            "/background: found a background beside an environment, expected one of the two"},
        BadScene{"MissingEnvironment", R"({"environment": {"file": "sky.hdr"}})",
            "/environment/file: found \"sky.hdr\", and no such file, expected a .hdr or .exr "
            "picture"},
        BadScene{"FogOfMinusOne", R"({"fog": {"absorption": [-1, 0, 0]}})",
            "/fog/absorption: found [-1,0,0], expected three numbers [r, g, b] from 0 to 1e18, per "
            "unit of length"},
        BadScene{"OnlyForward", R"({"fog": {"g": 1}})",
            "/fog/g: found 1, expected a mean cosine from -0.999 to 0.999"},
        BadScene{"LightOfNoKind", R"({"lights": {"sun": {"intensity": [1, 1, 1]}}})",
            "/lights/sun: found an object, expected a light: an object with intensity and exactly "
            "one of point, spot, directional"},
        BadScene{"LightWithoutIntensity",
            R"({"lights": {"sun": {"directional": {"direction": [0, -1, 0]}}}})",
            "/lights/sun: found no key \"intensity\", expected a light: an object with intensity "
            "and exactly one of point, spot, directional"},
        BadScene{"LightOfNoDirection",
            R"({"lights": {"sun": {"intensity": [1, 1, 1], "directional": {"direction": [0, 0, 0]}}}})",
            "/lights/sun/directional/direction: found [0,0,0], expected a direction: not all three "
            "0"},
        BadScene{"ConesInsideOut", R"({"lights": {"spot": {"intensity": [1, 1, 1], "spot":
                {"position": [0, 1, 0], "direction": [0, -1, 0], "inner_cone_degrees": 50}}}})",
            "/lights/spot/spot: found an inner cone of 50.0 degrees in an outer one of 45.0, "
            "expected inner_cone_degrees less than outer_cone_degrees"}),
    [](const auto& row) { return row.param.name; });

INSTANTIATE_TEST_SUITE_P(Timeline, BadSurroundingsTest,
    testing::Values(
        BadScene{"NoTime", R"({"timeline": [{"object": "ball", "move": [1, 0, 0]}]})",
            "/timeline/0: found no key \"at\", expected an event: an object with at, one of "
            "object, light, material, background, one of move, rotate_degrees, on, intensity, and "
            "optionally over"},
        BadScene{"TwoChanges",
            R"({"timeline": [{"at": 0, "object": "ball", "move": [1, 0, 0], "on": true}]})",
            "/timeline/0: found an object, expected an event: an object with at, one of object, "
            "light, material, background, one of move, rotate_degrees, on, intensity, and "
            "optionally over"},
        BadScene{"UnknownObject",
            R"({"timeline": [{"at": 0, "object": "bull", "move": [1, 0, 0]}]})",
            "/timeline/0/object: found the unknown object \"bull\", expected one of ball"},
        BadScene{"UnknownLight", R"({"timeline": [{"at": 0, "light": "sun", "on": false}]})",
            "/timeline/0/light: found the unknown light \"sun\", expected one of /lights, which "
            "has none"},
        BadScene{"UnknownMovedLight",
            R"({"timeline": [{"at": 0, "light": "sun", "move": [0, 1, 0]}]})",
            "/timeline/0/light: found the unknown light \"sun\", expected one of /lights, which "
            "has none"},
        BadScene{"UnknownMaterial", R"({"timeline": [{"at": 0, "material": "lamp", "on": false}]})",
            "/timeline/0/material: found the unknown material \"lamp\", expected one of white"},
        BadScene{"DimmedObject", R"({"timeline": [{"at": 0, "object": "ball", "intensity": 2}]})",
            "/timeline/0: found an object that is switched or dimmed, expected move or "
            "rotate_degrees; its light is its material's"},
        BadScene{"MovingSky", R"({"timeline": [{"at": 0, "background": true, "move": [0, 1, 0]}]})",
            "/timeline/0: found a background that moves, expected on or intensity"},
        BadScene{"TwoMovesAtOnce",
            R"({"timeline": [{"at": 3, "object": "ball", "move": [1, 0, 0]},
                             {"at": 1, "over": 2.5, "object": "ball", "move": [1, 0, 0]}]})",
            "/timeline/0/at: found 3 s, expected a time after /timeline/1, which changes the same "
            "until 3.5 s"},
        BadScene{"MovesBeyondTheWorld",
            R"({"timeline": [{"at": 0, "object": "ball", "move": [9e10, 0, 0]},
                             {"at": 1, "object": "ball", "move": [9e10, 0, 0]}]})",
            "/timeline/1/move: found a move beyond 1e11, expected coordinates of at most 1e11 in "
            "magnitude"},
        BadScene{"AmbiguousObject", R"({
            "objects": [{"name": "a", "material": "white", "sphere": {"center": [0, 0, 0], "radius": 1}},
                        {"name": "a", "material": "white", "sphere": {"center": [3, 0, 0], "radius": 1}}],
            "timeline": [{"at": 0, "object": "a", "move": [1, 0, 0]}]})",
            "/objects/1: found a second object called \"a\", expected one of that name, because "
            "/timeline moves it"}),
    [](const auto& row) { return row.param.name; });

}  // namespace
}  // namespace farlight
