// Reference: glTF 2.0 specification, section 3.7.2.1, which leaves the size of points and lines
// open.
#include "server/scene/gltf_strokes.h"

#include "server/scene/mesh_repair.h"
#include "server/scene/mesh_vertices.h"

#include <algorithm>
#include <array>
#include <cassert>

namespace farlight {

namespace {

constexpr int kPoints = 0;
constexpr int kLines = 1;
constexpr int kLineLoop = 2;

constexpr double kThickness = 1.0 / 200;  // of the whole: some pixels where it fills a picture
constexpr double kLonePoint = 0.01;  // [m], thickness of what has no size

using Segment = std::array<std::uint32_t, 2>;

std::vector<Segment> segments_of(const std::vector<std::uint32_t>& corners, int mode)
{
    std::vector<Segment> segments;
    if (mode == kPoints)
        for (const std::uint32_t corner : corners)
            segments.push_back({corner, corner});
    else
        for (std::size_t i = 0; i + 1 < corners.size(); i += mode == kLines ? 2 : 1)
            segments.push_back({corners[i], corners[i + 1]});
    if (mode == kLineLoop && corners.size() > 1)
        segments.push_back({corners.back(), corners.front()});
    return segments;
}

double radius_of(const Mesh& vertices, const std::vector<std::uint32_t>& corners)
{
    Bounds bounds;
    for (const std::uint32_t corner : corners)
        if (is_bounded(vertices.positions[corner]))
            bounds.extend(glm::dvec3(vertices.positions[corner]));
    const double thickness = bounds.empty() ? 0 : 2 * bounds.radius() * kThickness;
    return 0.5 * (thickness > 0 ? thickness : kLonePoint);
}

/// A solid's vertices, and the vertex of the file that each stands at.
class Solids {
public:
    explicit Solids(double radius) : radius_(radius) { }

    void add(const Segment& ends, const glm::dvec3& a, const glm::dvec3& b)
    {
        if (ends[0] == ends[1])
            add_point(ends[0], a);
        else if (a != b)
            add_prism(ends, a, b);
    }

    Mesh made_of(const Mesh& vertices) const
    {
        Mesh solids = vertices;
        solids.normals.clear();
        solids.tangents.clear();
        gather_vertices(solids, from_);
        solids.positions = positions_;
        solids.triangles = triangles_;
        return solids;
    }

private:
    std::uint32_t vertex(std::uint32_t of, const glm::dvec3& position)
    {
        from_.push_back(of);
        positions_.emplace_back(position);
        return static_cast<std::uint32_t>(from_.size() - 1);
    }

    void add_point(std::uint32_t point, const glm::dvec3& at)
    {
        std::array<std::uint32_t, 6> tip{};  // -x, +x, -y, +y, -z, +z
        for (std::size_t i = 0; i < 6; ++i) {
            glm::dvec3 offset(0);
            offset[static_cast<int>(i / 2)] = i % 2 == 0 ? -radius_ : radius_;
            tip[i] = vertex(point, at + offset);
        }
        for (std::size_t octant = 0; octant < 8; ++octant) {
            const std::uint32_t x = tip[octant & 1U];
            const std::uint32_t y = tip[2 + ((octant >> 1U) & 1U)];
            const std::uint32_t z = tip[4 + ((octant >> 2U) & 1U)];
            const bool outward = ((octant & 1U) + ((octant >> 1U) & 1U) + (octant >> 2U)) % 2 == 1;
            triangles_.push_back(outward ? glm::uvec3(x, y, z) : glm::uvec3(x, z, y));
        }
    }

    void add_prism(const Segment& ends, const glm::dvec3& a, const glm::dvec3& b)
    {
        const glm::dvec3 along = glm::normalize(b - a);
        const glm::dvec3 aside = std::abs(along.x) < 0.6 ? glm::dvec3(1, 0, 0)  // 0.6 > 1/sqrt(3)
                                                         : glm::dvec3(0, 1, 0);
        const glm::dvec3 u = glm::normalize(glm::cross(along, aside));
        const glm::dvec3 v = glm::cross(along, u);
        std::array<std::uint32_t, 6> corner{};  // three around each end
        for (std::size_t i = 0; i < 3; ++i) {
            const double angle = glm::radians(120.0 * static_cast<double>(i));
            const glm::dvec3 offset = radius_ * (std::cos(angle) * u + std::sin(angle) * v);
            corner[i] = vertex(ends[0], a + offset);
            corner[i + 3] = vertex(ends[1], b + offset);
        }
        triangles_.emplace_back(corner[0], corner[2], corner[1]);
        triangles_.emplace_back(corner[3], corner[4], corner[5]);
        for (std::size_t i = 0; i < 3; ++i) {
            const std::size_t next = (i + 1) % 3;
            triangles_.emplace_back(corner[i], corner[next], corner[next + 3]);
            triangles_.emplace_back(corner[i], corner[next + 3], corner[i + 3]);
        }
    }

    double radius_;
    std::vector<std::uint32_t> from_;
    std::vector<glm::vec3> positions_;
    std::vector<glm::uvec3> triangles_;
};

}  // namespace

std::uint64_t triangles_of_strokes(std::uint64_t corners, int mode)
{
    constexpr std::uint64_t kOfOne = 8;  // an octahedron's, and a prism's
    const std::uint64_t strokes = mode == kLines ? corners / 2
        : mode == kPoints || mode == kLineLoop   ? corners
                                                 : corners - std::min<std::uint64_t>(corners, 1);
    return kOfOne * strokes;
}

Mesh strokes_as_solids(const Mesh& vertices, const std::vector<std::uint32_t>& corners, int mode)
{
    assert(is_strokes(mode));
    Solids solids(radius_of(vertices, corners));
    for (const Segment& ends : segments_of(corners, mode)) {
        const glm::vec3& a = vertices.positions[ends[0]];
        const glm::vec3& b = vertices.positions[ends[1]];
        if (is_bounded(a) && is_bounded(b))
            solids.add(ends, glm::dvec3(a), glm::dvec3(b));
    }
    return solids.made_of(vertices);
}

}  // namespace farlight
