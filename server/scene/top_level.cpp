// Four-wide from the top: a range of entries is halved, its larger part again, until it is in four.
#include "server/scene/top_level.h"

#include "server/host_guard.h"
#include "shaders/shared/scene_layout.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <limits>

namespace farlight {
namespace {

const HostGuard top_level_within_its_stack("top_level_within_its_stack");

using Entries = std::span<TopLevelEntry>;

constexpr int kBins = 16;

/// Entries that may wait on the stack beyond what a tree of medians needs: room for the heuristic.
constexpr int kSlack = 6;

constexpr PrimitiveBounds kEmpty{glm::vec3(std::numeric_limits<float>::infinity()),
    glm::vec3(-std::numeric_limits<float>::infinity())};

PrimitiveBounds united(const PrimitiveBounds& a, const PrimitiveBounds& b)
{
    return {glm::min(a.lower, b.lower), glm::max(a.upper, b.upper)};
}

PrimitiveBounds bounds_of(Entries entries)
{
    PrimitiveBounds bounds = kEmpty;
    for (const TopLevelEntry& entry : entries)
        bounds = united(bounds, entry.bounds);
    return bounds;
}

/// Half the surface; in double, for the squares of 1e30 are no floats. 0 for nothing.
double half_area(const PrimitiveBounds& b)
{
    const glm::dvec3 d = glm::max(glm::dvec3(b.upper) - glm::dvec3(b.lower), glm::dvec3(0));
    return d.x * d.y + d.y * d.z + d.z * d.x;
}

double center(const TopLevelEntry& entry, int axis)
{
    return 0.5 * (static_cast<double>(entry.bounds.lower[axis]) + entry.bounds.upper[axis]);
}

glm::dvec3 center(const TopLevelEntry& entry)
{
    return 0.5 * (glm::dvec3(entry.bounds.lower) + glm::dvec3(entry.bounds.upper));
}

struct Span {
    int axis = 0;
    double lower = 0;
    double upper = 0;
};

/// The axis along which the centers spread most.
Span widest_span(Entries entries)
{
    glm::dvec3 lower(std::numeric_limits<double>::infinity());
    glm::dvec3 upper = -lower;
    for (const TopLevelEntry& entry : entries) {
        lower = glm::min(lower, center(entry));
        upper = glm::max(upper, center(entry));
    }
    const glm::dvec3 extent = upper - lower;
    int axis = extent.y > extent.x ? 1 : 0;
    axis = extent.z > extent[axis] ? 2 : axis;
    return {axis, lower[axis], upper[axis]};
}

/// Size of the first part after halving by count.
std::size_t split_at_median(Entries entries)
{
    const int axis = widest_span(entries).axis;
    const std::size_t half = (entries.size() + 1) / 2;
    std::nth_element(entries.begin(), entries.begin() + static_cast<std::ptrdiff_t>(half),
        entries.end(),
        [&](const auto& a, const auto& b) { return center(a, axis) < center(b, axis); });
    return half;
}

struct Bin {
    PrimitiveBounds bounds = kEmpty;
    std::size_t count = 0;

    void add(const Bin& other) { bounds = united(bounds, other.bounds), count += other.count; }
    double cost() const { return static_cast<double>(count) * half_area(bounds); }
};

/// Size of the first part after splitting where the heuristic over bins is least.
/// Source: Wald 2007, "On fast Construction of SAH-based Bounding Volume Hierarchies".
std::size_t split_by_area(Entries entries)
{
    const Span span = widest_span(entries);
    if (!(span.upper > span.lower))
        return split_at_median(entries);
    const double bins_per_metre = kBins / (span.upper - span.lower);
    const auto bin_of = [&](const TopLevelEntry& entry) {
        const double at = (center(entry, span.axis) - span.lower) * bins_per_metre;
        return static_cast<std::size_t>(std::min(static_cast<int>(at), kBins - 1));
    };
    std::array<Bin, kBins> bins;
    for (const TopLevelEntry& entry : entries)
        bins[bin_of(entry)].add({entry.bounds, 1});
    std::array<double, kBins> cost_right{};
    Bin right;
    for (std::size_t i = kBins - 1; i > 0; --i) {
        right.add(bins[i]);
        cost_right[i] = right.cost();
    }
    Bin left;
    std::size_t best = 1;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 1; i < kBins; ++i) {
        left.add(bins[i - 1]);
        if (const double cost = left.cost() + cost_right[i]; cost < least)
            least = cost, best = i;
    }
    const auto middle = std::partition(entries.begin(), entries.end(),
        [&](const TopLevelEntry& entry) { return bin_of(entry) < best; });
    const auto size = static_cast<std::size_t>(middle - entries.begin());
    return size == 0 || size == entries.size() ? split_at_median(entries) : size;
}

/// Stack that a tree of medians over so many entries needs: three wait at each level.
int balanced_stack(std::size_t entries)
{
    int stack = 0;
    for (std::size_t reach = 1; reach < entries; reach *= kBvhWidth)
        stack += kBvhWidth - 1;
    return stack;
}

struct Parts {
    std::array<Entries, kBvhWidth> entries;
    std::array<PrimitiveBounds, kBvhWidth> bounds{};
    std::array<double, kBvhWidth> gains{};  ///< From splitting each once more.
    std::size_t count = 0;

