// bsdf/interior.glsl over packed materials: a straight line through a glass of water with ice in
// it.
#include "lab/compute.h"
#include "server/gl/buffer.h"
#include "server/scene/materials.h"
#include "tests/support/gl_test.h"

namespace farlight {
namespace {

constexpr std::uint32_t kWater = 0;
constexpr std::uint32_t kIce = 1;
constexpr std::uint32_t kGlass = 2;

struct Step {
    std::uint32_t material;
    bool front;  ///< Entered, else left.
    double eta;  ///< Of no meaning where nothing real is met.
    bool real;
    double absorption;  ///< Of what is behind.
};

Material transparent(float ior, int priority, float absorption)
{
    Material m;
    m.transmission = 1;
    m.ior = ior;
    m.priority = priority;
    m.absorption = glm::vec3(absorption);
    return m;
}

class InteriorTest : public GlTest {
protected:
    static void expect_walk(const std::vector<Material>& materials, const std::vector<Step>& steps)
    {
        std::vector<glm::uvec4> met;
        met.reserve(steps.size());
        for (const Step& step : steps)
            met.emplace_back(step.material, step.front ? 1 : 0, 0, 0);
        const std::vector<Image8> no_images;
        TextureLayout textures(no_images);
        textures.lay_out({});
        const Texels packed = pack_materials(materials, textures);
        Buffer material_buffer("materials", std::as_bytes(std::span<const glm::uvec4>(packed)));
        Buffer step_buffer("steps", std::as_bytes(std::span<const glm::uvec4>(met)));
        add_shader_file("tests/interior_ranks",
            read_text(FARLIGHT_SOURCE_DIR "/tests/shaders/interior_ranks.comp"));
        const Program program(load_shader_source("tests/interior_ranks", {{"FX_DIELECTRIC", "1"}}));
        const auto results = run_compute(program,
            {{"materials", material_buffer.texture(GL_RGBA32UI)},
                {"steps", step_buffer.texture(GL_RGBA32UI)}},
            steps.size(), 1);
        for (std::size_t i = 0; i < steps.size(); ++i) {
            const double eta = steps[i].real ? steps[i].eta : static_cast<double>(results[i].x);
            EXPECT_NEAR(results[i].x, eta, 1e-6) << "step " << i;
            EXPECT_EQ(results[i].y, steps[i].real ? 1 : 0) << "step " << i;
            EXPECT_EQ(results[i].z, static_cast<float>(steps[i].absorption)) << "step " << i;
            EXPECT_EQ(results[i].w, 0) << "step " << i;
        }
    }
};

/// Water reaches into the glass, ice into the water: the glass wins over both, the ice over water.
TEST_F(InteriorTest, TheHighestPriorityFillsWhatThingsShare)
{
    expect_walk({transparent(1.33F, 0, 1), transparent(1.31F, 1, 2), transparent(1.5F, 2, 3)},
        {{kGlass, true, 1.5, true, 3}, {kWater, true, 0, false, 3},
            {kGlass, false, 1.33 / 1.5, true, 1}, {kIce, true, 1.31 / 1.33, true, 2},
            {kIce, false, 1.33 / 1.31, true, 1}, {kGlass, true, 1.5 / 1.33, true, 3},
            {kWater, false, 0, false, 3}, {kGlass, false, 1 / 1.5, true, 0}});
}

/// Of equals the one entered last counts, so plain nesting needs no priorities.
TEST_F(InteriorTest, EqualPrioritiesNest)
{
    expect_walk({transparent(1.33F, 0, 1), transparent(1.31F, 0, 2), transparent(1.5F, 0, 3)},
        {{kGlass, true, 1.5, true, 3}, {kWater, true, 1.33 / 1.5, true, 1},
            {kIce, true, 1.31 / 1.33, true, 2}, {kWater, false, 0, false, 2},
            {kIce, false, 1.5 / 1.31, true, 3}, {kGlass, false, 1 / 1.5, true, 0}});
}

/// A camera inside of something leaves what it never entered.
TEST_F(InteriorTest, LeavingWhatWasNeverEntered)
{
    expect_walk({transparent(1.33F, 0, 1)},
        {{kWater, false, 1 / 1.33, true, 0}, {kWater, true, 1.33, true, 1}});
}

}  // namespace
}  // namespace farlight
