// How the scene lies in its buffer textures: read by server/scene/gpu_scene.cpp, bvh.cpp and geometry/*.glsl.
// All are usamplerBuffer of rgba32ui; floats travel as their bits.
//
//   bvh_nodes    BVH_NODE_TEXELS a node: lower x of 4 children, lower y, lower z, upper x, upper y, upper z,
//                4 child words. A child word is a node's first texel, a leaf, or BVH_NO_CHILD.
//   triangles    3 a triangle, in leaf order: v0.xyz and primitive index, v1.xyz, v2.xyz
//   spheres      2 a sphere, in leaf order: center.xyz and radius; primitive index
//   primitives   2 a primitive: object, material, light + 1 (0: none), has shading normals;
//                its three shading normals, octahedral
//   materials    2 a material: albedo.rgb, MATERIAL_* flags; emission.rgb
//   lights       4 a light: LIGHT_* kind, material, pmf, area; p0.xyz and alias threshold;
//                edge_u.xyz (sphere: radius) and alias index; edge_v.xyz
#pragma once

#define BVH_NODE_TEXELS 7
#define BVH_NO_CHILD 0x7fffffffu
#define BVH_LEAF_BIT 0x80000000u
#define BVH_SPHERE_BIT 0x40000000u
#define BVH_COUNT_SHIFT 28          // primitives in the leaf minus one, 2 bits
#define BVH_FIRST_MASK 0x0fffffffu  // first primitive in leaf order

#define TRIANGLE_TEXELS 3
#define SPHERE_TEXELS 2
#define PRIMITIVE_TEXELS 2
#define MATERIAL_TEXELS 2
#define LIGHT_TEXELS 4

#define MATERIAL_EMITS_BOTH_SIDES 1u

#define LIGHT_QUAD 0u      // parallelogram p0 + s * edge_u + t * edge_v
#define LIGHT_TRIANGLE 1u  // p0, p0 + edge_u, p0 + edge_v
#define LIGHT_SPHERE 2u
