// Playing a script on a server: every run, its repetition where asked for, and the reference.
#pragma once

#include "client/metrics/temporal.h"
#include "client/script/script.h"
#include "client/session.h"

#include <functional>
#include <map>

namespace farlight::client {

/// What is remembered of one frame.
struct FrameFacts {
    std::uint64_t nonfinite = 0;  ///< Counted on the server plus those in the values received.
    std::uint64_t hash = 0;  ///< Of the payload.
    std::uint32_t samples = 0;
    bool history_reset = false;
};

/// Frames from one on, to the last.
struct PlayedSequence {
    FlickerMeter meter;
    std::size_t nonfinite = 0;  ///< Values of frames that therefore are not in the meter.
};

struct PlayedRun {
    std::vector<FrameFacts> frames;
    std::vector<FrameFacts> again;  ///< The second time; empty when nobody asked.
    std::map<int, Picture> pictures;  ///< The last frame and those an expectation is of.
    std::map<int, PlayedSequence> sequences;  ///< By the first frame, as expectations name them.
    std::vector<std::uint8_t> revealed;  ///< In the last frame; empty when nobody asked.
};

struct Played {
    std::map<std::string, PlayedRun> runs;
    std::optional<Picture> reference;
};

/// Called before each part with a line for people, as "svgf: 32 frames".
using Progress = std::function<void(const std::string&)>;

/// Each run and the reference are a lockstep session of their own, in raw linear frames.
/// Throws ConnectionError, SessionError; InputError where the server refuses what the script asks
/// for.
Played play(const Script& script, const Url& url, const Progress& progress);

}  // namespace farlight::client
