// Small pictures of scenes, what they are compared with, and shaders changed for a while.
#pragma once

#include "lab/case.h"
#include "lab/device_scene.h"
#include "lab/guards.h"

#include <cstddef>
#include <string>
#include <vector>

namespace farlight::lab {

struct Rendering {
    RenderSettings settings;
    Extent extent{48, 36};
    int frames = 1;
};

/// Four frames of `samples` a pixel, averaged; no path ends by chance.
Rendering averaged(int samples, bool light_sampling, int max_depth);

/// The last of its frames, and what was counted in all of them.
struct Drawn {
    Image image;
    BadValues counted;
};
Drawn drawn(const DeviceScene& scene, const Rendering& how);
Drawn drawn(const Scene& scene, const Rendering& how);

/// The last of its frames; NaN everywhere when a frame counted something that is not finite.
Image rendered(const DeviceScene& scene, const Rendering& how);
Image rendered(const Scene& scene, const Rendering& how);

/// Of any value.
double largest_off(const Image& image, double expected);
/// Of the mean.
double standard_errors_off(const Image& image, double expected);
/// Count of values whose bits differ; what is no number is like nothing.
double values_unlike(const std::vector<float>& a, const std::vector<float>& b);
double values_unlike(const Image& a, const Image& b);

/// Whether two pictures show the same, each with noise of its own.
struct Agreement {
    double standard_errors = 0;  ///< That the means differ by.
    double standard_error = 0;  ///< Of the difference, over the mean of the first.
    double least_p_value = 1;  ///< Of Student's test of any tile of 8x8 pixels.
    std::size_t tiles = 0;
};
Agreement agreement_of(const Image& a, const Image& b);
/// Means within 5 standard errors (one run in 1.7 million passes them), of which one is at most
/// `most_error` of the mean, and no tile that fewer than one run in a hundred has (Šidák).
void report_agreement(
    Findings& findings, const std::string& which, const Agreement& agreement, double most_error);

/// While it lives, shaders compiled anew have `instead` for `text` in `file`, where it stands once.
class ChangedShader {
public:
    ChangedShader(const std::string& file, const std::string& text, const std::string& instead);
    ~ChangedShader();
    ChangedShader(const ChangedShader&) = delete;
    ChangedShader& operator=(const ChangedShader&) = delete;

private:
    std::string file_;
    std::string before_;
};

}  // namespace farlight::lab
