// RenderSettings: THE list of tunables. Command line (--set), wire (`set`) and viewer follow from
// each_field.
#pragma once

#include "server/scene/effect_choice.h"

#include <cstdint>
#include <limits>
#include <nlohmann/json_fwd.hpp>
#include <stdexcept>
#include <string>
#include <string_view>

namespace farlight {

/// Values an integer setting may take, inclusive.
struct IntRange {
    std::int64_t lower;
    std::int64_t upper;
};

/// Values a real setting may take, inclusive; finite.
struct RealRange {
    double lower;
    double upper;
};

/// A setting whose values are text with rules of their own.
struct TextRule { };

enum class Denoiser : std::uint8_t { kOff, kAccumulate, kSvgf };
enum class Tonemap : std::uint8_t { kAces, kLinear };
/// What is drawn: the finished picture, or one of the buffers behind it.
enum class DebugView : std::uint8_t {
    kFinal,
    kSheet,  ///< Four quadrants: radiance, normal, variance, history length.
    kRawRadiance,
    kDirect,
    kIndirect,
    kSpecular,
    kScattered,
    kAlbedo,
    kEmission,
    kDepth,
    kDepthGradient,
    kPosition,
    kGeometricNormal,
    kShadingNormal,
    kObjectId,
    kMaterialId,
    kMotion,
    kVariance,
    kHistoryLength,
    kPredictedDeviation,
    kMeasuredError,
    kFlip,  ///< FLIP between the denoised picture and the running mean.
    kWipe,  ///< Two states of the picture beside each other.
    kBadValues,  ///< Where values were met that no healthy frame has (bad_values.h).
};
/// What a side of the wipe shows.
enum class WipeSide : std::uint8_t { kRaw, kDenoised, kAccumulated };

/// The wire's word for each value, in declaration order.
constexpr std::string_view kDenoiserNames[] = {"none", "accumulate", "svgf"};
constexpr std::string_view kTonemapNames[] = {"aces", "linear"};
constexpr std::string_view kDebugViewNames[] = {"final", "sheet", "raw_radiance", "direct",
    "indirect", "specular", "scattered", "albedo", "emission", "depth", "depth_gradient",
    "position", "geometric_normal", "shading_normal", "object_id", "material_id", "motion",
    "variance", "history_length", "predicted_deviation", "measured_error", "flip", "wipe",
    "bad_values"};
constexpr std::string_view kWipeSideNames[] = {"raw", "denoised", "accumulated"};

struct RenderSettings {
    Denoiser denoiser = Denoiser::kSvgf;
    int samples_per_pixel = 1;
    int max_depth = 4;
    int roulette_depth = 3;
    bool light_sampling = true;
    bool antialiasing = true;
    std::uint32_t seed = 0;

    bool play = true;
    float time = 0;
    float time_step = 1.0F / 30;

    int history_max = 32;
    float svgf_alpha = 0.2F;
    float svgf_moments_alpha = 0.2F;
    int svgf_spatial_frames = 4;
    int atrous_iterations = 5;
    int svgf_feedback_iteration = 1;
    float sigma_depth = 1;
    float sigma_normal = 128;
    float sigma_luminance = 4;
    float reproject_depth = 2;
    float reproject_normal = 0.9F;

    bool error_estimate = true;

    EffectChoice effects;

    int still_samples = 256;
    int refine_crossover = 64;

    float resolution_scale = 1;
    float budget_ms = 0;
    float target_error = 0;

    float exposure = 1;
    Tonemap tonemap = Tonemap::kAces;
    DebugView view = DebugView::kFinal;
    WipeSide wipe_left = WipeSide::kRaw;
    WipeSide wipe_right = WipeSide::kDenoised;
    float wipe_position = 0.5F;
    int jpeg_quality = 80;

    bool operator==(const RenderSettings&) const = default;

    /// visit(member, name, allowed values, "[unit] meaning") for every setting, in the order shown
    /// to people.
    static void each_field(auto& s, auto&& visit)
    {
        each_sampling_field(s, visit);
        each_time_field(s, visit);
        each_filter_field(s, visit);
        each_showing_field(s, visit);
    }

    /// Of these, what a denoised picture depends on, whatever the scene and the camera: what is
    /// known of its error holds while they stay.
    static void each_picture_field(auto& s, auto&& visit)
    {
        each_sampling_field(s, visit);
        each_filter_field(s, visit);
    }

private:
    static void each_sampling_field(auto& s, auto& visit)
    {
        visit(s.denoiser, "denoiser", kDenoiserNames, "how samples become a picture");
        visit(s.samples_per_pixel, "samples_per_pixel", IntRange{1, 1024},
            "paths traced a pixel and frame");
        visit(s.max_depth, "max_depth", IntRange{1, 64},
            "[segments] longest path from the camera: 1 sees emission only, 2 adds direct light");
        visit(s.roulette_depth, "roulette_depth", IntRange{1, 64},
            "[segments] Russian roulette may end a path after this many");
        visit(s.light_sampling, "light_sampling", IntRange{0, 1},
            "sample the lights at every hit and combine by MIS; 0 leaves light to chance hits");
        visit(s.antialiasing, "antialiasing", IntRange{0, 1},
            "where samples are averaged, spread them over the pixel's area");
        visit(s.seed, "seed", IntRange{0, std::numeric_limits<std::uint32_t>::max()},
            "same seed, same picture");
    }

