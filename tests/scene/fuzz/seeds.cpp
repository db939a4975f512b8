// The glTF seeds are made here, so that they are small and reach every reader.
#include "tests/scene/fuzz/seeds.h"

#include "server/scene/json_text.h"
#include "tests/scene/compressed_gltf.h"
#include "tests/scene/fuzz/mutation.h"
#include "tests/scene/png.h"

#include <algorithm>

namespace farlight {

namespace {

using Json = nlohmann::json;

/// A square with every attribute, a morph target and all kinds of materials, textures and lights.
GltfBuilder still_life()
{
    GltfBuilder gltf = triangle_gltf();
    Json& primitive = gltf.document["meshes"][0]["primitives"][0];
    Json& attributes = primitive["attributes"];
    attributes["NORMAL"] =
        gltf.add<std::int8_t>({0, 0, 127, 0, 0, 127, 0, 0, 127}, "VEC3", 4, true);
    attributes["TEXCOORD_0"] = gltf.add<float>({0, 0, 1, 0, 0, 1}, "VEC2");
    attributes["TEXCOORD_1"] = gltf.add<std::uint16_t>({0, 0, 9, 0, 0, 9}, "VEC2", 0, true);
    attributes["COLOR_0"] =
        gltf.add<std::uint8_t>({1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}, "VEC4", 0, true);
    primitive["material"] = 0;
    const int view = gltf.add_view(png8(1, 1, {128, 128, 255, 255}));
    gltf.document["images"] = {
        {{"bufferView", view}}, {{"uri", data_uri("image/png", png8(1, 1, {1, 2, 3, 4}))}}};
    gltf.document["samplers"] = {{{"wrapS", 33071}, {"wrapT", 33648}, {"magFilter", 9728}}};
    gltf.document["textures"] = {{{"source", 0}, {"sampler", 0}}, {{"source", 1}}};
    const Json turned = {{"index", 1}, {"texCoord", 1},
        {"extensions",
            {{"KHR_texture_transform",
                {{"offset", {0.5, 0}}, {"rotation", 1}, {"scale", {2, 3}}}}}}};
    gltf.document["materials"] = {{{"name", "all"}, {"normalTexture", {{"index", 0}, {"scale", 2}}},
        {"emissiveTexture", turned}, {"emissiveFactor", {1, 2, 3}}, {"alphaMode", "MASK"},
        {"pbrMetallicRoughness",
            {{"baseColorFactor", {1, 0.5, 0.2, 0.5}}, {"baseColorTexture", turned},
                {"metallicFactor", 0.5}}},
        {"extensions",
            {{"KHR_materials_emissive_strength", {{"emissiveStrength", 3}}},
                {"KHR_materials_ior", {{"ior", 1.3}}},
                {"KHR_materials_specular", {{"specularColorFactor", {1, 1, 0}}}},
                {"KHR_materials_transmission", {{"transmissionFactor", 0.5}}},
                {"KHR_materials_volume",
                    {{"thicknessFactor", 1}, {"attenuationDistance", 2},
                        {"attenuationColor", {0.5, 0.1, 1}}}},
                {"KHR_materials_clearcoat", {{"clearcoatFactor", 1}}}}}}};
    gltf.document["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "spot"}, {"spot", {{"innerConeAngle", 0.1}, {"outerConeAngle", 0.2}}}}};
    gltf.document["cameras"] = {
        {{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0.1}}}}};
    gltf.document["nodes"].push_back({{"camera", 0}, {"rotation", {0, 0, 0, 1}},
        {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    gltf.document["scenes"][0]["nodes"].push_back(1);
    return gltf;
}

/// A skinned, morphed triangle on moving nodes; sparse positions; lines beside it.
GltfBuilder in_motion()
{
    GltfBuilder gltf = triangle_gltf();
    Json& primitives = gltf.document["meshes"][0]["primitives"];
    Json& attributes = primitives[0]["attributes"];
    attributes["JOINTS_0"] = gltf.add<std::uint8_t>({0, 1, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0}, "VEC4");
    attributes["WEIGHTS_0"] =
        gltf.add<float>({0.5, 0.5, 0, 0, 1, 0, 0, 0, 0.25, 0.75, 0, 0}, "VEC4");
    attributes["JOINTS_1"] = attributes["JOINTS_0"];
    attributes["WEIGHTS_1"] = attributes["WEIGHTS_0"];
    primitives[0]["targets"] = {
        {{"POSITION", gltf.add<float>({0, 0, 1, 0, 0, 2, 0, 1, 0}, "VEC3")}}};
    primitives.push_back({{"attributes", attributes}, {"mode", 3}});
    const int place = gltf.add<std::uint8_t>({1}, "SCALAR");
    const int value = gltf.add<float>({2, 0, 0}, "VEC3");
    gltf.document["accessors"][0]["sparse"] = {{"count", 1},
        {"indices",
            {{"bufferView", gltf.document["accessors"][place]["bufferView"]},
                {"componentType", 5121}}},
        {"values", {{"bufferView", gltf.document["accessors"][value]["bufferView"]}}}};
    std::vector<float> binds(32, 0);
    for (const std::size_t i : {0U, 5U, 10U, 15U, 16U, 21U, 26U, 31U})
        binds[i] = 1;
    gltf.document["skins"] = {
        {{"joints", {1, 2}}, {"inverseBindMatrices", gltf.add<float>(binds, "MAT4")}}};
    gltf.document["nodes"] = {{{"mesh", 0}, {"skin", 0}, {"weights", {0.5}}},
        {{"children", {2, 3}}}, {{"translation", {1, 0, 0}}},
        {{"mesh", 0}, {"matrix", {-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}}};
    primitives[1]["targets"] = primitives[0]["targets"];
    gltf.document["scenes"][0]["nodes"] = {0, 1};
    const int times = gltf.add<float>({0, 1}, "SCALAR");
    const int turns = gltf.add<float>({0, 0, 0, 1, 0, 0, 1, 0}, "VEC4");
    const int weights = gltf.add<float>({0, 0, 1, 0, 1, 0}, "SCALAR");
    gltf.document["animations"] = {
        {{"channels",
             {{{"sampler", 0}, {"target", {{"node", 1}, {"path", "rotation"}}}},
                 {{"sampler", 1}, {"target", {{"node", 0}, {"path", "weights"}}}}}},
            {"samplers",
                {{{"input", times}, {"output", turns}},
                    {{"input", times}, {"output", weights}, {"interpolation", "CUBICSPLINE"}}}}}};
    return gltf;
}

void add_gltf(std::vector<Seed>& seeds, const std::string& name, GltfBuilder gltf)
{
    seeds.push_back({name + ".glb", SceneFormat::kGlb,
        join_scene(SceneFormat::kGlb, {gltf.document.dump(), gltf.bytes})});
    gltf.document["buffers"][0]["uri"] = data_uri("application/octet-stream", gltf.bytes);
    seeds.push_back({name + ".gltf", SceneFormat::kGltf, gltf.document.dump()});
}

}  // namespace

std::vector<Seed> fuzz_seeds()
{
    std::vector<Seed> seeds;
    add_gltf(seeds, "still_life", still_life());
    add_gltf(seeds, "in_motion", in_motion());
    add_gltf(seeds, "draco", draco_gltf());
    add_gltf(seeds, "meshopt", meshopt_gltf(false));
    add_gltf(seeds, "meshopt_sequence", meshopt_gltf(true));
    constexpr std::uintmax_t kSmall = 1U << 16U;  // bytes; larger ones would only be slow
    const std::filesystem::path folder = std::filesystem::path(FARLIGHT_SOURCE_DIR) / "scenes";
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        const std::string extension = entry.path().extension().string();
        const std::string name = entry.path().filename().string();
        if (!entry.is_regular_file() || entry.file_size() > kSmall
            || name.ends_with(".schema.json"))
            continue;
        if (extension == ".json")
            seeds.push_back({name, SceneFormat::kJson, read_file(entry.path(), "a scene")});
        else if (extension == ".glb")
            seeds.push_back({name, SceneFormat::kGlb, read_file(entry.path(), "a scene")});
    }
    std::sort(
        seeds.begin(), seeds.end(), [](const Seed& a, const Seed& b) { return a.name < b.name; });
    return seeds;
}

}  // namespace farlight
