// Counting frames, filling the constants, running the graph, collecting the result.
#include "server/render/view.h"

#include "server/host_guard.h"
#include "server/passes/error_estimate.h"
#include "server/render/camera.h"
#include "server/render/frame.h"
#include "server/scene/scene_origin.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace farlight {
namespace {

const HostGuard cuts_forget("cuts_forget");
const HostGuard sizes_forget("sizes_forget");
const HostGuard moved_since_last_frame("moved_since_last_frame");

template <typename T> std::span<const std::byte> object_bytes(const T& object)
{
    return std::as_bytes(std::span<const T, 1>(&object, 1));
}

/// A map for the eye is not worth drawing for every frame that is watched.
constexpr std::chrono::milliseconds kFlipPeriod{500};

/// The digits of n in base `base` mirrored at the point, in [0, 1).
/// Source: Halton 1960, "On the efficiency of certain quasi-random sequences of points".
float radical_inverse(int n, int base)
{
    double value = 0;
    for (double digit = 1.0 / base; n > 0; n /= base, digit /= base)
        value += digit * (n % base);
    return static_cast<float>(value);
}

/// What a denoised picture depends on besides the scene and where it is seen from.
std::vector<double> filter_key(const RenderSettings& settings, Extent drawn)
{
    std::vector<double> key{static_cast<double>(drawn.width), static_cast<double>(drawn.height)};
    RenderSettings::each_picture_field(settings,
        [&](const auto& member, auto&&...) { key.push_back(static_cast<double>(member)); });
    return key;
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

Extent scaled_extent(Extent full, float scale)
{
    const auto scaled = [&](int length) {
        return std::max(
            static_cast<int>(std::lround(static_cast<double>(scale) * static_cast<double>(length))),
            1);
    };
    return {scaled(full.width), scaled(full.height)};
}

View::View(const SharedScene& scene)
    : scene_(scene)
    , graph_(scene.programs, scene.software, scene.strict)
    , constants_("frame constants", object_bytes(shared::FrameConstants{}))
    , counters_("counters", object_bytes(BadValues::Counts{}))
    , painted_("painted", {})
    , tiles_("tile sums", {})
{
    if (scene.keep_all)
        graph_.keep_all();
}

/// Brings the counts of frames up to date with what changed since the last request.
void View::follow(const RenderRequest& request)
{
    const RenderSettings& s = request.settings;
    const Extent drawn = scaled_extent(request.extent, s.resolution_scale);
    const SampleKey key{request.camera, drawn, s.samples_per_pixel, s.max_depth, s.roulette_depth,
        s.light_sampling, s.antialiasing, s.seed, scene_.version, moment_shown(request.time)};
    if ((cuts_forget && request.reset_history) || (sizes_forget && request.extent != full_extent_))
        has_history_ = false;
    full_extent_ = request.extent;
    counts_.begin({.has_history = has_history_,
        .same_samples = key == key_,
        .averages = request.refine || s.denoiser == Denoiser::kAccumulate});
    key_ = key;
    std::vector<double> filter = filter_key(s, drawn);
    new_filter_ = filter != filter_;
    filter_ = std::move(filter);
}

/// The scene's own, but for a wide one.
glm::dvec3 View::origin_of_frame(const CameraPose& camera) const
{
    if (scene_.gpu == nullptr || !scene_.gpu->wide())
        return glm::dvec3(0);
    return origin_near(
        camera.position - scene_.look.origin, static_cast<double>(scene_.look.radius));
}

/// The scene as it is in this frame and was in the last; the milliseconds that took, 0 where
/// nothing has moved.
double View::pose(double time)
{
    const auto begun = std::chrono::steady_clock::now();
    const bool posed =
        scene_.gpu != nullptr && scene_.gpu->pose(time, has_history_ ? prev_time_ : time, origin_);
    if (moved_since_last_frame)
        prev_time_ = time;
    return posed
        ? std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begun)
              .count()
        : 0;
}

void View::upload_constants(const RenderRequest& request)
{
    shared::FrameConstants constants{};
    const glm::dvec3 origin = scene_.look.origin + origin_;
    constants.camera = camera_constants(request.camera, key_.extent, origin);
    // From its pose: another scene, with another origin, may have taken the place of the last.
    constants.prev_camera =
        has_history_ ? camera_constants(prev_camera_, prev_extent_, origin) : constants.camera;
    prev_camera_ = request.camera;
    prev_extent_ = key_.extent;
    constants.background = scene_.look.background;
    if (moves())
        constants.background *= scene_.gpu->background_factor();
    constants.light_count = scene_.light_count;
    constants.first_sample = counts_.first_sample();
    if (scene_.gpu != nullptr) {
        const Insides::Filling around = scene_.gpu->filling_at(request.camera.position - origin);
        constants.camera_inside = around.entered;
        constants.camera_absorption = around.absorption;
    }
    constants.extent = {key_.extent.width, key_.extent.height};
    constants.frame_index = counts_.frame_index();
    constants.seed = request.settings.seed;
    constants_.update(object_bytes(constants));
    counters_.update(object_bytes(BadValues::Counts{}));
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
    inputs.fog.center = glm::vec3(glm::dvec3(scene_.look.fog.center) - origin_);
    inputs.lens_radius = static_cast<float>(lens.radius);
    inputs.focus_distance = focus > 0 ? static_cast<float>(focus) : 1.0F;
    if (request.settings.antialiasing && counts_.mean() > 0)
        inputs.pixel_jitter = jitter_of(counts_.mean() - 1);
    return inputs;
}

std::uint32_t View::accumulated_samples(const RenderSettings& settings) const
{
    return counts_.samples(settings.samples_per_pixel);
}

bool View::converged(const RenderSettings& settings) const
{
    return accumulated_samples(settings) >= static_cast<std::uint32_t>(settings.still_samples);
}

/// Whether the FLIP map of before will do: of the same picture, which is not final yet, and younger
/// than kFlipPeriod.
bool View::keeps_flip(const RenderRequest& request)
{
    const auto now = std::chrono::steady_clock::now();
    const bool keeps = request.live && counts_.mean() > 1 && !converged(request.settings)
        && now - flip_drawn_ < kFlipPeriod;
    if (!keeps)
        flip_drawn_ = now;
    return keeps;
}

FramePlan View::plan_of(const RenderRequest& request)
{
    FramePlan plan;
    plan.settings = request.settings;
    plan.keeps_flip = request.settings.view == DebugView::kFlip && keeps_flip(request);
    plan.mean_frames = std::max(counts_.mean(), 1);
    plan.frame_index = counts_.frame_index();
    plan.refine = request.refine;
    plan.scene_radius = scene_.look.radius;
    plan.origin = scene_.look.origin + origin_;
    plan.scatters = scene_.look.scatters;
    plan.linear_output = request.format == PixelFormat::kRgb32f;
    const bool specular = scene_.scene_programs.scene_mask().has("specular_signal");
    plan.looks = schedule_.next(plan, new_filter_, specular);
    return plan;
}

void View::make_room_for_tiles(Extent tiles)
{
    const std::size_t bytes = sizeof(glm::vec4) * kTileSumParts
        * static_cast<std::size_t>(tiles.width) * static_cast<std::size_t>(tiles.height);
    if (tiles_.size() < bytes)
        tiles_ = Buffer("tile sums", std::vector<std::byte>(bytes));
}

/// A word a pixel, 0 at first; without `paints` no room is taken.
void View::clear_painted(bool paints)
{
    const auto pixels =
        static_cast<std::size_t>(key_.extent.width) * static_cast<std::size_t>(key_.extent.height);
    if (paints || paints_)
        painted_ =
            Buffer("painted", std::vector<std::byte>(paints ? pixels * sizeof(std::uint32_t) : 0));
    paints_ = paints;
}

/// Of the last frame, which must be done.
std::vector<glm::vec4> View::tile_sums(TileSums part) const
{
    const Extent tiles = tiles_of(key_.extent);
    std::vector<glm::vec4> sums(
        static_cast<std::size_t>(tiles.width) * static_cast<std::size_t>(tiles.height));
    glGetNamedBufferSubData(tiles_.id(),
        static_cast<GLintptr>(sizeof(glm::vec4)) * tile_offset(part, key_.extent),
        static_cast<GLsizeiptr>(sums.size() * sizeof(glm::vec4)), sums.data());
    return sums;
}

void View::begin(const RenderRequest& request)
{
    follow(request);
    origin_ = origin_of_frame(request.camera);
    const double pose_ms = pose(moment_shown(request.time));
    upload_constants(request);
    if (!has_history_)
        graph_.forget_histories();

    plan_ = plan_of(request);
    const FramePlan& plan = plan_;
    make_room_for_tiles(tiles_of(key_.extent));
    clear_painted(plan.settings.view == DebugView::kBadValues);
    const FrameInputs values = inputs_of(request);
    const DeclareFrame declare = [plan, values](FrameGraph& graph, const SceneInputs& inputs) {
        build_frame(graph, values.with_scene(inputs), plan);
    };
    const Variant& variant =
        scene_.scene_programs.choose(plan.settings.effects, effects_of(plan), declare);
    graph_.begin_frame(key_.extent,
        {{"frame_block", constants_.id()}, {"counter_block", counters_.id()},
            {"tile_block", tiles_.id()}, {"painted_block", painted_.id()}});
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
    frame_.accumulated_samples = accumulated_samples(request.settings);
    frame_.converged = converged(request.settings);
    has_history_ = true;
    counts_.end(request.settings.samples_per_pixel);
}

RenderedFrame View::finish()
{
    frame_.image = readback_.finish();
    frame_.image.full_extent = full_extent_;
    for (TextureAllocation& held : graph_.allocations())
        frame_.memory.emplace_back(std::move(held.name), held.bytes);
    BadValues::Counts& counts = frame_.bad_values.counts();
    glGetNamedBufferSubData(counters_.id(), 0, sizeof counts, counts.data());
    const ErrorLooks& looks = plan_.looks;
    frame_.errors = errors_.add({
        .starts_anew = frame_.history_reset || new_filter_,
        .predicted = looks.predicts ? tile_sums(TileSums::kPredicted) : std::vector<glm::vec4>{},
        .second_of_pair = looks.second_of_pair,
        .denoised = is_denoised(plan_) && plan_.settings.error_estimate,
        .measured = looks.measures ? tile_sums(TileSums::kMeasured) : std::vector<glm::vec4>{},
        .extent = key_.extent,
        .samples_per_pixel = plan_.settings.samples_per_pixel,
        .mean_frames = counts_.mean(),
        .mean_weight = mean_weight(plan_),
        .reference_frames = looks.measured_against,
    });
    frame_.frame_ms = frame_.trace_ms + graph_.frame_time();
    for (const TimedPass& pass : graph_.collect_times()) {
        const bool traces = pass.name == "gbuffer" || pass.name.starts_with("path_trace");
        frame_.pass_times.push_back({pass.name, pass.milliseconds});
        (traces ? frame_.trace_ms : frame_.denoise_ms) += pass.milliseconds;
    }
    return std::move(frame_);
}

}  // namespace farlight
