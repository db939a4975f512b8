// Insides: which transparent things fill a place, told from the surfaces around it: what a camera
// stands in.
#pragma once

#include "server/scene/scene.h"

#include <array>
#include <span>

namespace farlight {

/// Of a scene's bodies that have an inside: their materials transmit and are not thin-walled. What
/// a skin or morph targets deform is left out: a place in it counts as outside.
class Insides {
public:
    Insides() = default;
    explicit Insides(const Scene& scene);

    /// What fills a place.
    struct Filling {
        /// Materials + 1 of the bodies around it, the largest first, 0 after the last (as
        /// shaders/bsdf/interior.glsl keeps them); of more than four the smallest.
        glm::uvec4 entered{0};
        glm::vec3 absorption{0};  ///< Of the one that prevails [1/m].
    };
    /// `world_from_node`: of every node now. Some 30 ns a triangle of bodies whose bounds hold the
    /// point.
    Filling at(const glm::dvec3& point, std::span<const glm::dmat4> world_from_node) const;

private:
    /// All of one material that hangs on one node, in the node's space: together they are closed.
    struct Body {
        std::uint32_t material = 0;
        std::uint32_t node = kNone;
        std::vector<std::array<glm::vec3, 3>> triangles;  ///< Counter-clockwise from outside.
        std::vector<Sphere> spheres;
        Bounds bounds;
    };
    struct Around {
        std::uint32_t material = 0;
        double size = 0;
    };

    Body& body_of(std::uint32_t material, std::uint32_t node);
    void add_triangle(Body& body, const std::array<glm::dvec3, 3>& corners);
    void add_mesh(Body& body, const Mesh& mesh, const glm::dmat4& place);
    Filling filling_of(std::vector<Around> around) const;
    static int times_around(const Body& body, const glm::dvec3& point);

    std::vector<Body> bodies_;
    std::vector<int> priorities_;  ///< One a material.
    std::vector<glm::vec3> absorptions_;  ///< Likewise [1/m].
};

}  // namespace farlight
