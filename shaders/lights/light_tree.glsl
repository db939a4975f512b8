// Choosing a light by descending a tree over them, at each node in proportion to what either child may matter at the
// shading point (layout: light_tree in shared/scene_layout.h).
//
// Sources: Conty Estevez and Kulla 2018, "Importance Sampling of Many Lights with Adaptive Tree Splitting"; Pharr et
// al. 2023, "Physically Based Rendering", 4th ed., section 12.6.3.
// Differs from them: boxes are their bounding spheres; each level draws a fresh number, so that small probabilities stay
// exact.
#pragma once
#include "geometry/scene.glsl"
#include "lib/random.glsl"
#include "lights/light_table.glsl"

#if defined(FX_LIGHTS) && defined(FX_LIGHT_TREE)
uniform usamplerBuffer light_tree;

struct LightNode {
    vec3 center;
    float radius;
    vec3 axis;
    float cos_angle;
    float intensity;
    float cos_spread;
    uint link;  // second child, or LIGHT_NODE_LEAF and the light
    bool two_sided;
};

LightNode load_light_node(uint index)
{
    const int at = LIGHT_TREE_HEADER_TEXELS + int(index) * LIGHT_NODE_TEXELS;
    const vec4 a = uintBitsToFloat(fetch_attribute(light_tree, at));
    const vec4 b = uintBitsToFloat(fetch_attribute(light_tree, at + 1));
    const uvec4 c = fetch_attribute(light_tree, at + 2);
    return LightNode(
        a.xyz, a.w, b.xyz, b.w, uintBitsToFloat(c.x), uintBitsToFloat(c.y), c.z, c.w != 0u);
}

float sine(float cosine) { return sqrt(max(0.0, 1.0 - cosine * cosine)); }

// Cosine and sine of max(0, a - b), from the cosines (x) and sines (y) of two angles in [0, pi].
vec2 angle_beyond(vec2 a, vec2 b)
{
    return a.x > b.x ? vec2(1.0, 0.0) : vec2(a.x * b.x + a.y * b.y, a.y * b.x - a.x * b.y);
}

// The most that the node's lights may send to the surface, up to a factor common to all nodes. 0 only where they send
// nothing. `normal` 0: a point in a medium.
float light_importance(LightNode node, vec3 position, vec3 normal)
{
    precise const vec3 way = position - node.center;
    precise const float distance2 = dot(way, way);
    const float radius2 = node.radius * node.radius;
    const vec3 direction = distance2 > 0.0 ? way * inversesqrt(distance2) : vec3(0.0, 0.0, 1.0);
    // Half the angle under which the node's bounding sphere is seen.
    const float sin2 = radius2 / distance2;
    const vec2 seen = sin2 < 1.0 ? vec2(sqrt(1.0 - sin2), sqrt(sin2)) : vec2(-1.0, 0.0);
    float cos_axis = dot(node.axis, direction);
    cos_axis = node.two_sided ? abs(cos_axis) : cos_axis;
    const vec2 leaving = angle_beyond(angle_beyond(vec2(cos_axis, sine(cos_axis)),
                                          vec2(node.cos_angle, sine(node.cos_angle))),
        seen);
    const float cos_normal = abs(dot(normal, direction));
    const float arriving = angle_beyond(vec2(cos_normal, sine(cos_normal)), seen).x;
    const float cosines = leaving.x * (dot(normal, normal) > 0.0 ? arriving : 1.0);
    precise const float importance = node.intensity * cosines / max(distance2, radius2);
    return leaving.x > node.cos_spread && cosines > 0.0 ? importance : 0.0;
}

// Probability of the first child of two.
float first_share(float first, float second)
{
    precise const float share = first / (first + second);
    return first > 0.0 ? share : 0.0;
}

bool asks_light_tree() { return fetch_attribute(light_tree, 0).x != 0u; }

// The light at the end of a descent, and its probability; 0: none matters here.
uint descend_light_tree(vec3 position, vec3 normal, vec4 u, out float pmf)
{
    pmf = 1.0;
    uint node = 0u;
    uint link = load_light_node(0u).link;
    uint level = 0u;
    while ((link & LIGHT_NODE_LEAF) == 0u) {
        const LightNode first = load_light_node(node + 1u);
        const LightNode second = load_light_node(link);
        const float importance_first = light_importance(first, position, normal);
        const float importance_second = light_importance(second, position, normal);
        const float share = first_share(importance_first, importance_second);
        const uint hash = pcg4d(uvec4(floatBitsToUint(u.x), floatBitsToUint(u.w), floatBitsToUint(u.y), level)).x;
        const bool to_first = float(hash >> 8u) * exp2(-24.0) < share;
        pmf *= to_first ? share : importance_second > 0.0 ? 1.0 - share : 0.0;
        node = to_first ? node + 1u : link;
        link = to_first ? first.link : second.link;
        ++level;
    }
    return link & ~LIGHT_NODE_LEAF;
}

// The probability with which a descent ends at the leaf that `trail` leads to.
float light_tree_pmf(vec3 position, vec3 normal, uint trail)
{
    float pmf = 1.0;
    uint node = 0u;
    uint link = load_light_node(0u).link;
    while ((link & LIGHT_NODE_LEAF) == 0u) {
        const LightNode first = load_light_node(node + 1u);
        const LightNode second = load_light_node(link);
        const float importance_second = light_importance(second, position, normal);
        const float share = first_share(light_importance(first, position, normal), importance_second);
        const bool to_first = (trail & 1u) == 0u;
        pmf *= to_first ? share : importance_second > 0.0 ? 1.0 - share : 0.0;
        node = to_first ? node + 1u : link;
        link = to_first ? first.link : second.link;
        trail >>= 1u;
    }
    return pmf;
}
#endif
