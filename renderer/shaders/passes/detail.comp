// SPDX-License-Identifier: MIT
// Detail pass: visible pixels under one tile of a finer map ask for the texels that the thin casters before them take
// (detail_probe.h). "demand" is the controller's formula.
#include "shared/filters.glsl"
#include "demand"

layout(local_size_x = 16, local_size_y = 8) in;

layout(binding = 0) uniform sampler2D positions;
layout(binding = 1) uniform sampler2D planes;
layout(binding = 2) uniform sampler2D tileDepths;
layout(std430, binding = 0) buffer Counters { uint counters[STAIRWELL_DEMAND_COUNTERS]; };

layout(location = 0) uniform vec4 rule;  // in the order of StairwellDemandRule
layout(location = 1) uniform uint hasKernel;
// Cells of CELL x CELL pixels that may lie under the tile: xy the first one, zw how many.
layout(location = 2) uniform ivec4 cells;
layout(location = 3) uniform ivec4 tile;  // xy texel of the finer map in the tile's corner, z its margin, w its edge

// A caster at least so many times as long as it is wide.
const int kElongation = 3;
const int kReach = kElongation * WIDEST_TEXELS;
// Share of the light that a thin shadow takes away if it is to be kept: chosen by eye.
const float kShows = 0.02;
// More than a rasteriser moves a depth; a caster that throws a shadow of its own stands farther before the receiver.
const float kBiasTexels = 1.0 / 32.0;

// Before the receiver's plane. `texel` is of the finer map.
bool blocked(ivec2 texel, PlaneCompare plane) {
    return texelFetch(tileDepths, texel - tile.xy, 0).x < planeDepth(plane, texel.x, texel.y);
}

// Texels from one that is blocked to the first that is not; most + 1 for none within as many.
int runTo(ivec2 texel, ivec2 way, int most, PlaneCompare plane) {
    int run = 1;
    while (run <= most && blocked(texel + run * way, plane)) ++run;
    return run;
}

ivec2 wayOf(int i) { return i == 0 ? ivec2(1, 0) : i == 1 ? ivec2(0, 1) : i == 2 ? ivec2(1, 1) : ivec2(1, -1); }

// Width in texels of the thin caster before the texel; 0 for none. Most that is blocked lies in a wide shadow, where
// no walk is longer than a thin caster is wide.
float thinWidth(ivec2 texel, PlaneCompare plane) {
    float narrowest = 1e9;
    for (int i = 0; i < 4; ++i) {
        ivec2 way = wayOf(i);
        int ahead = runTo(texel, way, WIDEST_TEXELS, plane);
        if (ahead > WIDEST_TEXELS) continue;
        int behind = runTo(texel, -way, WIDEST_TEXELS, plane);
        if (behind <= WIDEST_TEXELS) narrowest = min(narrowest, float(ahead + behind - 1) * length(vec2(way)));
    }
    if (narrowest > float(WIDEST_TEXELS)) return 0.0;
    for (int i = 0; i < 4; ++i) {
        ivec2 way = wayOf(i);
        int both = runTo(texel, way, kReach, plane) + runTo(texel, -way, kReach, plane) - 1;
        if (float(both) * length(vec2(way)) >= float(kElongation) * narrowest) return narrowest;
    }
    return 0.0;
}

// In texels; 0 where there is nothing thin to be seen.
float pixelDetail(ivec2 pixel) {
    vec4 position = texelFetch(positions, pixel, 0);
    if (position.w == 0.0) return 0.0;
    // Most pixels are under another tile: no more of them than their place.
    vec4 h = shadow.shadowFromEyeRelative * vec4(position.xyz, 1.0);
    vec2 place = h.xy / h.w * shadow.map.x;
    if (!(all(greaterThanEqual(place, vec2(0.0))) && all(lessThan(place, vec2(shadow.map.x))))) return 0.0;
    ivec2 texel = ivec2(place);
    ivec2 inTile = texel - tile.xy;
    if (any(lessThan(inTile, ivec2(tile.z))) || any(greaterThanEqual(inTile, ivec2(tile.w - tile.z)))) return 0.0;
    ShadowReceiver receiver = shadowReceiver(position.xyz, texelFetch(planes, pixel, 0).xyz, view, shadow);
    if (!receiver.facesLight) return 0.0;
    if (!serves(receiver, dot(position.xyz, view.forward.xyz), shadow)) return 0.0;
    PlaneCompare plane = planeCompare(receiver, shadow, kBiasTexels);
    if (!blocked(texel, plane)) return 0.0;
    float widthUv = thinWidth(texel, plane) * shadow.map.y;
    if (widthUv == 0.0) return 0.0;
    // A line of this width through a disc's middle takes away 2 w / (pi r) of the light.
    if (hasKernel != 0u && 2.0 * widthUv < 3.14159265 * shadow.kernel.x * kShows) return 0.0;
    // The formula at a radius that asks for nothing, so that the caster's width alone speaks. A shadow that is wider
    // than a pixel may be of a caster that is not.
    bool wide = hasKernel != 0u && shadow.kernel.x >= receiver.footprintUv;
    return stairwellDemand(StairwellDemandRule(1.0, rule.y, 0.0, rule.w), 1.0, wide ? 0.0 : receiver.footprintUv, 1.0,
                           widthUv);
}

// One of a cell, always the same, or an answer would differ from the next in a still view; without a pattern, or a bar
// that is a pixel wide could pass between all of them. The mixing is pcg2d's (M. Jarzynski, M. Olano, "Hash functions
// for GPU rendering", JCGT 2020).
ivec2 pixelOf(ivec2 cellIndex) {
    uvec2 v = uvec2(cellIndex) * 1664525u + 1013904223u;
    for (int i = 0; i < 2; ++i) {
        v.x += v.y * 1664525u;
        v.y += v.x * 1664525u;
        v ^= v >> 16u;
    }
    return cellIndex * CELL + ivec2(v % uint(CELL));
}

void main() {
    ivec2 id = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(id, cells.zw))) return;
    ivec2 pixel = pixelOf(cells.xy + id);
    if (any(greaterThanEqual(pixel, ivec2(view.viewport.xy)))) return;
    float texels = pixelDetail(pixel);
    if (texels > 0.0) atomicAdd(counters[stairwellDemandCounter(texels)], 1u);
}
