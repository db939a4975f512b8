// Alias tables draw each entry with exactly the probability that they state.
#include "server/scene/alias_table.h"

#include <gtest/gtest.h>
#include <numeric>
#include <random>
#include <vector>

namespace farlight {
namespace {

/// The probability that each index is drawn.
std::vector<double> masses(std::span<const AliasSlot> slots)
{
    std::vector<double> mass(slots.size(), 0);
    for (std::size_t i = 0; i < slots.size(); ++i) {
        const auto threshold = static_cast<double>(slots[i].threshold);
        mass[i] += threshold / static_cast<double>(slots.size());
        mass[slots[i].alias] += (1 - threshold) / static_cast<double>(slots.size());
    }
    return mass;
}

TEST(AliasTables, HaveExactlyTheStatedProbabilities)
{
    std::vector<double> weights(1000);
    for (std::size_t i = 0; i < weights.size(); ++i)
        weights[i] = i == 7 ? 1e5 : static_cast<double>(i % 13);
    const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
    const std::vector<double> mass = masses(alias_table(weights));
    for (std::size_t i = 0; i < weights.size(); ++i)
        if (weights[i] > 0)
            EXPECT_NEAR(mass[i], weights[i] / total, 1e-7) << i;
        else
            EXPECT_EQ(mass[i], 0) << i;
}

TEST(AliasTables, NeverDrawWhatHasNoWeight)
{
    std::mt19937 random(1);
    for (int n = 1; n < 60; ++n) {
        std::vector<double> weights;
        for (int i = 0; i < n; ++i)
            weights.push_back(i == n / 2 || random() % 3 == 0 ? std::exp(random() % 50) : 0);
        const std::vector<double> mass = masses(alias_table(weights));
        for (std::size_t i = 0; i < weights.size(); ++i)
            EXPECT_EQ(mass[i] > 0, weights[i] > 0) << i << " of " << n;
    }
}

}  // namespace
}  // namespace farlight
