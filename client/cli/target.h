// Target: the server a command talks to, given by --url or started for it by --scene.
#pragma once

#include "client/connection.h"
#include "client/server_process.h"

#include <CLI/App.hpp>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace farlight::client {

/// What the user said; filled by CLI11.
struct TargetOptions {
    std::string url;
    std::string scene;
    std::string device;
    std::string size;  ///< WxH
    std::vector<std::string> set;  ///< key=value
    int port = 0;

    /// `scene_option`: the command takes --scene; otherwise it knows its scenes itself.
    void add_to(CLI::App& command, bool scene_option = true);
};

class Target {
public:
    /// Starts a private server unless there is a --url. Throws std::invalid_argument for options
    /// that do not fit together, ServerProcessError. `scene` stands in for --scene.
    explicit Target(const TargetOptions& options, const std::string& scene = "");

    const Url& url() const { return url_; }
    /// hello of this command: with --url it carries --size and --set, which a private server
    /// already has.
    protocol::Hello hello(protocol::Mode mode, protocol::Format format) const;

private:
    Url url_;
    std::unique_ptr<ServerProcess> server_;  ///< Null with --url.
    std::optional<protocol::Size> size_;
    std::map<std::string, nlohmann::json> settings_;
};

/// "WxH". Throws std::invalid_argument.
protocol::Size parse_size(const std::string& text);

}  // namespace farlight::client
