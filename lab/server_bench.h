// ServerBench: the whole server in this process, and clients that reach it over WebSocket.
#pragma once

#include "client/session.h"
#include "lab/temp_folder.h"
#include "server/renderer_service.h"
#include "server/stream/listener.h"

#include <string>
#include <thread>

namespace farlight::lab {

class ServerBench {
public:
    /// Serves the scene until this goes. Throws what the server would end with.
    explicit ServerBench(const nlohmann::json& document);
    ~ServerBench();
    ServerBench(const ServerBench&) = delete;
    ServerBench& operator=(const ServerBench&) = delete;

    /// Of all benches of this process: auto, software, gpu, gpu:N.
    static void use_device(const std::string& selector);

    /// A lockstep session of raw linear frames.
    client::Session session(
        const protocol::Size& size, const std::map<std::string, nlohmann::json>& settings = {});
    /// Largest width or height [px].
    int max_dimension() const { return renderer_.description()->max_dimension; }
    /// Empty while the device works.
    std::string failure() const { return renderer_.failure(); }

private:
    TempFolder folder_;
    SceneDocument document_;
    Renderer renderer_;
    RendererService service_;
    Listener listener_;
    std::thread network_;
};

}  // namespace farlight::lab
