// Which pixels an error is a mean over.
#pragma once
#include "composite/compose.glsl"

// Sky alone is exact: it would only thin out what the rest is off.
bool counts(ivec2 px)
{
#ifdef FX_FOG
    if (max_component(fog_sigma_t) * texelFetch(in_fog_way, px, 0).x > 0.0)
        return true;
#endif
    return texelFetch(in_albedo, px, 0).a > 0.0;
}
