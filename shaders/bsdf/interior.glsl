// What a path is inside of: nested and overlapping transparent things, of which the one with the highest priority fills
// the place they share; of equals the one entered last.
//
// A path starts in what is around the camera (server/scene/insides.h). Leaving a thing that was never entered counts
// as leaving it.
//
// Source: Schmidt and Budge 2002, "Simple Nested Dielectrics in Ray Traced Images", Journal of Graphics Tools 7(2).
#pragma once
#include "geometry/scene.glsl"
#include "materials/shaded_material.glsl"

// Where a surface parts two insides.
struct Boundary {
    float eta;  // index of refraction behind the surface over that before it, for make_bsdf()
    bool real;  // else something of higher priority fills both sides: see_through() the surface
};

#ifdef FX_DIELECTRIC
struct Interior {
    uvec4 entered;   // materials + 1, oldest first; 0: free
    uint overflows;  // entries that found no place: what was entered then is not there
};

struct Inside {
    uint entry;  // material + 1; 0: nothing
    float ior;
    int priority;
    vec3 absorption;  // [1/m]
};

Interior outside_of_everything() { return Interior(uvec4(0u), 0u); }

Inside load_inside(uint material)
{
    const int at = int(material) * MATERIAL_TEXELS;
    const vec4 inside = uintBitsToFloat(texelFetch(materials, at + MATERIAL_INSIDE));
    const float ior = uintBitsToFloat(texelFetch(materials, at + MATERIAL_BASE).w);
    return Inside(material + 1u, ior, floatBitsToInt(inside.w), inside.rgb);
}

Inside prevailing(uvec4 entered)
{
    Inside best = Inside(0u, 1.0, -2147483647 - 1, vec3(0.0));
    for (int k = 0; k < 4; ++k) {
        const Inside inside = load_inside(max(entered[k], 1u) - 1u);
        if (entered[k] != 0u && inside.priority >= best.priority)
            best = inside;
    }
    return best;
}

// Of what fills the place where the path is [1/m].
vec3 current_absorption(Interior interior) { return prevailing(interior.entered).absorption; }

bool has_inside(ShadedMaterial m) { return m.transmission > 0.0 && !m.thin_walled; }

// Without the last of several equal ones.
uvec4 without(uvec4 entered, uint entry)
{
    const uvec4 rest = uvec4(entered.yzw, 0u);
    uvec4 left = entered.x == entry ? rest : entered;
    left = entered.y == entry ? uvec4(entered.x, rest.yzw) : left;
    left = entered.z == entry ? uvec4(entered.xy, rest.zw) : left;
    left = entered.w == entry ? uvec4(entered.xyz, 0u) : left;
    return left;
}

// With one more, if there is a place.
uvec4 entered_after(uvec4 entered, uint entry)
{
    const int free = findLSB(uint(entered.x == 0u) | uint(entered.y == 0u) << 1 | uint(entered.z == 0u) << 2 | 8u);
    entered[free] = entered[free] == 0u ? entry : entered[free];
    return entered;
}

// The surface of `material`, met from its front or from inside.
Boundary boundary_at(Interior interior, ShadedMaterial m, uint material, bool front)
{
    const Inside now = prevailing(interior.entered);
    const bool leaving = has_inside(m) && !front;
    const uvec4 rest = without(interior.entered, material + 1u);
    const Inside others = prevailing(rest);
    precise const float entering_eta = m.ior / now.ior;
    precise const float leaving_eta = others.ior / m.ior;
    Boundary boundary = Boundary(entering_eta, true);
    if (has_inside(m))
        boundary.real = m.priority >= now.priority;
    if (leaving) {
        const bool unknown = interior.entered == rest;
        boundary.real = unknown ? m.priority >= others.priority : now.entry == material + 1u;
        boundary.eta = leaving_eta;
    }
    return boundary;
}

// After the path was transmitted through the surface.
void cross_boundary(inout Interior interior, ShadedMaterial m, uint material, bool front)
{
    const uvec4 fewer = without(interior.entered, material + 1u);
    const bool full = interior.entered.w != 0u;
    const uvec4 more = full ? interior.entered : entered_after(interior.entered, material + 1u);
    if (has_inside(m)) {
        interior.entered = front ? more : fewer;
        interior.overflows += front && full ? 1u : 0u;
    }
}

// A surface that is not there: what meets it goes straight on.
void see_through(inout ShadedMaterial m)
{
    m.albedo = vec3(1.0);
    m.metallic = 0.0;
    m.alpha = 0.0;
    m.specular = 0.0;
    m.transmission = 1.0;
    m.thin_walled = true;
#ifdef FX_CLEARCOAT
    m.clearcoat = 0.0;
#endif
}
#endif

// Index behind an opaque surface over that before it, where nothing transmits.
float opaque_eta(ShadedMaterial m)
{
#if defined(FX_ROUGH_REFLECTION) || defined(FX_MIRROR) || defined(FX_DIELECTRIC)
    return m.ior;
#else
    return 1.0;
#endif
}
