// Owning what outlives a frame: programs, buffers, and what the scene looks like from outside.
#include "server/render/live_scene.h"

#include "server/render/frame.h"
#include "server/render/scene_settings.h"
#include "server/scene/neutral.h"
#include "server/scene/scene_origin.h"

#include <algorithm>

namespace farlight {
namespace {

std::string driver_name()
{
    std::string name;
    for (const GLenum part : {GL_VENDOR, GL_RENDERER, GL_VERSION})
        name.append(reinterpret_cast<const char*>(glGetString(part))).append("\n");
    return name;
}

const ProgramBinaries* pointer_to(const std::optional<ProgramBinaries>& binaries)
{
    return binaries ? &*binaries : nullptr;
}

std::optional<ProgramBinaries> binaries_in(const std::optional<std::filesystem::path>& folder)
{
    if (!folder)
        return std::nullopt;
    return ProgramBinaries(*folder, driver_name());
}

}  // namespace

LoadedScene load_onto_device(Scene scene)
{
    drop_neutral(scene);
    const Bounds bounds = scene_bounds(scene);
    count_from(scene, origin_of(scene));
    const SceneLook look = look_of(scene);
    const auto kept = std::make_shared<Scene>(std::move(scene));
    auto gpu = std::make_shared<GpuScene>(*kept);
    check_settings(*kept, gpu->effects());
    glFinish();  // another context will read it
    kept->meshes.clear();
    return {kept, std::move(gpu), bounds, look};
}

LiveScene::LiveScene(
    const Context& context, const RendererOptions& options, std::function<void()> wake)
    : binaries_(binaries_in(options.program_folder))
    , compiler_(std::make_unique<GlWorker>(context))
    , programs_(pointer_to(binaries_))
    , scene_programs_(programs_, pointer_to(binaries_), compiler_.get(), std::move(wake))
    , shared_{programs_, scene_programs_, {}}
{
    shared_.software = context.device().software;
}

/// The worker goes first: it must not be at work when programs that it has made are deleted.
LiveScene::~LiveScene()
{
    compiler_.reset();
}

void LiveScene::show(LoadedScene loaded)
{
    loaded_ = std::move(loaded);
    scene_programs_.follow(loaded_.gpu);
    shared_.light_count = static_cast<std::uint32_t>(loaded_.gpu->light_count());
    shared_.look = loaded_.look;
    shared_.gpu = loaded_.gpu.get();
    ++shared_.version;
}

void LiveScene::prepare_programs(const RenderSettings& settings)
{
    FramePlan moving;
    moving.settings = settings;
    moving.scatters = shared_.look.scatters;
    moving.looks.predicts = settings.error_estimate;
    FramePlan resting = moving;
    resting.refine = true;
    resting.looks = {.predicts = settings.error_estimate,
        .measures = true,
        .measured_against = 1,
        .reference = Reference::kKeep};
    const auto declared = [](const FramePlan& plan) -> DeclareFrame {
        return [plan](FrameGraph& graph, const SceneInputs& inputs) {
            build_frame(graph, FrameInputs{inputs, {}}, plan);
        };
    };
    scene_programs_.prepare(
        effects_of(moving), declared(moving), declared(resting), shared_.software);
}

RendererDescription describe(const Context& context, const LiveScene& live)
{
    const Scene& scene = live.scene();
    const GpuScene& gpu = live.gpu();
    RendererDescription d;
    d.device = context.device().selector;
    d.gl_renderer = context.device().name;
    d.gl_version = context.device().version;
    d.software = context.device().software;
    d.scene_name = scene.name;
    d.scene_file = scene.file;
    d.scene_notes = scene.notes;
    if (gpu.dropped_triangles() > 0)
        d.scene_notes.push_back(std::to_string(gpu.dropped_triangles())
            + " triangles of zero area or beyond 32-bit range in world space were left out.");
    d.effects = gpu.effects();
    for (const Allocation& allocation : gpu.allocations())
        d.allocations.emplace_back(allocation.name, allocation.bytes);
    d.camera = scene.camera;
    d.camera_paths = scene.camera_paths;
    d.bounds = live.bounds();
    d.triangles = gpu.triangle_count();
    d.lights = gpu.light_count();
    if (gpu.moves())
        d.course = course_of(scene.animation);
    GLint limit = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &limit);
    d.max_dimension = std::min(limit, 8192);  // above it one frame's buffers alone pass 16 GB
    return d;
}

}  // namespace farlight
