// Bounds of lights, and the split that costs least by their surface area orientation heuristic.
#include "server/scene/light_tree.h"

#include "shaders/shared/scene_layout.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <numbers>

namespace farlight {
namespace {

using std::numbers::pi;

constexpr std::size_t kMaxLevels = 32;  // bits of a trail
constexpr std::size_t kBuckets = 12;  // places to split at, along an axis (as many as pbrt has)

/// Directions within `angle` of an axis.
struct Cone {
    glm::dvec3 axis{0, 0, 1};
    double angle = -1;  ///< [rad]; < 0: empty.
};

/// The smallest cone about both; Pharr et al. 2023, section 3.8.4.
Cone joined(const Cone& a, const Cone& b)
{
    if (a.angle < 0 || b.angle < 0)
        return a.angle < 0 ? b : a;
    const double between = std::acos(std::clamp(glm::dot(a.axis, b.axis), -1.0, 1.0));
    if (std::min(between + b.angle, pi) <= a.angle)
        return a;
    if (std::min(between + a.angle, pi) <= b.angle)
        return b;
    const double angle = (a.angle + between + b.angle) / 2;
    const glm::dvec3 across = b.axis - glm::dot(a.axis, b.axis) * a.axis;
    if (angle >= pi || !(glm::length(across) > 0))
        return {a.axis, pi};
    const double turn = angle - a.angle;
    return {std::cos(turn) * a.axis + std::sin(turn) * glm::normalize(across), angle};
}

/// Where some lights are, which way they shine and how strongly.
struct LightBounds {
    Bounds box;
    Cone normals;  ///< Of the surfaces, or the axes of spots.
    double spread = 0;  ///< They shine up to this far from their normals [rad].
    double intensity = 0;  ///< Luminance [cd], along the strongest direction.
    bool two_sided = false;

    void extend(const LightBounds& other)
    {
        box.extend(other.box);
        if (!(other.intensity > 0))
            return;
        normals = joined(normals, other.normals);
        spread = std::max(spread, other.spread);
        intensity += other.intensity;
        two_sided = two_sided || other.two_sided;
    }
};

Bounds box_of(const Light& light)
{
    const glm::dvec3 p(light.p0);
    const glm::dvec3 u(light.edge_u);
    const glm::dvec3 v(light.edge_v);
    Bounds box;
    box.extend(p);
    switch (light.kind) {
    case LIGHT_SPHERE: box.extend(p - u.x), box.extend(p + u.x); break;
    case LIGHT_DISK: {
        const glm::dvec3 reach = u.x * glm::sqrt(glm::max(glm::dvec3(0), 1.0 - v * v));
        box.extend(p - reach), box.extend(p + reach);
        break;
    }
    case LIGHT_QUAD: box.extend(p + u + v); [[fallthrough]];
    case LIGHT_TRIANGLE: box.extend(p + u), box.extend(p + v); break;
    default: break;
    }
    return box;
}

/// Of a spot, a disk or a polygon; not of unit length. Of a sphere and a point light: any.
glm::dvec3 axis_of(const Light& light)
{
    const glm::dvec3 v(light.edge_v);
    switch (light.kind) {
    case LIGHT_QUAD:
    case LIGHT_TRIANGLE: return glm::cross(glm::dvec3(light.edge_u), v);
    case LIGHT_SPHERE:
    case LIGHT_POINT: return {0, 0, 1};
    default: return v;
    }
}

LightBounds bounds_of(const Light& light)
{
    const double area = light.area;
    const glm::dvec3 axis = axis_of(light);
    LightBounds bounds{box_of(light), {}, pi / 2, light.mean_luminance, light.emits_both_sides};
    // What has collapsed has no direction, and what is off needs none.
    const bool shines = light.kind >= LIGHT_POINT || (area > 0 && glm::dot(axis, axis) > 0);
    if (!shines || !(light.mean_luminance > 0))
        return {bounds.box, {{0, 0, 1}, pi}};
    switch (light.kind) {
    case LIGHT_SPHERE:
        bounds.normals = {{0, 0, 1}, pi};
        bounds.intensity *= area / 4;  // of the disk that is seen
        break;
    case LIGHT_DISK:
        bounds.normals = {axis, 0};
        bounds.intensity *= area;
        break;
    case LIGHT_POINT: bounds.normals = {{0, 0, 1}, pi}; break;
    case LIGHT_SPOT: {
        const double width = 1 / static_cast<double>(light.edge_u.x);
        const double outer = -static_cast<double>(light.edge_u.y) * width;
        bounds.normals = {axis, 0};
        bounds.spread = std::acos(std::clamp(outer, -1.0, 1.0));
        break;
    }
    default:
        bounds.normals = {glm::normalize(axis), 0};
        bounds.intensity *= area;
        break;
    }
    return bounds;
}

/// What a node costs: intensity times area of the box times measure of the directions it shines
/// to. Conty Estevez and Kulla 2018, section 4.4.
double cost(const LightBounds& b)
{
    if (b.box.empty())
        return 0;
    const glm::dvec3 d = b.box.upper - b.box.lower;
    const double area = 2 * (d.x * d.y + d.y * d.z + d.z * d.x);
    const double o = b.normals.angle;
    const double w = std::min(o + b.spread, pi);
    const double directions = 2 * pi * (1 - std::cos(o))
        + pi / 2 * (2 * w * std::sin(o) - std::cos(o - 2 * w) - 2 * o * std::sin(o) + std::cos(o));
    return b.intensity * directions * area;
}

struct Item {
    LightBounds bounds;
    std::uint32_t light;  ///< Which of the lights.
};

class Builder {
public:
    Builder(std::span<const Light> lights, std::span<const std::uint32_t> indices)
        : indices_(indices)
    {
        for (std::uint32_t i = 0; i < lights.size(); ++i)
            items_.push_back({bounds_of(lights[i]), i});
        tree_.trails.resize(lights.size());
        tree_.nodes.reserve((2 * lights.size() - 1) * LIGHT_NODE_TEXELS);
    }

