// SPDX-License-Identifier: MIT
// From the depth of the casters to what the technique stores of it, guard band included. An invocation does eight texels
// of a column, so that the depths of neighbours are read once.
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

#ifdef SAMPLED
layout(binding = 0) uniform sampler2DMS depthMap;
layout(location = 2) uniform int samples;
#else
layout(binding = 0) uniform sampler2D depthMap;
#endif
#if MAP_IS_SUMMED
layout(binding = 0) writeonly uniform uimage2DArray stored;
#define STORED_TEXEL unitsOf
#else
layout(binding = 0) writeonly uniform image2DArray stored;
#define STORED_TEXEL packedTexel
#endif

#ifdef SAMPLED
// As casterDepth() and casterSlope() of shared/filtered_map.glsl, sample by sample: neighbours have theirs in the same
// places.
float depthOf(ivec2 texel, int index) {
    ivec2 inside = texel - ivec2(int(shadow.prefilter.z));
    ivec2 at = clamp(inside, ivec2(0), ivec2(int(shadow.map.x) - 1));
    return at == inside ? casterOf(texelFetch(depthMap, at, index).x) : 1.0;
}

vec2 slopeOf(ivec2 texel, int index) {
    float here = depthOf(texel, index);
    return vec2(smallerOf(depthOf(texel + ivec2(1, 0), index) - here, here - depthOf(texel - ivec2(1, 0), index)),
                smallerOf(depthOf(texel + ivec2(0, 1), index) - here, here - depthOf(texel - ivec2(0, 1), index)));
}

vec4 storedValue(ivec2 texel, int layer) {
    vec4 sum = vec4(0.0);
    for (int i = 0; i < samples; ++i) sum += mapTexel(depthOf(texel, i), slopeOf(texel, i), layer, shadow);
    return sum / float(samples);
}
#else
vec4 storedValue(ivec2 texel, int layer) {
    return mapTexel(casterDepth(depthMap, texel, shadow), casterSlope(depthMap, texel, shadow), layer, shadow);
}
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
