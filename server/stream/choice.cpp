// Choices to settings and back, and their order.
#include "server/stream/choice.h"

#include <cmath>

namespace farlight {

Choice choice_of(const RenderSettings& settings)
{
    return {settings.resolution_scale, settings.samples_per_pixel, settings.atrous_iterations};
}

RenderSettings with_choice(RenderSettings settings, const Choice& choice)
{
    settings.resolution_scale = choice.resolution_scale;
    settings.samples_per_pixel = choice.samples_per_pixel;
    settings.atrous_iterations = choice.atrous_iterations;
    return settings;
}

std::string label_of(const Choice& choice, const Choice& usual)
{
    std::string label = std::to_string(choice.samples_per_pixel)
        + (choice.samples_per_pixel == 1 ? " sample" : " samples");
    if (choice.resolution_scale != 1)
        label = std::to_string(std::lround(100 * static_cast<double>(choice.resolution_scale)))
            + " % size, " + label;
    if (choice.atrous_iterations != usual.atrous_iterations)
        label += ", a-trous " + std::to_string(choice.atrous_iterations);
    return label;
}

double strength_of(const Choice& choice)
{
    const auto scale = static_cast<double>(choice.resolution_scale);
    return scale * scale * choice.samples_per_pixel * std::exp2(choice.atrous_iterations);
}

}  // namespace farlight
