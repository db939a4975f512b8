// Transforms in double precision, rounded once at the end.
#include "server/scene/instance_transform.h"

#include "server/scene/texels.h"
#include "shaders/shared/scene_layout.h"

#include <algorithm>
#include <cmath>

namespace farlight {
namespace {

glm::dmat3 absolute(const glm::dmat3& m)
{
    return {glm::abs(m[0]), glm::abs(m[1]), glm::abs(m[2])};
}

glm::vec3 point(const glm::dmat4& m, const glm::vec3& p)
{
    return glm::vec3(m * glm::dvec4(p, 1));
}

}  // namespace

bool is_similarity(const glm::dmat3& m)
{
    // Columns of equal length at right angles, within what products of matrices that came from
    // single-precision files are off by.
    constexpr double kTolerance = 1e-5;
    const double size = glm::dot(m[0], m[0]);
    for (int a = 0; a < 3; ++a)
        for (int b = 0; b <= a; ++b)
            if (!(std::abs(glm::dot(m[a], m[b]) - (a == b ? size : 0)) <= kTolerance * size))
                return false;
    return size > 0;
}

double scale_of(const glm::dmat4& m)
{
    return std::cbrt(std::abs(glm::determinant(glm::dmat3(m))));
}

bool is_invertible(const glm::dmat4& m)
{
    const glm::dmat4 inverse = glm::inverse(m);
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 3; ++row)
            if (!(std::abs(m[column][row]) < 1e30 && std::abs(inverse[column][row]) < 1e30))
                return false;
    return true;
}

void pack_rows(const glm::dmat4& m, std::span<glm::uvec4> texels)
{
    for (int row = 0; row < 3; ++row)
        texels[static_cast<std::size_t>(row)] =
            glm::floatBitsToUint(glm::vec4(glm::dvec4(m[0][row], m[1][row], m[2][row], m[3][row])));
}

PrimitiveBounds transformed(const PrimitiveBounds& bounds, const glm::dmat4& m)
{
    const glm::dvec3 lower(bounds.lower);
    const glm::dvec3 upper(bounds.upper);
    const glm::dvec3 center(m * glm::dvec4(0.5 * (lower + upper), 1));
    const glm::dvec3 reach = absolute(glm::dmat3(m)) * (0.5 * (upper - lower));
    // The ray is taken into the object's space with single precision: 16 roundings of the largest
    // coordinate, as in geometry/surface.glsl.
    const glm::dvec3 largest = absolute(glm::dmat3(m)) * glm::max(glm::abs(lower), glm::abs(upper))
        + glm::abs(glm::dvec3(m[3]));
    const double slack = 16 * 0x1p-24 * std::max(largest.x, std::max(largest.y, largest.z));
    return {glm::vec3(center - reach - slack), glm::vec3(center + reach + slack)};
}

Light transformed(const Light& shape, const glm::dmat4& m)
{
    Light light = shape;
    light.p0 = point(m, shape.p0);
    if (shape.kind == LIGHT_SPHERE || shape.kind == LIGHT_DISK) {
        const double scale = is_similarity(glm::dmat3(m)) ? scale_of(m) : 0;
        light.edge_u.x = static_cast<float>(scale * shape.edge_u.x);
        light.area = static_cast<float>(scale * scale * shape.area);
        if (shape.kind == LIGHT_DISK && scale > 0)
            light.edge_v = glm::vec3(glm::normalize(glm::dmat3(m) * glm::dvec3(shape.edge_v)));
        return light;
    }
    light.edge_u = point(m, shape.p0 + shape.edge_u) - light.p0;
    light.edge_v = point(m, shape.p0 + shape.edge_v) - light.p0;
    light.mirrored = glm::determinant(glm::dmat3(m)) < 0;
    if (light.mirrored)
        std::swap(light.edge_u, light.edge_v);  // the normal stays outside
    light.area = glm::length(glm::cross(light.edge_u, light.edge_v))
        * (shape.kind == LIGHT_TRIANGLE ? 0.5F : 1.0F);
    return light;
}

}  // namespace farlight
