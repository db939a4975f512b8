// What counts as news, and a rung as a point of the message.
#include "server/stream/frontier_news.h"

#include <algorithm>
#include <cmath>

namespace farlight {
namespace {

/// The frontier is said again when times or errors have changed by these factors.
constexpr double kNewMs = 1.1;
constexpr double kNewError = 1.25;

constexpr const char* kReportUnused =
    "every point of the server's report differs from this session's settings in more than "
    "resolution_scale, samples_per_pixel and atrous_iterations";

bool differs(double a, double b, double factor)
{
    const bool close = a <= factor * b && b <= factor * a;
    return !close && !(std::isnan(a) && std::isnan(b));
}

bool differs(const Rung& a, const Rung& b)
{
    if (a.choice != b.choice || differs(a.ms, b.ms, kNewMs)
        || a.error.has_value() != b.error.has_value())
        return true;
    return a.error
        && (differs(a.error->value, b.error->value, kNewError)
            || std::isnan(a.error->lower) != std::isnan(b.error->lower));
}

protocol::FrontierPoint point_of(const Rung& rung)
{
    protocol::FrontierPoint point{rung.label, {}, rung.ms, {}, {}, {}};
    point.settings = {{"resolution_scale", rung.choice.resolution_scale},
        {"samples_per_pixel", rung.choice.samples_per_pixel},
        {"atrous_iterations", rung.choice.atrous_iterations}};
    if (!rung.error)
        return point;
    point.error = rung.error->value;
    if (std::isfinite(rung.error->lower) && std::isfinite(rung.error->upper)) {
        point.lower = rung.error->lower;
        point.upper = rung.error->upper;
    }
    return point;
}

}  // namespace

std::optional<protocol::Frontier> FrontierNews::tell(
    const RungPrices& prices, Extent extent, Time now)
{
    const std::vector<Rung>& ladder = prices.ladder();
    const bool same = std::equal(said_.begin(), said_.end(), ladder.begin(), ladder.end(),
        [](const Rung& a, const Rung& b) { return !differs(a, b); });
    if (same)
        return std::nullopt;
    said_ = ladder;
    said_at_ = now;
    protocol::Frontier frontier{prices.source(), {}, {}};
    if (prices.report_unused())
        frontier.reason = kReportUnused;
    else if (prices.report() != nullptr)
        frontier.reason = otherwise_measured(*prices.report(), extent);
    for (const Rung& rung : ladder)
        frontier.points.push_back(point_of(rung));
    return frontier;
}

std::uint16_t FrontierNews::rung_of(const Choice& choice) const
{
    const auto said = std::find_if(
        said_.begin(), said_.end(), [&](const Rung& rung) { return rung.choice == choice; });
    return said == said_.end() ? 0 : static_cast<std::uint16_t>(said - said_.begin() + 1);
}

}  // namespace farlight
