// The rungs that a controller moves along: choices from cheap to dear, each dearer one with less
// error than those before.
#pragma once

#include "server/stream/choice.h"
#include "server/stream/rung_errors.h"

#include <optional>
#include <vector>

namespace farlight {

struct Rung {
    Choice choice;
    std::string label;
    double ms = 0;  ///< A frame, tracing and denoising; 0: not known.
    std::optional<RungError> error;  ///< relMSE; of a report as measured there, else while moving.
};

/// What to choose among where no report tells. First smaller pictures, then more samples of the
/// whole one: of two choices with as many samples the larger picture shows more, which estimates
/// of noise do not tell. Pixels and samples grow by at most half from rung to rung, so that a
/// budget finds a rung that uses two thirds of it; the first ones also filter less.
/// `most_samples`: of a pixel of the whole picture, as a frame has to end.
std::vector<Choice> candidate_choices(const RenderSettings& wishes, int most_samples);

/// Those that no other is both cheaper and better than, in the order of ms. Where errors are not
/// known, strength stands for them.
std::vector<Rung> frontier_of(std::vector<Rung> rungs);

}  // namespace farlight
