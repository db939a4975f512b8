// Equations of FLIP's colour pipeline (Andersson et al. 2020, section 4.1).
#include "client/metrics/flip_color.h"

#include <algorithm>
#include <cmath>

namespace farlight::client {
namespace {

constexpr double kColorExponent = 0.7;  // q_c
constexpr double kKnee = 0.4;  // p_c: share of the largest distance ...
constexpr double kKneeError = 0.95;  // p_t: ... that is mapped to this error

/// XYZ relative to white. The matrix is that of the primaries and white of sRGB in exact fractions;
/// its rows sum to the white point.
Color relative_xyz(const Color& rgb)
{
    const Color xyz{(10135552 * rgb.x + 8788810 * rgb.y + 4435075 * rgb.z) / 24577794,
        (2613072 * rgb.x + 8788810 * rgb.y + 887015 * rgb.z) / 12288897,
        (1425312 * rgb.x + 8788810 * rgb.y + 70074185 * rgb.z) / 73733382};
    constexpr double kWhiteX = (10135552.0 + 8788810.0 + 4435075.0) / 24577794.0;
    constexpr double kWhiteZ = (1425312.0 + 8788810.0 + 70074185.0) / 73733382.0;
    return {xyz.x / kWhiteX, xyz.y, xyz.z / kWhiteZ};
}

/// The inverse of relative_xyz(): that of the exact matrix, times white.
Color linear_of_relative_xyz(const Color& xyz)
{
    const double x = 0.950428545 * xyz.x;
    const double y = xyz.y;
    const double z = 1.088900371 * xyz.z;
    return {3.241003275 * x - 1.537398934 * y - 0.498615861 * z,
        -0.969224334 * x + 1.875930071 * y + 0.041554224 * z,
        0.055639423 * x - 0.204011202 * y + 1.057148933 * z};
}

/// CIE 15:2004, equation 8.
double lab_curve(double t)
{
    constexpr double kDelta = 6.0 / 29;
    return t > kDelta * kDelta * kDelta ? std::cbrt(t) : t / (3 * kDelta * kDelta) + 4.0 / 29;
}

double powered_distance(const Color& a, const Color& b)
{
    return std::pow(hyab(hunt_lab_of_linear(a), hunt_lab_of_linear(b)), kColorExponent);
}

}  // namespace

Color ycxcz_of_linear(const Color& rgb)
{
    const Color xyz = relative_xyz(rgb);
    return {116 * xyz.y - 16, 500 * (xyz.x - xyz.y), 200 * (xyz.y - xyz.z)};
}

Color screen_of_ycxcz(const Color& ycxcz)
{
    const double y = (ycxcz.x + 16) / 116;
    const Color rgb = linear_of_relative_xyz({y + ycxcz.y / 500, y, y - ycxcz.z / 200});
    return {std::clamp(rgb.x, 0.0, 1.0), std::clamp(rgb.y, 0.0, 1.0), std::clamp(rgb.z, 0.0, 1.0)};
}

Color hunt_lab_of_linear(const Color& rgb)
{
    const Color xyz = relative_xyz(rgb);
    const Color f{lab_curve(xyz.x), lab_curve(xyz.y), lab_curve(xyz.z)};
    const double lightness = 116 * f.y - 16;
    const double hunt = 0.01 * lightness;
    return {lightness, hunt * 500 * (f.x - f.y), hunt * 200 * (f.y - f.z)};
}

double hyab(const Color& a, const Color& b)
{
    return std::abs(a.x - b.x) + std::hypot(a.y - b.y, a.z - b.z);
}

double color_difference(const Color& test, const Color& reference)
{
    static const double largest = powered_distance({0, 1, 0}, {0, 0, 1});  // green and blue
    const double knee = kKnee * largest;
    const double distance = powered_distance(test, reference);
    return distance < knee ? kKneeError / knee * distance
                           : kKneeError + (distance - knee) / (largest - knee) * (1 - kKneeError);
}

}  // namespace farlight::client
