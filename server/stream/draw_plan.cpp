// DrawPlan: see the header.
#include "server/stream/draw_plan.h"

#include "server/stream/encoder.h"

#include <utility>

namespace farlight {

std::optional<std::string> refuse_extent(
    std::uint64_t width, std::uint64_t height, int max_dimension)
{
    const auto limit = static_cast<std::uint64_t>(max_dimension);
    if (width >= 1 && height >= 1 && width <= limit && height <= limit
        && width * height <= static_cast<std::uint64_t>(kMostPixels))
        return std::nullopt;
    const auto text = [](std::uint64_t w, std::uint64_t h) {
        return std::to_string(w) + "x" + std::to_string(h);
    };
    return "size is " + text(width, height) + ", expected 1x1 to " + text(limit, limit)
        + " and at most " + std::to_string(kMostPixels) + " pixels";
}

DrawPlan::DrawPlan(
    protocol::Mode mode, const RenderRequest& first, protocol::Format format, Time now)
    : mode_(mode)
    , wishes_(first)
    , format_(format)
    , time_(static_cast<double>(first.settings.time))
    , clock_start_(now)
    , changed_(now)
{
    wishes_.format = pixel_format_for(format);
}

bool DrawPlan::move_camera(const CameraPose& pose, std::uint32_t sequence, bool cut, Time now)
{
    if (mode_ == protocol::Mode::kLockstep && queue_.size() >= protocol::kLockstepQueue)
        return false;
    camera_sequence_ = sequence;
    wishes_.camera = pose;
    wishes_.reset_history = wishes_.reset_history || cut;
    change(now);
    if (mode_ == protocol::Mode::kLockstep) {
        queue_.push_back(draw_of_wishes(now));
        wishes_.reset_history = false;
        if (wishes_.settings.play)
            time_ += static_cast<double>(wishes_.settings.time_step);
    }
    return true;
}

void DrawPlan::set_settings(const RenderSettings& settings, Time now)
{
    const bool at_rest =
        planned_version_ == version_ ? unchanged_frames_ >= kFramesUntilRest : rests_on_;
    time_ = time_at(now);
    clock_start_ = now;
    wishes_.settings = settings;
    change(now);
    rests_on_ = at_rest;
}

void DrawPlan::go_to_time(Time now)
{
    time_ = static_cast<double>(wishes_.settings.time);
    clock_start_ = now;
    change(now);
}

void DrawPlan::set_extent(Extent extent, Time now)
{
    wishes_.extent = extent;
    ++session_epoch_;
    change(now);
}

void DrawPlan::set_format(protocol::Format format, Time now)
{
    format_ = format;
    wishes_.format = pixel_format_for(format);
    change(now);
}

void DrawPlan::change_scene(Time now)
{
    ++session_epoch_;
    change(now);
}

std::optional<Draw> DrawPlan::next()
{
    if (mode_ == protocol::Mode::kLockstep) {
        if (queue_.empty())
            return std::nullopt;
        Draw draw = queue_.front();
        queue_.pop_front();
        return draw;
    }
    if (planned_version_ != version_) {
        Draw draw = draw_of_wishes(changed_);
        draw.request.refine = rests_on_ && !plays();
        plan_instead(draw);
        return draw;
    }
    if (final_version_ == version_)
        return std::nullopt;
    ++unchanged_frames_;
    Draw draw = draw_of_wishes(std::nullopt);
    draw.request.refine = unchanged_frames_ >= kFramesUntilRest && !plays();
    return draw;
}

std::optional<Draw> DrawPlan::newer_than(const Draw& stale) const
{
    if (mode_ == protocol::Mode::kLockstep || planned_version_ == version_)
        return std::nullopt;
    Draw newer = draw_of_wishes(changed_);
    newer.request.reset_history |= stale.request.reset_history;
    newer.request.refine = rests_on_ && !plays();
    return newer;
}

void DrawPlan::plan_instead(const Draw& newer)
{
    planned_version_ = newer.version;
    unchanged_frames_ = newer.request.refine ? kFramesUntilRest : 0;
    wishes_.reset_history = false;
}

void DrawPlan::settle(const Draw& draw)
{
    final_version_ = draw.version;
}

bool DrawPlan::repeats_final(const Draw& draw) const
{
    return mode_ == protocol::Mode::kInteractive && draw.version == final_version_;
}

double DrawPlan::time_at(Time now) const
{
    if (mode_ == protocol::Mode::kLockstep || !wishes_.settings.play)
        return time_;
    return time_ + std::chrono::duration<double>(now - clock_start_).count();
}

void DrawPlan::change(Time now)
{
    ++version_;
    changed_ = now;
    rests_on_ = false;
}

Draw DrawPlan::draw_of_wishes(std::optional<Time> asked) const
{
    Draw draw{wishes_, format_, camera_sequence_, session_epoch_, version_, asked, false};
    draw.request.time = time_;
    draw.request.live = mode_ == protocol::Mode::kInteractive && !asked;
    if (mode_ == protocol::Mode::kInteractive && wishes_.settings.play)
        draw.request.clock_start = clock_start_;
    return draw;
}

}  // namespace farlight
