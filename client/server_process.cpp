// Starting and ending a private server (Linux).
#include "client/server_process.h"

#include <cerrno>
#include <csignal>
#include <cstring>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace farlight::client {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kPollInterval{5};
constexpr std::chrono::seconds kStopTimeout{10};
constexpr std::string_view kListening = "farlight-server: listening on http://";

std::string contents(int file)
{
    std::string text;
    char chunk[4096];
    for (ssize_t got = 0;
         (got = pread(file, chunk, sizeof chunk, static_cast<off_t>(text.size()))) > 0;)
        text.append(chunk, static_cast<std::size_t>(got));
    return text;
}

/// HOST:PORT of the line the server prints, once it is complete.
std::optional<Url> address_in(const std::string& output)
{
    const auto at = output.find(kListening);
    const auto end = at == std::string::npos ? at : output.find('\n', at);
    if (end == std::string::npos)
        return std::nullopt;
    const auto host = at + kListening.size();
    return parse_url("ws://" + output.substr(host, output.find('/', host) - host));
}

}  // namespace

ServerProcess::ServerProcess(const std::filesystem::path& program,
    const std::vector<std::string>& arguments, std::chrono::milliseconds timeout)
    : output_(memfd_create("farlight-server stdout", MFD_CLOEXEC))
    , log_(memfd_create("farlight-server stderr", MFD_CLOEXEC))
{
    try {
        start(program, arguments);
        await_address(program.string(), timeout);
    } catch (...) {
        stop();
        throw;
    }
}

ServerProcess::~ServerProcess()
{
    stop();
}

void ServerProcess::start(
    const std::filesystem::path& program, const std::vector<std::string>& arguments)
{
    std::vector<std::string> words{program.string()};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> argv;
    argv.reserve(words.size() + 1);
    for (std::string& word : words)
        argv.push_back(word.data());
    argv.push_back(nullptr);

    const pid_t parent = getpid();
    pid_ = fork();
    if (pid_ < 0)
        throw ServerProcessError(std::string("fork: ") + std::strerror(errno), -1);
    if (pid_ != 0)
        return;
    // In the child: only calls that are safe after fork.
    prctl(PR_SET_PDEATHSIG, SIGKILL);  // nobody is left to drain for
    if (getppid() != parent)
        _exit(1);
    dup2(output_, STDOUT_FILENO);
    dup2(log_, STDERR_FILENO);
    execv(argv[0], argv.data());
    constexpr int kCannotRun = 127;  // as a shell says it
    const char* problem = std::strerror(errno);
    const ssize_t written = write(STDERR_FILENO, problem, std::strlen(problem));
    _exit(written < 0 ? kCannotRun + 1 : kCannotRun);
}

void ServerProcess::await_address(const std::string& name, std::chrono::milliseconds timeout)
{
    const auto deadline = Clock::now() + timeout;
    while (Clock::now() < deadline) {
        if (const auto url = address_in(contents(output_))) {
            url_ = *url;
            return;
        }
        int status = 0;
        if (waitpid(pid_, &status, WNOHANG) == pid_) {
            pid_ = -1;
            const int code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
            throw ServerProcessError(name + " ended"
                    + (WIFSIGNALED(status) ? " by signal " + std::to_string(WTERMSIG(status))
                                           : " with status " + std::to_string(code))
                    + ":\n" + log(),
                code);
        }
        std::this_thread::sleep_for(kPollInterval);
    }
    throw ServerProcessError(name + " does not say where it listens:\n" + log(), -1);
}

void ServerProcess::stop()
{
    if (pid_ > 0) {
        kill(pid_, SIGTERM);
        const auto deadline = Clock::now() + kStopTimeout;
        while (waitpid(pid_, nullptr, WNOHANG) == 0) {
            if (Clock::now() > deadline)
                kill(pid_, SIGKILL);
            std::this_thread::sleep_for(kPollInterval);
        }
        pid_ = -1;
    }
    for (int* file : {&output_, &log_})
        if (*file >= 0)
            ::close(std::exchange(*file, -1));
}

std::string ServerProcess::log() const
{
    return contents(log_);
}

std::filesystem::path server_beside_this_program()
{
    return std::filesystem::read_symlink("/proc/self/exe").parent_path() / "farlight-server";
}

}  // namespace farlight::client
