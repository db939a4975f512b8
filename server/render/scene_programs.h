// ScenePrograms: which programs a scene is drawn with. The general ones hold every effect and serve
// any scene; special ones hold what this scene calls for and are compiled in the background. A
// frame is drawn with the smallest that is ready: all give the same bits, so histories stay.
#pragma once

#include "server/gl/gl_worker.h"
#include "server/render/frame_graph.h"
#include "server/scene/effect_choice.h"
#include "server/scene/gpu_scene.h"

#include <functional>
#include <mutex>

namespace farlight {

/// Special variants kept: an edit and its undoing find theirs again.
constexpr std::size_t kMostVariants = 8;

/// What shaders that look into a scene are compiled with and bound to.
struct Variant {
    EffectMask mask;
    SceneInputs inputs;

    /// The numbers among the defines: what the programs have room for.
    std::vector<std::pair<std::string, int>> constants() const;
};

/// Declares a frame's passes; kept until the programs it asks for are compiled.
using DeclareFrame = std::function<void(FrameGraph&, const SceneInputs&)>;

/// GL thread only, but for what it hands to `worker`.
class ScenePrograms {
public:
    /// `worker` null: special programs are compiled when they are first drawn with. `wake` is
    /// called on the worker's thread when some have become ready. All must outlive this.
    ScenePrograms(ProgramCache& programs, const ProgramBinaries* binaries, GlWorker* worker,
        std::function<void()> wake);

    /// From now on this scene is drawn.
    void follow(std::shared_ptr<const GpuScene> scene);

    /// What to draw the next frame with. `more`: effects called for by settings. The reference
    /// stays valid until the next call. A list that lacks what the scene calls for gets it without
    /// a word: server start, sessions and scene files refuse such a list, but one that was complete
    /// lags behind where an edit has since added an effect, and a frame must still be right.
    const Variant& choose(const EffectChoice& choice, EffectMask more, const DeclareFrame& declare);

    /// Compiles the general programs of frame `all`, and lets the driver finish them where it does
    /// so at the first dispatch; meanwhile the worker compiles the scene's own for frame `first`,
    /// for which settings call for `more`.
    void prepare(
        EffectMask more, const DeclareFrame& first, const DeclareFrame& all, bool software);
    /// Waits until the worker is done with what it was asked for.
    void wait_for_worker();

    EffectMask scene_mask() const { return scene_mask_; }
    /// How long the worker took for this scene's special programs so far [ms]; 0: none is ready.
    double last_compile_ms() const { return last_compile_ms_; }

private:
    struct Finished;
    struct Background;

    Variant variant_of(EffectMask mask) const;
    std::vector<ProgramKey> missing(const Variant& variant, const DeclareFrame& declare) const;
    void ask_for(const Variant& variant, const DeclareFrame& declare);
    void collect();
    void remember(const Variant& variant);

    ProgramCache& programs_;
    GlWorker* worker_;
    std::shared_ptr<Background> background_;
    std::shared_ptr<const GpuScene> scene_;
    EffectMask scene_mask_;
    std::vector<ProgramKey> asked_;  ///< Last: not asked for again, a failure stays one.
    std::vector<Variant> known_;  ///< Special variants drawn with or asked for, newest last.
    Variant chosen_;
    double last_compile_ms_ = 0;
};

/// The programs that a frame declared with `inputs` asks for, without drawing it.
std::vector<ProgramKey> programs_of(const DeclareFrame& declare, const SceneInputs& inputs);

/// Dispatches a frame of no pixels, so that every program is compiled and the driver has made of it
/// what it runs. Mesa's llvmpipe does that at the first dispatch; its own cache hands the result to
/// other contexts.
void rehearse(
    ProgramCache& programs, const DeclareFrame& declare, const SceneInputs& inputs, bool software);

}  // namespace farlight
