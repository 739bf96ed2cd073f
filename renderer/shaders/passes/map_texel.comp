// SPDX-License-Identifier: MIT
// From the depth of the casters to what the technique stores of it, guard band included. An invocation does eight texels
// of a column, so that the depths of neighbours are read once. SAMPLED: the map has several depths in a texel, whose
// stored values are joined as the prefilter joins texels (PREFILTER: a Prefilter of technique.h).
#ifdef SAMPLED
#define DEPTH_SAMPLER sampler2DMS
#endif
#include "shared/filters.glsl"
#include "technique"

#ifdef LISTED
#include "passes/tiles.glsl"
layout(local_size_x = TILE, local_size_y = TILE / 8) in;
ivec2 firstTexel() { return tileCorner() + ivec2(gl_LocalInvocationID.xy) * ivec2(1, 8); }
#else
layout(local_size_x = GROUP) in;
ivec2 firstTexel() { return ivec2(gl_GlobalInvocationID.xy) * ivec2(1, 8); }
#endif

layout(binding = 0) uniform DEPTH_SAMPLER depthMap;
#if MAP_IS_SUMMED
layout(binding = 0) writeonly uniform uimage2DArray stored;
#define STORED_TEXEL unitsOf
#else
layout(binding = 0) writeonly uniform image2DArray stored;
#define STORED_TEXEL packedTexel
#endif

vec4 valueOf(ivec2 texel, int index, int layer) {
    return mapTexel(casterDepth(depthMap, texel, index, shadow), casterSlope(depthMap, texel, index, shadow), layer,
                    shadow);
}

#ifdef SAMPLED
layout(location = 2) uniform int samples;

vec4 storedValue(ivec2 texel, int layer) {
    vec4 joined = emptyTaps(PREFILTER);
    for (int i = 0; i < samples; ++i)
        joined = joinedTaps(PREFILTER, joined, tapOf(PREFILTER, valueOf(texel, i, layer), 1.0));
    return valueOfTaps(PREFILTER, joined, float(samples));
}
#else
vec4 storedValue(ivec2 texel, int layer) { return valueOf(texel, 0, layer); }
#endif

void convert(ivec2 texel) {
    int layer = int(gl_GlobalInvocationID.z);
    vec4 value = storedValue(texel, layer);
    imageStore(stored, ivec3(texel, layer), STORED_TEXEL(value, shadow));
}

void main() {
    ivec2 first = firstTexel();
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
