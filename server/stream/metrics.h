// Metrics: what /metrics tells, in Prometheus' words. Thread-safe.
#pragma once

#include "protocol/messages.h"
#include "server/stream/pacing.h"
#include "server/stream/render_service.h"

#include <prometheus/counter.h>
#include <prometheus/gauge.h>
#include <prometheus/histogram.h>
#include <prometheus/registry.h>
#include <string>
#include <string_view>

namespace farlight {

class Metrics {
public:
    explicit Metrics(const RendererDescription& description);

    void connection_opened();
    void connection_closed(int code);
    void handshake_rejected(const std::string& reason);
    void message_refused();
    void controller_stepped(std::uint64_t times);
    void frame_drawn(double seconds);
    void frame_encoded(protocol::Format format, double seconds);
    void frame_sent(std::size_t bytes);
    void frame_dropped(std::string_view reason);
    void frame_acknowledged(const Pacing::Acknowledgement& times);

    /// The text of /metrics, with what only the caller knows filled in.
    std::string text(const RenderService& renderer, int frames_in_flight);

private:
    prometheus::Registry registry_;
    prometheus::Gauge& connections_;
    prometheus::Gauge& frames_in_flight_;
    prometheus::Gauge& resident_memory_;
    prometheus::Gauge& open_fds_;
    prometheus::Counter& frames_rendered_;
    prometheus::Counter& frames_sent_;
    prometheus::Counter& sent_bytes_;
    prometheus::Counter& messages_refused_;
    prometheus::Counter& controller_steps_;
    prometheus::Histogram& render_seconds_;
    prometheus::Histogram& encode_seconds_;
    prometheus::Histogram& ack_rtt_seconds_;
    prometheus::Histogram& input_to_ack_seconds_;
    prometheus::Family<prometheus::Counter>& frames_encoded_;
    prometheus::Family<prometheus::Counter>& frames_dropped_;
    prometheus::Family<prometheus::Counter>& closes_;
    prometheus::Family<prometheus::Counter>& handshakes_rejected_;
    prometheus::Family<prometheus::Counter>& bad_values_;
};

}  // namespace farlight
