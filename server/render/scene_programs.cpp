// Choosing, asking the worker, taking over what it has compiled.
#include "server/render/scene_programs.h"

#include "server/gl/buffer.h"
#include "server/render/bad_values.h"
#include "shaders/shared/frame_constants.h"
#include "shaders/shared/scene_layout.h"

#include <algorithm>
#include <chrono>
#include <spdlog/spdlog.h>

namespace farlight {
namespace {

/// Room that general programs have for any scene; special ones have what theirs needs. A scene that
/// needs more than this gets it, at the price of compiling when it is first drawn.
constexpr std::pair<std::string_view, int> kGeneralRoom[] = {
    {"BVH_STACK_SIZE", 64}, {"TEXTURE_ARRAY_COUNT", TEXTURE_ARRAYS}};

double milliseconds_since(std::chrono::steady_clock::time_point begun)
{
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begun)
        .count();
}

bool is_effect(const std::pair<std::string, std::string>& define)
{
    return define.first.starts_with("FX_");
}

bool is_room(const std::pair<std::string, std::string>& define)
{
    return std::any_of(std::begin(kGeneralRoom), std::end(kGeneralRoom),
        [&](const auto& room) { return room.first == define.first; });
}

/// What a program that looks into the scene has of the variant it was compiled for.
Defines variant_part(const Defines& defines)
{
    Defines part;
    std::copy_if(defines.begin(), defines.end(), std::back_inserter(part),
        [](const auto& define) { return is_effect(define) || is_room(define); });
    return part;
}

int value_of(const std::string& number)
{
    return std::atoi(number.c_str());
}

/// What the scene itself is compiled with, less effects: room for so and so much.
Defines room_of(const Defines& defines)
{
    Defines room;
    std::remove_copy_if(defines.begin(), defines.end(), std::back_inserter(room), is_effect);
    return room;
}

Defines general_room(Defines room)
{
    for (auto& [name, value] : room)
        for (const auto& [general_name, most] : kGeneralRoom)
            if (name == general_name)
                value = std::to_string(std::max(most, value_of(value)));
    return room;
}

Defines defines_of(EffectMask mask, const Defines& room)
{
    Defines defines;
    for (const std::string_view macro : mask.macros())
        defines.emplace_back(macro, "1");
    defines.insert(defines.end(), room.begin(), room.end());
    return defines;
}

/// Whether programs compiled for `has` have room for a scene that needs `needed`.
bool has_room(const Defines& has, const Defines& needed)
{
    return std::all_of(needed.begin(), needed.end(), [&](const auto& need) {
        return is_effect(need) || std::any_of(has.begin(), has.end(), [&](const auto& row) {
            return row.first == need.first && value_of(row.second) >= value_of(need.second);
        });
    });
}

}  // namespace

std::vector<std::pair<std::string, int>> Variant::constants() const
{
    std::vector<std::pair<std::string, int>> numbers;
    for (const auto& [name, value] : room_of(inputs.defines))
        numbers.emplace_back(name, value_of(value));
    return numbers;
}

/// What the worker has compiled, on its way to the GL thread.
struct ScenePrograms::Finished {
    std::vector<std::pair<ProgramKey, std::unique_ptr<Program>>> programs;
    EffectMask mask;
    double ms = 0;
};

/// What outlives this on the worker: jobs hold it.
struct ScenePrograms::Background {
    explicit Background(const ProgramBinaries* binaries) : programs(binaries) { }

    std::mutex mutex;
    std::vector<Finished> finished;  ///< Guarded by `mutex`.
    std::function<void()> wake;  ///< Guarded by `mutex`; empty once nobody waits.
    /// Worker's thread only. Its own copies of what is not special: two contexts must not set the
    /// same program's uniforms.
    ProgramCache programs;
};

ScenePrograms::ScenePrograms(ProgramCache& programs, const ProgramBinaries* binaries,
    GlWorker* worker, std::function<void()> wake)
    : programs_(programs)
    , worker_(worker)
    , background_(std::make_shared<Background>(binaries))
{
    background_->wake = std::move(wake);
}

void ScenePrograms::follow(std::shared_ptr<const GpuScene> scene)
{
    scene_ = std::move(scene);
    last_compile_ms_ = 0;
    scene_mask_ = mask_of(scene_->effects());
}

Variant ScenePrograms::variant_of(EffectMask mask) const
{
    const Defines room = room_of(scene_->defines());
    const bool general = mask == EffectMask::general();
    return {mask, {scene_->textures(), defines_of(mask, general ? general_room(room) : room)}};
}

/// What would have to be compiled before a frame is drawn with `variant`.
std::vector<ProgramKey> ScenePrograms::missing(
    const Variant& variant, const DeclareFrame& declare) const
{
    std::vector<ProgramKey> keys = programs_of(declare, variant.inputs);
    std::erase_if(keys, [&](const ProgramKey& key) { return programs_.has(key); });
    return keys;
}

