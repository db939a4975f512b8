// Whatever a scene file may hold, the protocol must be able to say: a welcome that the codec
// refuses is a server nobody can connect to.
#include "server/stream/welcome.h"

#include "protocol/codec.h"
#include "server/scene/scene_file.h"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <unistd.h>

namespace farlight {
namespace {

using nlohmann::json;

const json kBall{{"material", "m"}, {"sphere", {{"center", {0, 0, 0}}, {"radius", 1}}}};

json scene_with(const json& patch)
{
    json scene{{"version", 1}, {"materials", {{"m", json::object()}}}, {"objects", {kBall}}};
    scene.update(patch);
    return scene;
}

/// Empty, or what a client could not read in the welcome for `scene`.
std::string problem_of_welcome(const Scene& scene)
{
    RendererDescription description;
    description.scene_name = scene.name;
    description.camera = scene.camera;
    description.camera_paths = scene.camera_paths;
    description.bounds = scene_bounds(scene);
    protocol::Welcome welcome = describe_server(description);
    welcome.size = {1, 1};
    const auto decoded = protocol::decode_server_message(encode(protocol::ServerMessage(welcome)));
    const auto* error = std::get_if<protocol::DecodeError>(&decoded);
    return error ? to_string(*error) : "";
}

struct Extreme {
    const char* name;
    json patch;
};
void PrintTo(const Extreme& extreme, std::ostream* out)
{
    *out << extreme.patch;
}

class WelcomeOfExtremes : public testing::TestWithParam<Extreme> { };

TEST_P(WelcomeOfExtremes, IsUnderstood)
{
    const Scene scene = parse_scene(scene_with(GetParam().patch).dump(), ".", "extreme.json");
    EXPECT_EQ(problem_of_welcome(scene), "");
}

json camera(double coordinate, double fov)
{
    return {{"position", {coordinate, coordinate, coordinate}},
        {"target", {-coordinate, -coordinate, -coordinate}}, {"up", {0, coordinate, 0}},
        {"vertical_fov_degrees", fov}};
}

json ball(const json& center, double radius)
{
    return {
        {"objects", {{{"material", "m"}, {"sphere", {{"center", center}, {"radius", radius}}}}}}};
}

INSTANTIATE_TEST_SUITE_P(Schema, WelcomeOfExtremes,
    testing::Values(Extreme{"FarAndNarrow", {{"camera", camera(1e11, 0.001)}}},
        Extreme{"FarAndWide", {{"camera", camera(-1e11, 179)}}},
        Extreme{"PathFarAndLong",
            {{"camera", camera(1, 45)},
                {"camera_paths",
                    {{"p",
                        {{{"frame", 0}, {"position", {1e11, -1e11, 1e11}}},
                            {{"frame", 1e9}, {"vertical_fov_degrees", 179}}}}}}}},
        Extreme{"FramedLargestSphere", ball({0, 0, 0}, 1e11)},
        Extreme{"FramedBoxToAllCorners",
            {{"objects",
                {{{"material", "m"},
                    {"box", {{"lower", {-1e11, -1e11, -1e11}}, {"upper", {1e11, 1e11, 1e11}}}}}}}}},
        Extreme{"FramedFarSphere", ball({9e10, 9e10, 9e10}, 1e10)},
        Extreme{"FramedSpeckFarAway", ball({1e10, 1e10, 1e10}, 1e-12)}),
    [](const auto& tested) { return tested.param.name; });

/// The narrowest and the widest opening angle that glTF can say, and a model of the largest size.
TEST(WelcomeOfGltf, IsUnderstood)
{
    const auto file = std::filesystem::temp_directory_path()
        / ("farlight_welcome_" + std::to_string(getpid()) + ".gltf");
    for (const double yfov : {1e-9, 1.0, 3.1415}) {
        // One triangle: (0, 0, 0), (1, 0, 0), (0, 1, 0) as little-endian floats.
        json gltf = json::parse(R"({"asset": {"version": "2.0"}, "scene": 0,
          "scenes": [{"nodes": [0, 1]}],
          "nodes": [{"mesh": 0, "scale": [1e11, 1e11, 1e11]},
                    {"camera": 0, "translation": [1e11, 1e11, 1e11]}],
          "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
          "cameras": [{"type": "perspective", "perspective": {"znear": 1}}],
          "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                         "min": [0, 0, 0], "max": [1, 1, 0]}],
          "bufferViews": [{"buffer": 0, "byteLength": 36}],
          "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})");
        gltf["cameras"][0]["perspective"]["yfov"] = yfov;
        std::ofstream(file) << gltf;
        const Scene scene = load_scene(file);
        EXPECT_EQ(problem_of_welcome(scene), "") << yfov;
        const bool noted = std::any_of(scene.notes.begin(), scene.notes.end(),
            [](const std::string& note) { return note.find("yfov") != std::string::npos; });
        EXPECT_EQ(noted, yfov != 1.0) << yfov;
    }
    std::filesystem::remove(file);
}

}  // namespace
}  // namespace farlight
