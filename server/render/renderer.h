// Renderer: the one thread that owns the GL context, and the views it draws, one a client.
//
// The renderer pulls: it asks each attached FrameSource in turn what to draw, draws it, and hands
// the pixels back. A source that has nothing to draw (client slow, picture converged) says so and
// costs nothing.
#pragma once

#include "server/render/bad_values.h"
#include "server/render/error_estimate.h"
#include "server/render/image.h"
#include "server/render/settings.h"
#include "server/scene/scene.h"

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace farlight {

/// What one client wants drawn next.
struct RenderRequest {
    CameraPose camera;
    RenderSettings settings;
    Extent extent;
    PixelFormat format = PixelFormat::kRgb8;
    double time = 0;  ///< Of a scene that moves [s].
    /// Present: `time` was then and runs on; the frame shows the moment at which it is begun.
    std::optional<std::chrono::steady_clock::time_point> clock_start;
    bool reset_history =
        false;  ///< A cut: forget history and accumulated samples, restart the random numbers.
    bool refine =
        false;  ///< The camera rests: blend towards the accumulated mean (see RenderSettings).
    bool live = false;  ///< One more frame of what somebody watches: costly maps may be of an
                        ///< earlier one.
};

struct PassTime {
    std::string pass;
    double milliseconds = 0;
};

/// One drawn frame and what is known about it.
struct RenderedFrame {
    Image image;
    /// In execution order. GPU time, or host time on llvmpipe and of "pose": bringing the scene's
    /// moving parts to this frame's time.
    std::vector<PassTime> pass_times;
    double trace_ms = 0;  ///< Sum of the passes up to and including path_trace, and of posing.
    double denoise_ms = 0;  ///< Sum of the passes after it.
    double frame_ms = 0;  ///< All of them with what lies between them.
    FrameErrors errors;
    std::uint32_t accumulated_samples =
        0;  ///< Samples a pixel since the camera or a setting last changed.
    BadValues bad_values;  ///< Must be none.
    bool moves = false;  ///< The scene follows time: later frames may look different.
    double time = 0;  ///< Shown, of a scene that moves [s].
    bool history_reset = false;  ///< This frame started without history.
    bool converged = false;  ///< accumulated_samples reached settings.still_samples.
    EffectMask effects;  ///< Held by the programs that drew it.
    std::vector<ActiveEffect> by_settings;  ///< Effects that its settings called for.
    std::vector<std::pair<std::string, int>> constants;  ///< Compiled into them.
    double compile_ms = 0;  ///< Of the scene's own programs, in the background; 0: not yet.
    std::vector<std::pair<std::string, std::size_t>> memory;  ///< The view's textures [bytes].
    std::string error;  ///< Not empty: this frame could not be drawn and `image` is empty.
};

/// One client as the renderer sees it. Both functions are called on the render thread and must not
/// block.
class FrameSource {
public:
    virtual ~FrameSource() = default;
    /// The next frame to draw, or nothing. Called again after every drawn frame and every
    /// Renderer::wake().
    virtual std::optional<RenderRequest> next_request() = 0;
    /// The frame asked for by the last next_request(); frames come back in the order they were
    /// asked for.
    virtual void frame_done(RenderedFrame frame) = 0;
};

/// What a client may want to know before its first frame.
struct RendererDescription {
    std::string device;  ///< "software" or "gpu:N", and the device's own name.
    std::string gl_renderer;  ///< GL_RENDERER.
    std::string gl_version;
    bool software = false;
    std::string scene_name;
    std::string scene_file;
    std::vector<std::string> scene_notes;
    std::vector<ActiveEffect> effects;  ///< What the scene calls for, and why.
    std::vector<std::pair<std::string, std::size_t>>
        allocations;  ///< The scene's GPU memory [bytes], by what it is for.
    CameraPose camera;
    std::map<std::string, std::vector<CameraKeyframe>> camera_paths;
    Bounds bounds;
    std::size_t triangles = 0;
    std::size_t lights = 0;
    std::optional<Course> course;  ///< Of what follows time; absent: nothing does.
    RenderSettings settings;  ///< Defaults of every new client.
    Extent default_extent;
    int max_dimension = 0;  ///< Largest width or height the device can draw.
};

struct RendererOptions {
    std::string device = "auto";  ///< auto, software, gpu, gpu:N
    std::optional<Extent>
        extent;  ///< Absent: measured so that the first picture moves at 10 frames a second.
    RenderSettings settings;  ///< Defaults of every new client, unless the scene names others.
    std::vector<std::string> set = {};  ///< key=value, in order: these win over the scene's.
    /// What all views together may hold [bytes]; 0: half of this machine's memory on a software
    /// device, 8 GiB on hardware. A frame that would need more is refused, with the need and the
    /// limit in RenderedFrame::error.
    std::size_t view_memory = 0;
    /// Where compiled programs are kept from one run to the next; absent: nowhere.
    std::optional<std::filesystem::path> program_folder;
};

/// Starts the render thread. Thread-safe.
class Renderer {
public:
    /// Blocks until the scene is on the device. Throws DeviceError, SceneError or GlError with a
    /// full message.
    Renderer(Scene scene, const RendererOptions& options);
    /// Finishes the frame being drawn and joins the thread.
    ~Renderer();
    Renderer(const Renderer&) = delete;
    Renderer& operator=(const Renderer&) = delete;

    /// As of the scene being drawn.
    std::shared_ptr<const RendererDescription> description() const;

    /// Draws `scene` from the next frame on, with programs that hold what it calls for; histories
    /// stay. Loads it meanwhile, beside the frames being drawn, and returns when it is in place.
    /// Throws what the constructor throws for a scene; then the old one stays.
    void replace_scene(Scene scene);

    void attach(std::shared_ptr<FrameSource> source);
    /// After this returns, `source` is not called again. Its history is freed.
    void detach(const std::shared_ptr<FrameSource>& source);
    /// Some source may have something to draw now.
    void wake();

    /// Empty while the device works; else why it does not (lost context, GL error). Then no frames
    /// are drawn.
    std::string failure() const;
    std::uint64_t frames_rendered() const;
    /// Of all frames of all sources.
    BadValueTotals bad_values() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace farlight
