// What is known of a material at one point, free of any buffer.
#pragma once

// Names and meanings as server/scene/scene.h has them. Members of an effect that is not compiled do not exist.
struct ShadedMaterial {
    vec3 albedo;
    vec3 emission;        // radiance towards the side the surface was seen from
    vec3 shading_normal;  // unit, world space, on the viewer's side
#ifdef FX_UNLIT
    bool unlit;
#endif
#if defined(FX_ROUGH_REFLECTION) || defined(FX_MIRROR) || defined(FX_DIELECTRIC)
    float metallic;
    float alpha;  // of GGX; 0: a mirror
    float specular;
    float ior;  // of the inside
    vec3 specular_color;
#endif
#ifdef FX_DIELECTRIC
    float transmission;
    bool thin_walled;
    vec3 absorption;
    int priority;
#endif
#ifdef FX_CLEARCOAT
    float clearcoat;
    float clearcoat_alpha;
    vec3 clearcoat_normal;  // unit, world space, on the viewer's side
#endif
};

bool is_transparent(ShadedMaterial m)
{
#ifdef FX_DIELECTRIC
    return m.transmission > 0.0;
#else
    return false;
#endif
}

// GGX alpha, 0 for a mirror. What a texture says is never that sharp.
float alpha_of(float roughness, bool textured)
{
    const float sharp = textured ? GGX_ALPHA_MIN : 0.0;
    return roughness > MIRROR_ROUGHNESS ? roughness * roughness : sharp;
}