    LightTree run()
    {
        add(items_, 0, 0);
        return std::move(tree_);
    }

private:
    /// Appends the nodes of `items`; the first child follows its parent.
    void add(std::span<Item> items, std::uint32_t trail, std::uint32_t level)
    {
        LightBounds bounds;
        for (const Item& item : items)
            bounds.extend(item.bounds);
        const std::size_t at = tree_.nodes.size();
        append(bounds);
        if (items.size() == 1) {
            tree_.nodes[at + 2].z = LIGHT_NODE_LEAF | indices_[items[0].light];
            tree_.trails[items[0].light] = trail;
            return;
        }
        assert(level < kMaxLevels);
        const std::size_t middle = split(items, level);
        add(items.first(middle), trail, level + 1);
        tree_.nodes[at + 2].z = static_cast<std::uint32_t>(tree_.nodes.size() / LIGHT_NODE_TEXELS);
        add(items.subspan(middle), trail | 1U << level, level + 1);
    }

    void append(const LightBounds& b)
    {
        const glm::vec3 center(b.box.center());
        tree_.nodes.push_back(texel(center, bits(static_cast<float>(b.box.radius()))));
        tree_.nodes.push_back(
            texel(glm::vec3(b.normals.axis), bits(static_cast<float>(std::cos(b.normals.angle)))));
        tree_.nodes.emplace_back(bits(static_cast<float>(b.intensity)),
            bits(static_cast<float>(std::cos(b.spread))), 0, b.two_sided ? 1 : 0);
    }

    /// Orders the items so that those of the second child come last; how many are in the first.
    static std::size_t split(std::span<Item> items, std::uint32_t level)
    {
        Bounds centers;
        for (const Item& item : items)
            centers.extend(item.bounds.box.center());
        const glm::dvec3 extent = centers.upper - centers.lower;
        Plane best;
        for (int axis = 0; axis < 3; ++axis)
            if (extent[axis] > 0)
                try_axis(
                    items, Plane{1e300, axis, 0, centers.lower[axis], extent[axis]}, level, best);
        if (best.bucket == 0)
            return halve(items, extent);
        const auto middle = std::partition(items.begin(), items.end(),
            [&](const Item& item) { return bucket(item, best) < best.bucket; });
        return static_cast<std::size_t>(middle - items.begin());
    }

    /// Where to cut, and what that costs.
    struct Plane {
        double cost = 1e300;
        int axis = 0;
        std::size_t bucket = 0;  ///< The first of the second child; 0: no cut.
        double lower = 0;
        double extent = 0;
    };

    static std::size_t bucket(const Item& item, const Plane& plane)
    {
        const double place = (item.bounds.box.center()[plane.axis] - plane.lower) / plane.extent;
        return std::min(static_cast<std::size_t>(place * kBuckets), kBuckets - 1);
    }

    static void try_axis(std::span<const Item> items, Plane plane, std::uint32_t level, Plane& best)
    {
        std::array<LightBounds, kBuckets> buckets;
        std::array<std::size_t, kBuckets> counts{};
        for (const Item& item : items) {
            const std::size_t b = bucket(item, plane);
            buckets[b].extend(item.bounds);
            ++counts[b];
        }
        std::array<double, kBuckets> costs_above{};
        LightBounds above;
        for (std::size_t b = kBuckets - 1; b > 0; --b) {
            above.extend(buckets[b]);
            costs_above[b] = cost(above);
        }
        // Long boxes are better cut across: Conty Estevez and Kulla 2018, section 4.4.
        const double regularity = 1 / plane.extent;
        LightBounds below;
        std::size_t count = 0;
        for (std::size_t b = 1; b < kBuckets; ++b) {
            below.extend(buckets[b - 1]);
            count += counts[b - 1];
            const double total = regularity * (cost(below) + costs_above[b]);
            if (count > 0 && count < items.size() && fits(items.size(), count, level)
                && total < best.cost) {
                best = plane;
                best.cost = total;
                best.bucket = b;
            }
        }
    }

    /// By number, along the longest extent.
    static std::size_t halve(std::span<Item> items, const glm::dvec3& extent)
    {
        const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0
            : extent.y >= extent.z                                    ? 1
                                                                      : 2;
        const auto middle = items.begin() + static_cast<std::ptrdiff_t>(items.size() / 2);
        std::nth_element(items.begin(), middle, items.end(), [axis](const Item& a, const Item& b) {
            const double x = a.bounds.box.center()[axis];
            const double y = b.bounds.box.center()[axis];
            return x < y || (x == y && a.light < b.light);
        });
        return items.size() / 2;
    }

    /// Whether halving alone would bring both parts to leaves within the levels left.
    static bool fits(std::size_t count, std::size_t middle, std::uint32_t level)
    {
        const std::size_t larger = std::max(middle, count - middle);
        return level + 1 + static_cast<std::size_t>(std::bit_width(larger - 1)) <= kMaxLevels;
    }

    std::span<const std::uint32_t> indices_;
    std::vector<Item> items_;
    LightTree tree_;
};

}  // namespace

LightTree build_light_tree(std::span<const Light> lights, std::span<const std::uint32_t> indices)
{
    assert(!lights.empty() && lights.size() == indices.size());
    return Builder(lights, indices).run();
}

}  // namespace farlight
