// Session: see the header. Messages first, then the way of a frame, then how a session ends.
#include "server/stream/session.h"

#include "server/stream/drawn_frame.h"
#include "server/stream/welcome.h"

#include <algorithm>
#include <cassert>

namespace farlight {
namespace {

using protocol::Error;
using protocol::ErrorCode;
using protocol::Mode;

/// Frames of one client under way may hold this many bytes; one frame may always be under way.
constexpr std::int64_t kMostBytesInFlight = 256LL << 20U;

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

// ---------------------------------------------------------------- the way of a frame

bool Session::may_start() const
{
    const Extent extent = plan_->wishes().extent;
    const std::int64_t frame_bytes = static_cast<std::int64_t>(extent.width) * extent.height
        * static_cast<std::int64_t>(bytes_per_pixel(plan_->wishes().format));
    return pacing_->may_start()
        && (pacing_->in_flight() == 0
            || (pacing_->in_flight() + 1) * frame_bytes <= kMostBytesInFlight)
        && (plan_->mode() == Mode::kLockstep || ready_.empty());
}

void Session::plan_drawing()
{
    if (!plan_ || closed_)
        return;
    if (slot_->waiting()) {
        const std::optional<Draw> newer = plan_->newer_than(drawing_.back());
        if (newer && slot_->replace(newer->request)) {
            plan_->plan_instead(*newer);
            drawing_.back() = *newer;
        }
    }
    while (!slot_->waiting() && may_start()) {
        const std::optional<Draw> draw = plan_->next();
        if (!draw)
            return;
        pacing_->started();
        drawing_.push_back(*draw);
        slot_->put(draw->request);
        effects_.push_back(effects::WakeRenderer{});
    }
}

void Session::renderer_took_request()
{
    plan_drawing();
}

void Session::drawn(RenderedFrame frame, Time begun)
{
    assert(!drawing_.empty());
    const Draw draw = drawing_.front();
    drawing_.pop_front();
    if (closed_)
        return;
    if (!frame.error.empty())
        return renderer_failed(frame.error);
    plan_->scene_moves(frame.moves);
    last_frame_ = inspection_of(frame);
    if (plan_->repeats_final(draw)) {
        drop_frame("repeats_final");
        return plan_drawing();
    }
    if (frame.converged && draw.request.refine && plan_->is_current(draw)) {
        plan_->settle(draw);
        if (slot_->take()) {  // Planned before anybody knew that this one would be final.
            drawing_.pop_back();
            pacing_->dropped();
        }
    }
    effects_.push_back(
        effects::Encode{task_for(std::move(frame), draw, begun, plan_->repeats_final(draw))});
    encoding_.push_back(draw.asked);
    plan_drawing();
}

void Session::encoded(EncodedFrame frame)
{
    assert(!encoding_.empty());
    const std::optional<Time> asked = encoding_.front();
    encoding_.pop_front();
    if (closed_)
        return;
    if (!frame.error.empty())
        return renderer_failed(frame.error);
    if (plan_->mode() == Mode::kInteractive && !ready_.empty()) {
        ready_.pop_front();
        drop_frame("overtaken");
    }
    ready_.push_back({std::move(frame), asked});
}

std::optional<OutgoingFrame> Session::take_frame(Time now)
{
    if (ready_.empty() || closed_)
        return std::nullopt;
    ReadyFrame ready = std::move(ready_.front());
    ready_.pop_front();
    ready.frame.header.frame_id = ++last_frame_id_;
    pacing_->sent(last_frame_id_, now, ready.asked);
    plan_drawing();
    return OutgoingFrame{encode_frame_header(ready.frame.header), std::move(ready.frame.payload)};
}

void Session::frame_written(Time now)
{
    if (pacing_)
        pacing_->written(last_frame_id_, now);
}

void Session::drop_frame(std::string_view why)
{
    pacing_->dropped();
    effects_.push_back(effects::FrameDropped{why});
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
