// Two programs take turns in one session, A B B A, so that neither heat nor other programs favour
// one. Private servers start without compiled programs of earlier runs, so that compiling is paid.
#include "client/cli/bench_effects.h"

#include "client/camera_path.h"
#include "client/cli/command.h"
#include "client/metrics/bootstrap.h"
#include "client/session.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <numeric>
#include <optional>
#include <stdexcept>

namespace farlight::client {
namespace {

constexpr double kDegreesPerFrame = 1;
constexpr int kSettlingFrames = 12;
/// A scene's own programs may be this much slower than the general ones: the noise of a good run.
constexpr double kMostRatio = 1.01;
constexpr std::chrono::seconds kCompileTimeout{120};

/// While it lives, servers started from here find no compiled programs: neither ours nor the
/// driver's.
class ColdCaches {
public:
    ColdCaches()
    {
        std::string name = std::filesystem::temp_directory_path() / "farlight-bench-";
        name.append(6, 'X');  // for mkdtemp to replace
        if (mkdtemp(name.data()) == nullptr)
            throw std::runtime_error("cannot make the folder " + name);
        folder_ = name;
        setenv("XDG_CACHE_HOME", name.c_str(), 1);  // Mesa's cache is in there too
        unsetenv("MESA_SHADER_CACHE_DIR");
    }
    ~ColdCaches()
    {
        std::error_code ignored;
        std::filesystem::remove_all(folder_, ignored);
    }
    ColdCaches(const ColdCaches&) = delete;
    ColdCaches& operator=(const ColdCaches&) = delete;

private:
    std::filesystem::path folder_;
};

/// What drawing with one choice of effects takes.
struct Side {
    std::string effects;  ///< Value of the setting.
    std::vector<double> ms;  ///< Trace and denoise, a frame.
    double first_ms = 0;  ///< The first frame, compiling included.
    std::uint64_t view_bytes = 0;
    std::size_t passes = 0;
};

struct Row {
    std::string name;
    std::string effects;  ///< What the scene calls for.
    Side special;
    Side general;
    std::uint64_t scene_bytes = 0;
    double compile_ms = 0;  ///< Of the special programs.
    RatioOfMedians ratio;  ///< special / general

    double saved_ms() const { return median(general.ms) - median(special.ms); }
    /// Frames after which compiling has paid, if it ever does.
    std::optional<double> break_even() const
    {
        return saved_ms() > 0 ? std::optional(compile_ms / saved_ms()) : std::nullopt;
    }
    bool too_slow() const { return ratio.interval.lower > kMostRatio; }
};

std::uint64_t sum_of(const std::vector<protocol::MemoryUse>& uses)
{
    return std::accumulate(uses.begin(), uses.end(), std::uint64_t{0},
        [](std::uint64_t sum, const auto& use) { return sum + use.bytes; });
}

std::string join(const std::vector<std::string>& words)
{
    std::string text;
    for (const std::string& word : words)
        text += (text.empty() ? "" : ",") + word;
    return text;
}

class Bench {
public:
    explicit Bench(const Target& target)
        : session_(
            target.url(), target.hello(protocol::Mode::kLockstep, protocol::Format::kJpeg420))
    {
    }

    const protocol::Welcome& welcome() const { return session_.welcome(); }
    protocol::Inspection inspect() { return session_.inspect(); }

    /// Draws until the server has compiled the scene's own programs beside it; how long that took.
    double await_own_programs()
    {
        choose("auto");
        return session_.await_own_programs(welcome().camera, kCompileTimeout).compile_ms;
    }

    /// The first frame compiles; the later ones fill histories, and the server frees what only the
    /// other side has use for.
    void warm_up(Side& side)
    {
        const auto begun = std::chrono::steady_clock::now();
        draw(side);
        side.first_ms =
            std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begun)
                .count();
        for (int frame = 0; frame < kSettlingFrames; ++frame)
            draw(side);
        const protocol::Inspection inspection = inspect();
        side.view_bytes = sum_of(inspection.view_memory);
        side.passes = inspection.passes.size();
    }

