// Pacing: see the header.
#include "server/stream/pacing.h"

#include "server/host_guard.h"

#include <algorithm>
#include <cassert>

namespace farlight {
namespace {

const HostGuard ids_wrap_round("ids_wrap_round");

/// Whether `id` was counted after `other`: ids wrap round, and at most 2^31 lie between two.
/// Source: RFC 1982, section 3.2.
bool is_after(std::uint32_t id, std::uint32_t other)
{
    return ids_wrap_round ? static_cast<std::int32_t>(id - other) > 0 : id > other;
}

}  // namespace

Pacing::Pacing(int window, std::uint32_t last_sent) : window_(window), last_sent_(last_sent)
{
    assert(window >= 1 && window <= static_cast<int>(protocol::kMaxInFlight));
}

void Pacing::started()
{
    assert(may_start());
    ++preparing_;
}

void Pacing::dropped()
{
    assert(preparing_ > 0);
    --preparing_;
}

void Pacing::sent(std::uint32_t frame_id, Time now, std::optional<Time> asked)
{
    assert(preparing_ > 0 && frame_id == last_sent_ + 1);
    --preparing_;
    last_sent_ = frame_id;
    unacknowledged_.push_back({frame_id, now, asked, std::nullopt});
}

void Pacing::written(std::uint32_t frame_id, Time now)
{
    const auto frame = std::find_if(unacknowledged_.begin(), unacknowledged_.end(),
        [&](const Sent& sent) { return sent.frame_id == frame_id; });
    if (frame != unacknowledged_.end())  // A quick client may have acknowledged it already.
        frame->written = now;
}

std::optional<Pacing::Acknowledgement> Pacing::acknowledge(std::uint32_t frame_id, Time now)
{
    if (is_after(frame_id, last_sent_))
        return std::nullopt;
    std::optional<Acknowledgement> result;
    while (!unacknowledged_.empty() && !is_after(unacknowledged_.front().frame_id, frame_id)) {
        const Sent& shown = unacknowledged_.front();
        result = {now - shown.sent, std::nullopt};
        if (shown.asked)
            result->since_asked = now - *shown.asked;
        unacknowledged_.pop_front();
    }
    return result;
}

std::chrono::steady_clock::duration Pacing::oldest_wait(Time now) const
{
    if (unacknowledged_.empty() || !unacknowledged_.front().written)
        return {};
    return now - *unacknowledged_.front().written;
}

}  // namespace farlight
