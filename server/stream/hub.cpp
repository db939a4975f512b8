// Hub: see the header.
#include "server/stream/hub.h"

#include "server/stream/connection.h"
#include "server/stream/welcome.h"

#include <algorithm>
#include <boost/asio/post.hpp>
#include <thread>

namespace farlight {
namespace {

std::shared_ptr<const SessionDefaults> defaults_of(
    const RendererDescription& description, const StreamOptions& options)
{
    auto defaults = std::make_shared<SessionDefaults>();
    defaults->welcome = describe_server(description);
    defaults->request.camera = description.camera;
    defaults->request.settings = options.settings;
    defaults->request.extent = description.default_extent;
    defaults->max_dimension = description.max_dimension;
    defaults->deadlines = options.session;
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
    , session_defaults(defaults_of(*service.description(), options))
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

void Hub::detach_later(std::shared_ptr<FrameSource> source)
{
    boost::asio::post(detacher, [this, source = std::move(source)] { renderer.detach(source); });
}

}  // namespace farlight
