// The order of a sweep: everything on linear frames first, then times on frames as they are sent.
#include "client/accuracy/sweep.h"

#include "client/accuracy/findings.h"
#include "client/accuracy/gallery.h"
#include "client/accuracy/moving_light.h"
#include "client/accuracy/plans.h"
#include "client/camera_path.h"
#include "client/json_input.h"

#include <algorithm>
#include <ctime>

namespace farlight::client {
namespace {

using nlohmann::json;

constexpr std::chrono::seconds kCompileTimeout{120};
/// Counts up when what a journal holds is measured otherwise than before.
constexpr int kMethod = 2;
constexpr std::size_t kGalleryPoints = 4;
constexpr int kGallerySeeds = 10;

std::string today()
{
    const std::time_t now = std::time(nullptr);
    char text[16];
    std::strftime(text, sizeof text, "%Y-%m-%d", std::localtime(&now));
    return text;
}

json document_of(const std::filesystem::path& scene)
{
    return scene.extension() == ".json" ? JsonInput::read(scene).value() : json();
}

std::string hash_of(const std::filesystem::path& file)
{
    std::ifstream stream(file, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
    return std::to_string(hash_bytes(std::as_bytes(std::span(bytes))));
}

class Sweep {
public:
    Sweep(const Url& url, const protocol::Hello& hello, const SweepOptions& options,
        Progress& progress)
        : url_(url)
        , hello_(hello)
        , options_(options)
        , progress_(progress)
        , rig_(std::make_unique<Rig>(
              url, hello_in(protocol::Format::kRaw), progress, options.extent.degrees_per_frame))
        , grid_(make_grid(welcome().settings, options.extent.grid))
        , plans_(plans_for(grid_, options.extent))
        , document_(document_of(options.scene))
        , step_(dimming(document_))
        , motion_(motion_of_lamps(document_, middle_of(welcome().scene), plans_.motion_frames))
        , journal_(options.out / "measured.jsonl", key())
    {
        if (!journal_.finding().empty())
            std::fprintf(stderr, "%s\n", journal_.finding().c_str());
        const std::filesystem::path after_step = options.out / "reference" / "after_step";
        if (journal_.fresh()) {
            remove_batches(after_step.parent_path());
            remove_batches(after_step);
            remove_moving_reference(moments_folder());
            remove_averaged(averaged_folder());
        }
        std::filesystem::create_directories(after_step);
    }

    json run()
    {
        plan_work();
        progress_.phase("reference");
        reference_ = draw_reference(*rig_, plans_.reference, options_.out / "reference", progress_);
        json report = about();
        Measurements measured{.base = grid_.base};
        measure_errors(measured);
        report["response"] = respond();
        report["motion"] = follow_lamps();
        report["effects"] = measure_effects();
        take_times(measured);
        report.update(findings_of(measured));
        report["gallery"] = draw_pictures(report["frontier"]["points"]);
        return report;
    }

private:
    const protocol::Welcome& welcome() const { return rig_->welcome(); }

    protocol::Hello hello_in(protocol::Format format) const
    {
        protocol::Hello hello = hello_;
        hello.mode = protocol::Mode::kLockstep;
        hello.format = format;
        hello.max_in_flight = 1;
        return hello;
    }

    /// All that measurements depend on.
    json key() const
    {
        const protocol::Welcome& w = welcome();
        return {{"way of measuring", kMethod},
            {"scene", options_.scene.empty() ? w.scene.file : hash_of(options_.scene)},
            {"scene_files", options_.scene.empty() ? json() : named_files(options_.scene)},
            {"scene_size", {w.scene.triangles, w.scene.lights}}, {"size", w.size},
            {"server", w.server + " " + options_.server}, {"device", w.gl_renderer},
            {"settings", hash_text(json(w.settings).dump())}, {"grid", hash_text(grid_text())},
            {"seeds", options_.extent.seeds}, {"reference_samples", plans_.reference.samples},
            {"degrees_per_frame", options_.extent.degrees_per_frame}};
    }

    static std::string hash_text(const std::string& text)
    {
        return std::to_string(hash_bytes(std::as_bytes(std::span(text))));
    }

    /// Points and how they are measured.
    std::string grid_text() const
    {
        json text = json::array({plans_.error.history, plans_.time.rounds, plans_.time.frames});
        for (const SweepPoint& point : grid_.points)
            text.push_back(point.settings);
        return text.dump();
    }

    void plan_work()
    {
        progress_.plan(plans_.reference.work(welcome().size));
        for (const SweepPoint& point : grid_.points)
            if (journal_.find(error_name(point)) == nullptr)
                progress_.plan(work_of_seeds(point, plans_.error));
        if (journal_.find("averaging") == nullptr)
            progress_.plan(work_of_averaging(plans_.error, averaged_frames(options_.extent.grid)));
        for (const SweepPoint& point : response_points(grid_))
            if (journal_.find(response_name(point)) == nullptr)
                progress_.plan(work_of_response(point, plans_.response));
        if (moves())
            plan_motion();
        progress_.plan(work_of_times(timed_points(), plans_.time));
        progress_.plan(kGalleryPoints * work_of_seeds(base_point(grid_), gallery_plan()));
    }

    static std::string error_name(const SweepPoint& point) { return "error " + point.id(); }
    static std::string response_name(const SweepPoint& point) { return "response " + point.id(); }

    static std::string motion_name(const SweepPoint& point) { return "motion " + point.id(); }

    bool moves() const { return !motion_.patch.is_null() && welcome().edits; }
    std::filesystem::path averaged_folder() const { return options_.out / "averaged"; }
    std::filesystem::path moments_folder() const { return options_.out / "reference"; }

    void plan_motion()
    {
        progress_.plan(plans_.step_reference.work(welcome().size) * (motion_.frames + 1));
        for (const SweepPoint& point : response_points(grid_))
            if (journal_.find(motion_name(point)) == nullptr)
                progress_.plan(work_of_motion(point, plans_.motion, motion_.frames));
    }

    ErrorPlan gallery_plan() const
    {
        ErrorPlan plan = plans_.error;
        plan.seeds = std::min(plan.seeds, kGallerySeeds);
        return plan;
    }

    /// What is in the journal, or else is measured now and put there.
    json kept(const std::string& name, const std::function<json()>& measure)
    {
        if (const json* known = journal_.find(name))
            return *known;
        json value = measure();
        journal_.add(name, value);
        return value;
    }

    void measure_errors(Measurements& measured)
    {
        for (const SweepPoint& point : grid_.points) {
            progress_.phase("error of " + point.label);
            measured.points.push_back({point, kept(error_name(point), [&] {
                                           return measured_error(
                                               draw_seeds(*rig_, point, plans_.error), *reference_,
                                               plans_.error.flip_seeds);
                                       })});
        }
        progress_.phase("error of averaged frames");
        const json averaging = kept("averaging", [&] {
            json rows = json::array();
            for (const auto& [frames, error] : averaging_errors(*rig_, plans_.error, *reference_,
                     averaged_frames(options_.extent.grid), averaged_folder()))
                rows.push_back({frames, error});
            return rows;
        });
        for (const json& row : averaging)
            measured.averaging[row[0].get<int>()] = row[1];
    }

    json respond()
    {
        json result{{"history", plans_.response.history}, {"points", json::array()},
            {"still_frames", plans_.response.still_frames}, {"seeds", plans_.response.seeds}};
        std::optional<ReferencePicture> after;
        const bool steps = !step_.patch.is_null() && welcome().edits;
        if (steps) {
            result["step"] = step_.what;
            after = reference_after_step();
        }
        for (const SweepPoint& point : response_points(grid_)) {
            progress_.phase("response of " + point.label);
            json row = kept(response_name(point), [&] {
                return measure_response(*rig_, point, plans_.response, step_, reference_->counts,
                    after ? &*after : nullptr);
            });
            row["label"] = point.label;
            result["points"].push_back(std::move(row));
        }
        return result;
    }

    ReferencePicture reference_after_step()
    {
        progress_.phase("reference after the step");
        rig_->session().edit(step_.patch, /*reset=*/true);
        progress_.plan(plans_.step_reference.work(welcome().size));
        ReferencePicture after = draw_reference(
            *rig_, plans_.step_reference, options_.out / "reference" / "after_step", progress_);
        rig_->session().edit(json::object(), /*reset=*/true);
        return after;
    }

    /// {} where no lamp can be moved; "refused": why the server would not.
    json follow_lamps()
    {
        if (!moves())
            return json::object();
        json result{{"what", motion_.what}, {"frames", motion_.frames},
            {"history", plans_.motion.history}, {"seeds", plans_.motion.seeds},
            {"points", json::array()}};
        try {
            rig_->session().edit(motion_.patch, /*reset=*/true);
        } catch (const RefusedError& refused) {
            return {{"refused", refused.error.message}};
        }
        progress_.phase("references while the lamps move");
        const MovingReference truth = draw_moving_reference(
            *rig_, plans_.step_reference, motion_, moments_folder(), progress_);
        for (const SweepPoint& point : response_points(grid_)) {
            progress_.phase("moving lamps, " + point.label);
            json row = kept(motion_name(point),
                [&] { return measure_motion(*rig_, point, plans_.motion, truth); });
            row["label"] = point.label;
            result["points"].push_back(std::move(row));
        }
        rig_->choose({{"play", false}, {"time", 0}});
        rig_->session().edit(json::object(), /*reset=*/true);
        return result;
    }

    json measure_effects()
    {
        return kept("effects", [&] {
            return client::measure_effects(
                *rig_, plans_.effects, {document_, reference_->counts}, progress_);
        });
    }

    std::vector<SweepPoint> timed_points() const
    {
        std::vector<SweepPoint> points = grid_.points;
        points.push_back(averaging_point(grid_));
        return points;
    }

    void take_times(Measurements& measured)
    {
        rig_.reset();  // one picture's buffers at a time
        Rig rig(url_, hello_in(protocol::Format::kJpeg420), progress_);
        progress_.phase("waiting for the scene's own programs");
        rig.session().await_own_programs(rig.welcome().camera, kCompileTimeout);
        const std::vector<FrameTimes> times =
            measure_times(rig, timed_points(), plans_.time, journal_, progress_);
        for (std::size_t i = 0; i < measured.points.size(); ++i)
            measured.points[i].times = summary_of(times[i]);
        measured.averaging_times = summary_of(times.back());
    }

    json draw_pictures(const json& frontier)
    {
        progress_.phase("pictures");
        Rig rig(
            url_, hello_in(protocol::Format::kRaw), progress_, options_.extent.degrees_per_frame);
        std::vector<SweepPoint> points;
        for (const std::size_t at : spread(frontier.size(), kGalleryPoints))
            points.push_back({frontier[at].at("label").get<std::string>(),
                frontier[at].at("settings").get<Settings>()});
        json gallery = draw_gallery(rig, points, gallery_plan(), *reference_);
        const auto shown = spread(frontier.size(), kGalleryPoints);
        for (std::size_t i = 0; i < shown.size(); ++i)
            for (const char* key : {"ms", "relmse"})
                gallery["points"][i][key] = frontier[shown[i]].at(key);
        return gallery;
    }

    json about() const
    {
        const protocol::Welcome& w = welcome();
        return {{"format", "farlight-accuracy-1"},
            {"scene",
                {{"name", w.scene.name}, {"file", w.scene.file}, {"triangles", w.scene.triangles},
                    {"lights", w.scene.lights}}},
            {"size", w.size}, {"device", w.device}, {"gl_renderer", w.gl_renderer},
            {"server", w.server}, {"date", today()}, {"grid_points", grid_.points.size()},
            {"seeds", options_.extent.seeds}, {"history", plans_.error.history},
            {"degrees_per_frame", options_.extent.degrees_per_frame}, {"base", grid_.base},
            {"timing",
                {{"rounds", plans_.time.rounds}, {"settling_frames", plans_.time.settling},
                    {"frames_a_turn", plans_.time.frames}}},
            {"reference",
                {{"samples", reference_->samples}, {"batches", plans_.reference.batches},
                    {"first_seed", kFirstReferenceSeed}, {"relmse", reference_->own_relmse()},
                    {"counted_share", reference_->counted_share()},
                    {"max_depth", grid_.base.at("max_depth")}, {"antialiasing", false}}}};
    }

    Url url_;
    protocol::Hello hello_;
    SweepOptions options_;
    Progress& progress_;
    std::unique_ptr<Rig> rig_;  ///< Linear frames.
    Grid grid_;
    Plans plans_;
    json document_;  ///< Of the scene; null where it has none of ours.
    LightStep step_;
    LightMotion motion_;
    Journal journal_;
    std::optional<ReferencePicture> reference_;
};

}  // namespace

json sweep(
    const Url& url, const protocol::Hello& hello, const SweepOptions& options, Progress& progress)
{
    return Sweep(url, hello, options, progress).run();
}

}  // namespace farlight::client
