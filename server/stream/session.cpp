// Session: see the header. Messages, and how a session ends; the way of a frame is in
// session_frames.cpp.
#include "server/stream/session.h"

#include "server/stream/welcome.h"

namespace farlight {
namespace {

using protocol::Error;
using protocol::ErrorCode;
using protocol::Mode;

}  // namespace

Session::Session(std::shared_ptr<const SessionDefaults> defaults, std::string name,
    std::shared_ptr<Slot> slot, Time now)
    : defaults_(std::move(defaults))
    , name_(std::move(name))
    , slot_(std::move(slot))
    , opened_(now)
{
}

// ---------------------------------------------------------------- messages

void Session::receive(const protocol::ClientMessage& message, Time now)
{
    if (closed_)
        return;
    if (!plan_ && !std::holds_alternative<protocol::Hello>(message)) {
        effects_.push_back(effects::Say{
            Error{ErrorCode::kNoHello, "the first message must be hello", std::nullopt, true}});
        return close(CloseCode::kPolicy, "no hello");
    }
    std::visit([&](const auto& known) { on(known, now); }, message);
    plan_drawing();
}

void Session::receive_garbage(const protocol::DecodeError& error)
{
    if (!closed_)
        refuse(to_error_message(error));
}

void Session::on(const protocol::Hello& hello, Time now)
{
    if (plan_)
        return refuse({ErrorCode::kSecondHello, "hello was said already", std::nullopt, false});
    RenderRequest request = defaults_->request;
    for (const auto& [key, value] : hello.settings)
        try_setting(request.settings, key, value);
    if (hello.size)
        request.extent =
            checked_extent((*hello.size)[0], (*hello.size)[1]).value_or(request.extent);
    if (closed_)
        return;
    plan_.emplace(hello.mode, request, hello.format, now);
    pacing_.emplace(static_cast<int>(hello.max_in_flight));

    protocol::Welcome welcome = defaults_->welcome;
    welcome.session = name_;
    welcome.mode = hello.mode;
    welcome.format = hello.format;
    welcome.size = {static_cast<std::uint32_t>(request.extent.width),
        static_cast<std::uint32_t>(request.extent.height)};
    welcome.max_in_flight = hello.max_in_flight;
    welcome.settings = describe_settings(request.settings, defaults_->request.settings);
    effects_.push_back(effects::Say{std::move(welcome)});
    if (hello.mode == Mode::kInteractive) {
        controller_.emplace(defaults_->frontier);
        controller_->follow(request.settings, request.extent);
        say_frontier(now);
    }
}

void Session::on(const protocol::Camera& camera, Time now)
{
    if (plan_->move_camera(pose_from_wire(camera.pose), camera.sequence, camera.cut, now))
        return;
    effects_.push_back(effects::Say{Error{ErrorCode::kQueueFull,
        std::to_string(protocol::kLockstepQueue) + " cameras wait already", std::nullopt, true}});
    close(CloseCode::kPolicy, "too many cameras wait");
}

void Session::on(const protocol::Set& set, Time now)
{
    RenderSettings settings = plan_->wishes().settings;
    if (!try_setting(settings, set.key, set.value))
        return;
    if (settings != plan_->wishes().settings)
        plan_->set_settings(settings, now);
    if (set.key == "time")
        plan_->go_to_time(now);
    say_state();
}

void Session::on(const protocol::Resize& resize, Time now)
{
    const std::optional<Extent> extent = checked_extent(resize.width, resize.height);
    if (!extent)
        return;
    if (*extent != plan_->wishes().extent)
        plan_->set_extent(*extent, now);
    say_state();
}

void Session::on(const protocol::SetFormat& set_format, Time now)
{
    if (set_format.format != plan_->format())
        plan_->set_format(set_format.format, now);
    say_state();
}

void Session::on(const protocol::Ack& ack, Time now)
{
    if (const auto times = pacing_->acknowledge(ack.frame_id, now))
        effects_.push_back(effects::Acknowledged{*times});
    else
        effects_.push_back(effects::MessageRefused{
            "ack of frame " + std::to_string(ack.frame_id) + ", which is not in flight"});
}

void Session::on(const protocol::Ping& ping, Time /*now*/)
{
    effects_.push_back(effects::Say{protocol::Pong{ping.t}});
}

void Session::on(const protocol::ClientBye& /*bye*/, Time /*now*/)
{
    close(CloseCode::kNormal, "bye");
}

void Session::on(const protocol::Edit& edit, Time /*now*/)
{
    if (!defaults_->welcome.edits)
        return edit_refused("this server's scene is not to be edited", "");
    effects_.push_back(effects::Edit{edit});
}

void Session::on(const protocol::Inspect& /*inspect*/, Time /*now*/)
{
    protocol::Inspection inspection = last_frame_;
    const RendererDescription& description = *defaults_->description;
    std::vector<protocol::CalledEffect> by_scene;
    for (const ActiveEffect& effect : description.effects)
        by_scene.push_back({std::string(effect.name), effect.reason, {}});
    inspection.effects.insert(inspection.effects.begin(), by_scene.begin(), by_scene.end());
    for (const auto& [name, bytes] : description.allocations)
        inspection.scene_memory.push_back({name, bytes});
    effects_.push_back(effects::Say{std::move(inspection)});
}

void Session::scene_changed(
    std::shared_ptr<const SessionDefaults> defaults, std::optional<protocol::Edit> edit, Time now)
{
    defaults_ = std::move(defaults);
    if (!plan_ || closed_)
        return;
    plan_->change_scene(now);
    if (controller_)
        controller_->change_scene();
    protocol::SceneChanged changed{{}, defaults_->welcome.scene, defaults_->welcome.effects};
    if (edit)
        changed.edit = edit->id;
    effects_.push_back(effects::Say{std::move(changed)});
    plan_drawing();
}

void Session::edit_refused(const std::string& why, const std::string& pointer)
{
    Error error{ErrorCode::kEditRefused, why, std::nullopt, false};
    if (!pointer.empty())
        error.field = pointer;
    if (!closed_)
        refuse(std::move(error));
}

bool Session::try_setting(
    RenderSettings& settings, const std::string& key, const nlohmann::json& value)
{
    if (!is_setting(key)) {
        refuse({ErrorCode::kUnknownSetting, "no setting is called '" + key + "'", key, false});
        return false;
    }
    try {
        RenderSettings changed = settings;
        set_setting(changed, key, value);
        if (const auto missing = what_is_missing(changed.effects, defaults_->description->effects);
            missing && changed.effects != settings.effects)
            throw SettingError("setting 'effects': " + *missing);
        settings = changed;
        return true;
    } catch (const SettingError& problem) {
        refuse({ErrorCode::kBadSetting, problem.what(), key, false});
        return false;
    }
}

std::optional<Extent> Session::checked_extent(std::uint32_t width, std::uint32_t height)
{
    if (std::optional<std::string> problem =
            refuse_extent(width, height, defaults_->max_dimension)) {
        refuse({ErrorCode::kOutOfRange, std::move(*problem), "size", false});
        return std::nullopt;
    }
    return Extent{static_cast<int>(width), static_cast<int>(height)};
}

void Session::refuse(Error error)
{
    effects_.push_back(effects::MessageRefused{error.message});
    effects_.push_back(effects::Say{std::move(error)});
    if (++refused_messages_ < kMaxRefusedMessages || closed_)
        return;
    effects_.push_back(effects::Say{Error{ErrorCode::kTooManyErrors,
        std::to_string(refused_messages_) + " messages were refused", std::nullopt, true}});
    close(CloseCode::kPolicy, "too many errors");
}

void Session::say_state()
{
    const RenderRequest& wishes = plan_->wishes();
    effects_.push_back(effects::Say{protocol::State{setting_values(wishes.settings),
        {static_cast<std::uint32_t>(wishes.extent.width),
            static_cast<std::uint32_t>(wishes.extent.height)},
        plan_->format()}});
}

// ---------------------------------------------------------------- how it ends

void Session::tick(Time now)
{
    if (closed_)
        return;
    if (!plan_ && now - opened_ >= defaults_->deadlines.hello)
        return close(CloseCode::kPolicy, "no hello");
    if (pacing_ && pacing_->oldest_wait(now) >= defaults_->deadlines.acknowledgement)
        close(CloseCode::kStalled, "no acknowledgement");
}

void Session::renderer_failed(const std::string& why)
{
    if (closed_)
        return;
    effects_.push_back(effects::Say{Error{ErrorCode::kRenderFailed, why, std::nullopt, true}});
    close(CloseCode::kRendererFailed, "the renderer failed");
}

void Session::shut_down(const std::string& reason, std::uint32_t reconnect_ms)
{
    if (closed_)
        return;
    effects_.push_back(effects::Say{protocol::ServerBye{reason, reconnect_ms}});
    close(CloseCode::kGoingAway, reason);
}

void Session::close(CloseCode code, std::string reason)
{
    if (closed_)
        return;
    closed_ = true;
    ready_.clear();
    slot_->take();
    effects_.push_back(effects::Close{code, std::move(reason)});
}

std::vector<SessionEffect> Session::take_effects()
{
    return std::exchange(effects_, {});
}

}  // namespace farlight
