// ServerUnderTest: a Listener over a FakeRenderer, on a free loopback port and a thread of its own.
#pragma once

#include "server/stream/listener.h"
#include "tests/stream/fake_renderer.h"

#include <thread>

namespace farlight {

class ServerUnderTest {
public:
    explicit ServerUnderTest(StreamOptions options = {},
        std::chrono::milliseconds draw_time = std::chrono::milliseconds(0))
        : renderer_(draw_time)
        , listener_(renderer_, on_a_free_port(std::move(options)))
        , port_(listener_.port())
        , thread_([this] { listener_.run(); })
    {
    }
    ~ServerUnderTest()
    {
        listener_.shut_down();
        join();
    }

    std::uint16_t port() const { return port_; }
    FakeRenderer& renderer() { return renderer_; }
    Listener& listener() { return listener_; }
    /// Waits for run() to return.
    void join()
    {
        if (thread_.joinable())
            thread_.join();
    }

private:
    static StreamOptions on_a_free_port(StreamOptions options)
    {
        options.port = 0;
        return options;
    }

    FakeRenderer renderer_;
    Listener listener_;
    std::uint16_t port_;
    std::thread thread_;
};

}  // namespace farlight
