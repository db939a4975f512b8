// Texture lookups on the device against an oracle in double precision.
#include "lab/compute.h"
#include "server/scene/device_limits.h"
#include "server/scene/texture_arrays.h"
#include "tests/support/gl_test.h"

#include <random>

namespace farlight {
namespace {

constexpr std::uint32_t kProbes = 256;
constexpr int kStochastic = 4096;  // samples a probe

Image8 random_image(std::uint32_t width, std::uint32_t height, unsigned seed)
{
    std::mt19937 random(seed);
    Image8 image{"random", width, height, {}};
    for (std::uint32_t i = 0; i < width * height; ++i)
        image.texels.emplace_back(random(), random(), random(), random());
    return image;
}

int wrapped(Wrap wrap, int i, int n)
{
    const auto modulo = [](int a, int b) { return (a % b + b) % b; };
    switch (wrap) {
    case Wrap::kRepeat: return modulo(i, n);
    case Wrap::kMirror:
        return modulo(i, 2 * n) < n ? modulo(i, 2 * n) : 2 * n - 1 - modulo(i, 2 * n);
    case Wrap::kClamp: break;
    }
    return std::clamp(i, 0, n - 1);
}

/// What the OpenGL specification (8.14) makes of a lookup, with texels as the levels store them.
class Oracle {
public:
    Oracle(const Image8& image, const Texture& texture, TexelSpace space)
        : levels_(mip_levels(image, space))
        , texture_(texture)
        , space_(space)
    {
    }

    glm::dvec4 filtered(const glm::dvec2& uv, double lod) const
    {
        const glm::dvec3 at = glm::dmat3(texture_.image_from_uv) * glm::dvec3(uv, 1);
        const double last = static_cast<double>(levels_.size()) - 1;
        const double clamped = std::clamp(lod, 0.0, last);
        if (texture_.nearest && clamped == 0)
            return texel(0, static_cast<int>(std::floor(at.x * levels_[0].width)),
                static_cast<int>(std::floor(at.y * levels_[0].height)));
        const auto level = static_cast<std::size_t>(clamped);
        const double blend = clamped - static_cast<double>(level);
        const glm::dvec4 fine = bilinear(level, at);
        return blend == 0 ? fine : glm::mix(fine, bilinear(level + 1, at), blend);
    }

private:
    glm::dvec4 texel(std::size_t level, int x, int y) const
    {
        const Image8& image = levels_[level];
        const auto column = wrapped(texture_.wrap_u, x, static_cast<int>(image.width));
        const auto row = wrapped(texture_.wrap_v, y, static_cast<int>(image.height));
        return decoded(image.texels[static_cast<std::size_t>(row) * image.width
                           + static_cast<std::size_t>(column)],
            space_);
    }
    glm::dvec4 bilinear(std::size_t level, const glm::dvec2& at) const
    {
        const glm::dvec2 x = at * glm::dvec2(levels_[level].width, levels_[level].height) - 0.5;
        const glm::ivec2 i(glm::floor(x));
        const glm::dvec2 f = x - glm::floor(x);
        return glm::mix(glm::mix(texel(level, i.x, i.y), texel(level, i.x + 1, i.y), f.x),
            glm::mix(texel(level, i.x, i.y + 1), texel(level, i.x + 1, i.y + 1), f.x), f.y);
    }

    std::vector<Image8> levels_;
    Texture texture_;
    TexelSpace space_;
};

struct LookupCase {
    const char* name;
    glm::uvec2 size;
    Wrap wrap_u;
    Wrap wrap_v;
    bool nearest;
    TexelSpace space;
    bool transformed;

    friend void PrintTo(const LookupCase& c, std::ostream* out) { *out << c.name; }
};

class TextureLookupTest : public GlTest, public testing::WithParamInterface<LookupCase> {
protected:
    TextureLookupTest()
        : images_{random_image(3, 3, 1), random_image(GetParam().size.x, GetParam().size.y, 2)}
        , layout_(images_)
    {
        texture_.image = 1;
        texture_.wrap_u = GetParam().wrap_u;
        texture_.wrap_v = GetParam().wrap_v;
        texture_.nearest = GetParam().nearest;
        if (GetParam().transformed)
            texture_.image_from_uv = {{0.6F, 0.8F, 0}, {-1.6F, 1.2F, 0}, {0.3F, -0.4F, 1}};
        Texture other;
        other.image = 0;
        layout_.need(other, TexelSpace::kSrgb);
        layout_.need(other, TexelSpace::kLinear);
        layout_.need(texture_, GetParam().space);
        layout_.lay_out(device_limits().textures);
    }

    /// Results: two vectors a probe, filtered and the mean of stochastic lookups.
    std::vector<glm::vec4> looked_up(const std::vector<glm::vec4>& probes)
    {
        const PackedTexture packed = layout_.packed(texture_, GetParam().space);
        std::vector<glm::vec4> input = probes;
        for (const glm::uvec4& texel : packed)
            input.push_back(glm::uintBitsToFloat(texel));
        Buffer buffer("probes", std::as_bytes(std::span<const glm::vec4>(input)));
        const TextureArrays arrays(layout_);
        Inputs inputs = arrays.textures();
        inputs["probes"] = buffer.texture(GL_RGBA32UI);
        add_shader_file("tests/lookup", kShader);
        const Program program(load_shader_source("tests/lookup",
            {{"FX_TEXTURES", "1"}, {"TEXTURE_ARRAY_COUNT", std::to_string(layout_.arrays().size())},
                {"PROBES", std::to_string(kProbes)}, {"STOCHASTIC", std::to_string(kStochastic)}}));
        return run_compute(program, inputs, 2UL * kProbes, kProbes);
    }

