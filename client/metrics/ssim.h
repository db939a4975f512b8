// Structural similarity. Source: Wang, Bovik, Sheikh, Simoncelli 2004, "Image Quality Assessment:
// From Error Visibility to Structural Similarity", equation 13, on windows that lie within the
// picture, as in the authors' implementation.
#pragma once

#include "client/metrics/metrics.h"

namespace farlight::client {

constexpr int kSsimWindow = 11;  // [px], either way

/// Mean over the windows whose middle counts, of the luminance of display values in [0, 1], three a
/// pixel. A window sees neighbours that do not count. Throws MetricError, also for a picture that
/// is smaller than a window.
double structural_similarity(
    std::span<const float> test, std::span<const float> reference, ImageSize size, Mask mask = {});

}  // namespace farlight::client
