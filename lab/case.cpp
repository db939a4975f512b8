// What is common to all cases.
#include "lab/case.h"

#include "lab/groups.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>

namespace farlight::lab {

std::string_view to_text(Layer layer)
{
    constexpr std::string_view kNames[] = {"function", "picture", "sequence", "server"};
    return kNames[static_cast<std::size_t>(layer)];
}

double Measurement::margin() const
{
    if (bound == 0 || measured == bound)
        return holds() ? 1 : -1;
    const double left = (upper ? bound - measured : measured - bound) / std::abs(bound);
    return std::isnan(left) ? -1 : left;
}

const Measurement* Findings::decisive() const
{
    const auto least =
        std::min_element(all_.begin(), all_.end(), [](const Measurement& a, const Measurement& b) {
            return std::pair(a.holds(), a.margin()) < std::pair(b.holds(), b.margin());
        });
    return least == all_.end() ? nullptr : &*least;
}

bool Findings::hold() const
{
    return !all_.empty() && std::all_of(all_.begin(), all_.end(), [](const Measurement& one) {
        return one.holds() || one.known;
    });
}

namespace {

/// Laws after cases, by number, then by letter.
std::tuple<bool, int, std::string_view> rank_of(const Case& one)
{
    const bool law = one.id.starts_with('M');
    const std::string digits(one.id.substr(law ? 1 : 0));
    return {law, std::stoi(digits), one.id};
}

}  // namespace

std::vector<Case> all_cases()
{
    std::vector<Case> cases;
    for (const Group& group : all_groups())
        cases.insert(cases.end(), group.cases.begin(), group.cases.end());
    std::sort(cases.begin(), cases.end(),
        [](const Case& a, const Case& b) { return rank_of(a) < rank_of(b); });
    return cases;
}

}  // namespace farlight::lab