    static constexpr const char* kShader = R"(#version 450
#include "lib/random.glsl"
#include "textures/texture.glsl"
layout(local_size_x = 64) in;
layout(std430) buffer output_block { vec4 results[]; };
uniform usamplerBuffer probes;
void main()
{
    const int i = int(gl_GlobalInvocationID.x);
    const TextureRef t = unpack_texture(texelFetch(probes, PROBES), texelFetch(probes, PROBES + 1));
    const vec4 probe = uintBitsToFloat(texelFetch(probes, i));
    results[2 * i] = texture_filtered(t, probe.xy, probe.z);
    vec4 sum = vec4(0.0);
    for (uint s = 0u; s < STOCHASTIC; ++s)
        sum += texture_stochastic(t, probe.xy, probe.z, random4(uvec2(i, 0u), 1u, s, 0u, 0u).xyz);
    results[2 * i + 1] = sum / float(STOCHASTIC);
}
)";

    std::vector<Image8> images_;
    TextureLayout layout_;
    Texture texture_;
};

TEST_P(TextureLookupTest, FilteredAndStochasticAgreeWithTheOracle)
{
    const LookupCase& c = GetParam();
    const Oracle oracle(images_[1], texture_, c.space);
    const glm::dmat3 m(texture_.image_from_uv);
    const double texels =
        static_cast<double>(c.size.x) * c.size.y * std::abs(m[0][0] * m[1][1] - m[0][1] * m[1][0]);
    std::mt19937 random(3);
    std::uniform_real_distribution<float> place(-2.5F, 2.5F);
    std::uniform_real_distribution<float> level(-1.5F, 6.5F);
    std::vector<glm::vec4> probes;
    for (std::uint32_t i = 0; i < kProbes; ++i) {
        glm::vec2 uv(place(random), place(random));
        if (i % 4 == 0)  // texel centres
            uv = (glm::floor(uv * glm::vec2(c.size)) + 0.5F) / glm::vec2(c.size);
        const float lod = i % 2 == 0 ? -1.0F : level(random);
        probes.emplace_back(uv, lod - static_cast<float>(0.5 * std::log2(texels)), lod);
    }
    const std::vector<glm::vec4> results = looked_up(probes);
    for (std::uint32_t i = 0; i < kProbes; ++i) {
        const glm::dvec2 uv(probes[i].x, probes[i].y);
        const glm::dvec4 expected = oracle.filtered(uv, probes[i].w);
        // 4e-3: places are rounded to 2.5 * 2^-23 of the image, times up to 37 texels, and the
        // device decodes sRGB to within 1e-3. A nearest lookup at such a place may fall on either
        // side: probes lie far enough from texel edges, fixed by the seed.
        for (int k = 0; k < 4; ++k)
            ASSERT_NEAR(results[2 * i][k], expected[k], 4e-3)
                << "probe " << i << " at " << uv.x << ", " << uv.y << " level " << probes[i].w;
        // Texels lie in [0, 1], so 4096 of them have a standard error of 1/128 at most; 5.5 of
        // those are exceeded once in 26 million, with 1024 channels once in 25 000 seeds.
        for (int k = 0; k < 4; ++k)
            ASSERT_NEAR(results[2 * i + 1][k], expected[k], 5.5 / 128) << "probe " << i;
    }
}

INSTANTIATE_TEST_SUITE_P(Textures, TextureLookupTest,
    testing::Values(LookupCase{"RepeatSrgb", {8, 8}, Wrap::kRepeat, Wrap::kRepeat, false,
                        TexelSpace::kSrgb, false},
        LookupCase{"MirrorLinear", {8, 4}, Wrap::kMirror, Wrap::kMirror, false, TexelSpace::kLinear,
            false},
        LookupCase{
            "ClampOddSize", {13, 7}, Wrap::kClamp, Wrap::kClamp, false, TexelSpace::kSrgb, false},
        LookupCase{"MixedWrapsOddSize", {37, 5}, Wrap::kMirror, Wrap::kRepeat, false,
            TexelSpace::kLinear, false},
        LookupCase{"Nearest", {6, 5}, Wrap::kRepeat, Wrap::kMirror, true, TexelSpace::kSrgb, false},
        LookupCase{
            "Transformed", {16, 9}, Wrap::kRepeat, Wrap::kClamp, false, TexelSpace::kSrgb, true},
        LookupCase{
            "OneTexel", {1, 1}, Wrap::kRepeat, Wrap::kRepeat, false, TexelSpace::kSrgb, false},
        LookupCase{
            "OneRow", {9, 1}, Wrap::kRepeat, Wrap::kRepeat, false, TexelSpace::kLinear, false}),
    [](const auto& test) { return test.param.name; });

class TextureArraysTest : public GlTest { };

TEST_F(TextureArraysTest, BindAllArraysAndReportTheirMemory)
{
    const std::vector<Image8> images{random_image(8, 8, 1)};
    TextureLayout layout(images);
    Texture texture;
    texture.image = 0;
    layout.need(texture, TexelSpace::kSrgb);
    layout.lay_out(device_limits().textures);
    const TextureArrays arrays(layout);
    EXPECT_EQ(arrays.textures().size(), std::size_t{TEXTURE_ARRAYS});
    ASSERT_EQ(arrays.arrays().size(), 1U);
    EXPECT_EQ(arrays.arrays()[0].name, "texture_array_0");
    EXPECT_EQ(arrays.arrays()[0].content, "1 layers of 8x8 sRGB texels with mip levels");
    EXPECT_EQ(arrays.arrays()[0].bytes, 4U * (64 + 16 + 4 + 1));
}

}  // namespace
}  // namespace farlight
