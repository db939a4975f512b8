// Values that no healthy frame has, by the stage that meets them and by kind: what lib/counters.glsl counts them under.
// server/render/bad_values.h has their names.
#pragma once

// In the order of a frame. Stages of one shader follow each other, at most eight.
#define STAGE_PRIMARY_RAY 0u
#define STAGE_GBUFFER 1u
#define STAGE_HIT 2u
#define STAGE_LIGHT 3u
#define STAGE_THROUGHPUT 4u
#define STAGE_FOG 5u
#define STAGE_RADIANCE 6u
#define STAGE_HISTORY 7u
#define STAGE_TEMPORAL 8u
#define STAGE_MOMENTS 9u
#define STAGE_VARIANCE 10u
#define STAGE_ATROUS_1 11u  // as many as the setting atrous_iterations allows
#define STAGE_COMPOSITE 19u
#define STAGE_ACCUMULATE 20u
#define STAGE_ERROR_ESTIMATE 21u
#define STAGE_TONEMAP 22u
#define STAGE_COUNT 23u

#define KIND_NAN 0u
#define KIND_INFINITE 1u
#define KIND_NEGATIVE 2u
#define KIND_CLAMPED 3u
#define KIND_COUNT 4u

// How the view of them paints each kind, 0xRRGGBB: four that are told apart with any colour vision.
// Source: Okabe, Ito 2008, "Color Universal Design".
#define NAN_COLOR 0xd55e00u
#define INFINITE_COLOR 0xf0e442u
#define NEGATIVE_COLOR 0x56b4e9u
#define CLAMPED_COLOR 0xcc79a7u
