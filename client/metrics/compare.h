// Two pictures by every metric that speaks of two pictures.
#pragma once

#include "client/metrics/display.h"
#include "client/metrics/flip.h"
#include "client/metrics/metric_table.h"
#include "client/picture.h"

#include <optional>
#include <string_view>
#include <vector>

namespace farlight::client {

struct CompareOptions {
    DisplayOptions display;  ///< Of linear pictures; display values are as they are.
    double pixels_per_degree = kPixelsPerDegree;
};

/// A picture both as light and as shown. Display values are decoded to light in [0, 1], in which
/// exposure and tone curve remain.
struct Appearance {
    ImageSize size;
    std::vector<float> linear;
    std::vector<float> display;
    bool is_light = false;  ///< `linear` is the original, else `display` is.
};
Appearance appearance_of(const Picture& picture, const DisplayOptions& options = {});

struct MetricValue {
    std::string_view name;  ///< A row of kMetrics.
    double value = 0;
};

struct PictureComparison {
    std::vector<MetricValue> values;  ///< In the order of the table; hdr_flip of light only.
    std::vector<float> flip_map;  ///< LDR-FLIP of each pixel.
    Pooled flip;
    std::optional<Pooled> hdr_flip;
};

/// Throws MetricError where sizes or kinds differ, and before anything is averaged when a value is
/// not finite; FLIP and SSIM look at a pixel's neighbours, so here those that do not count too.
PictureComparison compare(const Appearance& test, const Appearance& reference,
    const CompareOptions& options = {}, Mask mask = {});

/// One of them alone. Throws likewise.
double metric_value(std::string_view name, const Appearance& test, const Appearance& reference,
    const CompareOptions& options = {}, Mask mask = {});

}  // namespace farlight::client