const Variant& ScenePrograms::choose(
    const EffectChoice& choice, EffectMask more, const DeclareFrame& declare)
{
    collect();
    const EffectMask needed = scene_mask_ | more;
    if (choice.kind == EffectChoice::Kind::kGeneral)
        return chosen_ = variant_of(EffectMask::general());
    const EffectMask wanted =
        choice.kind == EffectChoice::Kind::kList ? needed | choice.mask : needed;
    chosen_ = variant_of(wanted);
    if (choice.kind == EffectChoice::Kind::kList || worker_ == nullptr
        || missing(chosen_, declare).empty()) {
        remember(chosen_);
        return chosen_;
    }
    const Variant* smallest = nullptr;
    for (Variant& other : known_) {
        other.inputs.buffers = scene_->textures();
        if (other.mask.contains(needed) && has_room(other.inputs.defines, scene_->defines())
            && (smallest == nullptr || other.mask.size() < smallest->mask.size())
            && missing(other, declare).empty())
            smallest = &other;
    }
    Variant general = variant_of(EffectMask::general());
    const std::size_t lacking = missing(general, declare).size();
    if (smallest == nullptr && lacking > 0 && lacking >= missing(chosen_, declare).size()) {
        remember(chosen_);  // something must be compiled at once, and the scene's own takes least
        return chosen_;
    }
    const Variant instead = smallest != nullptr ? *smallest : general;
    ask_for(chosen_, declare);
    return chosen_ = instead;
}

void ScenePrograms::ask_for(const Variant& variant, const DeclareFrame& declare)
{
    std::vector<ProgramKey> wanted = missing(variant, declare);
    if (wanted == asked_)
        return;
    asked_ = wanted;
    remember(variant);
    worker_->request(
        [background = background_, scene = scene_, wanted = std::move(wanted), variant, declare] {
            const auto begun = std::chrono::steady_clock::now();
            rehearse(background->programs, declare, variant.inputs, /*software=*/true);
            Finished finished{{}, variant.mask, 0};
            for (const ProgramKey& key : wanted)
                if (auto program = background->programs.take(key))
                    finished.programs.emplace_back(key, std::move(program));
            finished.ms = milliseconds_since(begun);
            const std::lock_guard lock(background->mutex);
            background->finished.push_back(std::move(finished));
            if (background->wake)
                background->wake();
        });
}

/// Takes over what has become ready; what nobody draws with any more goes.
void ScenePrograms::collect()
{
    if (worker_ == nullptr || worker_->idle())
        programs_.delete_dropped();
    std::vector<Finished> finished;
    {
        const std::lock_guard lock(background_->mutex);
        finished.swap(background_->finished);
    }
    for (Finished& one : finished) {
        last_compile_ms_ += one.ms;
        spdlog::info("programs for {} effects compiled in the background in {:.0f} ms",
            one.mask.size(), one.ms);
        for (auto& [key, program] : one.programs)
            programs_.adopt(key, std::move(program));
    }
}

/// Keeps the newest variants; forgets the programs of the oldest. The general one is always kept.
void ScenePrograms::remember(const Variant& variant)
{
    if (variant.mask == EffectMask::general())
        return;
    const auto same = [](const Variant& a) {
        return [&a](const Variant& b) { return a.inputs.defines == b.inputs.defines; };
    };
    known_.erase(std::remove_if(known_.begin(), known_.end(), same(variant)), known_.end());
    known_.push_back(variant);
    if (known_.size() <= kMostVariants)
        return;
    const Defines oldest = known_.front().inputs.defines;
    known_.erase(known_.begin());
    programs_.drop([&](const ProgramKey& key) { return variant_part(key.defines) == oldest; });
}

void ScenePrograms::prepare(
    EffectMask more, const DeclareFrame& first, const DeclareFrame& all, bool software)
{
    if (worker_ != nullptr)
        ask_for(variant_of(scene_mask_ | more), first);
    const auto begun = std::chrono::steady_clock::now();
    rehearse(programs_, all, variant_of(EffectMask::general()).inputs, software);
    spdlog::info("general programs compiled in {:.0f} ms", milliseconds_since(begun));
}

void ScenePrograms::wait_for_worker()
{
    if (worker_ != nullptr)
        worker_->wait();
    collect();
}

std::vector<ProgramKey> programs_of(const DeclareFrame& declare, const SceneInputs& inputs)
{
    ProgramCache none;
    FrameGraph graph(none, /*software=*/true, /*strict=*/false);
    graph.begin_frame({1, 1}, {});
    declare(graph, inputs);
    return graph.programs();
}

void rehearse(
    ProgramCache& programs, const DeclareFrame& declare, const SceneInputs& inputs, bool software)
{
    // Neither side a power of two: llvmpipe compiles for that, and pictures' sizes seldom are.
    constexpr Extent kSmall{24, 14};
    const shared::FrameConstants nobody_is_inside{};  // extent 0: every invocation returns at once
    const Buffer constants("rehearsal constants",
        std::as_bytes(std::span<const shared::FrameConstants, 1>(&nobody_is_inside, 1)));
    const Buffer counters("rehearsal counters", std::vector<std::byte>(sizeof(BadValues::Counts)));
    const Buffer painted("rehearsal painted", {});
    FrameGraph graph(programs, software, /*strict=*/false);
    const Buffer tiles("rehearsed tile sums", {});
    graph.begin_frame(kSmall,
        {{"frame_block", constants.id()}, {"counter_block", counters.id()},
            {"tile_block", tiles.id()}, {"painted_block", painted.id()}});
    declare(graph, inputs);
    graph.execute();
    glFinish();
}

}  // namespace farlight
