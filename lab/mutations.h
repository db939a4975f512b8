// Cases without their guards, a process each: what breaks may not come back.
#pragma once

#include "lab/guards.h"
#include "lab/report.h"

#include <filesystem>

namespace farlight::lab {

/// Runs `hard_case` in a process of its own, `program` with the option that takes `guard` out. A
/// process that crashes or is not done after two minutes has noticed too.
Mutation run_without(const std::filesystem::path& program, const Guard& guard,
    std::string_view case_id, const std::string& device);

/// Ids in Guard::keeps.
std::vector<std::string> cases_kept_by(const Guard& guard);

}  // namespace farlight::lab
