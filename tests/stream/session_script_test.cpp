// Sessions as scripts: each file of sessions/ is one test, told line by line.
//
// * client TYPE key=value ...: the client says this; values are JSON or bare words, a,b,c is an
//   array
// * server TYPE key=value ...: the next thing the server says; fields not named may be anything
// * server nothing: the server has said nothing more
// * wait MILLISECONDS: time passes
// * socket stops | goes on: the client stops reading; goes on
// * frame takes MILLISECONDS: from now on, at full size and 1 sample a pixel
//
// Frames have the type `frame` and their header's fields, the end of a connection has the type
// `close`.
#include "tests/stream/session_bench.h"

#include <algorithm>
#include <deque>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <sstream>

namespace farlight {
namespace {

using nlohmann::json;

json value_of(const std::string& text)
{
    json plain = json::parse(text, nullptr, false);
    if (!plain.is_discarded())
        return plain;
    const json array = json::parse("[" + text + "]", nullptr, false);
    return text.find(',') != std::string::npos && !array.is_discarded() ? array : json(text);
}

json read_object(std::istringstream& words)
{
    std::string word;
    words >> word;
    json object{{"type", word}};
    while (words >> word) {
        const auto equals = word.find('=');
        object[word.substr(0, equals)] = value_of(word.substr(equals + 1));
    }
    return object;
}

/// Completes a camera, so that scripts need not.
json completed(json message)
{
    if (message["type"] == "camera") {
        json camera{{"position", {0, 0, 5}}, {"target", {0, 0, 0}}, {"up", {0, 1, 0}},
            {"vertical_fov_degrees", 45}};
        camera.update(message);
        return camera;
    }
    if (message["type"] == "hello")
        message.emplace("client", "script");
    return message;
}

class ScriptRunner {
public:
    void run(const std::string& line)
    {
        std::istringstream words(line);
        std::string who;
        words >> who;
        if (who == "client")
            say(completed(read_object(words)));
        else if (who == "server")
            expect(read_object(words));
        else if (who == "wait")
            wait(words);
        else if (who == "socket")
            set_socket(words);
        else if (who == "frame")
            words >> who >> bench_.frame_ms;
        else
            ADD_FAILURE() << "unknown line: " << line;
    }

private:
    void say(const json& message)
    {
        const auto decoded = protocol::decode_client_message(message.dump());
        if (const auto* good = std::get_if<protocol::ClientMessage>(&decoded))
            bench_.receive(*good);
        else
            bench_.receive_garbage(std::get<protocol::DecodeError>(decoded));
        go_on();
    }

    void go_on()
    {
        if (socket_reads_)
            bench_.settle();
        else
            while (bench_.socket_takes() || bench_.encoder_finishes() || bench_.renderer_finishes()
                || bench_.renderer_takes()) { }
        for (json& event : bench_.take_events())
            said_.push_back(std::move(event));
    }

    void expect(const json& expected)
    {
        if (expected["type"] == "nothing") {
            EXPECT_TRUE(said_.empty()) << "but it said " << said_.front();
            return;
        }
        if (said_.empty()) {
            ADD_FAILURE() << "expected " << expected << ", but the server said nothing";
            return;
        }
        const json actual = said_.front();
        said_.pop_front();
        for (const auto& [key, value] : expected.items())
            EXPECT_EQ(actual.value(key, json()), value) << key << " of " << actual;
    }

    void wait(std::istringstream& words)
    {
        int milliseconds = 0;
        words >> milliseconds;
        bench_.pass_time(std::chrono::milliseconds(milliseconds));
        go_on();
    }

    void set_socket(std::istringstream& words)
    {
        std::string verb;
        words >> verb;
        socket_reads_ = verb == "goes";
        go_on();
    }

    SessionBench bench_;
    bool socket_reads_ = true;
    std::deque<json> said_;
};

std::vector<std::filesystem::path> scripts()
{
    std::vector<std::filesystem::path> files;
    for (const auto& entry :
        std::filesystem::directory_iterator(FARLIGHT_SOURCE_DIR "/tests/stream/sessions"))
        files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

class SessionScript : public testing::TestWithParam<std::filesystem::path> { };

TEST_P(SessionScript, GoesAsWritten)
{
    std::ifstream file(GetParam());
    ScriptRunner runner;
    std::string line;
    for (int number = 1; std::getline(file, line); ++number) {
        if (line.empty() || line[0] == '#')
            continue;
        SCOPED_TRACE(GetParam().string() + ":" + std::to_string(number) + ": " + line);
        runner.run(line);
    }
}

INSTANTIATE_TEST_SUITE_P(Sessions, SessionScript, testing::ValuesIn(scripts()),
    [](const auto& parameter) { return parameter.param.stem().string(); });

}  // namespace
}  // namespace farlight
