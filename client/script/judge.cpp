// What becomes of the values of expectations.
#include "client/script/judge.h"

#include "client/metrics/metrics.h"
#include "client/script/facts.h"

#include <algorithm>
#include <cstdio>

namespace farlight::client {
namespace {

std::string number_text(double value)
{
    char text[32];
    std::snprintf(text, sizeof text, "%.4g", value);
    return text;
}

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
