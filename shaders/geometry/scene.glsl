// The scene's buffer textures (layout: shared/scene_layout.h) and typed access to them.
#pragma once
#include "shared/scene_layout.h"

uniform usamplerBuffer bvh_nodes;
uniform usamplerBuffer materials;
#ifdef FX_TRIANGLES
uniform usamplerBuffer triangles;
#ifdef FX_SHADING_NORMALS
uniform usamplerBuffer normals;
#endif
#ifdef FX_TEXTURES
uniform usamplerBuffer uvs;
#ifdef FX_SECOND_UVS
uniform usamplerBuffer uvs1;
#endif
#endif
#ifdef FX_NORMAL_MAPS
uniform usamplerBuffer tangents;
#endif
#ifdef FX_VERTEX_COLORS
uniform usamplerBuffer colors;
#endif
#endif
#ifdef FX_SPHERES
uniform usamplerBuffer spheres;
#endif
#ifdef FX_DISKS
uniform usamplerBuffer disks;
#endif

#ifdef FX_INSTANCES
uniform usamplerBuffer instances;
#ifdef FX_MOTION
uniform usamplerBuffer prev_instances;
#endif
#endif
#ifdef FX_DEFORMATION
uniform usamplerBuffer prev_vertices;
#endif

// A texel of a buffer that may be shorter than others: one that a scene does without has a single texel of zeros.
uvec4 fetch_attribute(usamplerBuffer source, int at) { return texelFetch(source, min(at, textureSize(source) - 1)); }
