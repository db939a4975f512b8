// Drawing with one mask and another, and comparing all that was written.
#include "tests/render/same_bits.h"

#include <cstring>
#include <gtest/gtest.h>
#include <iomanip>
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

WrittenTexels texels_of(const std::string& name, const GpuTexture& texture)
{
    const Extent extent = texture.extent();
    WrittenTexels texels{name, extent, {}};
    texels.values.resize(4UL * static_cast<std::size_t>(extent.width * extent.height));
    const bool integer = texture.format() == GL_RGBA32UI;
    glGetTextureImage(texture.id(), 0, integer ? GL_RGBA_INTEGER : GL_RGBA,
        integer ? GL_UNSIGNED_INT : GL_FLOAT, static_cast<GLsizei>(texels.values.size() * 4),
        texels.values.data());
    return texels;
}

/// How many texels of the two differ in any bit, and the first that does; "" for none.
std::string difference(const WrittenTexels& a, const WrittenTexels& b)
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
    for (const WrittenTexels* texels : {&a, &b})
        for (std::size_t k = 0; k < 4; ++k)
            text << (k == 0 ? "  (" : " ") << texels->values[first + k] << (k == 3 ? ")" : "");
    return text.str();
}

/// Textures of the same name come in the same order; `more` may have names that `less` lacks.
void expect_equal(const std::vector<WrittenTexels>& less, const std::vector<WrittenTexels>& more,
    const std::string& what)
{
    std::size_t compared = 0;
    auto next = more.begin();
    for (const WrittenTexels& texels : less) {
        next = std::find_if(next, more.end(),
            [&](const WrittenTexels& other) { return other.name == texels.name; });
        ASSERT_NE(next, more.end()) << what << ": no texture " << texels.name;
        // What follows from a difference differs too.
        ASSERT_EQ(difference(texels, *next), "") << what;
        ++next;
        ++compared;
    }
    EXPECT_GT(compared, 4U * kFrames) << what;
}

}  // namespace

Subject::Subject(Scene scene)
    : loaded_(load_onto_device(std::move(scene)))
    , scene_programs_(programs_of_all_tests(), nullptr, nullptr, {})
    , shared_{programs_of_all_tests(), scene_programs_, loaded_.look,
          static_cast<std::uint32_t>(loaded_.gpu->light_count()), true}
{
    shared_.gpu = loaded_.gpu.get();
    shared_.keep_all = true;
    scene_programs_.follow(loaded_.gpu);
}

std::vector<WrittenTexels> Subject::draw(RenderSettings settings, const EffectChoice& effects) const
{
    settings.effects = effects;
    View view(shared_);
    RenderRequest request = linear_request(*loaded_.scene, {40, 24}, settings);
    request.format = PixelFormat::kRgb8;
    const double step = 0.02 * glm::length(request.camera.target - request.camera.position);
    std::vector<WrittenTexels> all;
    for (int frame = 0; frame < kFrames; ++frame) {
        request.camera.position.x += step;
        request.time = kFirstTime + kTimeStep * frame;
        EXPECT_EQ(view.render(request).bad_values.all(), 0U) << "frame " << frame;
        for (const auto& [name, texture] : view.graph().written())
            all.push_back(texels_of("frame " + std::to_string(frame) + " " + name, *texture));
    }
    return all;
}

EffectMask random_superset(EffectMask mask, std::mt19937& random)
{
    std::vector<std::string_view> names = mask.names();
    for (const std::string_view name : EffectMask::general().names())
        if (random() % 2 == 0)
            names.push_back(name);
    return EffectMask::of(names);
}

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

}  // namespace farlight
