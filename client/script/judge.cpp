// The functions an expectation may call, and what becomes of their values.
#include "client/script/judge.h"

#include "client/metrics/metrics.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace farlight::client {
namespace {

constexpr double kLeastLitShare = 0.01;  // see `not_black` in kFunctions

std::string number_text(double value)
{
    char text[32];
    std::snprintf(text, sizeof text, "%.4g", value);
    return text;
}

/// The values of calls for one played script.
class Facts {
public:
    Facts(const Script& script, const Played& played) : script_(script), played_(played) { }

    /// Throws MetricError when a mean would hide non-finite values.
    double operator()(const Call& call) const
    {
        const std::string_view name = call.function->name;
        if (name == "nonfinite")
            return sum(call, [](const PlayedRun& run) {
                double count = 0;
                for (const FrameFacts& frame : run.frames)
                    count += static_cast<double>(frame.nonfinite);
                return count;
            });
        if (name == "not_black")
            return all(call, [&](const PlayedRun& run) {
                return share_lit(run.pictures.at(script_.frames - 1).linear) > kLeastLitShare;
            });
        if (name == "same_bytes_twice")
            return all(call, same_bytes);
        return of_run(call, played_.runs.at(call.run));
    }

private:
    double of_run(const Call& call, const PlayedRun& run) const
    {
        const std::string_view name = call.function->name;
        const int frame = call.frame.value_or(script_.frames - 1);
        if (name == "frames")
            return static_cast<double>(run.frames.size());
        if (name == "history_resets")
            return static_cast<double>(std::count_if(run.frames.begin(), run.frames.end(),
                [](const FrameFacts& facts) { return facts.history_reset; }));
        if (name == "samples")
            return run.frames.at(static_cast<std::size_t>(frame)).samples;
        const std::vector<float>& picture = run.pictures.at(frame).linear;
        if (name == "mean")
            return mean_value(picture);
        if (name == "max")
            return largest_value(picture);
        if (name == "relmse")
            return relative_mse(picture, played_.reference->linear);
        return root_mean_square_error(picture, played_.reference->linear);
    }

    static bool same_bytes(const PlayedRun& run)
    {
        return std::equal(run.frames.begin(), run.frames.end(), run.again.begin(), run.again.end(),
            [](const FrameFacts& a, const FrameFacts& b) { return a.hash == b.hash; });
    }

    template <typename Of> double sum(const Call& call, Of&& of) const
    {
        double total = 0;
        for (const auto& [name, run] : played_.runs)
            if (call.run.empty() || call.run == name)
                total += of(run);
        return total;
    }

    template <typename Of> double all(const Call& call, Of&& of) const
    {
        return sum(call, [&](const PlayedRun& run) { return of(run) ? 0.0 : 1.0; }) == 0 ? 1 : 0;
    }

    const Script& script_;
    const Played& played_;
};

Verdict judge_one(const Expectation& expectation, const Facts& facts)
{
    Verdict verdict{.expectation = expectation.text};
    try {
        const double left = evaluate(expectation.left, facts);
        if (expectation.comparison == Comparison::kNone) {
            verdict.ok = holds(left, Comparison::kNone, 0);
            verdict.finding = verdict.ok ? "yes" : "no";
            return verdict;
        }
        const double right = evaluate(expectation.right, facts);
        verdict.ok = holds(left, expectation.comparison, right);
        verdict.finding = number_text(left);
        if (expectation.right.kind != Expression::Kind::kNumber)
            verdict.finding +=
                " " + std::string(to_string(expectation.comparison)) + " " + number_text(right);
    } catch (const MetricError& problem) {
        verdict.finding = problem.what();
    }
    return verdict;
}

std::string escaped(const std::string& text)
{
    std::string result;
    for (const char c : text) {
        switch (c) {
        case '&': result += "&amp;"; break;
        case '<': result += "&lt;"; break;
        case '>': result += "&gt;"; break;
        case '"': result += "&quot;"; break;
        default: result += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
        }
    }
    return result;
}

std::size_t failures_in(const std::vector<Verdict>& verdicts)
{
    return static_cast<std::size_t>(
        std::count_if(verdicts.begin(), verdicts.end(), [](const Verdict& v) { return !v.ok; }));
}

}  // namespace

std::vector<Verdict> judge(const Script& script, const Played& played)
{
    const Facts facts(script, played);
    std::vector<Verdict> verdicts;
    for (const Expectation& expectation : script.expectations)
        verdicts.push_back(judge_one(expectation, facts));
    return verdicts;
}

std::string to_line(const Verdict& verdict)
{
    return (verdict.ok ? "ok  " : "FAIL ") + verdict.expectation + "  (" + verdict.finding + ")";
}

std::string junit_xml(const std::vector<JudgedScript>& scripts)
{
    std::string xml = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n";
    for (const JudgedScript& script : scripts) {
        xml += "  <testsuite name=\"" + escaped(script.file) + "\" tests=\""
            + std::to_string(script.verdicts.size()) + "\" failures=\""
            + std::to_string(failures_in(script.verdicts)) + "\" time=\""
            + number_text(script.seconds) + "\">\n";
        for (const Verdict& verdict : script.verdicts) {
            xml += "    <testcase classname=\"" + escaped(script.file) + "\" name=\""
                + escaped(verdict.expectation) + "\"";
            xml += verdict.ok
                ? "/>\n"
                : "><failure message=\"" + escaped(verdict.finding) + "\"/></testcase>\n";
        }
        xml += "  </testsuite>\n";
    }
    return xml + "</testsuites>\n";
}

}  // namespace farlight::client
