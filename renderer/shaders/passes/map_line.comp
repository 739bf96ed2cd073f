// SPDX-License-Identifier: MIT
// The prefilter along one axis. PREFILTER is a Prefilter of technique.h. What it computes is filteredLine()
// (shared/filtered_map.glsl), texel by texel. For a box an invocation does STRIP neighbours on the line at once: all of
// their kernels hold the texels in the middle (`core`), which are joined once; of those before and behind it each
// kernel holds the ones from its own end on. Nothing is taken out of a sum again, as a running sum would: that leaves
// rounding behind, and a least or a greatest cannot be taken out. (M. van Herk, "A fast algorithm for local minimum and
// maximum filters", 1992.)
#include "shared/filters.glsl"

layout(location = 0) uniform ivec2 axis;

// A whole map is done line by line: neighbouring invocations do neighbouring memory.
#ifdef LISTED
#include "passes/tiles.glsl"
layout(local_size_x = TILE, local_size_y = TILE / STRIP) in;
ivec2 firstTexel() {
    ivec2 id = ivec2(gl_LocalInvocationID.xy);
    return tileCorner() + (axis.x == 1 ? ivec2(id.y * STRIP, id.x) : ivec2(id.x, id.y * STRIP));
}
#else
layout(local_size_x = GROUP) in;
ivec2 firstTexel() {
    ivec2 id = ivec2(gl_GlobalInvocationID.xy);
    return axis.x == 1 ? ivec2(id.x * STRIP, id.y) : ivec2(id.x, id.y * STRIP);
}
#endif

layout(binding = 0) uniform sampler2DArray map;
layout(binding = 0) writeonly uniform image2DArray filtered;

vec4 tapAt(ivec2 texel) {
    vec4 value = lineTexel(map, texel, int(gl_GlobalInvocationID.z), filteredEdge(shadow) - 1, shadow);
    return tapOf(PREFILTER, value, 1.0);
}

// Of texels beyond the map nothing is kept.
void write(ivec2 texel, vec4 value) {
    imageStore(filtered, ivec3(texel, gl_GlobalInvocationID.z), packedTexel(value, shadow));
}

// Drivers leave loops over arrays as loops over memory; these are registers. EACH(DO): DO(k) for every texel of the
// strip; INWARDS(DO): DO(k, k + 1) from the last but one to the first.
#if STRIP == 8
#define EACH(DO) DO(0) DO(1) DO(2) DO(3) DO(4) DO(5) DO(6) DO(7)
#define INWARDS(DO) DO(6, 7) DO(5, 6) DO(4, 5) DO(3, 4) DO(2, 3) DO(1, 2) DO(0, 1)
#define LAST(name) name##7
#else
#define EACH(DO) DO(0) DO(1) DO(2) DO(3)
#define INWARDS(DO) DO(2, 3) DO(1, 2) DO(0, 1)
#define LAST(name) name##3
#endif

void main() {
    ivec2 first = firstTexel();
    int taps = kernelTaps(shadow);
    bool gaussian = shadow.prefilter.y != 0.0;
    if (gaussian || 2 * taps < STRIP) {
        int layer = int(gl_GlobalInvocationID.z);
        for (int k = 0; k < STRIP; ++k)
            write(first + axis * k, filteredLine(map, first + axis * k, axis, layer, PREFILTER, shadow));
        return;
    }
    float rim = tapWeights(shadow).rim;
    float total = float(2 * taps - 1) + 2.0 * rim;

    vec4 core = emptyTaps(PREFILTER);
    for (int i = STRIP - taps; i < taps; ++i) core = joinedTaps(PREFILTER, core, tapAt(first + axis * i));
#define READ(k) vec4 before##k = tapAt(first + axis * (k - taps)), after##k = tapAt(first + axis * (k + taps));
    EACH(READ)
    // sumK: from behind the outermost texel before K to the core's end.
    vec4 LAST(sum) = core;
#define JOIN_BEFORE(k, next) vec4 sum##k = joinedTaps(PREFILTER, before##next, sum##next);
    INWARDS(JOIN_BEFORE)
    vec4 behind = emptyTaps(PREFILTER);
#define WRITE(k)                                                                                                \
    write(first + axis * k,                                                                                     \
          valueOfTaps(PREFILTER,                                                                                \
                      joinedTaps(PREFILTER, joinedTaps(PREFILTER, sum##k, behind),                              \
                                 joinedTaps(PREFILTER, weightedTaps(PREFILTER, before##k, rim),                 \
                                            weightedTaps(PREFILTER, after##k, rim))),                           \
                      total));                                                                                  \
    behind = joinedTaps(PREFILTER, behind, after##k);
    EACH(WRITE)
}