    void take_turns(Side& a, Side& b, int frames)
    {
        for (int i = 0; i < frames; ++i) {
            Side& first = i % 2 == 0 ? a : b;
            Side& second = i % 2 == 0 ? b : a;
            first.ms.push_back(draw(first));
            second.ms.push_back(draw(second));
        }
    }

private:
    void choose(const std::string& effects)
    {
        if (effects == set_)
            return;
        session_.set("effects", effects);
        set_ = effects;
    }

    double draw(const Side& side)
    {
        choose(side.effects);
        const double angle = kDegreesPerFrame * (frame_++ % 30);
        const auto header =
            session_.draw(orbit(welcome().camera, middle_of(welcome().scene), angle)).header;
        return (header.trace_us + header.denoise_us) / 1000.0;
    }

    Session session_;
    std::string set_;
    int frame_ = 0;
};

/// Programs with what the scene calls for and `more`, against the general ones or, with `more`,
/// against those without.
Row measure(Bench& bench, const std::string& name, const std::string& more, int frames)
{
    const protocol::Inspection scene = bench.inspect();
    std::vector<std::string> names;
    for (const auto& effect : scene.effects)
        if (effect.setting.empty())
            names.push_back(effect.name);
    Row row;
    row.name = name;
    row.effects = join(names);
    row.scene_bytes = sum_of(scene.scene_memory);
    row.special.effects = row.effects;
    row.general.effects = "general";
    if (!more.empty()) {
        row.general.effects = row.effects;
        names.push_back(more);
        row.special.effects = join(names);
    }
    row.compile_ms = more.empty() ? bench.await_own_programs() : 0;
    bench.warm_up(row.special);
    bench.warm_up(row.general);
    bench.take_turns(row.special, row.general, frames);
    if (!more.empty())
        row.compile_ms = std::max(0.0, row.special.first_ms - median(row.special.ms));
    row.ratio = ratio_of_medians(row.special.ms, row.general.ms);
    return row;
}

/// The names of all effects that the scene lacks, as the server knows them.
std::vector<std::string> lacking(Bench& bench)
{
    Side general{.effects = "general"};
    bench.warm_up(general);
    protocol::Inspection inspection = bench.inspect();
    std::erase_if(inspection.program, [&](const std::string& name) {
        return std::any_of(inspection.effects.begin(), inspection.effects.end(),
            [&](const auto& effect) { return effect.name == name; });
    });
    return inspection.program;
}

nlohmann::json to_json(const Row& row)
{
    const auto side = [](const Side& s) {
        return nlohmann::json{{"effects", s.effects}, {"median_ms", median(s.ms)},
            {"first_frame_ms", s.first_ms}, {"view_bytes", s.view_bytes}, {"passes", s.passes}};
    };
    nlohmann::json json{{"name", row.name}, {"effects", row.effects},
        {"special", side(row.special)}, {"general", side(row.general)},
        {"scene_bytes", row.scene_bytes}, {"ratio", row.ratio.ratio},
        {"ratio_interval", {row.ratio.interval.lower, row.ratio.interval.upper}},
        {"compile_ms", row.compile_ms}, {"saved_ms", row.saved_ms()}};
    if (const auto frames = row.break_even())
        json["break_even_frames"] = *frames;
    return json;
}

double mib(std::uint64_t bytes)
{
    return static_cast<double>(bytes) / (1U << 20U);
}

/// Rows are printed as they come: who stops a long run keeps what is measured.
void print_scene_heading()
{
    std::printf("%-20s %9s %9s %6s  %-15s %9s %9s %9s %7s\n", "scene", "general", "its own",
        "ratio", "95 % interval", "general", "its own", "compile", "frames");
    std::printf("%-20s %9s %9s %6s  %-15s %9s %9s %9s %7s\n", "", "[ms]", "[ms]", "", "", "[MiB]",
        "[MiB]", "[ms]", "to pay");
}

void print_scene(const Row& row)
{
    const auto frames = row.break_even();
    std::printf("%-20s %9.2f %9.2f %6.3f  %.3f to %.3f %s%9.1f %9.1f %9.0f %7s\n", row.name.c_str(),
        median(row.general.ms), median(row.special.ms), row.ratio.ratio, row.ratio.interval.lower,
        row.ratio.interval.upper, row.too_slow() ? "!" : " ",
        mib(row.scene_bytes + row.general.view_bytes),
        mib(row.scene_bytes + row.special.view_bytes), row.compile_ms,
        frames ? std::to_string(std::lround(*frames)).c_str() : "never");
    std::fflush(stdout);
}

void print_leave_one_in_heading(const std::string& scene)
{
    std::printf("\n%s with one effect more than it calls for\n", scene.c_str());
    std::printf("%-20s %9s %9s %6s  %-15s %9s %9s\n", "effect", "[ms]", "more", "ratio",
        "95 % interval", "more", "compile");
    std::printf("%-20s %9s %9s %6s  %-15s %9s %9s\n", "", "", "[ms]", "", "", "[MiB]", "[ms]");
}

void print_left_in(const Row& row)
{
    std::printf("%-20s %9.2f %9.2f %6.3f  %.3f to %.3f %9.1f %9.0f\n", row.name.c_str(),
        median(row.special.ms), -row.saved_ms(), row.ratio.ratio, row.ratio.interval.lower,
        row.ratio.interval.upper, mib(row.special.view_bytes) - mib(row.general.view_bytes),
        row.compile_ms);
    std::fflush(stdout);
}

std::vector<Row> measure_scenes(
    const TargetOptions& options, const EffectsBenchOptions& bench_options)
{
    std::vector<Row> rows;
    if (!bench_options.json)
        print_scene_heading();
    for (const std::string& scene : bench_options.scenes) {
        const ColdCaches cold;
        const Target target(options, scene);
        Bench bench(target);
        const std::string& name = bench.welcome().scene.name;
        say("effects: " + name);
        rows.push_back(measure(bench, name, "", bench_options.frames));
        if (!bench_options.json)
            print_scene(rows.back());
    }
    return rows;
}

/// The first scene with each of the effects that it lacks.
std::vector<Row> measure_left_in(
    const TargetOptions& options, const EffectsBenchOptions& bench_options)
{
    const ColdCaches cold;
    const Target target(options, bench_options.scenes.front());
    Bench bench(target);
    const std::string& name = bench.welcome().scene.name;
    std::vector<Row> rows;
    if (!bench_options.json)
        print_leave_one_in_heading(name);
    for (const std::string& effect : lacking(bench)) {
        say(std::string("effects: ").append(name).append(" with ").append(effect));
        rows.push_back(measure(bench, effect, effect, bench_options.frames));
        if (!bench_options.json)
            print_left_in(rows.back());
    }
    return rows;
}

}  // namespace

int bench_effects(const TargetOptions& options, EffectsBenchOptions bench_options)
{
    if (bench_options.scenes.empty())
        bench_options.scenes.push_back(options.scene);
    const std::vector<Row> rows = measure_scenes(options, bench_options);
    const std::vector<Row> left_in =
        bench_options.leave_one_in ? measure_left_in(options, bench_options) : std::vector<Row>();
    if (bench_options.json) {
        nlohmann::json json{{"scenes", nlohmann::json::array()}};
        for (const Row& row : rows)
            json["scenes"].push_back(to_json(row));
        for (const Row& row : left_in)
            json["leave_one_in"].push_back(to_json(row));
        print_json(json);
    }
    return std::any_of(rows.begin(), rows.end(), [](const Row& row) { return row.too_slow(); })
        ? kFailed
        : kDone;
}

}  // namespace farlight::client
