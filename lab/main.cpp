// farlight-hard-cases: the laboratory's command line; `farlight hard-cases` starts it.
#include "lab/guards.h"
#include "lab/mutations.h"
#include "lab/server_bench.h"
#include "server/gl/context.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <chrono>
#include <fstream>
#include <iostream>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

namespace farlight::lab {
namespace {

constexpr int kDone = 0;
constexpr int kFailed = 1;
constexpr int kWrongUse = 2;

struct Options {
    std::vector<std::string> filters;
    std::vector<std::string> ids;
    std::string html;
    std::string device = "software";
    std::string without;  ///< Name of a guard.
    bool long_forms = false;
    bool mutations = false;
    bool list = false;
    bool json = false;
};

/// Of several cases of one number letters tell them apart.
std::string_view number_of(const Case& one)
{
    return one.id.substr(0, one.id.find_last_of("0123456789") + 1);
}

/// A case, all of a number or of a group if there are such, else what has it in its name.
bool matches(const Case& one, const std::string& filter)
{
    static const std::vector<Case> all = all_cases();
    const auto exactly = [&](const Case& any) {
        return any.id == filter || number_of(any) == filter || any.group == filter;
    };
    return std::any_of(all.begin(), all.end(), exactly)
        ? exactly(one)
        : one.name.find(filter) != std::string_view::npos;
}

bool wanted(const Case& one, const Options& options)
{
    if (!options.ids.empty())
        return std::find(options.ids.begin(), options.ids.end(), one.id) != options.ids.end();
    return options.filters.empty()
        || std::any_of(options.filters.begin(), options.filters.end(),
            [&](const std::string& filter) { return matches(one, filter); });
}

std::vector<Case> chosen_cases(const Options& options)
{
    std::vector<Case> cases = all_cases();
    std::erase_if(cases, [&](const Case& one) { return !wanted(one, options); });
    if (cases.empty())
        throw CLI::ValidationError("no case is called so, see --list");
    return cases;
}

void take_out_by_name(const std::string& name)
{
    const std::vector<Guard> guards = all_guards();
    const auto found = std::find_if(
        guards.begin(), guards.end(), [&](const Guard& guard) { return guard.name == name; });
    if (found == guards.end())
        throw CLI::ValidationError("no guard is called '" + name + "', see --list");
    take_out(*found);
}

Judged judge(const Case& one, Length length)
{
    Judged judged{one, {}, {}, 0};
    const auto begun = std::chrono::steady_clock::now();
    try {
        one.run(judged.findings, length);
    } catch (const std::exception& problem) {
        judged.failure = problem.what();
    }
    judged.seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
    return judged;
}

/// Every guard of the cases chosen, one process after the other.
void run_mutations(const Options& options, std::span<const Case> cases, Sheet& sheet)
{
    const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe");
    for (const Guard& guard : all_guards())
        for (const std::string& id : cases_kept_by(guard)) {
            const bool chosen = std::any_of(
                cases.begin(), cases.end(), [&](const Case& one) { return one.id == id; });
            if (!chosen)
                continue;
            sheet.mutations.push_back(run_without(program, guard, id, options.device));
            std::cerr << line_of(sheet.mutations.back()) << std::endl;
        }
}

/// Cases that hold and that no guard of ours is known to keep: nothing proves that they can fail.
std::vector<std::string> unproven(const Sheet& sheet)
{
    std::vector<std::string> ids;
    for (const Judged& judged : sheet.cases) {
        const Case& one = judged.hard_case;
        bool kept = judged.verdict() != "ok";
        for (const Guard& guard : all_guards()) {
            const std::vector<std::string> by = cases_kept_by(guard);
            kept = kept || std::find(by.begin(), by.end(), one.id) != by.end();
        }
        if (!kept)
            ids.emplace_back(one.id);
    }
    return ids;
}

constexpr const char* kWithoutARow = "of the list's 68 cases and 8 laws without a row:";

/// Numbers of the list, 68 cases and 8 laws, that have no row yet. Letters tell rows of one number
/// apart.
std::string without_a_row()
{
    std::vector<std::string> numbers;
    for (int i = 1; i <= 68; ++i)
        numbers.push_back(std::to_string(i));
    for (int i = 1; i <= 8; ++i)
        numbers.push_back("M" + std::to_string(i));
    for (const Case& one : all_cases()) {
        std::erase(numbers, number_of(one));
    }
    std::string text;
    for (const std::string& number : numbers)
        text += " " + number;
    return text;
}

int list()
{
    for (const Case& one : all_cases())
        std::cout << one.id << "  " << one.group << "  " << one.name << ": " << one.claim << "\n";
    for (const Guard& guard : all_guards())
        std::cout << "guard " << guard.name << " in " << (guard.in_host() ? "C++" : guard.file)
                  << " keeps " << guard.keeps << "\n";
    const std::string missing = without_a_row();
    if (!missing.empty())
        std::cout << kWithoutARow << missing << "\n";
    return missing.empty() ? kDone : kFailed;
}

std::string summary_of(const Sheet& sheet)
{
    const auto count = [&](std::string_view verdict) {
        return std::to_string(std::count_if(sheet.cases.begin(), sheet.cases.end(),
            [&](const Judged& judged) { return judged.verdict() == verdict; }));
    };
    std::string text = count("ok") + " kept, " + count("FAIL") + " broken, "
        + count("known failure") + " known to fail, of " + std::to_string(sheet.cases.size());
    if (!sheet.mutations.empty())
        text += "; "
            + std::to_string(std::count_if(sheet.mutations.begin(), sheet.mutations.end(),
                [](const Mutation& m) { return m.noticed; }))
            + " of " + std::to_string(sheet.mutations.size()) + " guards taken out were noticed";
    return text;
}

int run(const Options& options)
{
    static_cast<void>(all_guards());  // throws where rows and C++ disagree
    if (options.list)
        return list();
    const std::vector<Case> cases = chosen_cases(options);
    std::ofstream page;
    if (!options.html.empty())  // now, not after minutes
        page.open(options.html);
    if (page.fail())
        throw CLI::ValidationError(options.html + " cannot be written");
    if (!options.without.empty())
        take_out_by_name(options.without);
    spdlog::set_default_logger(spdlog::stderr_color_st("farlight-hard-cases"));
    spdlog::set_level(spdlog::level::err);
    const Context context(options.device);
    ServerBench::use_device(options.device);
    Sheet sheet;
    sheet.device = context.device().name + ", " + context.device().version;
    std::ostream& lines = options.json ? std::cerr : std::cout;
    lines << sheet.device << "\n";
    sheet.capabilities = capabilities();
    for (const Capability& c : sheet.capabilities)
        lines << "      " << c.expression << " = " << c.result << "  (" << c.left_open << ")\n";
    for (const Case& one : cases) {
        sheet.cases.push_back(judge(one, options.long_forms ? Length::kLong : Length::kShort));
        lines << line_of(sheet.cases.back()) << std::endl;
    }
    std::vector<std::string> without_a_guard;
    if (options.mutations) {
        run_mutations(options, cases, sheet);
        without_a_guard = unproven(sheet);
        for (const std::string& id : without_a_guard)
            lines << "no guard is known that keeps case " << id << "\n";
    }
    lines << summary_of(sheet) << "\n";
    if (const std::string missing = without_a_row(); !missing.empty())
        lines << kWithoutARow << missing << "\n";
    if (options.json)
        std::cout << to_json(sheet).dump(2) << "\n";
    if (page.is_open() && !(page << to_html(sheet) << std::flush))
        throw CLI::ValidationError(options.html + " cannot be written");
    const bool broken = std::any_of(sheet.cases.begin(), sheet.cases.end(),
        [](const Judged& judged) { return judged.counts_as_failure(); });
    const bool survived = std::any_of(sheet.mutations.begin(), sheet.mutations.end(),
        [](const Mutation& m) { return !m.noticed; });
    return broken || survived || !without_a_guard.empty() ? kFailed : kDone;
}

int run(int argc, char** argv)
{
    CLI::App app("farlight hard-cases: inputs that break renderers, and what ours makes of them; "
                 "one line a case");
    Options options;
    app.add_option("--filter", options.filters,
        "a case, all cases of a number or a group, else those with this in their name");
    app.add_option("--case", options.ids, "this case alone");
    app.add_option("--html", options.html, "write everything to this file as one page");
    app.add_option("--device", options.device, "auto, software, gpu or gpu:N");
    app.add_option(
        "--without", options.without, "take out this guard first: its cases must fail then");
    app.add_flag("--long", options.long_forms, "long forms of cases that have one");
    app.add_flag(
        "--mutations", options.mutations, "besides, run each case without each of its guards");
    app.add_flag("--list", options.list, "list cases and guards");
    app.add_flag("--json", options.json, "print everything as JSON");
    try {
        app.parse(argc, argv);
        return run(options);
    } catch (const CLI::ParseError& problem) {
        return app.exit(problem) == 0 ? kDone : kWrongUse;
    } catch (const std::exception& problem) {
        std::cerr << "farlight hard-cases: " << problem.what() << "\n";
        return kWrongUse;
    }
}

}  // namespace
}  // namespace farlight::lab

int main(int argc, char** argv)
{
    return farlight::lab::run(argc, argv);
}
