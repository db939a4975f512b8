// Choice: the settings that trade time for accuracy while a camera moves, and void no history.
#pragma once

#include "server/render/settings.h"

#include <string>

namespace farlight {

struct Choice {
    float resolution_scale = 1;
    int samples_per_pixel = 1;
    int atrous_iterations = 5;

    bool operator==(const Choice&) const = default;
};

/// The keys of the three, as in RenderSettings.
constexpr std::string_view kChoiceKeys[] = {
    "resolution_scale", "samples_per_pixel", "atrous_iterations"};

Choice choice_of(const RenderSettings& settings);
RenderSettings with_choice(RenderSettings settings, const Choice& choice);

/// For people; `usual` is what they get without saying: "50 % size, 1 sample".
std::string label_of(const Choice& choice, const Choice& usual);

/// How many samples the filter can average for a pixel that is shown, up to a factor: the samples
/// drawn for it, and twice as many with each level of the filter. In a flat area a level leaves a
/// quarter of the noise and not half; edges, which it does not cross, halve that. What is lost of
/// the detail in a smaller picture counts as if the missing samples were noise.
double strength_of(const Choice& choice);

}  // namespace farlight
