// The filter: what is constant stays so, what is noisy keeps its mean and its variance, and nothing
// leaks.
#include "lab/filter_bench.h"
#include "lab/groups.h"
#include "lab/whole_filter.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <limits>
#include <random>

namespace farlight::lab {
namespace {

glm::uvec4 wall_everywhere(int /*x*/, int /*y*/)
{
    return wall_at(kWallDepth);
}

Texels texels_of(const std::function<glm::vec3(int x, int y)>& value)
{
    Texels texels;
    for_pixels([&](int x, int y) { texels.emplace_back(value(x, y), 0); });
    return texels;
}

/// A mean and a variance of luminance in 32 bits over time: E[x^2] - E[x]^2 of them is less than
/// nothing in a quarter of the frames where they hardly vary. Welford 1962 in double precision,
/// with the same weights, is the oracle.
void variance_is_never_negative(Findings& findings, Length length)
{
    const std::unique_ptr<PassBench> bench = filter_bench("temporal", kFiltered);
    const auto pixels = place_of(0, kFiltered.height);
    std::vector<double> mean(pixels);
    std::vector<double> variance(pixels);
    std::mt19937 random(11);
    std::normal_distribution<float> normal(0, 1);
    const int frames = length == Length::kLong ? 4096 : 256;
    double off = 0;
    int negative = 0;
    for (int frame = 1; frame <= frames; ++frame) {
        Texels light(pixels);
        for (std::size_t i = 0; i < pixels; ++i) {
            // From a millionth to a tenth, over rows.
            const float sigma =
                std::pow(10.0F, -6.0F + 5.0F * static_cast<float>(i) / static_cast<float>(pixels));
            light[i] = glm::vec4(glm::vec3(std::max(0.0F, 1 + sigma * normal(random))), 0);
            const double value = static_cast<double>(light[i].x)
                * (0.2126F + static_cast<double>(0.7152F) + 0.0722F);
            const double weight = std::max(static_cast<double>(0.2F), 1.0 / std::min(frame, 32));
            const double delta = frame == 1 ? 0 : value - mean[i];
            mean[i] = frame == 1 ? value : mean[i] + weight * delta;
            variance[i] = (1 - weight) * (variance[i] + weight * delta * delta);
        }
        bench->set_texels("in_light", light);
        bench->constant("history_valid", frame > 1 ? 1 : 0);
        bench->run();
        bench->swap("prev_light", "out_light");
        bench->swap("prev_light_2", "out_light_2");
        bench->swap("prev_moments", "out_moments");
        bench->swap("prev_length", "out_length");
        const Texels moments = bench->read("prev_moments");
        for (std::size_t i = 0; i < pixels; ++i) {
            negative += moments[i].y >= 0 ? 0 : 1;
            off = farther(off, std::abs(moments[i].y - variance[i]) / (mean[i] * mean[i]));
        }
    }
    findings.none("variances below zero", negative);
    findings.at_most("variance off Welford's, of the mean squared", off, 1e-5);
}

/// Light at which a square leaves half precision, single precision, or all.
void bright_light_overflows_nothing(Findings& findings, Length /*length*/)
{
    double off = 0;
    double shortest = 4;
    std::uint32_t bad = 0;
    for (const float bright : {256.0F, 6e4F, 1e18F, 1e25F, 1e37F}) {
        WholeFilter filter(wall_everywhere);
        Texels picture;
        for (int frame = 0; frame < 4; ++frame)
            picture = filter.frame(texels_of([&](int, int) { return glm::vec3(bright); }));
        for (const glm::vec4& texel : picture)
            off = farther(off, std::abs(static_cast<double>(texel.x) / bright - 1));
        shortest = std::min(shortest, filter.shortest_history());
        bad += filter.bad_values().all();
    }
    findings.at_least("shortest history after 4 frames", shortest, 4);
    findings.at_most("deviation from constants of 256 to 1e37", off, 1e-5);
    findings.none("values that were no light", bad);
}

/// One pixel brighter than half precision can say, flaring up in a still grey picture.
void a_flare_stays_a_flare(Findings& findings, Length /*length*/)
{
    double hue = 0;
    double shortest = 6;
    int beyond = 0;
    int endless = 0;
    int miscounted = 0;
    std::uint32_t bad = 0;
    for (const float bright : {1e5F, 1e12F, 1e20F, 1e37F}) {
        WholeFilter filter(wall_everywhere);
        for (int frame = 0; frame < 6; ++frame) {
            const Texels& picture = filter.frame(texels_of([&](int x, int y) {
                return frame == 3 && x == 20 && y == 11 ? bright * glm::vec3(1, 0.5F, 0.25F)
                                                        : glm::vec3(0.5F);
            }));
            for (const glm::vec4& texel : picture)
                beyond += texel.x >= 0 && texel.y >= 0 && texel.x <= bright * 1.00001F ? 0 : 1;
            endless += filter.endless_moments();
            const glm::dvec3 flare(picture[place_of(20, 11)]);
            if (frame >= 3 && flare.x > 1e4)
                hue = farther(hue,
                    farther(std::abs(flare.y / flare.x / 0.5 - 1),
                        std::abs(flare.z / flare.x / 0.25 - 1)));
        }
        shortest = std::min(shortest, filter.shortest_history());
        const BadValues met = filter.bad_values();
        const std::uint32_t cut = met.of(BadKind::kClamped);
        bad += met.all() - cut;
        // The variance of a pixel is cut once, where its square is beyond single precision.
        miscounted += (cut > 0) == (bright > 1e18F) ? 0 : 1;
    }
    findings.none("flares whose cut squares are not counted, or counted without a cut", miscounted);
    findings.at_least("shortest history after 6 frames", shortest, 6);
    findings.at_most("change of the flare's hue", hue, 1e-4);
    findings.none("pixels outside of what came in", beyond);
    findings.none("means and variances that are no number", endless);
    findings.none("values that were no light", bad);
}

/// Zero variance makes the luminance weight exp(-x / 0).
void a_constant_stays(Findings& findings, Length length)
{
    const int frames = length == Length::kLong ? 1000 : 8;
    double off = 0;
    std::uint32_t bad = 0;
    for (const glm::vec3 constant : {glm::vec3(0), glm::vec3(1e-30F, 0, 1e-20F),
             glm::vec3(0.1F, 0.7F, 1.3F), glm::vec3(3e4F)}) {
        WholeFilter filter(wall_everywhere);
        for (int frame = 0; frame < frames; ++frame)
            for (const glm::vec4& texel :
                filter.frame(texels_of([&](int, int) { return constant; })))
                for (int c = 0; c < 3; ++c)
                    off = farther(off,
                        constant[c] > 0 ? std::abs(static_cast<double>(texel[c]) / constant[c] - 1)
                                        : std::abs(static_cast<double>(texel[c])));
        bad += filter.bad_values().all();
    }
    findings.at_most(
        "deviation from constants after " + std::to_string(frames) + " frames", off, 1e-5);
    findings.none("values that were no light", bad);
}

/// Columns from 20 on see the sky, or a wall at least 20 pixel footprints nearer or farther, up to
/// 1e30 m away.
void nothing_leaks_over_an_edge(Findings& findings, Length /*length*/)
{
    double wall = 0;
    double other = 0;
    for (const float depth_there : {0.0F, 0.01F, 12.0F, 1e30F}) {
        WholeFilter filter([&](int x, int) {
            return x < 20         ? wall_at(kWallDepth)
                : depth_there > 0 ? wall_at(depth_there)
                                  : glm::uvec4(0);
        });
        std::mt19937 random(5);
        std::exponential_distribution<float> value(1);
        for (int frame = 0; frame < 6; ++frame) {
            // A noisy dark side: its large variance would let everything through.
            const Texels& picture = filter.frame(texels_of([&](int x, int) {
                return x < 20         ? glm::vec3(1)
                    : depth_there > 0 ? glm::vec3(100 * value(random))
                                      : glm::vec3(0);
            }));
            for_pixels([&](int x, int y) {
                const glm::vec4& texel = picture[place_of(x, y)];
                if (x < 20)
                    wall = farther(wall, std::abs(static_cast<double>(texel.x) - 1));
                else if (!(depth_there > 0))
                    other = farther(other, std::abs(static_cast<double>(texel.x)));
            });
        }
    }
    findings.at_most("light of what is behind, on a white wall", wall, 1e-5);
    findings.none("light on the sky", other);
}

/// Column 20 is one wall seen past another: a post a pixel wide.
void nothing_leaks_over_a_post(Findings& findings, Length /*length*/)
{
    WholeFilter filter([](int x, int) { return wall_at(x == 20 ? 5.0F : kWallDepth); });
    double bleed = 0;
    for (int frame = 0; frame < 6; ++frame) {
        const Texels& picture = filter.frame(texels_of(
            [](int x, int) { return x == 20 ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0); }));
        for_pixels([&](int x, int y) {
            const glm::vec4& texel = picture[place_of(x, y)];
            bleed = farther(bleed, x == 20 ? texel.y : texel.x);
        });
    }
    findings.at_most("light of the other colour", bleed, 1.0 / 255);
}

constexpr Extent kShown{37, 21};

/// Six frames of noise, mirrored or not, in a frame beyond whose edges the textures hold `beyond`.
WholeFilter filtered_in_band(float beyond, bool mirrored, Texels& picture)
{
    WholeFilter filter(wall_everywhere, kShown, beyond);
    std::mt19937 random(17);
    std::exponential_distribution<float> value(1);
    for (int frame = 1; frame <= 6; ++frame) {
        Texels light(place_of(0, kFiltered.height), glm::vec4(beyond));
        for (int y = 0; y < kShown.height; ++y)
            for (int x = 0; x < kShown.width; ++x)
                light[place_of(mirrored ? kShown.width - 1 - x : x, y)] =
                    glm::vec4(glm::vec3(value(random)), 0);
        picture = filter.frame(light);
    }
    return filter;
}

/// A tap that leaves the frame would bring in what is there: NaN, or light like any.
void edges_are_pixels_like_others(Findings& findings, Length /*length*/)
{
    Texels in_nan;
    Texels in_light;
    const WholeFilter filter = filtered_in_band(NAN, false, in_nan);
    const WholeFilter bright = filtered_in_band(1, false, in_light);
    int differ = 0;
    for (int y = 0; y < kShown.height; ++y)
        for (int x = 0; x < kShown.width; ++x)
            differ += in_nan[place_of(x, y)] == in_light[place_of(x, y)] ? 0 : 1;
    findings.none("pixels that show what is beyond the frame", differ);
    findings.none(
        "values that were no light", filter.bad_values().all() + bright.bad_values().all());
    findings.at_least("shortest history after 6 frames", filter.shortest_history(), 6);
}

void mirrored_light(Findings& findings, Length /*length*/)
{
    Texels plain;
    Texels mirrored;
    const WholeFilter filter = filtered_in_band(NAN, false, plain);
    const WholeFilter other = filtered_in_band(NAN, true, mirrored);
    double off = 0;
    for (int y = 0; y < kShown.height; ++y)
        for (int x = 0; x < kShown.width; ++x) {
            const double here = plain[place_of(x, y)].x;
            off = farther(off, std::abs(mirrored[place_of(kShown.width - 1 - x, y)].x / here - 1));
        }
    // Sums in another order: 25 roundings a pass.
    findings.at_most("mirrored light off the mirrored picture", off, 1e-4);
    findings.none(
        "shortest histories apart", std::abs(filter.shortest_history() - other.shortest_history()));
}

/// What has no depth now has no history; what had none is no history.
void no_depth_no_history(Findings& findings, Length /*length*/)
{
    int kept = 0;
    int lost = 0;
    double stale = 0;
    for (const float depth :
        {std::numeric_limits<float>::quiet_NaN(), -1.0F, std::numeric_limits<float>::infinity()})
        for (const char* which : {"in_surface", "prev_surface"}) {
            const std::unique_ptr<PassBench> bench = filter_bench("temporal", kFiltered);
            bench->fill("in_light", GL_RGBA32F, glm::vec4(1));
            bench->fill("prev_light", GL_RGBA32F, glm::vec4(1, 1, 1, noise_word(1)));
            bench->fill("prev_length", GL_RGBA32F, glm::vec4(5));
            bench->set_pixel("prev_light", 20, 11, {1000, 1000, 1000, noise_word(1)});
            bench->set_bits(which, 20, 11, wall_at(depth));
            bench->run();
            const Texels lengths = bench->read("out_length");
            const Texels light = bench->read("out_light");
            for_pixels([&](int x, int y) {
                if (x == 20 && y == 11)
                    return;
                lost += lengths[place_of(x, y)].x == 6 ? 0 : 1;
            });
            if (std::string_view(which) == "in_surface")
                kept += lengths[place_of(20, 11)].x == 1 ? 0 : 1;
            stale = farther(stale, light[place_of(20, 11)].x - 1);
        }
    findings.none("histories of pixels without depth", kept);
    findings.none("other histories lost", lost);
    findings.at_most("light taken from pixels without depth", stale, 1e-6);
}

constexpr Case kFilterCases[] = {
    {"52", "filter", "variance below zero", Layer::kFunction,
        "The variance over time is never negative and is Welford's.", variance_is_never_negative},
    {"53", "filter", "squares of bright light", Layer::kFunction,
        "Constant light of any brightness has no variance and stays.",
        bright_light_overflows_nothing},
    {"54", "filter", "a flare", Layer::kFunction,
        "A pixel brighter than half precision can say keeps its hue and makes nothing brighter "
        "than itself; what is cut for it is counted.",
        a_flare_stays_a_flare},
    {"55", "filter", "a constant picture", Layer::kFunction,
        "Constant light stays constant through the whole filter.", a_constant_stays},
    {"56", "filter", "a post a pixel wide", Layer::kFunction, "Nothing leaks over a silhouette.",
        nothing_leaks_over_a_post},
    {"57", "filter", "sky beside a wall", Layer::kFunction,
        "Neither sky nor what is much farther or nearer takes part in a wall's light.",
        nothing_leaks_over_an_edge},
    {"60", "filter", "a depth that is none", Layer::kFunction,
        "A pixel whose depth is no number starts anew, and nobody takes its light.",
        no_depth_no_history},
    {"61", "filter", "the frame's edge", Layer::kFunction,
        "Nothing from beyond the frame is looked at, and its edge has histories as all of it has.",
        edges_are_pixels_like_others},
    {"M7", "filter", "mirrored light", Layer::kFunction,
        "Mirrored light gives the mirrored picture.", mirrored_light},
};

constexpr Guard kFilterGuards[] = {
    {"centred_moments", "52 53", "svgf/temporal.comp",
        "(1.0 - alpha) * (old.y + alpha * bounded * bounded)",
        "mix(old.y + old.x * old.x, value * value, alpha) - pow(old.x + alpha * delta, 2.0)"},
    {"normalised_kernel", "55", "svgf/atrous.comp", "const vec2 scale = 1.0 / weight_sum;",
        "const vec2 scale = vec2(1.0);"},
    {"depth_weight", "56 57", "svgf/surface.glsl",
        "return abs(p.depth - depth_q) / max(expected, 1e-37);",
        "return 1e-3 * abs(p.depth - depth_q) / max(expected, 1e-37);"},
    {"accept_if", "60", "svgf/past.glsl", "plane_distance <= p.tolerance",
        "!(plane_distance > p.tolerance)"},
    {"tap_in_frame", "61", "svgf/atrous.comp",
        "if (inside_frame(q) && takes_part(other) && comparable && o != ivec2(0))",
        "if (takes_part(other) && comparable && o != ivec2(0))"},
    {"bounded_square", "54", "svgf/temporal.comp", "clamp(delta, -1e18, 1e18)", "delta"},
    {"cut_square_counted", "54", "svgf/temporal.comp", "abs(delta) > 1e18 ? IS_CLAMPED : 0u", "0u"},
};

}  // namespace

Group filter_group()
{
    return {kFilterCases, kFilterGuards};
}

}  // namespace farlight::lab
