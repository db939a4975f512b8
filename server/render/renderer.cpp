// The render thread: owns the context, asks sources for work, draws, hands pixels back.
#include "server/render/renderer.h"

#include "server/gl/context.h"
#include "server/gl/gl_error.h"
#include "server/render/start_size.h"
#include "server/render/view.h"
#include "server/scene/neutral.h"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <future>
#include <mutex>
#include <spdlog/spdlog.h>
#include <thread>
#include <unistd.h>

namespace farlight {
namespace {

struct Client {
    std::shared_ptr<FrameSource> source;
    std::unique_ptr<View> view;  ///< Made at the first request, on the render thread.
    std::size_t view_bytes = 0;  ///< Most that the view may hold.
    bool in_flight = false;
    bool leaving = false;
};

std::size_t memory_for_views(const RendererOptions& options, bool software)
{
    if (options.view_memory != 0)
        return options.view_memory;
    const auto physical = static_cast<std::size_t>(sysconf(_SC_PHYS_PAGES))
        * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
    return software ? physical / 2 : std::size_t{8} << 30;
}

/// Longest a frame may be [path segments]: about a second of a fast GPU, minutes of llvmpipe. One
/// client's frame is drawn in one go, so this also bounds how long the others wait, and keeps clear
/// of drivers' watchdogs.
constexpr double kMostSegments = 1e9;

/// Why a request is too much for one frame, or nothing.
std::string too_much_work(const RenderRequest& request)
{
    const RenderSettings& s = request.settings;
    const double segments = static_cast<double>(request.extent.width) * request.extent.height
        * s.samples_per_pixel * s.max_depth;
    if (segments <= kMostSegments)
        return {};
    return "a frame of " + std::to_string(request.extent.width) + "x"
        + std::to_string(request.extent.height) + " with " + std::to_string(s.samples_per_pixel)
        + " samples a pixel and " + std::to_string(s.max_depth)
        + " segments is more than 1e9 path segments: ask for fewer samples a frame";
}

RendererDescription describe(const Context& context, const Scene& scene, const GpuScene& gpu_scene)
{
    RendererDescription d;
    d.device = context.device().selector;
    d.gl_renderer = context.device().name;
    d.gl_version = context.device().version;
    d.software = context.device().software;
    d.scene_name = scene.name;
    d.scene_file = scene.file;
    d.scene_notes = scene.notes;
    if (gpu_scene.dropped_triangles() > 0)
        d.scene_notes.push_back(std::to_string(gpu_scene.dropped_triangles())
            + " triangles of zero area or beyond 32-bit range in world space were left out.");
    for (const ActiveEffect& effect : gpu_scene.effects())
        d.effects.push_back(std::string(effect.name) + ": " + effect.reason);
    d.camera = scene.camera;
    d.camera_paths = scene.camera_paths;
    d.bounds = scene_bounds(scene);
    d.triangles = gpu_scene.triangle_count();
    d.lights = gpu_scene.light_count();
    GLint limit = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &limit);
    d.max_dimension = std::min(limit, 8192);  // above it one frame's buffers alone pass 16 GB
    return d;
}

}  // namespace

struct Renderer::State {
    Scene scene;
    RendererOptions options;
    RendererDescription description;
    std::size_t view_memory = 0;  ///< [bytes]

    std::mutex mutex;
    std::condition_variable work;  ///< Something may have changed for the render thread.
    std::condition_variable left;  ///< A leaving client is gone.
    std::vector<std::shared_ptr<Client>> clients;
    std::string failure;
    bool woken = false;
    bool stopping = false;
    std::atomic<std::uint64_t> frames_rendered = 0;
    std::thread thread;

    void run(std::promise<void> ready);
    void serve(const SharedScene& scene) noexcept;
    std::vector<std::shared_ptr<Client>> take_clients();
    bool advance(Client& client, const SharedScene& scene);
    bool alone();
    bool is_over(const Client& client);
    std::string failure_message();
    std::string reserve(Client& client, Extent extent);
    void finish(Client& client);
    void fail(Client& client, const std::string& message);
    void lose_device(const std::string& message);
};

/// Everything that touches GL, from the first context to the last texture.
void Renderer::State::run(std::promise<void> ready)
{
    std::unique_ptr<Context> context;
    try {
        context = std::make_unique<Context>(options.device);
        ProgramCache programs;
        const GpuScene gpu_scene(scene);
        description = describe(*context, scene, gpu_scene);
        const SharedScene shared{programs, {gpu_scene.textures(), gpu_scene.defines()},
            look_of(scene), description.software};
        view_memory = memory_for_views(options, description.software);
        description.default_extent =
            options.extent ? *options.extent : start_extent(shared, scene.camera, options.settings);
        scene.meshes.clear();  // the device has them now
        ready.set_value();
        serve(shared);
        const std::lock_guard lock(mutex);
        clients.clear();
    } catch (...) {
        ready.set_exception(std::current_exception());  // serve() throws nothing
    }
}

/// Drops leaving clients, and gives the ones to serve this round.
std::vector<std::shared_ptr<Client>> Renderer::State::take_clients()
{
    const std::lock_guard lock(mutex);
    const auto gone = std::remove_if(
        clients.begin(), clients.end(), [](const auto& client) { return client->leaving; });
    if (gone != clients.end()) {
        clients.erase(gone, clients.end());
        left.notify_all();
    }
    return clients;
}

