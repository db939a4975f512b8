// See the header.
#include "lab/host_guards.h"

#include "server/host_guard.h"

#include <algorithm>

namespace farlight::lab {

std::vector<std::string_view> HostGuards::names()
{
    std::vector<std::string_view> names;
    for (const HostGuard* guard = HostGuard::first; guard != nullptr; guard = guard->next_)
        names.emplace_back(guard->name_);
    return names;
}

bool HostGuards::take_out(std::string_view name)
{
    for (const HostGuard* guard = HostGuard::first; guard != nullptr; guard = guard->next_)
        if (guard->name_ == name) {
            guard->in_ = false;
            return true;
        }
    return false;
}

std::string disagreement(
    std::span<const Guard> rows, const std::vector<std::string_view>& host_guards)
{
    const auto quoted = [](std::string_view name) { return "'" + std::string(name) + "'"; };
    for (const Guard& row : rows) {
        const auto of_its_name = [&](const Guard& other) { return other.name == row.name; };
        if (std::count_if(rows.begin(), rows.end(), of_its_name) > 1)
            return "two guards are called " + quoted(row.name);
        if (row.in_host()
            && std::find(host_guards.begin(), host_guards.end(), row.name) == host_guards.end())
            return "no C++ of this process has the guard " + quoted(row.name);
    }
    for (const std::string_view name : host_guards) {
        if (std::count(host_guards.begin(), host_guards.end(), name) > 1)
            return "two places in C++ are called " + quoted(name);
        const auto names_it = [&](const Guard& row) { return row.in_host() && row.name == name; };
        if (std::none_of(rows.begin(), rows.end(), names_it))
            return "no row says what the guard " + quoted(name) + " in C++ keeps";
    }
    return {};
}

}  // namespace farlight::lab
