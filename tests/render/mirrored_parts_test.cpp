// A glTF node that mirrors shows what a mesh that was modelled as the mirror image does: its lamp
// shines outward, its glass is solid, its normal map's bumps are bumps.
#include "lab/temp_folder.h"
#include "tests/scene/gltf_builder.h"
#include "tests/scene/png.h"
#include "tests/support/gl_test.h"

namespace farlight {
namespace {

using Json = nlohmann::json;

constexpr Extent kMirroredExtent{48, 32};

struct PartVertices {
    std::vector<float> positions;
    std::vector<float> normals;
    std::vector<float> uvs;
    std::vector<std::uint16_t> indices;
};

/// corner, + u, + u + v, + v; seen from where u x v points.
PartVertices sheet(const glm::vec3& corner, const glm::vec3& u, const glm::vec3& v)
{
    PartVertices sheet{{}, {}, {0, 1, 1, 1, 1, 0, 0, 0}, {0, 1, 2, 0, 2, 3}};
    const glm::vec3 normal = glm::normalize(glm::cross(u, v));
    for (const glm::vec3& p : {corner, corner + u, corner + u + v, corner + v}) {
        sheet.positions.insert(sheet.positions.end(), {p.x, p.y, p.z});
        sheet.normals.insert(sheet.normals.end(), {normal.x, normal.y, normal.z});
    }
    return sheet;
}

PartVertices ball(const glm::vec3& center, float radius)
{
    constexpr int kAround = 24;
    constexpr int kAlong = 12;
    PartVertices ball;
    for (int i = 0; i <= kAlong; ++i)
        for (int k = 0; k < kAround; ++k) {
            const float theta = glm::radians(180.0F * static_cast<float>(i) / kAlong);
            const float phi = glm::radians(360.0F * static_cast<float>(k) / kAround);
            const glm::vec3 n(
                std::sin(theta) * std::sin(phi), std::cos(theta), std::sin(theta) * std::cos(phi));
            const glm::vec3 p = center + radius * n;
            ball.positions.insert(ball.positions.end(), {p.x, p.y, p.z});
            ball.normals.insert(ball.normals.end(), {n.x, n.y, n.z});
            ball.uvs.insert(ball.uvs.end(), {0, 0});
        }
    for (int i = 0; i < kAlong; ++i)
        for (int k = 0; k < kAround; ++k) {
            const auto at = [&](int down, int right) {
                return static_cast<std::uint16_t>((i + down) * kAround + (k + right) % kAround);
            };
            ball.indices.insert(
                ball.indices.end(), {at(0, 0), at(1, 0), at(1, 1), at(0, 0), at(1, 1), at(0, 1)});
        }
    return ball;
}

/// The mirror image at x = 0, outside still outside.
PartVertices mirror_image(PartVertices v)
{
    for (std::size_t i = 0; i < v.positions.size(); i += 3) {
        v.positions[i] = -v.positions[i];
        v.normals[i] = -v.normals[i];
    }
    for (std::size_t i = 0; i < v.indices.size(); i += 3)
        std::swap(v.indices[i + 1], v.indices[i + 2]);
    return v;
}

Json materials_of_parts()
{
    return {{{"emissiveFactor", {1, 1, 1}},
                {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", 20}}}}}},
        {{"pbrMetallicRoughness", {{"metallicFactor", 0}, {"roughnessFactor", 0}}},
            {"extensions",
                {{"KHR_materials_transmission", {{"transmissionFactor", 1}}},
                    {"KHR_materials_volume", {{"thicknessFactor", 1}}}}}},
        {{"pbrMetallicRoughness", {{"metallicFactor", 0}}}, {"normalTexture", {{"index", 0}}}}};
}

enum class By : std::uint8_t { kNode, kModel };

/// A lamp off to a side, a glass ball and a floor with a slanted normal map, mirrored at x = 0 by
/// their node or as they were modelled. Moving, they stand at time 1 s where they stand at rest.
Scene mirrored_parts(By by, bool moving)
{
    GltfBuilder gltf;
    const int view = gltf.add_view(png8(1, 1, {220, 170, 200, 255}));
    gltf.document["images"] = {{{"bufferView", view}}};
    gltf.document["textures"] = {{{"source", 0}}};
    gltf.document["materials"] = materials_of_parts();
    int material = 0;
    for (const PartVertices& part : {sheet({0.5F, 2.5F, -0.5F}, {1, 0, 0}, {0, 0, 1}),
             ball({-0.4F, 0.8F, 0.3F}, 0.6F), sheet({-3, 0, 3}, {6, 0, 0}, {0, 0, -6})}) {
        const PartVertices v = by == By::kModel ? mirror_image(part) : part;
        const Json attributes{{"POSITION", gltf.add(v.positions, "VEC3")},
            {"NORMAL", gltf.add(v.normals, "VEC3")}, {"TEXCOORD_0", gltf.add(v.uvs, "VEC2")}};
        gltf.add_mesh({{"attributes", attributes}, {"indices", gltf.add(v.indices, "SCALAR")},
            {"material", material++}});
    }
    gltf.document["nodes"].push_back(
        {{"children", {0, 1, 2}}, {"scale", {by == By::kNode ? -1 : 1, 1, 1}}});
    gltf.document["scenes"][0]["nodes"] = {3};
    if (moving) {
        const int times = gltf.add<float>({0, 1, 2}, "SCALAR");
        const int places = gltf.add<float>({0.5F, 0, 0, 0, 0, 0, 0.5F, 0, 0}, "VEC3");
        gltf.document["animations"] = {
            {{"channels", {{{"sampler", 0}, {"target", {{"node", 3}, {"path", "translation"}}}}}},
                {"samplers", {{{"input", times}, {"output", places}}}}}};
    }
    const TempFolder folder;
    gltf.write_glb(folder.path() / "parts.glb");
    Scene scene = load_scene(folder.path() / "parts.glb");
    scene.background = glm::vec3(0.1F, 0.2F, 0.4F);
    scene.camera = {{0.5, 2, 4}, {0, 0.7, 0}, {0, 1, 0}, 45};
    return scene;
}

class MirroredPartsTest : public GlTest {
protected:
    static Image picture(By by, bool moving)
    {
        const DeviceScene scene(mirrored_parts(by, moving));
        EXPECT_EQ(scene.inputs.calls_for("FX_INSTANCES"), moving);
        EXPECT_TRUE(scene.inputs.calls_for("FX_NORMAL_MAPS"));
        RenderRequest request = linear_request(scene.scene, kMirroredExtent, {});
        request.settings.denoiser = Denoiser::kOff;
        request.settings.samples_per_pixel = 16;
        request.settings.max_depth = 6;
        request.time = 1;
        View view(scene.shared);
        const RenderedFrame frame = view.render(request);
        EXPECT_EQ(frame.bad_values.all(), 0U);
        return frame.image;
    }

    /// Pixels whose colours differ by more than a fiftieth.
    static int different(const Image& a, const Image& b)
    {
        int count = 0;
        for (int y = 0; y < kMirroredExtent.height; ++y)
            for (int x = 0; x < kMirroredExtent.width; ++x) {
                const glm::vec3 expected = pixel(b, x, y);
                count += glm::distance(pixel(a, x, y), expected) <= 0.02F * glm::length(expected)
                    ? 0
                    : 1;
            }
        return count;
    }
};

/// The same triangles of the same bits.
TEST_F(MirroredPartsTest, AtRestTheyAreTheirTwins)
{
    EXPECT_EQ(different(picture(By::kNode, false), picture(By::kModel, false)), 0);
}

/// Another space, other roundings: a path here and there turns elsewhere.
TEST_F(MirroredPartsTest, MovingTheyAreTheirTwins)
{
    const Image twin = picture(By::kModel, false);
    const int pixels = kMirroredExtent.width * kMirroredExtent.height;
    EXPECT_LE(different(picture(By::kModel, true), twin), pixels / 20);
    EXPECT_LE(different(picture(By::kNode, true), twin), pixels / 20);
}

}  // namespace
}  // namespace farlight
