// View: one client's picture on the GPU: its camera of last frame, its histories, its accumulated
// mean.
#pragma once

#include "server/gl/buffer.h"
#include "server/gl/program_cache.h"
#include "server/render/error_estimate.h"
#include "server/render/error_schedule.h"
#include "server/render/frame_counts.h"
#include "server/render/readback.h"
#include "server/render/renderer.h"
#include "server/render/scene_look.h"
#include "server/render/scene_programs.h"
#include "shaders/shared/frame_constants.h"

#include <chrono>

namespace farlight {

/// What all views of a renderer share.
struct SharedScene {
    ProgramCache& programs;
    ScenePrograms& scene_programs;
    SceneLook look;
    std::uint32_t light_count = 0;
    bool software = false;
    bool strict = false;  ///< See FrameGraph.
    bool keep_all = false;  ///< Likewise.
    std::uint32_t version = 0;  ///< Counts scenes shown: pictures of two must not be averaged.
    GpuScene* gpu = nullptr;  ///< Brought to each frame's time, if it moves.
};

/// GPU memory a view takes at most, with every stage on, its pixel buffer included [bytes a pixel].
constexpr std::size_t kViewBytesPerPixel = 768;

/// Effects that a frame calls for by itself, whatever the scene.
EffectMask effects_of(const FramePlan& plan);

/// What is drawn of a picture of `full` size: each side times `scale`, rounded, at least 1.
Extent scaled_extent(Extent full, float scale);

/// GL thread only.
class View {
public:
    /// `scene` must outlive the view.
    explicit View(const SharedScene& scene);

    /// Issues the frame's commands; finish() must follow before the next begin(). Throws GlError,
    /// ShaderError.
    void begin(const RenderRequest& request);
    /// Waits for the frame and returns it.
    RenderedFrame finish();

    RenderedFrame render(const RenderRequest& request)
    {
        begin(request);
        return finish();
    }
    const FrameGraph& graph() const { return graph_; }

private:
    /// What the samples of a frame depend on: while it stays, samples may be averaged.
    struct SampleKey {
        CameraPose camera;
        Extent extent;  ///< Drawn, which resolution_scale may make smaller than what is asked for.
        int samples_per_pixel = 0;
        int max_depth = 0;
        int roulette_depth = 0;
        bool light_sampling = false;
        bool antialiasing = false;
        std::uint32_t seed = 0;
        std::uint32_t scene_version = 0;
        double time = 0;  ///< Of a scene that moves.

        bool operator==(const SampleKey&) const = default;
    };

    bool moves() const { return scene_.gpu != nullptr && scene_.gpu->moves(); }
    /// What of `time` can be seen [s].
    double moment_shown(double time) const { return moves() ? scene_.gpu->moment_shown(time) : 0; }
    void follow(const RenderRequest& request);
    glm::dvec3 origin_of_frame(const CameraPose& camera) const;
    double pose(double time);
    void upload_constants(const RenderRequest& request);
    FrameInputs inputs_of(const RenderRequest& request) const;
    FramePlan plan_of(const RenderRequest& request);
    std::uint32_t accumulated_samples(const RenderSettings& settings) const;
    bool converged(const RenderSettings& settings) const;
    bool keeps_flip(const RenderRequest& request);
    void make_room_for_tiles(Extent tiles);
    void clear_painted(bool paints);
    std::vector<glm::vec4> tile_sums(TileSums part) const;

    const SharedScene& scene_;
    FrameGraph graph_;
    Buffer constants_;
    Buffer counters_;  ///< BadValues.
    Buffer painted_;  ///< Where there were any; nothing, unless the frame shows it.
    bool paints_ = false;
    Readback readback_;
    SampleKey key_;
    std::vector<double> filter_;  ///< What the denoised picture depends on: see filter_key().
    bool new_filter_ = false;  ///< It changed with this frame.
    Extent full_extent_;  ///< Of the last frame.
    glm::dvec3 origin_{0};  ///< From where this frame counts positions, in the scene's coordinates.
    CameraPose prev_camera_;
    Extent prev_extent_;  ///< Drawn in the last frame.
    double prev_time_ = 0;
    bool has_history_ = false;
    FrameCounts counts_;
    std::chrono::steady_clock::time_point flip_drawn_;  ///< Not just kept, when last asked for.
    Buffer tiles_;  ///< What the error estimate sums up.
    ErrorSchedule schedule_;
    ErrorRecord errors_;
    RenderedFrame frame_;  ///< Of the frame in flight.
    FramePlan plan_;  ///< Likewise.
};

}  // namespace farlight
