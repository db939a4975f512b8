// Frame headers and inspections.
#include "server/stream/drawn_frame.h"

#include <algorithm>

namespace farlight {
namespace {

/// JPEG quality of a resting picture on its way to the lossless one.
constexpr int kRestingQuality = 90;
/// An estimate is a mean over pairs of frames: that of fewer frames at rest is not believed.
constexpr int kFramesToBelieve = 8;

std::uint32_t microseconds(double milliseconds)
{
    return static_cast<std::uint32_t>(std::clamp(milliseconds * 1000, 0.0, 4e9));
}

void put_errors(const FrameErrors& errors, protocol::FrameHeader& header)
{
    header.predicted_error = static_cast<float>(errors.predicted.value);
    header.predicted_lower = static_cast<float>(errors.predicted.lower);
    header.predicted_upper = static_cast<float>(errors.predicted.upper);
    header.measured_error = static_cast<float>(errors.measured.value);
    header.measured_lower = static_cast<float>(errors.measured.lower);
    header.measured_upper = static_cast<float>(errors.measured.upper);
    header.reference_samples = errors.reference_samples;
    header.effective_samples = static_cast<float>(errors.effective_samples);
    header.noise_error = static_cast<float>(errors.noise);
    header.raw_error = static_cast<float>(errors.raw);
}

void put_bad_values(const BadValues& met, protocol::FrameHeader& header)
{
    header.nonfinite_count = met.nonfinite();
    header.negative_count = met.of(BadKind::kNegative);
    header.clamped_count = met.of(BadKind::kClamped);
    for (const CountedStage& stage : kCountedStages)
        if (met.of(stage) > 0)
            header.stages.push_back({std::string(stage.name), met.of(stage, BadKind::kNan),
                met.of(stage, BadKind::kInfinite), met.of(stage, BadKind::kNegative),
                met.of(stage, BadKind::kClamped)});
}

}  // namespace

EncodeTask task_for(RenderedFrame&& frame, const Draw& draw,
    std::chrono::steady_clock::time_point begun, bool final)
{
    namespace flags = protocol::frame_flags;
    const bool still = draw.request.refine;
    EncodeTask task{std::move(frame.image), {}, draw.request.settings.jpeg_quality};
    protocol::FrameHeader& header = task.header;
    header.format = draw.format;
    if (still && draw.format == protocol::Format::kJpeg420) {
        header.format = protocol::Format::kJpeg444;
        task.jpeg_quality = std::max(task.jpeg_quality, kRestingQuality);
    }
    if (final && !is_lossless(draw.format))
        header.format = protocol::Format::kPng;
    const auto flag = [](bool set, std::uint16_t bit) { return set ? bit : std::uint16_t{0}; };
    header.flags = flag(still, flags::kStill) | flag(is_lossless(header.format), flags::kLossless)
        | flag(frame.history_reset, flags::kHistoryReset) | flag(final, flags::kConverged);
    header.camera_sequence = draw.camera_sequence;
    header.session_epoch = draw.session_epoch;
    header.accumulated_samples = frame.accumulated_samples;
    put_bad_values(frame.bad_values, header);
    header.scene_time = static_cast<float>(frame.time);
    if (draw.asked)
        header.wait_us =
            microseconds(std::chrono::duration<double, std::milli>(begun - *draw.asked).count());
    header.trace_us = microseconds(frame.trace_ms);
    header.denoise_us = microseconds(frame.denoise_ms);
    header.frame_us = microseconds(frame.frame_ms);
    header.samples_per_pixel = static_cast<std::uint16_t>(draw.request.settings.samples_per_pixel);
    put_errors(frame.errors, header);
    for (const PassTime& time : frame.pass_times)
        if (header.passes.size() < protocol::kMaxPasses)
            header.passes.push_back({time.pass, static_cast<float>(time.milliseconds)});
    return task;
}

DrawnCost cost_of(const RenderedFrame& frame, const Draw& draw)
{
    const ErrorEstimate& predicted = frame.errors.predicted;
    return {choice_of(draw.request.settings), frame.trace_ms, frame.denoise_ms,
        {predicted.value, predicted.lower, predicted.upper, frame.errors.noise}};
}

bool is_final(const RenderedFrame& frame, const Draw& draw)
{
    const auto target = static_cast<double>(draw.request.settings.target_error);
    const bool believed = frame.accumulated_samples
        >= static_cast<std::uint32_t>(kFramesToBelieve * draw.request.settings.samples_per_pixel);
    return frame.converged || (target > 0 && believed && frame.errors.predicted.upper <= target);
}

protocol::Inspection inspection_of(const RenderedFrame& frame)
{
    protocol::Inspection inspection;
    for (const std::string_view name : (frame.effects | mask_of(frame.by_settings)).names())
        inspection.program.emplace_back(name);
    for (const ActiveEffect& effect : frame.by_settings)
        inspection.effects.push_back(
            {std::string(effect.name), effect.reason, std::string(setting_of(effect.name))});
    for (const auto& [name, value] : frame.constants)
        inspection.constants.push_back({name, static_cast<std::uint64_t>(value)});
    inspection.general = frame.effects == EffectMask::general();
    for (const PassTime& time : frame.pass_times)
        inspection.passes.push_back(time.pass);
    for (const auto& [name, bytes] : frame.memory)
        inspection.view_memory.push_back({name, bytes});
    inspection.compile_ms = frame.compile_ms;
    return inspection;
}

}  // namespace farlight
