// Guards that are C++: which there are, and how to take one out of this process.
#pragma once

#include "lab/guards.h"

#include <span>
#include <string>

namespace farlight::lab {

class HostGuards {
public:
    /// Of all that are linked into this process.
    static std::vector<std::string_view> names();
    /// False where there is none called so.
    static bool take_out(std::string_view name);
};

/// How rows and names differ: a row whose guard is not in the process, a guard without a row, two
/// of one name; empty if they do not.
std::string disagreement(
    std::span<const Guard> rows, const std::vector<std::string_view>& host_guards);

}  // namespace farlight::lab
