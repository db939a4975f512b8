// Counting frames, filling the constants, running the graph, collecting the result.
#include "server/render/view.h"

#include "server/render/camera.h"
#include "server/render/frame.h"

#include <chrono>

namespace farlight {
namespace {

template <typename T> std::span<const std::byte> object_bytes(const T& object)
{
    return std::as_bytes(std::span<const T, 1>(&object, 1));
}

/// The digits of n in base `base` mirrored at the point, in [0, 1).
/// Source: Halton 1960, "On the efficiency of certain quasi-random sequences of points".
float radical_inverse(int n, int base)
{
    double value = 0;
    for (double digit = 1.0 / base; n > 0; n /= base, digit /= base)
        value += digit * (n % base);
    return static_cast<float>(value);
}

/// Where in its pixel frame `index` of a mean looks [px from the middle]: first the middle itself,
/// then evenly all over it.
glm::vec2 jitter_of(int index)
{
    const glm::vec2 point(radical_inverse(index, 2), radical_inverse(index, 3));
    return glm::fract(point + 0.5F) - 0.5F;
}

}  // namespace

EffectMask effects_of(const FramePlan& plan)
{
    std::vector<ActiveEffect> compiled = effects_by_settings(plan);
    std::erase_if(compiled, [](const ActiveEffect& effect) { return effect.macro.empty(); });
    return mask_of(compiled);
}

View::View(const SharedScene& scene)
    : scene_(scene)
    , graph_(scene.programs, scene.software, scene.strict)
    , constants_("frame constants", object_bytes(shared::FrameConstants{}))
    , counters_("counters", object_bytes(std::uint32_t{0}))
{
    if (scene.keep_all)
        graph_.keep_all();
}

/// Brings the counts of frames up to date with what changed since the last request.
void View::follow(const RenderRequest& request)
{
    const RenderSettings& s = request.settings;
    const SampleKey key{request.camera, request.extent, s.samples_per_pixel, s.max_depth,
        s.roulette_depth, s.light_sampling, s.antialiasing, s.seed, scene_.version,
        moment_shown(request.time)};
    if (request.reset_history || request.extent != key_.extent)
        has_history_ = false;
    if (!has_history_)
        samples_ = 0;
    const bool same = has_history_ && key == key_;
    const bool averages = request.refine || s.denoiser == Denoiser::kAccumulate;
    still_frames_ = same ? still_frames_ + 1 : 1;
    mean_frames_ = averages ? (same ? mean_frames_ + 1 : 1) : 0;
    key_ = key;
}

/// The scene as it is in this frame and was in the last; the milliseconds that took, 0 where
/// nothing has moved.
double View::pose(double time)
{
    const auto begun = std::chrono::steady_clock::now();
    const bool posed = moves() && scene_.gpu->pose(time, has_history_ ? prev_time_ : time);
    prev_time_ = time;
    return posed
        ? std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begun)
              .count()
        : 0;
}

void View::upload_constants(const RenderRequest& request)
{
    shared::FrameConstants constants{};
    constants.camera = camera_constants(request.camera, request.extent);
    constants.prev_camera =
        has_history_ ? camera_constants(prev_camera_, request.extent) : constants.camera;
    constants.background = scene_.look.background;
    if (moves())
        constants.background *= scene_.gpu->background_factor();
    constants.light_count = scene_.light_count;
    constants.first_sample = samples_;
    constants.extent = {request.extent.width, request.extent.height};
    constants.seed = request.settings.seed;
    constants_.update(object_bytes(constants));
    counters_.update(object_bytes(std::uint32_t{0}));
}

/// What the scene and the camera's optics give to the stages of this frame.
FrameInputs View::inputs_of(const RenderRequest& request) const
{
    static const SceneInputs no_scene;  // for what does not depend on the programs
    FrameInputs inputs{no_scene, scene_.look.fog};
    const Lens& lens = scene_.look.lens;
    const double target = glm::length(request.camera.target - request.camera.position);
    const double focus = lens.focus_distance > 0 ? lens.focus_distance : target;
    inputs.holes = scene_.look.holes;
    inputs.lens_radius = static_cast<float>(lens.radius);
    inputs.focus_distance = focus > 0 ? static_cast<float>(focus) : 1.0F;
    if (request.settings.antialiasing && mean_frames_ > 0)
        inputs.pixel_jitter = jitter_of(mean_frames_ - 1);
    return inputs;
}

void View::begin(const RenderRequest& request)
{
    follow(request);
    const double pose_ms = pose(moment_shown(request.time));
    upload_constants(request);
    if (!has_history_)
        graph_.forget_histories();

    FramePlan plan;
    plan.settings = request.settings;
    plan.mean_frames = std::max(mean_frames_, 1);
    plan.refine = request.refine;
    plan.scene_radius = scene_.look.radius;
    plan.scatters = scene_.look.scatters;
    plan.linear_output = request.format == PixelFormat::kRgb32f;
    const FrameInputs values = inputs_of(request);
    const DeclareFrame declare = [plan, values](FrameGraph& graph, const SceneInputs& inputs) {
        build_frame(graph, values.with_scene(inputs), plan);
    };
    const Variant& variant =
        scene_.scene_programs.choose(plan.settings.effects, effects_of(plan), declare);
    graph_.begin_frame(
        request.extent, {{"frame_block", constants_.id()}, {"counter_block", counters_.id()}});
    const TextureHandle result = build_frame(graph_, values.with_scene(variant.inputs), plan);
    graph_.keep(result);
    graph_.execute();
    readback_.begin(graph_.texture(result));

    frame_ = RenderedFrame{};
    if (pose_ms > 0)
        frame_.pass_times.push_back({"pose", pose_ms});
    frame_.trace_ms = pose_ms;
    frame_.time = moment_shown(request.time);
    frame_.moves = moves() && frame_.time >= request.time;
    frame_.history_reset = !has_history_;
    frame_.effects = variant.mask;
    frame_.by_settings = effects_by_settings(plan);
    frame_.constants = variant.constants();
    frame_.compile_ms = scene_.scene_programs.last_compile_ms();
    const int averaged = mean_frames_ > 0 ? mean_frames_ : still_frames_;
    frame_.accumulated_samples = static_cast<std::uint32_t>(averaged)
        * static_cast<std::uint32_t>(request.settings.samples_per_pixel);
    frame_.converged =
        frame_.accumulated_samples >= static_cast<std::uint32_t>(request.settings.still_samples);
    prev_camera_ = request.camera;
    has_history_ = true;
    samples_ += static_cast<std::uint32_t>(request.settings.samples_per_pixel);
}

RenderedFrame View::finish()
{
    frame_.image = readback_.finish();
    for (TextureAllocation& held : graph_.allocations())
        frame_.memory.emplace_back(std::move(held.name), held.bytes);
    glGetNamedBufferSubData(
        counters_.id(), 0, sizeof frame_.nonfinite_count, &frame_.nonfinite_count);
    for (const TimedPass& pass : graph_.collect_times()) {
        const bool traces = pass.name == "gbuffer" || pass.name.starts_with("path_trace");
        frame_.pass_times.push_back({pass.name, pass.milliseconds});
        (traces ? frame_.trace_ms : frame_.denoise_ms) += pass.milliseconds;
    }
    return std::move(frame_);
}

}  // namespace farlight
