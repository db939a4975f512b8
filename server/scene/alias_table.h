// Alias table: draws an index with probability proportional to its weight in constant time.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace farlight {

/// Draw a slot uniformly; keep it where a second uniform number is below `threshold`, else take
/// `alias`.
struct AliasSlot {
    float threshold = 0;
    std::uint32_t alias = 0;
};

/// One slot a weight; weights are >= 0. An index of weight 0 is never drawn, unless all are 0.
/// Source: Vose 1991, "A Linear Algorithm for Generating Random Numbers with a Given Distribution".
std::vector<AliasSlot> alias_table(std::span<const double> weights);

}  // namespace farlight