void Renderer::State::serve(const SharedScene& shared) noexcept
{
    for (;;) {
        bool drew = false;
        for (const auto& client : take_clients())
            drew = advance(*client, shared) || drew;
        if (drew)
            continue;
        std::unique_lock lock(mutex);
        const bool leaving =
            std::any_of(clients.begin(), clients.end(), [](const auto& c) { return c->leaving; });
        if (!leaving && !stopping)
            work.wait(lock, [this] { return woken || stopping; });
        if (stopping)
            return;
        woken = false;
    }
}

/// One step for one client: returns its finished frame, starts its next. True if there was anything
/// to do.
bool Renderer::State::advance(Client& client, const SharedScene& shared)
{
    bool busy = client.in_flight;
    try {
        if (client.in_flight)
            finish(client);
        if (is_over(client))
            return busy;
        const std::optional<RenderRequest> request = client.source->next_request();
        if (!request)
            return busy;
        busy = true;
        std::string problem = failure_message();
        if (problem.empty())
            problem = too_much_work(*request);
        if (problem.empty())
            problem = reserve(client, request->extent);
        if (!problem.empty()) {
            fail(client, problem);
            return busy;
        }
        if (client.view == nullptr)
            client.view = std::make_unique<View>(shared);
        client.view->begin(*request);
        client.in_flight = true;
        if (shared.software || alone())
            finish(client);  // nobody else's commands to overlap with
    } catch (const MemoryError& error) {
        client.view.reset();
        client.view_bytes = 0;
        fail(client, error.what());
    } catch (const GlError& error) {
        lose_device(error.what());
        fail(client, error.what());
    } catch (const std::exception& error) {
        fail(client, error.what());
    }
    return busy;
}

bool Renderer::State::is_over(const Client& client)
{
    const std::lock_guard lock(mutex);
    return client.leaving || stopping;
}

std::string Renderer::State::failure_message()
{
    const std::lock_guard lock(mutex);
    return failure;
}

/// Books memory for the client's view; says why not if there is too little left.
std::string Renderer::State::reserve(Client& client, Extent extent)
{
    const std::size_t wanted = kViewBytesPerPixel * static_cast<std::size_t>(extent.width)
        * static_cast<std::size_t>(extent.height);
    const std::lock_guard lock(mutex);
    std::size_t taken = 0;
    for (const auto& other : clients)
        taken += other.get() == &client ? 0 : other->view_bytes;
    if (taken + wanted > view_memory)
        return "a picture of " + std::to_string(extent.width) + "x" + std::to_string(extent.height)
            + " needs " + std::to_string(wanted >> 20) + " MiB, but of the "
            + std::to_string(view_memory >> 20) + " MiB for all clients only "
            + std::to_string((view_memory - taken) >> 20) + " MiB are left";
    client.view_bytes = wanted;
    return {};
}

bool Renderer::State::alone()
{
    const std::lock_guard lock(mutex);
    return clients.size() == 1;
}

void Renderer::State::finish(Client& client)
{
    client.in_flight = false;
    RenderedFrame frame = client.view->finish();
    ++frames_rendered;
    client.source->frame_done(std::move(frame));
}

void Renderer::State::fail(Client& client, const std::string& message)
{
    spdlog::error("frame failed: {}", message);
    client.in_flight = false;
    RenderedFrame frame;
    frame.error = message;
    client.source->frame_done(std::move(frame));
}

void Renderer::State::lose_device(const std::string& message)
{
    const std::lock_guard lock(mutex);
    failure = message;
}

Renderer::Renderer(Scene scene, const RendererOptions& options) : state_(std::make_unique<State>())
{
    state_->scene = std::move(scene);
    drop_neutral(state_->scene);
    state_->options = options;
    std::promise<void> ready;
    std::future<void> started = ready.get_future();
    state_->thread = std::thread([state = state_.get(), promise = std::move(ready)]() mutable {
        state->run(std::move(promise));
    });
    try {
        started.get();
    } catch (...) {
        state_->thread.join();
        throw;
    }
}

Renderer::~Renderer()
{
    {
        const std::lock_guard lock(state_->mutex);
        state_->stopping = true;
    }
    state_->work.notify_all();
    state_->left.notify_all();
    state_->thread.join();
}

const RendererDescription& Renderer::description() const
{
    return state_->description;
}

void Renderer::attach(std::shared_ptr<FrameSource> source)
{
    auto client = std::make_shared<Client>();
    client->source = std::move(source);
    {
        const std::lock_guard lock(state_->mutex);
        state_->clients.push_back(std::move(client));
    }
    wake();
}

void Renderer::detach(const std::shared_ptr<FrameSource>& source)
{
    std::unique_lock lock(state_->mutex);
    const auto attached = [&] {
        return std::any_of(state_->clients.begin(), state_->clients.end(),
            [&](const auto& client) { return client->source == source; });
    };
    for (const auto& client : state_->clients)
        client->leaving = client->leaving || client->source == source;
    state_->woken = true;
    state_->work.notify_all();
    state_->left.wait(lock, [&] { return !attached() || state_->stopping; });
}

void Renderer::wake()
{
    {
        const std::lock_guard lock(state_->mutex);
        state_->woken = true;
    }
    state_->work.notify_all();
}

std::string Renderer::failure() const
{
    const std::lock_guard lock(state_->mutex);
    return state_->failure;
}

std::uint64_t Renderer::frames_rendered() const
{
    return state_->frames_rendered;
}

}  // namespace farlight
