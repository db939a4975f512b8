// LiveScene: the scene being drawn, on the device, with the programs that draw it; may be replaced
// between frames.
#pragma once

#include "server/gl/gl_worker.h"
#include "server/gl/program_binaries.h"
#include "server/render/renderer.h"
#include "server/render/view.h"

#include <filesystem>

namespace farlight {

/// A scene and what was made of it on the device.
struct LoadedScene {
    std::shared_ptr<const Scene> scene;  ///< Without meshes: the device has them.
    std::shared_ptr<GpuScene> gpu;
    Bounds bounds;  ///< In the file's coordinates; those of `scene` start at its origin.
    SceneLook look;
};

/// Packs and uploads; any thread with a context that shares with the renderer's. Throws GlError,
/// SceneError.
LoadedScene load_onto_device(Scene scene);

/// GL thread only.
class LiveScene {
public:
    /// `wake` is called on another thread when better programs have become ready.
    LiveScene(const Context& context, const RendererOptions& options, std::function<void()> wake);
    ~LiveScene();
    LiveScene(const LiveScene&) = delete;
    LiveScene& operator=(const LiveScene&) = delete;

    /// Draws this from now on.
    void show(LoadedScene loaded);
    /// Compiles the general programs, and in the background the scene's own.
    void prepare_programs(const RenderSettings& settings);
    /// Waits for those in the background.
    void finish_programs() { scene_programs_.wait_for_worker(); }

    const SharedScene& shared() const { return shared_; }
    const Scene& scene() const { return *loaded_.scene; }
    const GpuScene& gpu() const { return *loaded_.gpu; }
    const Bounds& bounds() const { return loaded_.bounds; }

private:
    std::optional<ProgramBinaries> binaries_;
    std::unique_ptr<GlWorker> compiler_;
    LoadedScene loaded_;
    ProgramCache programs_;
    ScenePrograms scene_programs_;
    SharedScene shared_;
};

/// What clients may know of renderer and scene.
RendererDescription describe(const Context& context, const LiveScene& live);

}  // namespace farlight
