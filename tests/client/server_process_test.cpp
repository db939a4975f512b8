// Private servers, played by the shell: found, reported, stopped.
#include "client/server_process.h"

#include <csignal>
#include <gmock/gmock.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace farlight {
namespace {

using namespace client;
using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

std::vector<std::string> shell(const std::string& commands)
{
    return {"-c", commands};
}

constexpr const char* kShell = "/bin/sh";
const std::string listening_line = "echo 'farlight-server: listening on http://127.0.0.1:4711/'; ";

bool alive(pid_t pid)
{
    return kill(pid, 0) == 0;
}

TEST(ServerProcess, IsFoundByTheLineItPrintsAndEndsWithTheObject)
{
    pid_t pid = 0;
    {
        const ServerProcess server(
            kShell, shell("echo warming up; " + listening_line + "exec sleep 100"));
        EXPECT_EQ(server.url(), (Url{"127.0.0.1", "4711", "/ws"}));
        pid = server.pid();
        EXPECT_TRUE(alive(pid));
    }
    EXPECT_FALSE(alive(pid));
}

TEST(ServerProcess, OneThatEndsEarlyIsReportedWithItsWords)
{
    EXPECT_THAT([] { ServerProcess(kShell, shell("echo no such scene >&2; exit 2")); },
        ThrowsMessage<ServerProcessError>(
            AllOf(HasSubstr("ended with status 2"), HasSubstr("no such scene"))));
    try {
        const ServerProcess server(kShell, shell("exit 2"));
        ADD_FAILURE() << "expected an exception";
    } catch (const ServerProcessError& problem) {
        EXPECT_EQ(problem.exit_status, 2);
    }
}

TEST(ServerProcess, OneThatCannotRunOrIsKilledIsReported)
{
    EXPECT_THAT([] { ServerProcess("/no/such/server", {}); },
        ThrowsMessage<ServerProcessError>(HasSubstr("No such file")));
    EXPECT_THAT([] { ServerProcess(kShell, shell("kill -SEGV $$")); },
        ThrowsMessage<ServerProcessError>(HasSubstr("ended by signal 11")));
}

TEST(ServerProcess, OneThatNeverListensTimesOut)
{
    EXPECT_THAT(
        [] { ServerProcess(kShell, shell("exec sleep 100"), std::chrono::milliseconds(50)); },
        ThrowsMessage<ServerProcessError>(HasSubstr("does not say where it listens")));
}

TEST(ServerProcess, IsNotLeftBehindWhenWeAreKilled)
{
    prctl(PR_SET_CHILD_SUBREAPER, 1);  // orphans come to us, so that we can wait for them
    int link[2];
    ASSERT_EQ(pipe(link), 0);
    const pid_t victim = fork();
    if (victim == 0) {
        const ServerProcess server(kShell,
            shell("trap '' TERM; " + listening_line
                + "exec sleep 100"));  // as deaf to SIGTERM as one that drains
        const pid_t pid = server.pid();
        if (write(link[1], &pid, sizeof pid) == sizeof pid)
            kill(getpid(), SIGKILL);
        _exit(1);
    }
    pid_t orphan = 0;
    ASSERT_EQ(read(link[0], &orphan, sizeof orphan), static_cast<ssize_t>(sizeof orphan));
    EXPECT_EQ(waitpid(victim, nullptr, 0), victim);
    int status = 0;
    EXPECT_EQ(waitpid(orphan, &status, 0), orphan);
    EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL);
    close(link[0]);
    close(link[1]);
}

}  // namespace
}  // namespace farlight
