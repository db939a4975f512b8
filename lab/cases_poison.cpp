// Poison: one pixel that holds no light, written by any stage, is left out, and gone a frame
// later.
#include "lab/device_scene.h"
#include "lab/filter_bench.h"
#include "lab/groups.h"
#include "lab/meshes.h"
#include "lab/poison.h"
#include "server/scene/scene.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <random>

namespace farlight::lab {
namespace {

constexpr Extent kPoisonedPicture{24, 16};

/// A closed box whose every wall emits 1 and reflects half: without light sampling every sample of
/// four segments is 1 + 1/2 + 1/4 + 1/8, so the picture is constant, and whoever takes a hole for
/// black is seen.
constexpr double kFurnaceRadiance = 1.875;

Scene furnace_box()
{
    Scene scene = box_of({"wall", glm::vec3(0.5F), glm::vec3(1), true});
    scene.camera = {{0.3, 0.2, 1.2}, {0, 0, -1}, {0, 1, 0}, 60};
    return scene;
}

RenderRequest furnace_request(const Scene& scene)
{
    RenderSettings settings;
    settings.light_sampling = false;
    settings.roulette_depth = 64;
    settings.refine_crossover = 1;
    return linear_request(scene, kPoisonedPicture, settings);
}

/// How far a picture is off the furnace's constant, relative; infinite where it holds no light.
double off_constant(const Image& image, bool without_poisoned)
{
    double most = 0;
    for (int y = 0; y < kPoisonedPicture.height; ++y)
        for (int x = 0; x < kPoisonedPicture.width; ++x)
            for (int c = 0; c < 3; ++c) {
                if (without_poisoned && x == kPoisonedX && y == kPoisonedY)
                    continue;
                most = farther(most, std::abs(pixel(image, x, y)[c] / kFurnaceRadiance - 1));
            }
    return most;
}

struct PoisonSeen {
    double others = 0;  ///< How far off in the poisoned frame, but for the pixel itself.
    double later = 0;  ///< How far off a frame later, with it.
    int itself =
        0;  ///< Poisoned pixels shown as less or more than what is around them may make them.
    int miscounted =
        0;  ///< Poisoned frames that were not counted, or were though no light was bad.
    int counted_later = 0;
};

void look_at(PoisonSeen& seen, View& view, RenderRequest& request, const PoisonedStage& stage,
    std::uint32_t code)
{
    request.camera.position.x += 0.01;
    request.settings.seed = code;
    const RenderedFrame poisoned = view.render(request);
    seen.others = farther(seen.others, off_constant(poisoned.image, true));
    const glm::vec3 itself = pixel(poisoned.image, kPoisonedX, kPoisonedY);
    const double least = stage.filled ? (1 - 1e-5) * kFurnaceRadiance : 0;
    seen.itself += itself.x >= least && itself.x <= (1 + 1e-5) * kFurnaceRadiance ? 0 : 1;
    seen.miscounted += stage.counted == (poisoned.bad_values.all() > 0) ? 0 : 1;
    request.camera.position.x -= 0.01;
    request.settings.seed = 0;
    request.reset_history = false;
    const RenderedFrame later = view.render(request);
    seen.later = farther(seen.later, off_constant(later.image, false));
    seen.counted_later += later.bad_values.all() == 0 ? 0 : 1;
}

/// The furnace has no specular and no scattered light.
bool is_of_an_effect(const PoisonedStage& stage)
{
    return stage.only_with != nullptr && std::string_view(stage.only_with).starts_with("FX_");
}

/// Every stage, every kind of poison, with a history and without, in a picture that refines too.
void poisoned_stages(Findings& findings, Length /*length*/)
{
    const PoisonedShaders poisoned;
    const DeviceScene scene(furnace_box());
    PoisonSeen seen;
    int frames = 0;
    for (const bool with_history : {true, false})
        for (std::size_t stage = 0; stage < PoisonedShaders::stages().size(); ++stage) {
            if (is_of_an_effect(PoisonedShaders::stages()[stage]))
                continue;
            View view(scene.shared);
            RenderRequest request = furnace_request(scene.scene);
            for (int i = 0; i < 2 && with_history; ++i)
                view.render(request);
            for (std::uint32_t kind = 0; kind < kPoisonKinds; ++kind, ++frames) {
                request.reset_history = !with_history;
                look_at(seen, view, request, PoisonedShaders::stages()[stage],
                    PoisonedShaders::code(stage, kind));
            }
        }
    findings.at_most("deviation of other pixels from a constant picture, " + std::to_string(frames)
            + " poisoned frames",
        seen.others, 1e-5);
    findings.at_most("deviation a frame later", seen.later, 1e-5);
    findings.none(
        "poisoned pixels shown as something else than what is around them or black", seen.itself);
    findings.none("poisoned frames not counted", seen.miscounted);
    findings.none("frames that count something a frame later", seen.counted_later);
}

/// Pixels of `a` and `b` that differ in some bit, but for the poisoned one.
int differing(const std::vector<glm::vec4>& a, const std::vector<glm::vec4>& b, Extent extent)
{
    const auto poisoned =
        static_cast<std::size_t>(kPoisonedY) * static_cast<std::size_t>(extent.width) + kPoisonedX;
    int count = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        for (int c = 0; c < 4; ++c)
            count += i != poisoned
                    && std::bit_cast<std::uint32_t>(a[i][c])
                        != std::bit_cast<std::uint32_t>(b[i][c])
                ? 1
                : 0;
    return count;
}

/// Light as noisy as that of one sample a pixel.
void fill_noisily(PassBench& bench, const std::string& name, bool with_noise)
{
    std::mt19937 random(7);
    std::exponential_distribution<float> value(1);
    for (int y = 0; y < kPoisonedPicture.height; ++y)
        for (int x = 0; x < kPoisonedPicture.width; ++x) {
            const float variance = value(random);
            bench.set_pixel(name, x, y,
                {value(random), value(random), value(random),
                    with_noise ? noise_word(variance) : variance});
        }
}

/// One pass over noisy light, and what it makes of pixel (kPoisonedX, kPoisonedY): left out as a
/// miss, or poisoned in `texture`.
struct LeftOut {
    const char* pass;
    const char* texture;
    const char* missing;  ///< Where a miss says so.
};

std::vector<glm::vec4> filtered_without(const LeftOut& out, const glm::vec4* poison)
{
    const std::unique_ptr<PassBench> bench = filter_bench(out.pass, kPoisonedPicture);
    for (const char* light : {"in_light", "in_light_2"})
        fill_noisily(*bench, light, true);
    const std::string pass = out.pass;
    if (pass == "variance")
        fill_noisily(*bench, "in_moments", false);
    if (pass == "temporal") {
        for (const char* light : {"prev_light", "prev_light_2"})
            fill_noisily(*bench, light, true);
        fill_noisily(*bench, "prev_moments", false);
        bench->fill("prev_length", GL_RGBA32F, glm::vec4(3));
        bench->fill("in_motion", GL_RGBA32F, glm::vec4(0.3F, -0.4F, 0, 1));
    }
    if (poison == nullptr)
        bench->set_bits(out.missing, kPoisonedX, kPoisonedY, glm::uvec4(0));
    else
        bench->set_pixel(out.texture, kPoisonedX, kPoisonedY, *poison);
    bench->run();
    return bench->read("out_light");
}

void left_out_as_a_miss(Findings& findings, Length /*length*/)
{
    static constexpr LeftOut kPlaces[] = {
        {"atrous", "in_light", "in_surface"},
        {"atrous", "in_light_2", "in_surface"},
        {"variance", "in_moments", "in_surface"},
        {"temporal", "prev_light", "prev_identity"},
        {"temporal", "prev_light_2", "prev_identity"},
        {"temporal", "prev_moments", "prev_identity"},
        {"temporal", "prev_length", "prev_identity"},
    };
    int differ = 0;
    for (const LeftOut& place : kPlaces) {
        const std::vector<glm::vec4> expected = filtered_without(place, nullptr);
        for (std::uint32_t kind = 0; kind < kPoisonKinds; ++kind) {
            const float value = std::bit_cast<float>(kPoisonBits[kind]);
            // An endless history is as long as histories may be.
            if (std::isinf(value) && value > 0 && std::string_view(place.texture) == "prev_length")
                continue;
            const glm::vec4 poison(value);
            differ += differing(filtered_without(place, &poison), expected, kPoisonedPicture);
        }
    }
    findings.none("values that differ from those beside a miss", differ);
}

/// A picture that rests: the mean is of the frames that were light.
void poisoned_mean(Findings& findings, Length /*length*/)
{
    constexpr Extent kOne{1, 1};
    double most = 0;
    for (std::uint32_t kind = 0; kind < kPoisonKinds; ++kind)
        for (const int when : {1, 2, 5}) {
            PassBench bench("accumulate/accumulate.comp", {}, kOne);
            for (const char* name :
                {"in_radiance", "prev_mean", "prev_variance", "out_mean", "out_variance"})
                bench.fill(name, GL_RGBA32F, glm::vec4(0));
            for (int i = 1; i <= when + 1; ++i) {
                bench.set_pixel("in_radiance", 0, 0,
                    glm::vec4(i == when ? std::bit_cast<float>(kPoisonBits[kind]) : 0.7F));
                bench.constant("frame_count", i);
                bench.run();
                bench.swap("prev_mean", "out_mean");
                bench.swap("prev_variance", "out_variance");
            }
            const glm::vec4 mean = bench.read("prev_mean")[0];
            for (int c = 0; c < 3; ++c) {
                most = farther(most, std::abs(static_cast<double>(mean[c]) / 0.7F - 1));
            }
            most = std::isfinite(mean.w) ? most : INFINITY;
        }
    findings.at_most("deviation of the mean a frame later", most, 1e-6);
}

constexpr Case kPoisonCases[] = {
    {"59", "poison", "a poisoned pixel in any stage", Layer::kPicture,
        "NaN, infinity or less than nothing in one pixel of any stage changes no other pixel of a "
        "constant picture, is counted, and is gone a frame later.",
        poisoned_stages},
    {"59b", "poison", "poison is left out", Layer::kFunction,
        "Beside a poisoned pixel the filter's passes give the bits that they give beside a miss.",
        left_out_as_a_miss},
    {"59c", "poison", "a poisoned frame in a mean", Layer::kFunction,
        "A mean leaves out what is no light, the first frame included.", poisoned_mean},
};

constexpr Guard kPoisonGuards[] = {
    {"known_tap", "59 59b", "svgf/atrous.comp",
        "const bool comparable = geometry >= 0.0 && light_q.known;",
        "const bool comparable = geometry >= 0.0;"},
    {"known_variance", "59b", "svgf/atrous.comp",
        "inside_frame(q) && takes_part(guide_at(q)) && light.known;",
        "inside_frame(q) && takes_part(guide_at(q));"},
    {"known_history", "59 59b 59d", "svgf/temporal.comp",
        "const bool known = is_light(first) && is_light(second) && is_light(moments);",
        "const bool known = true;"},
    {"known_sample", "59", "svgf/temporal.comp",
        "const bool known = is_light(first) && is_light(second);", "const bool known = true;"},
    {"unknown_sample", "59", "svgf/temporal.comp", "first = second = unknown_light();",
        "first = second = vec3(0.0);"},
    {"known_moments", "59b", "svgf/variance.comp", "geometry >= 0.0 && is_light(moments)",
        "geometry >= 0.0"},
    {"unknown_is_negative_zero", "59", "lib/unknown.glsl",
        "return vec3(uintBitsToFloat(0x80000000u));", "return vec3(0.0);"},
    {"known_frame", "59c", "accumulate/accumulate.comp",
        "if (known) {  // else there is no sample, and the others stand", "{"},
    {"known_mean", "59c", "accumulate/accumulate.comp", "if (frame_count > 1 && is_light(old))",
        "if (frame_count > 1)"},
};

}  // namespace

Group poison_group()
{
    return {kPoisonCases, kPoisonGuards};
}

}  // namespace farlight::lab
