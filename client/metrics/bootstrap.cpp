// Percentile bootstrap over pairs.
#include "client/metrics/bootstrap.h"

#include <algorithm>
#include <cassert>
#include <random>

namespace farlight::client {
namespace {

constexpr int kResamples = 2000;  // the interval's ends then vary by about 1 % of its width
constexpr double kOutside = 0.025;  // on either side

}  // namespace

double median(std::vector<double> values)
{
    if (values.empty())
        return 0;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    if (values.size() % 2 == 1)
        return *middle;
    return 0.5 * (*middle + *std::max_element(values.begin(), middle));
}

RatioOfMedians ratio_of_medians(const std::vector<double>& a, const std::vector<double>& b)
{
    assert(a.size() == b.size() && !a.empty());
    std::mt19937 random(1);
    std::uniform_int_distribution<std::size_t> pick(0, a.size() - 1);
    std::vector<double> ratios;
    std::vector<double> some_a(a.size());
    std::vector<double> some_b(a.size());
    for (int i = 0; i < kResamples; ++i) {
        for (std::size_t k = 0; k < a.size(); ++k) {
            const std::size_t pair = pick(random);
            some_a[k] = a[pair];
            some_b[k] = b[pair];
        }
        ratios.push_back(median(some_a) / median(some_b));
    }
    std::sort(ratios.begin(), ratios.end());
    const auto at = [&](double share) {
        return ratios[static_cast<std::size_t>(share * (kResamples - 1))];
    };
    return {median(a) / median(b), {at(kOutside), at(1 - kOutside)}};
}

}  // namespace farlight::client