    std::size_t most_to_gain() const
    {
        const auto end = gains.begin() + static_cast<std::ptrdiff_t>(count);
        return static_cast<std::size_t>(std::max_element(gains.begin(), end) - gains.begin());
    }
};

/// In up to four parts, always splitting the one with the most to gain.
template <typename Split> Parts split(Entries entries, const Split& split_once, bool by_count)
{
    Parts parts;
    const auto set = [&](std::size_t at, Entries part) {
        parts.entries[at] = part;
        parts.bounds[at] = bounds_of(part);
        const double count = part.size() < 2 ? 0 : static_cast<double>(part.size());
        parts.gains[at] = by_count ? count : count * (half_area(parts.bounds[at]) + 1e-300);
    };
    set(parts.count++, entries);
    while (parts.count < kBvhWidth) {
        const std::size_t largest = parts.most_to_gain();
        const Entries part = parts.entries[largest];
        if (part.size() < 2)
            break;
        const std::size_t first = split_once(part);
        set(parts.count++, part.subspan(first));
        set(largest, part.first(first));
    }
    return parts;
}

class Builder {
public:
    explicit Builder(std::span<glm::uvec4> nodes) : nodes_(nodes) { }

    /// `stack`: what the subtree may need. Returns its first texel.
    unsigned build(Entries entries, int stack)
    {
        Parts parts = split(entries, split_by_area, false);
        const auto fits = [&](Entries part) {
            return balanced_stack(part.size()) <= stack - static_cast<int>(parts.count) + 1;
        };
        if (top_level_within_its_stack
            && !std::all_of(parts.entries.begin(),
                parts.entries.begin() + static_cast<std::ptrdiff_t>(parts.count), fits))
            parts = split(entries, split_at_median, true);
        const unsigned at = used_;
        used_ += BVH_NODE_TEXELS;
        for (std::size_t i = 0; i < kBvhWidth; ++i) {
            const bool there = i < parts.count && !parts.entries[i].empty();
            set_child_bounds(nodes_, at, i, there ? parts.bounds[i] : kNowhereBounds);
            nodes_[at + 6][static_cast<int>(i)] = !there ? BVH_NO_CHILD
                : parts.entries[i].size() == 1
                ? parts.entries[i].front().word
                : build(parts.entries[i], stack - static_cast<int>(parts.count) + 1);
        }
        return at;
    }

private:
    std::span<glm::uvec4> nodes_;
    unsigned used_ = 0;
};

}  // namespace

std::size_t top_level_texels(std::size_t entries)
{
    // Every node but the root has two children or more, so there are fewer than there are entries.
    return std::max<std::size_t>(entries, 1) * BVH_NODE_TEXELS;
}

int top_level_stack(std::size_t entries)
{
    // Up to four fit one node, whatever splits them.
    return entries <= kBvhWidth ? kBvhWidth - 1 : balanced_stack(entries) + kSlack;
}

void build_top_level(std::span<TopLevelEntry> entries, std::span<glm::uvec4> nodes)
{
    assert(nodes.size() >= top_level_texels(entries.size()));
    std::fill(nodes.begin(), nodes.end(), glm::uvec4(BVH_NO_CHILD));
    Builder(nodes).build(entries, top_level_stack(entries.size()));
}

}  // namespace farlight
