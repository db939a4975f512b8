// See the header.
#include "lab/server_bench.h"

#include <nlohmann/json.hpp>

namespace farlight::lab {
namespace {

std::string& device_of_benches()
{
    static std::string selector = "software";
    return selector;
}

RendererOptions renderer_options()
{
    RendererOptions options;
    options.device = device_of_benches();
    options.extent = Extent{16, 16};
    return options;
}

StreamOptions any_free_port()
{
    StreamOptions options;
    options.port = 0;
    return options;
}

}  // namespace

ServerBench::ServerBench(const nlohmann::json& document)
    : document_(SceneDocument::load(folder_.write("scene.json", document.dump())))
    , renderer_(document_.scene(), renderer_options())
    , service_(renderer_, document_)
    , listener_(service_, any_free_port())
    , network_([this] { listener_.run(); })
{
}

ServerBench::~ServerBench()
{
    listener_.shut_down();
    network_.join();
}

void ServerBench::use_device(const std::string& selector)
{
    device_of_benches() = selector;
}

client::Session ServerBench::session(
    const protocol::Size& size, const std::map<std::string, nlohmann::json>& settings)
{
    protocol::Hello hello;
    hello.client = "farlight-hard-cases";
    hello.mode = protocol::Mode::kLockstep;
    hello.format = protocol::Format::kRaw;
    hello.size = size;
    hello.max_in_flight = 1;
    hello.settings = settings;
    return {
        {"127.0.0.1", std::to_string(listener_.port()), std::string(protocol::kEndpoint)}, hello};
}

}  // namespace farlight::lab
