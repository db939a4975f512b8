// Sums over tiles of 8x8 pixels, one invocation each, for the host to add up: it gets intervals from how much they differ.
#pragma once
#include "error_estimate/relative.glsl"
#include "lib/counters.glsl"

const int TILE_SIZE = 8;  // [px]; server/render/error_estimate.h

layout(local_size_x = 8, local_size_y = 8) in;

// Of tile (x, y) at tile_offset + x + y * tiles in a row.
layout(std430) writeonly buffer tile_block { vec4 tile_sums[]; };
uniform int tile_offset;

vec4 sums_at(ivec2 px);

void main()
{
    const ivec2 tile = ivec2(gl_GlobalInvocationID.xy);
    const ivec2 tiles = (ivec2(frame.extent) + TILE_SIZE - 1) / TILE_SIZE;
    if (tile.x >= tiles.x || tile.y >= tiles.y)
        return;
    const ivec2 first = tile * TILE_SIZE;
    const ivec2 size = min(ivec2(frame.extent) - first, ivec2(TILE_SIZE));
    vec4 sum = vec4(0.0);
    ivec2 at = first;
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) {
            const vec4 one = sums_at(first + ivec2(x, y));
            const uint kinds = nonfinite_in(dot(one, vec4(1.0)));
            note(STAGE_ERROR_ESTIMATE, kinds);
            sum += kinds == 0u ? one : vec4(0.0);
            at = kinds == 0u ? at : first + ivec2(x, y);
        }
    tile_sums[tile_offset + tile.x + tile.y * tiles.x] = sum;
    tell_noted(at, STAGE_ERROR_ESTIMATE);
}
