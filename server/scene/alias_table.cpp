// Vose's construction, in double precision.
#include "server/scene/alias_table.h"

#include <algorithm>
#include <cassert>
#include <numeric>

namespace farlight {

std::vector<AliasSlot> alias_table(std::span<const double> weights)
{
    const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
    std::vector<AliasSlot> slots(weights.size());
    if (!(total > 0))
        return slots;
    std::vector<double> scaled;
    std::vector<std::uint32_t> small;
    std::vector<std::uint32_t> large;
    for (std::uint32_t i = 0; i < weights.size(); ++i) {
        assert(weights[i] >= 0);
        scaled.push_back(weights[i] / total * static_cast<double>(weights.size()));
        (scaled[i] < 1 ? small : large).push_back(i);
    }
    while (!small.empty() && !large.empty()) {
        const std::uint32_t s = small.back();
        const std::uint32_t l = large.back();
        small.pop_back();
        slots[s] = {static_cast<float>(scaled[s]), l};
        scaled[l] -= 1 - scaled[s];
        if (scaled[l] < 1) {
            large.pop_back();
            small.push_back(l);
        }
    }
    // What is left has a scaled weight of 1 up to rounding, or of 0 when rounding used up the
    // large.
    const auto heaviest = static_cast<std::uint32_t>(
        std::max_element(weights.begin(), weights.end()) - weights.begin());
    for (const auto& rest : {small, large})
        for (const std::uint32_t i : rest)
            slots[i] = weights[i] > 0 ? AliasSlot{1, i} : AliasSlot{0, heaviest};
    return slots;
}

}  // namespace farlight
