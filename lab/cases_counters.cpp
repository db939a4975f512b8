// Counters: a bad value is counted by the stage that comes to it, under its kind and nowhere else,
// before anything cleans it; the view shows where.
#include "lab/device_scene.h"
#include "lab/groups.h"
#include "lab/injections.h"
#include "lab/meshes.h"
#include "server/scene/scene.h"

#include <cmath>

namespace farlight::lab {
namespace {

constexpr Extent kCounted{24, 16};

/// A closed box of lamps filled with thin fog: paths meet every stage of theirs at every pixel.
Scene foggy_box()
{
    Scene scene = box_of({"wall", glm::vec3(0.5F), glm::vec3(1), true});
    scene.camera = {{0.3, 0.2, 1.2}, {0, 0, -1}, {0, 1, 0}, 60};
    scene.medium.sigma_s = glm::vec3(0.05F);
    return scene;
}

RenderRequest counted_request(const Scene& scene)
{
    RenderSettings settings;
    settings.roulette_depth = 64;
    settings.atrous_iterations = 8;
    settings.svgf_spatial_frames = 64;
    settings.view = DebugView::kBadValues;
    return linear_request(scene, kCounted, settings);
}

struct Counted {
    int missed = 0;  ///< Injections that their stage did not count once.
    int elsewhere = 0;  ///< Pixels counted by other stages or as other kinds.
    int not_painted = 0;
    int painted_elsewhere = 0;
    int before = 0;  ///< Counted before anything was injected.
    int injected = 0;
    std::string first;  ///< That was not counted as it should.
};

/// Numbers: bits of kinds. Colours: the kind's own, beside grey; the pixels around it are tinted.
void look_at_picture(Counted& seen, const RenderedFrame& frame, BadKind kind, bool on_screen)
{
    static constexpr std::uint32_t kColors[] = {
        NAN_COLOR, INFINITE_COLOR, NEGATIVE_COLOR, CLAMPED_COLOR};
    const auto shown = [&](int x, int y) -> std::uint32_t {
        if (!on_screen)
            return static_cast<std::uint32_t>(pixel(frame.image, x, y).x);
        const std::size_t at = 3
            * (static_cast<std::size_t>(y) * static_cast<std::size_t>(kCounted.width)
                + static_cast<std::size_t>(x));
        const auto byte = [&](std::size_t i) {
            return std::to_integer<std::uint32_t>(frame.image.bytes[at + i]);
        };
        const std::uint32_t color = byte(0) << 16U | byte(1) << 8U | byte(2);
        return byte(0) == byte(1) && byte(1) == byte(2) ? 0 : color;
    };
    const auto k = static_cast<std::size_t>(kind);
    const std::uint32_t expected = on_screen ? kColors[k] : 1U << k;
    const int halo = on_screen ? 2 : 0;
    for (int y = 0; y < kCounted.height; ++y)
        for (int x = 0; x < kCounted.width; ++x) {
            if (x == kInjectedX && y == kInjectedY)
                seen.not_painted += shown(x, y) == expected ? 0 : 1;
            else if (std::abs(x - kInjectedX) > halo || std::abs(y - kInjectedY) > halo)
                seen.painted_elsewhere += shown(x, y) == 0 ? 0 : 1;
        }
}

void inject(Counted& seen, View& view, RenderRequest& request, std::size_t row, BadKind kind)
{
    const Injection& injection = InjectingShaders::all()[row];
    request.settings.seed = InjectingShaders::seed(row, kind);
    for (int i = 1; i < injection.frames; ++i)
        view.render(request);
    const RenderedFrame frame = view.render(request);
    const CountedStage& stage = kCountedStages[injection.stage];
    const std::uint32_t counted = frame.bad_values.of(stage, kind);
    seen.missed += counted == 1 ? 0 : 1;
    seen.elsewhere += static_cast<int>(frame.bad_values.all() - counted);
    if (seen.first.empty() && (counted != 1 || frame.bad_values.all() != counted))
        seen.first = ": first " + std::string(kBadKinds[static_cast<std::size_t>(kind)].name)
            + " by " + std::string(stage.name) + ", row " + std::to_string(row);
    look_at_picture(seen, frame, kind, injection.on_screen);
    ++seen.injected;
}

void counted_where_it_is_made(Findings& findings, Length /*length*/)
{
    const InjectingShaders injecting;
    const DeviceScene scene(foggy_box());
    Counted seen;
    for (std::size_t row = 0; row < InjectingShaders::all().size(); ++row) {
        const Injection& injection = InjectingShaders::all()[row];
        View view(scene.shared);
        RenderRequest request = counted_request(scene.scene);
        request.refine = injection.refines;
        if (injection.on_screen)
            request.format = PixelFormat::kRgb8;
        seen.before += static_cast<int>(view.render(request).bad_values.all());
        for (const BadKindRow& kind : kBadKinds)
            if (injection.kinds.find(kind.name) != std::string_view::npos)
                inject(seen, view, request, row, kind.kind);
    }
    findings.none("values that their stage did not count once, of " + std::to_string(seen.injected)
            + seen.first,
        seen.missed);
    findings.none("pixels counted elsewhere or as something else", seen.elsewhere);
    findings.none("pixels counted before anything was injected", seen.before);
    findings.none("bad pixels that the view does not show as what they are", seen.not_painted);
    findings.none("others that it shows", seen.painted_elsewhere);
}

constexpr Case kCountersCases[] = {
    {"59e", "counters", "bad values by stage", Layer::kPicture,
        "NaN, infinity, less than nothing and what is cut at a limit are counted once, by the "
        "stage "
        "that comes to them and no other, and the view shows them where they are.",
        counted_where_it_is_made},
};

constexpr Guard kCountersGuards[] = {
    {"counts_at_all", "59e", "lib/counters.glsl",
        "atomicAdd(bad_value_counts[stage * KIND_COUNT + bit % KIND_COUNT], 1u);", ""},
    {"counts_by_stage", "59e", "lib/counters.glsl",
        "const uint stage = first + ((bit / KIND_COUNT - first) & 7u);",
        "const uint stage = first + bit / KIND_COUNT;"},
    {"counts_the_cause", "59e", "lib/counters.glsl", "note(stage, noted == 0u ? kinds : 0u);",
        "note(stage, kinds);"},
    {"counts_nan", "59e", "lib/counters.glsl", "magnitude > 0xff000000u ? IS_NAN",
        "false ? IS_NAN"},
    {"counts_negative", "59e", "lib/counters.glsl", "least < 0.0              ? IS_NEGATIVE",
        "false ? IS_NEGATIVE"},
    {"paints", "59e", "lib/counters.glsl",
        "atomicOr(kinds_of_pixels[px.y * int(frame.extent.x) + px.x], kinds);", "kinds = 0u;"},
    {"paints_a_color_each", "59e", "debug_view/bad_values.comp", "COLORS[findLSB(kinds)]",
        "COLORS[0]"},
    {"counts_primary_ray", "59e", "gbuffer/gbuffer.comp", "note(STAGE_PRIMARY_RAY,",
        "note(STAGE_GBUFFER,"},
    {"counts_hit", "59e", "path_trace/path_trace.comp",
        "note_cause(STAGE_HIT, alive ? kinds_of_hit(ray, s, met, way) : 0u);",
        "note_cause(STAGE_HIT, 0u);"},
    {"counts_throughput", "59e", "path_trace/path_trace.comp",
        "note_cause(STAGE_THROUGHPUT, alive ? kinds_in(first ? weight : next, "
        "vec3(bounce.weight.pdf)) : 0u);",
        ""},
    {"counts_history", "59e", "svgf/temporal.comp", "note(STAGE_HISTORY, kinds);", ""},
    {"counts_variance", "59e", "svgf/variance.comp", "note(STAGE_VARIANCE, kinds);", ""},
    {"counts_filtered", "59e", "svgf/signal.glsl", "note(stage, light.known ? kinds : 0u);", ""},
    {"counts_cut_variance", "59e", "svgf/signal.glsl",
        "note(stage, light.known && max(variance.x, variance.y) > MOST_VARIANCE ? IS_CLAMPED : "
        "0u);",
        ""},
    {"counts_composite", "59e", "composite/composite.comp",
        "radiance = counted_light(STAGE_COMPOSITE,", "radiance = ("},
    {"counts_on_screen", "59e", "tonemap/tonemap.comp", "note(STAGE_TONEMAP, kinds_in(radiance));",
        ""},
};

}  // namespace

Group counters_group()
{
    return {kCountersCases, kCountersGuards};
}

}  // namespace farlight::lab
