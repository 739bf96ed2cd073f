// SPDX-License-Identifier: MIT
// From the depth of the casters to what the technique stores of it, guard band included. An invocation does eight texels
// of a column, so that the depths of neighbours are read once. SAMPLED: the map has several depths in a texel, whose
// stored values are joined as the prefilter joins texels (PREFILTER: a Prefilter of technique.h). MARKS_GAPS: the tiles
// are marked in which the kernel may meet two surfaces, one before the other.
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

#ifdef MARKS_GAPS
layout(std430, binding = 2) writeonly buffer Gaps { uint gaps[]; };
layout(location = 3) uniform ivec2 grid;  // tilesEdge, texels that the kernel reaches to either side

// Of the eight: the first and the last that have a gap.
ivec2 gap = ivec2(8, -1);

void noteGap(ivec2 first, int k) {
    if (gl_GlobalInvocationID.z > 0u || grid.x == 0) return;  // once for all layers
    if (hasGap(depthMap, first + ivec2(0, k), shadow)) gap = ivec2(min(gap.x, k), k);
}

void markGap(ivec2 first) {
    if (gap.y < 0) return;
    ivec2 low = max(first + ivec2(0, gap.x) - grid.y, ivec2(0)) / TILE;
    ivec2 high = min((first + ivec2(0, gap.y) + grid.y) / TILE, ivec2(grid.x - 1));
    for (int y = low.y; y <= high.y; ++y)
        for (int x = low.x; x <= high.x; ++x) gaps[y * grid.x + x] = 1u;
}
#else
void noteGap(ivec2 first, int k) {}
void markGap(ivec2 first) {}
#endif

void convert(ivec2 first, int k) {
    convert(first + ivec2(0, k));
    noteGap(first, k);
}

void main() {
    ivec2 first = firstTexel();
    // Written out: where a driver leaves a loop as it is it reads every neighbour again.
    convert(first, 0);
    convert(first, 1);
    convert(first, 2);
    convert(first, 3);
    convert(first, 4);
    convert(first, 5);
    convert(first, 6);
    convert(first, 7);
    markGap(first);
}
