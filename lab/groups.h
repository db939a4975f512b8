// Groups of cases, one file each.
#pragma once

#include "lab/case.h"

namespace farlight::lab {

std::span<const Case> accumulation_cases();
std::span<const Case> display_cases();

inline std::vector<std::span<const Case>> all_groups()
{
    return {accumulation_cases(), display_cases()};
}

}  // namespace farlight::lab
