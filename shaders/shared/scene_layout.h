// How the scene lies in its buffer textures: written by server/scene/*.cpp, read by geometry, materials, bsdf, lights
// and textures.
// All are usamplerBuffer of rgba32ui; floats travel as their bits. A buffer that a scene has no use for is not there.
//
//   bvh_nodes    BVH_NODE_TEXELS a node: lower x of 4 children, lower y, lower z, upper x, upper y, upper z,
//                4 child words. A child word is a node's first texel, a leaf, or BVH_NO_CHILD. The first node is
//                the world's root, or the root of a top level over trees in world space and instances.
//   triangles    3 a triangle, in leaf order: v0.xyz and object, v1.xyz and material, v2.xyz and light + 1 (0: none);
//                in an instance's tree object and material are the instance's, lights count from its first
//   spheres      2 a sphere: center.xyz and radius; object, material, light + 1
//   disks        3 a disk: center.xyz and radius; normal.xyz; object, material, light + 1
//   normals      1 a triangle (FX_SHADING_NORMALS): its three shading normals, octahedral; 1 if it has any
//   uvs          2 a triangle (FX_TEXTURES): uv of v0 and v1; uv of v2, log2 of sqrt(uv area / world area)
//   uvs1         likewise the second set (FX_SECOND_UVS)
//   tangents     1 a triangle (FX_NORMAL_MAPS): its three tangents, octahedral; bit k set where bitangent k is
//                -cross(normal, tangent)
//   colors       2 a triangle (FX_VERTEX_COLORS): rgba of v0 and v1, of v2, as halfs
//   instances    INSTANCE_TEXELS an instance (FX_INSTANCES), each at its INSTANCE_* offset below
//   prev_instances  3 an instance (FX_MOTION): rows of the previous world_from_object
//   prev_vertices   PREV_VERTEX_HEADER: first of the triangles that deform and how many; 3 each (FX_DEFORMATION): its
//                vertices of last frame
//   materials    MATERIAL_TEXELS a material, each at its MATERIAL_* offset below
//   lights       LIGHT_TEXELS a light: LIGHT_* kind and flags, place in light_textures + 1 (0: none), pmf, area;
//                p0.xyz and alias threshold; edge_u.xyz and alias index; edge_v.xyz; radiance.rgb. By kind:
//                quad, triangle: p0, edge_u, edge_v        sphere: p0 center, edge_u.x radius
//                disk: p0 center, edge_u.x radius, edge_v normal
//                point, spot: p0, radiance is intensity [W/sr]; spot: edge_v the way it goes, edge_u.xy scale and
//                offset of the cosine to it (KHR_lights_punctual)
//                directional: edge_v the way it goes, radiance is irradiance
//                environment: none of these; there is one at most, the last light
//                with a tree the pmf of a light that has a place is that of asking the tree; the last word of its
//                radiance's texel is the way to its leaf, lowest bit first
//   light_tree   LIGHT_TREE_HEADER_TEXELS: nodes (0: no tree), lights without a place, probability of asking the tree.
//                Then LIGHT_NODE_TEXELS a node: center of the box and half its diagonal; axis of the directions its
//                lights face and cosine of their angle to it; intensity, cosine of how far from these they shine, second
//                child (the first follows its parent) or LIGHT_NODE_LEAF and light, 1 if any shines both ways. Then a
//                texel a light without a place: its index
//   light_textures  LIGHT_TEXTURE_TEXELS a light whose emission or opacity is textured: uv of p0, p0 + edge_u,
//                p0 + edge_v for the emission, the same for the opacity; opacity, alpha cutoff (negative: none);
//                texture reference of the emission; of the opacity (its A)
//   environment  ENVIRONMENT_HEADER_TEXELS: width, height (0: no map); three rows of map_from_world. Then a texel of
//                the map: radiance.rgb, density of sampling it given the map [1/sr]. Then the alias table over these:
//                threshold and index of two a texel
//
// A texture reference is TEXTURE_TEXELS texels wherever it stands: TEXTURE_* flags with array and layer, width and
// height in 16 bits each, offset.xy; column_u.xy, column_v.xy. All zero: no texture, which reads as white.
#pragma once

#define BVH_NODE_TEXELS 7
#define BVH_NO_CHILD 0x7fffffffu
#define BVH_LEAF_BIT 0x80000000u
#define BVH_KIND_MASK 0x60000000u  // what a leaf holds: one of BVH_TRIANGLES ...
#define BVH_TRIANGLES 0x00000000u
#define BVH_SPHERES 0x20000000u
#define BVH_DISKS 0x40000000u
#define BVH_INSTANCES 0x60000000u   // in place of the first primitive, which instance
#define BVH_COUNT_SHIFT 27          // primitives in the leaf minus one, 2 bits
#define BVH_FIRST_MASK 0x07ffffffu  // first primitive of its kind, in leaf order

