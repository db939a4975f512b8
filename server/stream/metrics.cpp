// Metrics: see the header.
#include "server/stream/metrics.h"

#include <filesystem>
#include <fstream>
#include <prometheus/text_serializer.h>
#include <unistd.h>

namespace farlight {
namespace {

prometheus::Gauge& gauge(
    prometheus::Registry& registry, const std::string& name, const std::string& help)
{
    return prometheus::BuildGauge().Name(name).Help(help).Register(registry).Add({});
}

prometheus::Family<prometheus::Counter>& counters(
    prometheus::Registry& registry, const std::string& name, const std::string& help)
{
    return prometheus::BuildCounter().Name(name).Help(help).Register(registry);
}

prometheus::Histogram& seconds_histogram(
    prometheus::Registry& registry, const std::string& name, const std::string& help)
{
    return prometheus::BuildHistogram().Name(name).Help(help).Register(registry).Add({},
        prometheus::Histogram::BucketBoundaries{
            .001, .002, .005, .01, .02, .05, .1, .2, .5, 1, 2, 5, 10});
}

/// Resident memory of this process [bytes]; 0 where /proc does not tell.
double resident_bytes()
{
    std::ifstream statm("/proc/self/statm");
    double total_pages = 0;
    double resident_pages = 0;
    statm >> total_pages >> resident_pages;
    return resident_pages * static_cast<double>(sysconf(_SC_PAGESIZE));
}

double open_file_descriptors()
{
    std::error_code error;
    std::filesystem::directory_iterator descriptors("/proc/self/fd", error);
    return error ? 0 : static_cast<double>(std::distance(begin(descriptors), end(descriptors)));
}

/// To a number counted elsewhere, which only grows.
void raise_to(prometheus::Counter& counter, std::uint64_t value)
{
    counter.Increment(static_cast<double>(value) - counter.Value());
}

double seconds(std::chrono::steady_clock::duration duration)
{
    return std::chrono::duration<double>(duration).count();
}

}  // namespace

Metrics::Metrics(const RendererDescription& description)
    : connections_(gauge(registry_, "farlight_connections", "Open WebSocket connections"))
    , frames_in_flight_(gauge(registry_, "farlight_inflight_frames",
          "Frames asked for and not yet acknowledged, all clients together"))
    , resident_memory_(gauge(registry_, "process_resident_memory_bytes", "Resident memory"))
    , open_fds_(gauge(registry_, "process_open_fds", "Open file descriptors"))
    , frames_rendered_(
          counters(registry_, "farlight_frames_rendered_total", "Frames drawn").Add({}))
    , frames_sent_(counters(registry_, "farlight_frames_sent_total", "Frames sent").Add({}))
    , sent_bytes_(counters(registry_, "farlight_sent_bytes_total", "Bytes of frames sent").Add({}))
    , messages_refused_(counters(registry_, "farlight_messages_refused_total",
          "Client messages that were garbage or had no effect")
                            .Add({}))
    , controller_steps_(counters(registry_, "farlight_controller_steps_total",
          "Times that another choice of settings was taken to keep a budget")
                            .Add({}))
    , render_seconds_(seconds_histogram(
          registry_, "farlight_render_seconds", "Drawing one frame: tracing and denoising"))
    , encode_seconds_(seconds_histogram(registry_, "farlight_encode_seconds", "Encoding one frame"))
    , ack_rtt_seconds_(seconds_histogram(registry_, "farlight_ack_rtt_seconds",
          "From handing a frame to the socket to its acknowledgement"))
    , input_to_ack_seconds_(seconds_histogram(registry_, "farlight_input_to_ack_seconds",
          "From a client's message to the acknowledgement of the frame that shows it"))
    , frames_encoded_(counters(registry_, "farlight_frames_encoded_total", "Frames encoded"))
    , frames_dropped_(
          counters(registry_, "farlight_frames_dropped_total", "Frames drawn and never sent"))
    , closes_(counters(registry_, "farlight_closes_total", "Connections ended, by close code"))
    , handshakes_rejected_(
          counters(registry_, "farlight_handshake_rejected_total", "WebSocket upgrades refused"))
    , bad_values_(counters(registry_, "farlight_bad_values_total",
          "Pixels in which a stage met NaN, infinite, negative or clamped values, all frames "
          "together"))
{
    prometheus::BuildGauge()
        .Name("farlight_build_info")
        .Help("Always 1; the labels tell")
        .Register(registry_)
        .Add({{"version", FARLIGHT_VERSION}, {"gl_renderer", description.gl_renderer}})
        .Set(1);
}

void Metrics::connection_opened()
{
    connections_.Increment();
}

void Metrics::connection_closed(int code)
{
    connections_.Decrement();
    // A peer may send any code: those beyond the documented ones share a label.
    const bool known = (code >= 1000 && code <= 1013) || code == 4008;
    closes_.Add({{"code", known ? std::to_string(code) : "other"}}).Increment();
}

void Metrics::handshake_rejected(const std::string& reason)
{
    handshakes_rejected_.Add({{"reason", reason}}).Increment();
}

void Metrics::message_refused()
{
    messages_refused_.Increment();
}

void Metrics::controller_stepped(std::uint64_t times)
{
    controller_steps_.Increment(static_cast<double>(times));
}

void Metrics::frame_drawn(double seconds)
{
    render_seconds_.Observe(seconds);
}

void Metrics::frame_encoded(protocol::Format format, double seconds)
{
    frames_encoded_.Add({{"format", std::string(protocol::name_of(format))}}).Increment();
    encode_seconds_.Observe(seconds);
}

void Metrics::frame_sent(std::size_t bytes)
{
    frames_sent_.Increment();
    sent_bytes_.Increment(static_cast<double>(bytes));
}

void Metrics::frame_dropped(std::string_view reason)
{
    frames_dropped_.Add({{"reason", std::string(reason)}}).Increment();
}

void Metrics::frame_acknowledged(const Pacing::Acknowledgement& times)
{
    ack_rtt_seconds_.Observe(seconds(times.round_trip));
    if (times.since_asked)
        input_to_ack_seconds_.Observe(seconds(*times.since_asked));
}

std::string Metrics::text(const RenderService& renderer, int frames_in_flight)
{
    raise_to(frames_rendered_, renderer.frames_rendered());
    const BadValueTotals met = renderer.bad_values();
    for (const CountedStage& stage : kCountedStages)
        for (const BadKindRow& row : kBadKinds)
            raise_to(bad_values_.Add(
                         {{"stage", std::string(stage.name)}, {"kind", std::string(row.name)}}),
                met.of(stage, row.kind));
    frames_in_flight_.Set(frames_in_flight);
    resident_memory_.Set(resident_bytes());
    open_fds_.Set(open_file_descriptors());
    return prometheus::TextSerializer().Serialize(registry_.Collect());
}

}  // namespace farlight
