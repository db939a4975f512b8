// How far a picture is from the truth: from sums over tiles to relMSE with an interval, and what a
// view knows of its errors from frame to frame. No OpenGL.
#pragma once

#include "server/gl/extent.h"

#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <span>

namespace farlight {

constexpr int kTileSize = 8;  ///< [px], as in shaders/error_estimate/tiles.glsl.

/// The parts of tile_block, one after the other.
enum class TileSums : std::uint8_t { kPredicted, kMeasured };
constexpr int kTileSumParts = 2;

/// A relMSE and the interval that holds it in 95 of 100 cases; NaN: not known.
struct ErrorEstimate {
    double value = std::numeric_limits<double>::quiet_NaN();
    double lower = std::numeric_limits<double>::quiet_NaN();
    double upper = std::numeric_limits<double>::quiet_NaN();
    double deviation = std::numeric_limits<double>::quiet_NaN();  ///< Standard error of `value`.

    bool known() const { return value == value; }
};

/// Tiles across and down.
Extent tiles_of(Extent extent);

/// Mean of what the tiles of a picture hold in `component`, over what they hold in w, the pixels or
/// pairs of pixels that count; NaN of none. The interval takes blocks of tiles for
/// independent: 64 pixels, the reach of five a-trous iterations, or less where the picture has
/// fewer than 9 such blocks. It does not go below 0;
/// of fewer than 5 blocks there is none.
ErrorEstimate mean_of_tiles(std::span<const glm::vec4> sums, Extent extent, int component);

/// What is known of a frame's errors (relMSE).
struct FrameErrors {
    ErrorEstimate predicted;  ///< Of the picture that is shown.
    double noise = std::numeric_limits<double>::quiet_NaN();  ///< The part of it that is noise.
    ErrorEstimate measured;  ///< Of the denoised picture, against samples that it does not hold.
    std::uint32_t reference_samples = 0;  ///< A pixel, in the mean that it was measured against.
    double raw = std::numeric_limits<double>::quiet_NaN();  ///< Of the frame's own samples.
    /// A pixel, that a plain mean needs for the error of the picture that is shown.
    double effective_samples = std::numeric_limits<double>::quiet_NaN();
};

/// The errors of a view's pictures. Frames come in order; a mean's run begins with mean_frames 1.
class ErrorRecord {
public:
    /// What a frame's sums say, and how it was made.
    struct Frame {
        /// What was known of the denoised picture's error is of another picture: after a cut, or
        /// where samples, size or filter are others than before.
        bool starts_anew = false;
        /// Of error_estimate/predict.comp; may be empty, also between frames that have them.
        std::span<const glm::vec4> predicted;
        bool second_of_pair = false;  ///< They are of the second frame of a pair.
        bool denoised = false;  ///< The picture is, and its error is estimated.
        std::span<const glm::vec4> measured;  ///< Of error_estimate/measure.comp; may be empty.
        Extent extent;  ///< Of the picture [px].
        int samples_per_pixel = 1;
        int mean_frames = 0;  ///< In the running mean with this one; 0: there is none.
        double mean_weight = 0;  ///< Of the mean in the picture shown.
        int reference_frames = 0;  ///< In the mean that `measured` compared with; 0: none.
    };
    FrameErrors add(const Frame& frame);

private:
    void predict(const Frame& frame);
    ErrorEstimate prediction() const;
    void measure(const Frame& frame);

    double noise_ = std::numeric_limits<double>::quiet_NaN();  ///< Of the last denoised picture.
    double raw_ = std::numeric_limits<double>::quiet_NaN();  ///< Likewise of its samples.
    int predicted_pairs_ = 0;  ///< Since the last cut.
    double predicted_ = 0;  ///< Running mean of the denoised picture's error.
    double predicted_square_ = 0;  ///< Of predicted_'s own standard error.
    ErrorEstimate measured_;
    std::uint32_t reference_samples_ = 0;
    ErrorEstimate noise_of_one_frame_;
};

/// Frames after which a temporal filter holds at most a thousandth of what it held, if a new frame
/// weighs at least `alpha`.
int frames_to_forget(double alpha);

}  // namespace farlight