    static void each_time_field(auto& s, auto& visit)
    {
        visit(s.play, "play", IntRange{0, 1}, "time passes in a scene that moves");
        visit(
            s.time, "time", RealRange{0, 3600}, "[s] of a scene that moves: setting it goes there");
        visit(s.time_step, "time_step", RealRange{0.0001, 10},
            "[s] that pass from frame to frame in lockstep; else it is the clock that runs");
    }

    static void each_filter_field(auto& s, auto& visit)
    {
        visit(s.history_max, "history_max", IntRange{1, 4096},
            "[frames] longest history a pixel remembers");
        visit(s.svgf_alpha, "svgf_alpha", RealRange{0.001, 1},
            "least weight of the new frame in the blended radiance");
        visit(s.svgf_moments_alpha, "svgf_moments_alpha", RealRange{0.001, 1},
            "least weight of the new frame in the luminance moments");
        visit(s.svgf_spatial_frames, "svgf_spatial_frames", IntRange{1, 64},
            "[frames] with less history than this, variance is estimated over 7x7 pixels");
        visit(s.atrous_iterations, "atrous_iterations", IntRange{0, 8},
            "wavelet filter passes, steps 1, 2, 4, ... pixels");
        visit(s.svgf_feedback_iteration, "svgf_feedback_iteration", IntRange{0, 8},
            "the output of this a-trous pass becomes history; 0 feeds back the unfiltered blend");
        visit(s.sigma_depth, "sigma_depth", RealRange{0.01, 100},
            "depth edge stop, in units of the depth gradient");
        visit(s.sigma_normal, "sigma_normal", RealRange{0, 1024},
            "normal edge stop: exponent of the cosine");
        visit(s.sigma_luminance, "sigma_luminance", RealRange{0.01, 100},
            "luminance edge stop, in standard deviations");
        visit(s.reproject_depth, "reproject_depth", RealRange{0.01, 100},
            "[pixel footprints] a reprojected pixel this far off its surface's plane is another "
            "surface");
        visit(s.reproject_normal, "reproject_normal", RealRange{-1, 1},
            "least cosine between the normals of a pixel and its history");
        visit(s.error_estimate, "error_estimate", IntRange{0, 1},
            "estimate the picture's relMSE: predicted while it moves, measured when it rests");
    }

    /// Programs, costs, and what is made of the result.
    static void each_showing_field(auto& s, auto& visit)
    {
        visit(s.effects, "effects", TextRule{},
            "effects compiled in: auto (what the scene calls for), general (all), or a list of "
            "names with commas; less than the scene calls for is refused");
        visit(s.still_samples, "still_samples", IntRange{1, 65536},
            "samples a pixel after which a resting picture is final and sent lossless");
        visit(s.refine_crossover, "refine_crossover", IntRange{1, 65536},
            "samples at which a plain mean equals the denoiser; sets how fast a resting picture "
            "turns to the mean");
        visit(s.resolution_scale, "resolution_scale", RealRange{0.25, 1},
            "of width and height that are drawn; clients show the picture at its full size");
        visit(s.budget_ms, "budget_ms", RealRange{0, 10000},
            "[ms] a moving frame may take: the server chooses resolution, samples and filter "
            "passes for the least error; 0: off; nothing in lockstep");
        visit(s.target_error, "target_error", RealRange{0, 10},
            "[relMSE] a picture may have: moving, the server chooses the cheapest for it, within "
            "budget_ms; resting, it is final then; 0: off; nothing in lockstep");
        visit(s.exposure, "exposure", RealRange{0, 1e6}, "linear scale before tone mapping");
        visit(s.tonemap, "tonemap", kTonemapNames, "curve from scene-linear to display");
        visit(s.view, "view", kDebugViewNames, "the finished picture or a buffer behind it");
        visit(s.wipe_left, "wipe_left", kWipeSideNames,
            "left side of the view `wipe`: this frame's samples, the denoised picture, or the mean "
            "of a resting one");
        visit(s.wipe_right, "wipe_right", kWipeSideNames, "likewise its right side");
        visit(s.wipe_position, "wipe_position", RealRange{0, 1},
            "share of the width that is its left side");
        visit(s.jpeg_quality, "jpeg_quality", IntRange{1, 100}, "quality of moving pictures");
    }
};

struct SettingError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Sets `key` from a JSON string, number or boolean. Throws SettingError that names key, value
/// found and values expected; `settings` is then unchanged.
void set_setting(RenderSettings& settings, std::string_view key, const nlohmann::json& value);

/// The same from `key=value`, as on the command line.
void set_setting(RenderSettings& settings, std::string_view key_equals_value);

/// [{"key", "type": "choice"|"integer"|"real"|"boolean"|"text", "value", "default", "choices" |
/// "lower","upper", "help"}].
nlohmann::json describe_settings(const RenderSettings& settings, const RenderSettings& defaults);

}  // namespace farlight
