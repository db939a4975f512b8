// See the header.
#include "lab/report.h"

#include <cmath>
#include <cstdio>

namespace farlight::lab {
namespace {

using nlohmann::json;

std::string number(double value)
{
    char text[32];
    std::snprintf(text, sizeof text, "%.4g", value);
    return text;
}

std::string text_of(const Measurement& m)
{
    return m.what + ": " + number(m.measured) + (m.upper ? " <= " : " >= ") + number(m.bound);
}

std::string margin_of(const Measurement& m)
{
    if (m.bound == 0 || m.measured == m.bound)
        return m.holds() ? "exact" : "none";
    return number(100 * m.margin()) + " %";
}

/// NaN and infinity have no JSON.
json finite(double value)
{
    return std::isfinite(value) ? json(value) : json(number(value));
}

json to_json(const Measurement& m)
{
    return {{"what", m.what}, {"measured", finite(m.measured)}, {"bound", finite(m.bound)},
        {"kind", m.upper ? "at most" : "at least"}, {"margin", finite(m.margin())},
        {"holds", m.holds()}};
}

std::string escaped(std::string_view text)
{
    std::string out;
    for (const char c : text)
        out += c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '&' ? "&amp;" : std::string(1, c);
    return out;
}

std::string cell(std::string_view text, std::string_view tag = "td")
{
    return "<" + std::string(tag) + ">" + escaped(text) + "</" + std::string(tag) + ">";
}

std::string head(std::initializer_list<std::string_view> names)
{
    std::string row = "<tr>";
    for (const std::string_view name : names)
        row += cell(name, "th");
    return row + "</tr>\n";
}

constexpr const char* kPage = R"(<!doctype html>
<html lang="en"><meta charset="utf-8"><title>Farlight: hard cases</title>
<style>
body { font: 15px/1.45 system-ui, sans-serif; max-width: 75rem; margin: 2rem auto; padding: 0 1rem; color: #1b1b1b; }
table { border-collapse: collapse; width: 100%; margin: 1rem 0 2rem; }
th, td { text-align: left; vertical-align: top; padding: .25rem .6rem; border-bottom: 1px solid #d8d8d8; }
td.ok { color: #00674d; } td.FAIL { color: #a03000; font-weight: bold; }
td:nth-last-child(2) { white-space: nowrap; }
code { font-size: 13px; }
</style>
)";

std::string with_reason(const Judged& judged)
{
    const std::string& reason = judged.findings.reason();
    return reason.empty() ? reason : "  (" + reason + ")";
}

std::string row_of(const Judged& judged)
{
    const Measurement* m = judged.findings.decisive();
    const std::string verdict(judged.verdict());
    return "<tr>" + cell(judged.hard_case.id) + cell(judged.hard_case.name)
        + cell(judged.hard_case.claim) + cell(to_text(judged.hard_case.layer))
        + cell(m == nullptr ? judged.failure : text_of(*m) + with_reason(judged))
        + cell(m == nullptr ? "" : margin_of(*m)) + "<td class=\"" + verdict + "\">" + verdict
        + "</td></tr>\n";
}

}  // namespace

std::string_view Judged::verdict() const
{
    if (!failure.empty())
        return "FAIL";
    if (!findings.hold())
        return "FAIL";
    return findings.reason().empty() ? "ok" : "known failure";
}

std::string line_of(const Judged& judged)
{
    const Measurement* m = judged.findings.decisive();
    std::string line(judged.verdict());
    line.resize(std::max<std::size_t>(line.size(), 4), ' ');
    line +=
        "  " + std::string(judged.hard_case.id) + "  " + std::string(judged.hard_case.name) + "  ";
    if (!judged.failure.empty())
        return line + judged.failure;
    line += m == nullptr ? "measured nothing" : text_of(*m) + "  margin " + margin_of(*m);
    return line + with_reason(judged);
}

std::string line_of(const Mutation& mutation)
{
    return std::string(mutation.noticed ? "noticed " : "SURVIVED") + "  " + mutation.guard
        + " out, case " + mutation.case_id + ": " + mutation.how;
}

json to_json(const Sheet& sheet)
{
    json page{{"device", sheet.device}};
    for (const Capability& c : sheet.capabilities)
        page["capabilities"].push_back(
            {{"expression", c.expression}, {"result", c.result}, {"left_open", c.left_open}});
    for (const Judged& judged : sheet.cases) {
        json row{{"id", judged.hard_case.id}, {"group", judged.hard_case.group},
            {"name", judged.hard_case.name}, {"layer", to_text(judged.hard_case.layer)},
            {"claim", judged.hard_case.claim}, {"verdict", judged.verdict()},
            {"seconds", judged.seconds}, {"measurements", json::array()}};
        if (!judged.failure.empty())
            row["failure"] = judged.failure;
        if (!judged.findings.reason().empty())
            row["known_because"] = judged.findings.reason();
        for (const Measurement& m : judged.findings.all())
            row["measurements"].push_back(to_json(m));
        page["cases"].push_back(std::move(row));
    }
    for (const Mutation& m : sheet.mutations)
        page["mutations"].push_back(
            {{"guard", m.guard}, {"case", m.case_id}, {"noticed", m.noticed}, {"how", m.how}});
    return page;
}

std::string to_html(const Sheet& sheet)
{
    std::string page = kPage;
    page += "<h1>Hard cases</h1><p>" + escaped(sheet.device) + "</p>\n<table>"
        + head(
            {"id", "case", "what must hold", "layer", "measured and bound", "margin", "verdict"});
    for (const Judged& judged : sheet.cases)
        page += row_of(judged);
    page += "</table>\n";
    if (!sheet.mutations.empty()) {
        page += "<h2>Without their guards</h2><p>A case that holds without its guard proves "
                "nothing.</p><table>"
            + head({"guard taken out", "case", "what became of it", ""});
        for (const Mutation& m : sheet.mutations)
            page += "<tr>" + cell(m.guard) + cell(m.case_id) + cell(m.how) + "<td class=\""
                + (m.noticed ? "ok\">noticed" : "FAIL\">survived") + "</td></tr>\n";
        page += "</table>\n";
    }
    page += "<h2>What the device makes of open arithmetic</h2><table>"
        + head({"expression", "result", "what is left open"});
    for (const Capability& c : sheet.capabilities)
        page += "<tr><td><code>" + escaped(c.expression) + "</code></td>" + cell(c.result)
            + cell(c.left_open) + "</tr>\n";
    return page + "</table></html>\n";
}

}  // namespace farlight::lab
