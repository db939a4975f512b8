// Student's t on logarithms: times are above 0 and what slows them down is a factor.
#include "client/metrics/turns.h"

#include <boost/math/distributions/students_t.hpp>
#include <cassert>
#include <cmath>
#include <limits>

namespace farlight::client {
namespace {

constexpr double kHeld = 0.975;  // a share of 0.025 lies on either side of an interval

TurnValues joined(const std::vector<TurnValues>& turns)
{
    TurnValues all;
    for (const TurnValues& turn : turns)
        all.insert(all.end(), turn.begin(), turn.end());
    return all;
}

double mean_of_logarithms(const std::vector<double>& logarithms)
{
    double sum = 0;
    for (const double x : logarithms)
        sum += x;
    return sum / static_cast<double>(logarithms.size());
}

/// About `value`, from logarithms of what each turn says of it.
Estimate about(double value, const std::vector<double>& logarithms)
{
    assert(!logarithms.empty());
    if (logarithms.size() < 2)
        return {value, {0, std::numeric_limits<double>::infinity()}};
    const auto n = static_cast<double>(logarithms.size());
    const double mean = mean_of_logarithms(logarithms);
    double squares = 0;
    for (const double x : logarithms)
        squares += (x - mean) * (x - mean);
    const double reach = boost::math::quantile(boost::math::students_t(n - 1), kHeld)
        * std::sqrt(squares / (n - 1) / n);
    return {value, {value * std::exp(-reach), value * std::exp(reach)}};
}

}  // namespace

Estimate median_of_turns(const std::vector<TurnValues>& turns)
{
    std::vector<double> logarithms;
    logarithms.reserve(turns.size());
    for (const TurnValues& turn : turns)
        logarithms.push_back(std::log(median(turn)));
    return about(median(joined(turns)), logarithms);
}

Estimate ratio_of_turns(const std::vector<TurnValues>& a, const std::vector<TurnValues>& b)
{
    assert(a.size() == b.size());
    std::vector<double> logarithms;
    logarithms.reserve(a.size());
    for (std::size_t i = 0; i < a.size(); ++i)
        logarithms.push_back(std::log(median(a[i]) / median(b[i])));
    return about(std::exp(mean_of_logarithms(logarithms)), logarithms);
}

}  // namespace farlight::client
