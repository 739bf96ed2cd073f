// SPDX-License-Identifier: MIT
// Running sums along one axis; along both, the summed-area table of shared/summed_map.glsl. Whole numbers, modulo 2^32.
#include "shared/filters.glsl"

layout(local_size_x = GROUP) in;

layout(binding = 0) uniform usampler2DArray map;
layout(binding = 0) writeonly uniform uimage2DArray sums;

layout(location = 0) uniform ivec2 axis;

void main() {
    int edge = filteredEdge(shadow);
    int line = int(gl_GlobalInvocationID.x);
    if (line >= edge) return;
    uvec4 sum = uvec4(0u);
    for (int i = 0; i < edge; ++i) {
        ivec3 texel = ivec3(axis * i + (ivec2(1, 1) - axis) * line, 0);
        sum += texelFetch(map, texel, 0);
        imageStore(sums, texel, sum);
    }
}