#define TRIANGLE_TEXELS 3
#define SPHERE_TEXELS 2
#define DISK_TEXELS 3
#define UV_TEXELS 2
#define PREV_INSTANCE_TEXELS 3
#define PREV_VERTEX_HEADER 1
#define COLOR_TEXELS 2
#define LIGHT_TEXELS 5
#define LIGHT_TEXTURE_TEXELS 8
#define LIGHT_TREE_HEADER_TEXELS 1
#define LIGHT_NODE_TEXELS 3
#define LIGHT_NODE_LEAF 0x80000000u
#define ENVIRONMENT_HEADER_TEXELS 4
#define TEXTURE_TEXELS 2

// Texels of an instance.
#define INSTANCE_TEXELS 8
#define INSTANCE_OBJECT_FROM_WORLD 0  // three rows
#define INSTANCE_IDS 3                // root of its tree in bvh_nodes; object; material; index + 1 of its first light
#define INSTANCE_WORLD_FROM_OBJECT 4  // three rows
#define INSTANCE_SCALE 7              // log2 of its scale; -1 if it mirrors, else 1

// Texels of a material.
#define MATERIAL_TEXELS (7 + MATERIAL_MAPS * TEXTURE_TEXELS)
#define MATERIAL_ALBEDO 0    // albedo.rgb; MATERIAL_* flags
#define MATERIAL_EMISSION 1  // emission.rgb; opacity
#define MATERIAL_BASE 2      // metallic; roughness, perceptual; specular; ior
#define MATERIAL_SPECULAR 3  // specular_color.rgb; transmission
#define MATERIAL_INSIDE 4    // absorption.rgb; priority, as a signed integer
#define MATERIAL_COAT 5      // clearcoat; clearcoat_roughness; normal_scale; alpha_cutoff

#define MATERIAL_COAT_NORMAL 6  // clearcoat_normal_scale; 0; 0; 0
#define MATERIAL_TEXTURES 7  // texture references, in the order of MAP_*

// A material's textures. Bit MATERIAL_MAP_SHIFT + MAP_* of the flags is set for each that there is.
#define MATERIAL_MAPS 10
#define MAP_ALBEDO 0
#define MAP_EMISSION 1
#define MAP_SPECULAR_COLOR 2
#define MAP_METALLIC_ROUGHNESS 3
#define MAP_NORMAL 4
#define MAP_SPECULAR 5
#define MAP_TRANSMISSION 6
#define MAP_CLEARCOAT 7
#define MAP_CLEARCOAT_ROUGHNESS 8
#define MAP_CLEARCOAT_NORMAL 9
#define MATERIAL_MAP_SHIFT 16

// Beside the index of a material wherever a primitive or an instance names one: it has holes (FX_ALPHA).
#define MATERIAL_HAS_HOLES 0x80000000u

// Flags of a material.
#define MATERIAL_EMITS_BOTH_SIDES 1u
#define MATERIAL_UNLIT 2u
#define MATERIAL_THIN_WALLED 4u
#define MATERIAL_ALPHA_MASK 8u

// At or below this perceptual roughness a lobe is a mirror. 2^-5, so alpha is 2^-10: the distribution of half vectors
// known to 3 ulp still has 3 digits (4 * 3 ulp / alpha), and the blur is less than a pixel of a 720 lines high picture.
#define MIRROR_ROUGHNESS 0.03125
#define GGX_ALPHA_MIN 0.0009765625

//   reflection_albedo  (ALBEDO_NODES - 1)^2 cells of albedo without Fresnel over albedo_coordinate (fastest) and
//                      perceptual roughness; then as many of q - (1 - cosine) over sqrt(cosine) and roughness, where
//                      q^5 is Schlick's mean weight. A cell holds its corners (0, 0), (1, 0), (0, 1), (1, 1).
//   dielectric_albedo  DIELECTRIC_ETA_NODES layers of (DIELECTRIC_NODES - 1)^2 cells over coordinate and roughness;
//                      layers over (eta - 1) / (eta + 1) from -DIELECTRIC_CONTRAST to +DIELECTRIC_CONTRAST
#define ALBEDO_NODES 32
#define DIELECTRIC_NODES 20
#define DIELECTRIC_ETA_NODES 25
#define DIELECTRIC_CONTRAST 0.6  // eta from 1/4 to 4

#define LIGHT_QUAD 0u      // parallelogram p0 + s * edge_u + t * edge_v
#define LIGHT_TRIANGLE 1u  // p0, p0 + edge_u, p0 + edge_v
#define LIGHT_SPHERE 2u
#define LIGHT_DISK 3u
#define LIGHT_POINT 4u
#define LIGHT_SPOT 5u
#define LIGHT_DIRECTIONAL 6u
#define LIGHT_ENVIRONMENT 7u
#define LIGHT_KIND_MASK 0xffu
#define LIGHT_EMITS_BOTH_SIDES 0x100u

#define TEXTURE_ARRAYS 6u  // sampler2DArrays a program may bind for materials
#define TEXTURE_USED 0x80000000u
#define TEXTURE_NEAREST 0x40000000u
#define TEXTURE_UV_SET_1 0x20000000u
#define TEXTURE_WRAP_U_SHIFT 24  // 2 bits each
#define TEXTURE_WRAP_V_SHIFT 22
#define TEXTURE_ARRAY_SHIFT 16  // 3 bits; the layer is below
#define TEXTURE_REPEAT 0u
#define TEXTURE_MIRROR 1u
#define TEXTURE_CLAMP 2u
