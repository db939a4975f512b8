// Colour spaces of FLIP, and its distance of colours.
#pragma once

namespace farlight::client {

/// Three coordinates of a colour, or of a difference.
struct Color {
    double x = 0;
    double y = 0;
    double z = 0;
};

/// Linear sRGB to YCxCz, an opponent space that is linear in light, relative to D65 white.
Color ycxcz_of_linear(const Color& rgb);
/// The inverse, clamped to what a screen can show, [0, 1].
Color screen_of_ycxcz(const Color& ycxcz);
/// CIELAB with chroma scaled by lightness (Hunt effect).
Color hunt_lab_of_linear(const Color& rgb);
/// Distance for large differences. Source: Abasi, Tehran, Fairchild 2020, "Distance Metrics for
/// Very Large Color Differences".
double hyab(const Color& a, const Color& b);
/// Of filtered linear colours, mapped to [0, 1] (FLIP 2020, section 4.1.3).
double color_difference(const Color& test, const Color& reference);

}  // namespace farlight::client
