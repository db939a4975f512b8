// ServerProcess: a private farlight-server on a free port, for as long as this object lives.
#pragma once

#include "client/connection.h"

#include <filesystem>
#include <string>
#include <sys/types.h>
#include <vector>

namespace farlight::client {

/// The server did not start or has ended; what() holds what it wrote to stderr.
struct ServerProcessError : std::runtime_error {
    ServerProcessError(const std::string& what, int status)
        : runtime_error(what)
        , exit_status(status)
    {
    }
    int exit_status;  ///< The server's own; -1 when a signal ended it or it did not get that far.
};

class ServerProcess {
public:
    /// Starts `program arguments...` and waits for its line
    /// `farlight-server: listening on http://HOST:PORT/`. Throws ServerProcessError.
    /// The server is also killed when this process is.
    ServerProcess(const std::filesystem::path& program, const std::vector<std::string>& arguments,
        std::chrono::milliseconds timeout = std::chrono::minutes(2));
    /// SIGTERM; SIGKILL when that has no effect for some seconds.
    ~ServerProcess();
    ServerProcess(const ServerProcess&) = delete;
    ServerProcess& operator=(const ServerProcess&) = delete;

    const Url& url() const { return url_; }
    pid_t pid() const { return pid_; }
    /// What the server has written to stderr so far.
    std::string log() const;

private:
    void start(const std::filesystem::path& program, const std::vector<std::string>& arguments);
    void await_address(const std::string& name, std::chrono::milliseconds timeout);
    void stop();

    Url url_;
    pid_t pid_ = -1;  ///< -1 once it has been waited for.
    int output_ = -1;  ///< Memory files: the server never blocks on a pipe that nobody reads.
    int log_ = -1;
};

/// farlight-server beside the running program.
std::filesystem::path server_beside_this_program();

}  // namespace farlight::client
