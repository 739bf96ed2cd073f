// SPDX-License-Identifier: MIT
// From the depth of the casters to what the technique stores of it, guard band included. An invocation does eight texels
// of a column, so that the depths of neighbours are read once.
#include "shared/filters.glsl"
#include "technique"

layout(local_size_x = GROUP) in;

layout(binding = 0) uniform sampler2D depthMap;
#if MAP_IS_SUMMED
layout(binding = 0) writeonly uniform uimage2DArray stored;
#define STORED_TEXEL unitsOf
#else
layout(binding = 0) writeonly uniform image2DArray stored;
#define STORED_TEXEL packedTexel
#endif

void convert(ivec2 texel) {
    int layer = int(gl_GlobalInvocationID.z);
    vec4 value = mapTexel(casterDepth(depthMap, texel, shadow), casterSlope(depthMap, texel, shadow), layer, shadow);
    imageStore(stored, ivec3(texel, layer), STORED_TEXEL(value, shadow));
}

void main() {
    ivec2 first = ivec2(gl_GlobalInvocationID.xy) * ivec2(1, STRIP);
    if (first.x >= filteredEdge(shadow)) return;
    // Written out: where a driver leaves a loop as it is it reads every neighbour again.
    convert(first);
    convert(first + ivec2(0, 1));
    convert(first + ivec2(0, 2));
    convert(first + ivec2(0, 3));
    convert(first + ivec2(0, 4));
    convert(first + ivec2(0, 5));
    convert(first + ivec2(0, 6));
    convert(first + ivec2(0, 7));
}
