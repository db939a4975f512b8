// Driving a session.
#include "client/session.h"

#include <algorithm>

namespace farlight::client {

using namespace protocol;

Session::Session(const Url& url, const Hello& hello) : connection_(url)
{
    connection_.send(hello);
    auto first = next();
    const auto* message = std::get_if<ServerMessage>(&first);
    const auto* welcome = message != nullptr ? std::get_if<Welcome>(message) : nullptr;
    if (welcome == nullptr)
        throw SessionError("the server answers hello by something else than welcome");
    welcome_ = *welcome;
}

std::variant<ServerMessage, Frame> Session::next()
{
    auto event = connection_.receive(kPatience);
    if (!event)
        throw SessionError(
            "the server is silent for " + std::to_string(kPatience.count()) + " minutes");
    if (const auto* closed = std::get_if<Closed>(&*event))
        throw SessionError("the server closed the connection: " + to_string(*closed));
    if (const auto* garbage = std::get_if<DecodeError>(&*event))
        throw SessionError("the server sent a bad message: " + to_string(*garbage));
    if (auto* frame = std::get_if<Frame>(&*event))
        return std::move(*frame);
    auto& message = std::get<ServerMessage>(*event);
    if (const auto* error = std::get_if<Error>(&message)) {
        if (error->fatal)
            throw SessionError("the server breaks off: " + error->message);
        throw RefusedError(*error);
    }
    if (const auto* bye = std::get_if<ServerBye>(&message))
        throw SessionError("the server says bye: " + bye->reason);
    return std::move(message);
}

std::uint32_t Session::send_camera(const Pose& pose, bool cut)
{
    connection_.send(Camera{.sequence = ++sequence_, .pose = pose, .cut = cut});
    return sequence_;
}

Frame Session::next_frame()
{
    while (true) {
        auto received = next();
        if (auto* frame = std::get_if<Frame>(&received))
            return std::move(*frame);
    }
}

void Session::acknowledge(const Frame& frame)
{
    connection_.send(Ack{.frame_id = frame.header.frame_id});
}

Frame Session::draw(const Pose& pose, bool cut)
{
    const std::uint32_t sequence = send_camera(pose, cut);
    Frame frame = next_frame();
    if (frame.header.camera_sequence != sequence)
        throw SessionError("found a frame of camera " + std::to_string(frame.header.camera_sequence)
            + ", expected " + std::to_string(sequence));
    acknowledge(frame);
    return frame;
}

template <typename Message, typename Accept> Message Session::wait_for(const Accept& accept)
{
    while (true) {
        auto received = next();
        if (auto* frame = std::get_if<Frame>(&received)) {
            acknowledge(*frame);  // interactive: pictures go on
            continue;
        }
        auto* message = std::get_if<Message>(&std::get<ServerMessage>(received));
        if (message != nullptr && accept(*message))
            return std::move(*message);
    }
}

void Session::set(const std::string& key, const nlohmann::json& value)
{
    connection_.send(Set{.key = key, .value = value});
    wait_for<State>([](const State&) { return true; });
}

void Session::resize(const Size& size)
{
    connection_.send(Resize{.width = size[0], .height = size[1]});
    wait_for<State>([](const State&) { return true; });
}

SceneChanged Session::edit(const nlohmann::json& merge_patch, bool reset)
{
    const std::uint32_t id = ++last_edit_;
    connection_.send(Edit{.id = id, .patch = merge_patch, .reset = reset});
    return wait_for<SceneChanged>([id](const SceneChanged& changed) { return changed.edit == id; });
}

Inspection Session::inspect()
{
    connection_.send(Inspect{});
    return wait_for<Inspection>([](const Inspection&) { return true; });
}

Inspection Session::await_own_programs(const Pose& pose, std::chrono::milliseconds patience)
{
    const auto begun = std::chrono::steady_clock::now();
    while (true) {
        draw(pose);
        Inspection inspection = inspect();
        if (drawn_with_own_programs(inspection)
            || std::chrono::steady_clock::now() - begun >= patience)
            return inspection;
    }
}

bool drawn_with_own_programs(const Inspection& inspection)
{
    return std::all_of(
        inspection.program.begin(), inspection.program.end(), [&](const std::string& name) {
            return std::any_of(inspection.effects.begin(), inspection.effects.end(),
                [&](const CalledEffect& effect) { return effect.name == name; });
        });
}

}  // namespace farlight::client
