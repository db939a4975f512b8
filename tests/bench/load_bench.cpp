// How long a glTF file of many triangles takes until its tables are ready for the GPU, and how much
// of the GPU's memory each triangle takes there, table by table.
//
// farlight-load-bench [FILE]: without a file, a grid of 1,000,000 triangles with normals and uvs,
// written beside the other temporary files. Prints the best of a few rounds, as a machine that
// does other things besides allows no better.
#include "lab/temp_folder.h"
#include "server/scene/packed_scene.h"
#include "server/scene/scene_file.h"
#include "tests/scene/gltf_builder.h"

#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>
#include <map>
#include <optional>

namespace farlight {
namespace {

constexpr int kRounds = 5;
constexpr std::uint32_t kSide = 708;  // vertices: 2 * 707^2 triangles

double seconds_of(const std::function<void()>& work)
{
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// A wavy sheet.
GltfBuilder million_triangles()
{
    std::vector<float> positions;
    std::vector<float> normals;
    std::vector<float> uvs;
    std::vector<std::uint32_t> indices;
    for (std::uint32_t j = 0; j < kSide; ++j)
        for (std::uint32_t i = 0; i < kSide; ++i) {
            const float u = static_cast<float>(i) / (kSide - 1);
            const float v = static_cast<float>(j) / (kSide - 1);
            positions.insert(positions.end(), {u, 0.1F * std::sin(9 * u) * std::cos(7 * v), v});
            normals.insert(normals.end(), {0, 1, 0});
            uvs.insert(uvs.end(), {u, v});
            if (i + 1 == kSide || j + 1 == kSide)
                continue;
            const std::uint32_t a = j * kSide + i;
            const std::uint32_t c = a + kSide;
            indices.insert(indices.end(), {a, c, a + 1, a + 1, c, c + 1});
        }
    GltfBuilder gltf;
    nlohmann::json attributes{{"POSITION", gltf.add<float>(positions, "VEC3")},
        {"NORMAL", gltf.add<float>(normals, "VEC3")}, {"TEXCOORD_0", gltf.add<float>(uvs, "VEC2")}};
    gltf.add_mesh(
        {{"attributes", attributes}, {"indices", gltf.add<std::uint32_t>(indices, "SCALAR")}});
    return gltf;
}

void run(const std::filesystem::path& file)
{
    double load = 1e9;
    double pack = 1e9;
    std::size_t triangles = 0;
    std::map<std::string, std::size_t> bytes;
    for (int round = 0; round < kRounds; ++round) {
        Scene scene;
        load = std::min(load, seconds_of([&] { scene = load_scene(file); }));
        std::optional<PackedScene> packed;
        pack = std::min(pack, seconds_of([&] { packed.emplace(pack_scene(scene)); }));
        triangles = packed->content.triangles;
        for (const auto& [name, texels] : packed->tables())
            bytes[name] = texels->size() * sizeof(Texels::value_type);
    }
    std::printf("%zu triangles: file to scene %.3f s, scene to tables with tree %.3f s\n",
        triangles, load, pack);
    std::size_t all = 0;
    for (const auto& [name, count] : bytes) {
        all += count;
        if (count > triangles)  // a byte a triangle
            std::printf("%-10s %6.1f bytes a triangle\n", name.c_str(),
                static_cast<double>(count) / static_cast<double>(triangles));
    }
    std::printf("%-10s %6.1f bytes a triangle\n", "all",
        static_cast<double>(all) / static_cast<double>(triangles));
}

}  // namespace
}  // namespace farlight

int main(int count, char** arguments)
{
    if (count > 1) {
        farlight::run(arguments[1]);
        return 0;
    }
    const farlight::TempFolder folder;
    farlight::million_triangles().write_glb(folder.path() / "million.glb");
    farlight::run(folder.path() / "million.glb");
}
