// A program with only the effects that a scene calls for gives the same bits as the one with all:
// in every texture of every frame, histories and the picture included.
#include "server/render/live_scene.h"
#include "tests/support/gl_test.h"
#include "tests/support/shipped_scenes.h"

#include <iomanip>
#include <numeric>
#include <random>
#include <sstream>

namespace farlight {
namespace {

constexpr int kFrames = 4;
/// Of what moves: off its rest, and not in step with any key.
constexpr double kFirstTime = 0.37;
constexpr double kTimeStep = 0.083;

/// The general programs are compiled once for all tests.
ProgramCache& programs_of_all_tests()
{
    static ProgramCache programs;
    return programs;
}

struct Texels {
    std::string name;
    Extent extent;
    std::vector<float> values;  ///< 4 a texel; integers as their bits.
};

Texels texels_of(const std::string& name, const GpuTexture& texture)
{
    const Extent extent = texture.extent();
    Texels texels{name, extent, {}};
    texels.values.resize(4UL * static_cast<std::size_t>(extent.width * extent.height));
    const bool integer = texture.format() == GL_RGBA32UI;
    glGetTextureImage(texture.id(), 0, integer ? GL_RGBA_INTEGER : GL_RGBA,
        integer ? GL_UNSIGNED_INT : GL_FLOAT, static_cast<GLsizei>(texels.values.size() * 4),
        texels.values.data());
    return texels;
}

/// A scene on the device that any mask may draw.
class Subject {
public:
    explicit Subject(Scene scene)
        : loaded_(load_onto_device(std::move(scene)))
        , scene_programs_(programs_of_all_tests(), nullptr, nullptr, {})
        , shared_{programs_of_all_tests(), scene_programs_, loaded_.look,
              static_cast<std::uint32_t>(loaded_.gpu->light_count()), true}
    {
        shared_.gpu = loaded_.gpu.get();
        shared_.keep_all = true;
        scene_programs_.follow(loaded_.gpu);
    }

    EffectMask mask() const { return scene_programs_.scene_mask(); }

