// The render thread: owns the context, asks sources for work, draws, hands pixels back.
#include "server/render/renderer.h"

#include "server/gl/context.h"
#include "server/gl/gl_error.h"
#include "server/render/frame_limits.h"
#include "server/render/live_scene.h"
#include "server/render/scene_settings.h"
#include "server/render/start_size.h"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <future>
#include <mutex>
#include <spdlog/spdlog.h>
#include <thread>

namespace farlight {

struct Client {
    std::shared_ptr<FrameSource> source;
    std::unique_ptr<View> view;  ///< Made at the first request, on the render thread.
    std::size_t view_bytes = 0;  ///< Most that the view may hold.
    bool in_flight = false;
    bool leaving = false;
};

namespace {

double seconds_since(std::chrono::steady_clock::time_point start)
{
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

/// A scene on its way to the render thread.
struct IncomingScene {
    LoadedScene loaded;
    std::promise<void> shown;
};

struct Renderer::State {
    Scene scene;  ///< The first one, until the render thread has it.
    RendererOptions options;
    std::size_t view_memory = 0;  ///< [bytes]

    std::mutex mutex;
    std::condition_variable work;  ///< Something may have changed for the render thread.
    std::condition_variable left;  ///< A leaving client is gone.
    std::vector<std::shared_ptr<Client>> clients;
    std::shared_ptr<const RendererDescription> description;
    std::unique_ptr<IncomingScene> incoming;
    std::string failure;
    bool woken = false;
    bool stopping = false;
    std::atomic<std::uint64_t> frames_rendered = 0;
    BadValueTotals bad_values;  ///< Guarded by `mutex`.
    std::mutex replacing;  ///< One scene is replaced at a time.
    std::unique_ptr<GlWorker> loader;
    std::thread thread;

    void run(std::promise<void> ready);
    void serve(const Context& context, LiveScene& live) noexcept;
    void take_scene(const Context& context, LiveScene& live);
    void publish(RendererDescription d);
    void wake();
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
        LiveScene live(*context, options, [this] { wake(); });
        live.show(load_onto_device(std::move(scene)));
        RendererDescription d = describe(*context, live);
        d.settings = settings_for(live.scene(), options.settings, options.set);
        live.prepare_programs(d.settings);
        view_memory = memory_for_views(options.view_memory, d.software);
        if (!options.extent)
            live.finish_programs();  // what is measured is what will draw
        d.default_extent =
            options.extent ? *options.extent : start_extent(live.shared(), d.camera, d.settings);
        publish(std::move(d));
        loader = std::make_unique<GlWorker>(*context);
        ready.set_value();
        serve(*context, live);
        loader.reset();
        const std::lock_guard lock(mutex);
        clients.clear();
        incoming.reset();
    } catch (...) {
        ready.set_exception(std::current_exception());  // serve() throws nothing
    }
}

void Renderer::State::publish(RendererDescription d)
{
    const std::lock_guard lock(mutex);
    description = std::make_shared<const RendererDescription>(std::move(d));
}

/// Shows the scene that waits, if one does.
void Renderer::State::take_scene(const Context& context, LiveScene& live)
{
    std::unique_ptr<IncomingScene> next;
    {
        const std::lock_guard lock(mutex);
        next = std::move(incoming);
    }
    if (next == nullptr)
        return;
    live.show(std::move(next->loaded));
    RendererDescription d = describe(context, live);
    d.default_extent = description->default_extent;
    d.settings = settings_for(live.scene(), options.settings, options.set);
    publish(std::move(d));
    next->shown.set_value();
}

void Renderer::State::wake()
{
    {
        const std::lock_guard lock(mutex);
        woken = true;
    }
    work.notify_all();
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

void Renderer::State::serve(const Context& context, LiveScene& live) noexcept
{
    for (;;) {
        bool drew = false;
        for (const auto& client : take_clients()) {
            take_scene(context, live);
            drew = advance(*client, live.shared()) || drew;
        }
        take_scene(context, live);
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
        std::optional<RenderRequest> request = client.source->next_request();
        if (!request)
            return busy;
        busy = true;
        if (request->clock_start)
            request->time += seconds_since(*request->clock_start);
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
        return too_little_memory(extent, wanted, taken, view_memory);
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
    {
        const std::lock_guard lock(mutex);
        bad_values.add(frame.bad_values);
    }
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

std::shared_ptr<const RendererDescription> Renderer::description() const
{
    const std::lock_guard lock(state_->mutex);
    return state_->description;
}

void Renderer::replace_scene(Scene scene)
{
    const std::lock_guard one_at_a_time(state_->replacing);
    // Shared with a job that may be done after this has returned, when the renderer ends meanwhile.
    auto loaded = std::make_shared<std::promise<LoadedScene>>();
    std::future<LoadedScene> when_loaded = loaded->get_future();
    auto job = [loaded = std::move(loaded), scene = std::move(scene)]() mutable {
        try {
            loaded->set_value(load_onto_device(std::move(scene)));
        } catch (...) {
            loaded->set_exception(std::current_exception());
        }
    };
    state_->loader->request(std::move(job));
    std::future<void> when_shown;
    {
        auto next = std::make_unique<IncomingScene>(IncomingScene{when_loaded.get(), {}});
        when_shown = next->shown.get_future();
        const std::lock_guard lock(state_->mutex);
        state_->incoming = std::move(next);
    }
    wake();
    when_shown.get();
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
    state_->wake();
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

BadValueTotals Renderer::bad_values() const
{
    const std::lock_guard lock(state_->mutex);
    return state_->bad_values;
}

}  // namespace farlight
