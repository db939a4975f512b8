// DrawPlan: what one client wants drawn next. Pure logic: no threads, no clock, no sockets.
//
// Interactive: the newest camera wins; a resting picture is drawn again and again, refined, until
// the renderer calls it converged, then nothing until something changes; settings may change
// without stirring it. Lockstep: one frame for
// each camera message, in order, none left out. A scene that moves follows the clock, in lockstep
// the settings' step a frame, so that a recording can be repeated.
#pragma once

#include "protocol/messages.h"
#include "server/render/renderer.h"

#include <chrono>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>

namespace farlight {

/// Frames of an unmoved camera after which the picture counts as resting and is refined.
constexpr int kFramesUntilRest = 2;

/// Larger pictures than 8K are refused whatever the device: a frame must fit a sane amount of
/// memory.
constexpr std::int64_t kMostPixels = 7680LL * 4320;

/// Why a picture of this size cannot be drawn, or nothing.
std::optional<std::string> refuse_extent(
    std::uint64_t width, std::uint64_t height, int max_dimension);

/// One frame to be drawn, and how to label it.
struct Draw {
    using Time = std::chrono::steady_clock::time_point;

    RenderRequest request;
    protocol::Format format = protocol::Format::kJpeg420;  ///< What the client asked for.
    std::uint32_t camera_sequence = 0;
    std::uint32_t session_epoch = 0;
    std::uint64_t version = 0;  ///< Of the wishes it was made from.
    std::optional<Time> asked;  ///< Arrival of the message that asked for it; none when refining.
    bool by_rung = false;  ///< A controller's rung lies over what the client asked for.
};

class DrawPlan {
public:
    using Time = Draw::Time;

    /// `first` is what to draw before any message changes it.
    DrawPlan(protocol::Mode mode, const RenderRequest& first, protocol::Format format, Time now);

    protocol::Mode mode() const { return mode_; }
    const RenderRequest& wishes() const { return wishes_; }
    protocol::Format format() const { return format_; }
    std::uint32_t session_epoch() const { return session_epoch_; }

    /// False: lockstep, and kLockstepQueue cameras wait already; the message is dropped.
    bool move_camera(const CameraPose& pose, std::uint32_t sequence, bool cut, Time now);
    void set_settings(const RenderSettings& settings, Time now);
    /// To the moment that the settings name, wherever the clock has come to.
    void go_to_time(Time now);
    void set_extent(Extent extent, Time now);
    void set_format(protocol::Format format, Time now);
    /// The same wishes of another scene.
    void change_scene(Time now);

    /// Whether the scene follows time, as the last frame knew: while it plays it never rests.
    void scene_moves(bool moves) { moves_ = moves; }

    /// The next frame worth drawing, or nothing. Each call counts as a frame drawn.
    std::optional<Draw> next();
    /// Interactive: what should be drawn in place of `stale`, planned but not begun, if anything
    /// changed since. It counts once plan_instead() says that it is to be drawn.
    std::optional<Draw> newer_than(const Draw& stale) const;
    void plan_instead(const Draw& newer);

    /// The frame drawn for `draw` is final: nothing more is planned until something changes.
    void settle(const Draw& draw);
    /// Nothing changed since `draw` was planned.
    bool is_current(const Draw& draw) const { return draw.version == version_; }
    /// `draw` would only repeat the final picture already drawn.
    bool repeats_final(const Draw& draw) const;

private:
    bool plays() const { return moves_ && wishes_.settings.play; }
    double time_at(Time now) const;
    void change(Time now);
    Draw draw_of_wishes(std::optional<Time> asked) const;

    protocol::Mode mode_;
    RenderRequest wishes_;
    protocol::Format format_;
    std::uint32_t camera_sequence_ = 0;
    std::uint32_t session_epoch_ = 1;

    double time_ = 0;  ///< Of the scene [s]: next frame's in lockstep, else at clock_start_.
    Time clock_start_;
    bool moves_ = false;

    std::uint64_t version_ = 1;  ///< Counts changes.
    std::uint64_t planned_version_ = 0;
    std::uint64_t final_version_ = 0;
    int unchanged_frames_ = 0;
    bool rests_on_ = false;  ///< It rested, and only settings have changed since.
    Time changed_;

    std::deque<Draw> queue_;  ///< Lockstep.
};

}  // namespace farlight
