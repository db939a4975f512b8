// FakeRenderer: see the header.
#include "tests/stream/fake_renderer.h"

#include "server/scene/scene_file.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

namespace farlight {
namespace {

RendererDescription fake_description()
{
    RendererDescription description;
    description.device = "fake";
    description.gl_renderer = "FakeRenderer";
    description.gl_version = "4.5";
    description.scene_name = "gradient";
    description.scene_file = "gradient.json";
    description.bounds.extend(glm::dvec3(-1));
    description.bounds.extend(glm::dvec3(1));
    description.camera.position = {0, 0, 5};
    description.default_extent = {64, 36};
    description.max_dimension = 4096;
    description.effects = {{"fog", "FX_FOG", "medium 'haze', sigma_t 0.02 1/m"}};
    return description;
}

}  // namespace

Image fake_picture(const RenderRequest& request, std::uint32_t frame_index)
{
    const auto [width, height] = request.extent;
    Image image{request.extent, request.format, {}};
    image.bytes.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)
        * bytes_per_pixel(request.format));
    const double phase = request.camera.position.x + 0.01 * frame_index;
    std::size_t at = 0;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int channel = 0; channel < 3; ++channel) {
                const auto value = static_cast<float>(
                    0.5 + 0.5 * std::sin(phase + 0.05 * x + 0.07 * y + 2.0 * channel));
                if (request.format == PixelFormat::kRgb32f) {
                    std::memcpy(&image.bytes[at], &value, sizeof value);
                    at += sizeof value;
                } else {
                    image.bytes[at++] = static_cast<std::byte>(std::lround(255 * value));
                }
            }
    return image;
}

FakeRenderer::FakeRenderer(std::chrono::milliseconds draw_time)
    : draw_time_(draw_time)
    , description_(fake_description())
    , thread_([this] { run(); })
{
}

FakeRenderer::~FakeRenderer()
{
    {
        const std::lock_guard lock(mutex_);
        stop_ = true;
    }
    woken_.notify_one();
    thread_.join();
}

std::shared_ptr<const RendererDescription> FakeRenderer::description() const
{
    const std::lock_guard lock(state_mutex_);
    return std::make_shared<const RendererDescription>(description_);
}

void FakeRenderer::edit(const nlohmann::json& merge_patch, bool reset)
{
    const std::lock_guard lock(state_mutex_);
    if (merge_patch.contains("bad")) {
        SceneError refused("gradient.json: /bad: found something, expected nothing");
        refused.pointer = "/bad";
        throw refused;
    }
    if (reset)
        description_ = fake_description();
    description_.scene_name = merge_patch.value("name", description_.scene_name);
}

void FakeRenderer::attach(std::shared_ptr<FrameSource> source)
{
    {
        const std::lock_guard lock(state_mutex_);
        attached_.push_back(std::move(source));
    }
    wake();
}

void FakeRenderer::detach(const std::shared_ptr<FrameSource>& source)
{
    const std::scoped_lock lock(mutex_, state_mutex_);
    std::erase(attached_, source);
    std::erase_if(views_, [&](const View& view) { return view.source == source; });
}

void FakeRenderer::wake()
{
    woken_.notify_one();
}

std::string FakeRenderer::failure() const
{
    const std::lock_guard lock(state_mutex_);
    return failure_;
}

void FakeRenderer::fail(const std::string& why)
{
    const std::lock_guard lock(state_mutex_);
    failure_ = why;
}

void FakeRenderer::fail_frames(const std::string& why)
{
    const std::lock_guard lock(state_mutex_);
    frame_error_ = why;
}

std::size_t FakeRenderer::sources() const
{
    const std::lock_guard lock(mutex_);
    return views_.size();
}

void FakeRenderer::run()
{
    std::unique_lock lock(mutex_);
    while (!stop_) {
        take_in_attached();
        if (failure().empty() && draw_round())
            continue;
        // Polls too: a wake() between the check and the wait must not be slept through.
        woken_.wait_for(lock, std::chrono::milliseconds(1));
    }
}

void FakeRenderer::take_in_attached()
{
    const std::lock_guard lock(state_mutex_);
    for (auto& source : attached_)
        views_.push_back({std::move(source), std::nullopt, 0, 0});
    attached_.clear();
}

bool FakeRenderer::draw_round()
{
    bool drew = false;
    for (View& view : views_) {
        const std::optional<RenderRequest> request = view.source->next_request();
        if (!request)
            continue;
        drew = true;
        view.source->frame_done(draw(view, *request));
        ++frames_rendered_;
    }
    return drew;
}

RenderedFrame FakeRenderer::draw(View& view, const RenderRequest& request) const
{
    std::this_thread::sleep_for(draw_time_);
    RenderedFrame frame;
    {
        const std::lock_guard lock(state_mutex_);
        frame.error = frame_error_;
    }
    if (!frame.error.empty())
        return frame;
    frame.effects = EffectMask::of({"fog"});
    frame.by_settings = {{"denoising", "", "setting denoiser = svgf"}};
    frame.constants = {{"BVH_STACK_SIZE", 9}};
    frame.history_reset =
        !view.previous || request.reset_history || view.previous->extent != request.extent;
    const bool same = view.previous && view.previous->camera == request.camera
        && view.previous->settings == request.settings;
    view.frames = frame.history_reset ? 0 : view.frames + 1;
    view.samples = (same && !frame.history_reset ? view.samples : 0)
        + static_cast<std::uint32_t>(request.settings.samples_per_pixel);
    view.previous = request;
    frame.image = fake_picture(request, view.frames);
    frame.pass_times = {{"fake", 1.5}};
    frame.trace_ms = 1.5;
    frame.accumulated_samples = view.samples;
    frame.converged = view.samples >= static_cast<std::uint32_t>(request.settings.still_samples);
    return frame;
}

}  // namespace farlight
