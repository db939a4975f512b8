// farlight script: plays scripted-camera tests. SCRIPT.md explains the files.
#include "client/cli/command.h"
#include "client/cli/target.h"
#include "client/picture_file.h"
#include "client/script/judge.h"

#include <iostream>
#include <memory>

namespace farlight::client {
namespace {

struct Options {
    TargetOptions target;
    std::vector<std::string> files;
    std::string junit;
    bool json = false;
};

/// Private servers, one a scene, started when first needed and kept while the scene stays the same.
class Servers {
public:
    explicit Servers(const TargetOptions& options) : options_(options) { }

    const Url& for_scene(const std::filesystem::path& scene)
    {
        if (!target_ || (options_.url.empty() && scene != scene_)) {
            target_.reset();  // the old server ends before the new one starts
            target_.emplace(options_, scene.string());
            scene_ = scene;
        }
        return target_->url();
    }

private:
    TargetOptions options_;
    std::filesystem::path scene_;
    std::optional<Target> target_;
};

JudgedScript play_and_judge(const Script& script, Servers& servers)
{
    using Clock = std::chrono::steady_clock;
    const auto start = Clock::now();
    const Played played = play(
        script, servers.for_scene(script.scene), [](const std::string& line) { say("  " + line); });
    return {.file = script.file.string(),
        .seconds = std::chrono::duration<double>(Clock::now() - start).count(),
        .verdicts = judge(script, played)};
}

nlohmann::json to_json(const std::vector<JudgedScript>& scripts)
{
    nlohmann::json json = nlohmann::json::array();
    for (const JudgedScript& script : scripts) {
        nlohmann::json verdicts = nlohmann::json::array();
        for (const Verdict& verdict : script.verdicts)
            verdicts.push_back({{"expectation", verdict.expectation}, {"ok", verdict.ok},
                {"finding", verdict.finding}});
        json.push_back(
            {{"file", script.file}, {"seconds", script.seconds}, {"verdicts", verdicts}});
    }
    return json;
}

int run(const Options& options)
{
    std::vector<Script> scripts;  // all are read before the first is played
    for (const std::string& file : options.files)
        scripts.push_back(read_script(file));

    Servers servers(options.target);
    std::vector<JudgedScript> judged;
    bool all_ok = true;
    for (const Script& script : scripts) {
        say(script.file.string());
        judged.push_back(play_and_judge(script, servers));
        for (const Verdict& verdict : judged.back().verdicts) {
            all_ok = all_ok && verdict.ok;
            if (!options.json)
                std::cout << to_line(verdict) << std::endl;
        }
    }
    if (!options.junit.empty()) {
        const std::string xml = junit_xml(judged);
        write_bytes(options.junit, std::as_bytes(std::span(xml)));
    }
    if (options.json)
        print_json(to_json(judged));
    return all_ok ? kDone : kFailed;
}

}  // namespace

Command add_script(CLI::App& farlight)
{
    auto* app = farlight.add_subcommand("script", "play scripted-camera tests; one verdict a line");
    auto options = std::make_shared<Options>();
    options->target.add_to(*app, false);
    app->add_option("files", options->files, "script files, see SCRIPT.md")->required();
    app->add_option("--junit", options->junit, "write the verdicts to this file as JUnit XML");
    app->add_flag("--json", options->json, "print the verdicts as JSON");
    return {app, [options] { return run(*options); }};
}

}  // namespace farlight::client