    /// Everything that all frames wrote, to the picture as people see it, while the camera moves a
    /// little and time passes.
    std::vector<Texels> draw(RenderSettings settings, const EffectChoice& effects) const
    {
        settings.effects = effects;
        View view(shared_);
        RenderRequest request = linear_request(*loaded_.scene, {40, 24}, settings);
        request.format = PixelFormat::kRgb8;
        const double step = 0.02 * glm::length(request.camera.target - request.camera.position);
        std::vector<Texels> all;
        for (int frame = 0; frame < kFrames; ++frame) {
            request.camera.position.x += step;
            request.time = kFirstTime + kTimeStep * frame;
            view.render(request);
            for (const auto& [name, texture] : view.graph().written())
                all.push_back(texels_of("frame " + std::to_string(frame) + " " + name, *texture));
        }
        return all;
    }

private:
    LoadedScene loaded_;
    ScenePrograms scene_programs_;
    SharedScene shared_;
};

/// How many texels of the two differ in any bit, and the first that does; "" for none.
std::string difference(const Texels& a, const Texels& b)
{
    std::size_t count = 0;
    std::size_t first = 0;
    for (std::size_t i = 0; i < a.values.size(); i += 4)
        if (std::memcmp(&a.values[i], &b.values[i], 16) != 0 && count++ == 0)
            first = i;
    if (count == 0)
        return "";
    std::ostringstream text;
    text << a.name << " differs in " << count << " of " << a.values.size() / 4 << " texels, first ("
         << first / 4 % static_cast<std::size_t>(a.extent.width) << ", "
         << first / 4 / static_cast<std::size_t>(a.extent.width) << "):" << std::setprecision(9);
    for (const Texels* texels : {&a, &b})
        for (std::size_t k = 0; k < 4; ++k)
            text << (k == 0 ? "  (" : " ") << texels->values[first + k] << (k == 3 ? ")" : "");
    return text.str();
}

/// Textures of the same name come in the same order; `more` may have names that `less` lacks.
void expect_equal(
    const std::vector<Texels>& less, const std::vector<Texels>& more, const std::string& what)
{
    std::size_t compared = 0;
    auto next = more.begin();
    for (const Texels& texels : less) {
        next = std::find_if(
            next, more.end(), [&](const Texels& other) { return other.name == texels.name; });
        ASSERT_NE(next, more.end()) << what << ": no texture " << texels.name;
        // What follows from a difference differs too.
        ASSERT_EQ(difference(texels, *next), "") << what;
        ++next;
        ++compared;
    }
    EXPECT_GT(compared, 4U * kFrames) << what;
}

EffectMask random_superset(EffectMask mask, std::mt19937& random)
{
    std::vector<std::string_view> names = mask.names();
    for (const std::string_view name : EffectMask::general().names())
        if (random() % 2 == 0)
            names.push_back(name);
    return EffectMask::of(names);
}

/// `choices` against the general programs.
void expect_as_general(const Subject& subject, const RenderSettings& settings,
    const std::vector<EffectChoice>& choices, const std::string& what)
{
    const auto expected = subject.draw(settings, {EffectChoice::Kind::kGeneral, {}});
    for (const EffectChoice& choice : choices)
        expect_equal(subject.draw(settings, choice), expected,
            what + " with " + (choice.mask.empty() ? "its own" : to_text(choice)));
}

EffectChoice list(EffectMask mask)
{
    return {EffectChoice::Kind::kList, mask};
}

RenderSettings averaging()
{
    RenderSettings settings;
    settings.denoiser = Denoiser::kAccumulate;
    return settings;
}

unsigned seed_of(const std::string& scene)
{
    return std::accumulate(scene.begin(), scene.end(), 7U,
        [](unsigned sum, char c) { return 31 * sum + static_cast<unsigned char>(c); });
}

std::vector<std::string> scene_names()
{
    std::vector<std::string> names;
    for (const auto& file : shipped_scenes())
        names.push_back(file.stem());
    return names;
}

class SpecialisedTest : public GlTest, public testing::WithParamInterface<std::string> { };

TEST_P(SpecialisedTest, EqualsTheGeneralProgramBitForBit)
{
    const Subject subject(shipped_scene(GetParam() + ".json"));
    expect_as_general(subject, {}, {list({})}, GetParam());
}

/// Every effect, and those that meet; all scenes are in the long form.
INSTANTIATE_TEST_SUITE_P(Scenes, SpecialisedTest,
    testing::Values("cornell_box", "four_spheres", "fog_and_alpha", "lens_and_mirror",
        "glass_in_fog", "worn_metal", "lantern", "moving", "deforming", "everything"),
    [](const auto& test) { return test.param; });

/// More than the scene calls for, and less than all.
class SupersetTest : public SpecialisedTest { };

TEST_P(SupersetTest, EqualsTheGeneralProgramBitForBit)
{
    const Subject subject(shipped_scene(GetParam() + ".json"));
    std::mt19937 random(seed_of(GetParam()));
    expect_as_general(subject, {}, {list(random_superset(subject.mask(), random))}, GetParam());
}

INSTANTIATE_TEST_SUITE_P(Scenes, SupersetTest, testing::Values("cornell_box", "lens_and_mirror"),
    [](const auto& test) { return test.param; });

/// What no shipped scene is small enough for: something that rests in a space of its own.
TEST_F(GlTest, SpecialisedEqualsGeneralForInstancesAtRest)
{
    Scene scene = shipped_scene("cornell_box.json");
    scene.animation.nodes.push_back({.name = "holder"});
    scene.animation.nodes.back().translation = scene_bounds(scene).center();
    scene.animation.nodes.back().scale = glm::dvec3(0.3, 0.2, 0.1) * scene_bounds(scene).radius();
    scene.objects.push_back({.name = "egg", .shape = Sphere{}, .node = 0});
    const Subject subject(std::move(scene));
    ASSERT_TRUE(subject.mask().has("instances"));
    ASSERT_FALSE(subject.mask().has("motion"));
    expect_as_general(subject, {}, {list({})}, "egg");
}

/// As many samples as fog would need another dispatch for: a program that could draw fog must not
/// add them up in another order.
TEST_F(GlTest, SpecialisedEqualsGeneralForManySamplesAtOnce)
{
    RenderSettings many = averaging();
    many.samples_per_pixel = 40;
    const Subject subject(shipped_scene("cornell_box.json"));
    expect_as_general(subject, many, {list({})}, "cornell_box");
}

/// Minutes: run by ctest -L long.
class SpecialisedLongTest : public SpecialisedTest { };

TEST_P(SpecialisedLongTest, EqualsTheGeneralProgramBitForBit)
{
    const Subject subject(shipped_scene(GetParam() + ".json"));
    std::mt19937 random(seed_of(GetParam()));
    std::vector<EffectChoice> choices{list({})};
    for (int i = 0; i < 4; ++i)
        choices.push_back(list(random_superset(subject.mask(), random)));
    expect_as_general(subject, {}, choices, GetParam());
    RenderSettings many = averaging();
    many.samples_per_pixel = 3;
    many.max_depth = 9;
    expect_as_general(subject, many, choices, GetParam() + " averaged");
}

INSTANTIATE_TEST_SUITE_P(Scenes, SpecialisedLongTest, testing::ValuesIn(scene_names()),
    [](const auto& test) { return test.param; });

/// Each effect compiled in for nothing.
class LeaveOneInLongTest : public GlTest, public testing::WithParamInterface<std::string> { };

TEST_P(LeaveOneInLongTest, ChangesNoBitOfAPlainScene)
{
    const Subject subject(shipped_scene("cornell_box.json"));
    const EffectMask more = EffectMask::of({GetParam()});
    expect_as_general(subject, {}, {list(more)}, GetParam());
}

std::vector<std::string> compiled_effects()
{
    std::vector<std::string> names;
    for (const std::string_view name : EffectMask::general().names())
        names.emplace_back(name);
    return names;
}

INSTANTIATE_TEST_SUITE_P(Effects, LeaveOneInLongTest, testing::ValuesIn(compiled_effects()),
    [](const auto& test) { return test.param; });

}  // namespace
}  // namespace farlight
