// SPDX-License-Identifier: MIT
// From the depth of the casters to what the technique stores of it, guard band included. An invocation does 2 x 4 texels,
// so that the depths of neighbours are read once.
#include "shared/filters.glsl"
#include "technique"

#include "passes/tiles.glsl"

layout(local_size_x = TILE / 2, local_size_y = TILE / 4) in;

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
    ivec2 first = tileCorner() + ivec2(gl_LocalInvocationID.xy) * ivec2(2, 4);
    // Written out: where a driver leaves a loop as it is it reads every neighbour again.
    convert(first);
    convert(first + ivec2(1, 0));
    convert(first + ivec2(0, 1));
    convert(first + ivec2(1, 1));
    convert(first + ivec2(0, 2));
    convert(first + ivec2(1, 2));
    convert(first + ivec2(0, 3));
    convert(first + ivec2(1, 3));
}
