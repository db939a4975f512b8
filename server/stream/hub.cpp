// Hub: see the header.
#include "server/stream/hub.h"

#include "server/scene/scene_file.h"
#include "server/stream/connection.h"
#include "server/stream/welcome.h"

#include <algorithm>
#include <boost/asio/post.hpp>
#include <thread>

namespace farlight {
namespace {

/// Waiting for the one being made; each may load files.
constexpr int kMostEditsWaiting = 16;

std::shared_ptr<const SessionDefaults> defaults_of(
    std::shared_ptr<const RendererDescription> shared_description, const StreamOptions& options)
{
    const RendererDescription& description = *shared_description;
    auto defaults = std::make_shared<SessionDefaults>();
    defaults->description = std::move(shared_description);
    defaults->welcome = describe_server(description);
    defaults->welcome.edits = options.edits;
    defaults->request.camera = description.camera;
    defaults->request.settings = description.settings;
    defaults->request.extent = description.default_extent;
    defaults->max_dimension = description.max_dimension;
    defaults->deadlines = options.session;
    defaults->frontier = options.frontier;
    return defaults;
}

/// One core is the renderer's; more than four encoders have nothing to do.
std::size_t worker_count()
{
    const unsigned cores = std::thread::hardware_concurrency();
    return std::clamp(cores > 1 ? cores - 1 : 1U, 1U, 4U);
}

}  // namespace

Hub::Hub(RenderService& service, StreamOptions stream_options)
    : renderer(service)
    , options(std::move(stream_options))
    , session_defaults(defaults_of(service.description(), options))
    , metrics(*service.description())
    , workers(worker_count())
    , context(1)
{
}

std::string Hub::not_ready() const
{
    if (const std::string failure = renderer.failure(); !failure.empty())
        return "the renderer failed: " + failure;
    return draining ? "the server is shutting down" : "";
}

int Hub::frames_in_flight() const
{
    int frames = 0;
    for (const Connection* connection : connections)
        frames += connection->frames_in_flight();
    return frames;
}

void Hub::edit(std::weak_ptr<Connection> author, protocol::Edit edit)
{
    if (edits_waiting >= kMostEditsWaiting) {
        if (const auto connection = author.lock())
            connection->edit_refused(std::to_string(edits_waiting) + " edits wait already", "");
        return;
    }
    ++edits_waiting;
    boost::asio::post(editor, [this, author = std::move(author), edit = std::move(edit)] {
        std::string problem;
        std::string pointer;
        try {
            renderer.edit(edit.patch, edit.reset);
        } catch (const SceneError& refused) {
            problem = refused.what();
            pointer = refused.pointer;
        } catch (const std::exception& refused) {
            problem = refused.what();
        }
        boost::asio::post(context, [this, author, edit, problem, pointer] {
            --edits_waiting;
            if (problem.empty())
                tell_of_new_scene(author, edit);
            else if (const auto connection = author.lock())
                connection->edit_refused(problem, pointer);
        });
    });
}

void Hub::tell_of_new_scene(const std::weak_ptr<Connection>& author, const protocol::Edit& edit)
{
    session_defaults = defaults_of(renderer.description(), options);
    const Connection* const by = author.lock().get();
    for (Connection* connection : std::set<Connection*>(connections))
        connection->scene_changed(session_defaults,
            connection == by ? std::optional(edit) : std::optional<protocol::Edit>());
}

void Hub::detach_later(std::shared_ptr<FrameSource> source)
{
    boost::asio::post(detacher, [this, source = std::move(source)] { renderer.detach(source); });
}

}  // namespace farlight
