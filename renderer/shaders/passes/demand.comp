// SPDX-License-Identifier: MIT
// Demand pass: one pixel of every cell asks for a number of texels ("demand" is the controller's formula, handed in by
// who joins the two), counted in shared memory first. No stair-step of the map can show in the sky, on surfaces turned
// from the light, outside the map and, where the kernel is wider than a pixel, outside penumbrae. A penumbra narrower
// than a pixel falls between the pixels' samples, so there every receiver counts, as it does without a kernel.
#include "shared/blocks.glsl"
#include "shared/receiver.glsl"
#include "demand"

layout(local_size_x = 16, local_size_y = 8) in;

layout(binding = 0) uniform sampler2D positions;
layout(binding = 1) uniform sampler2D planes;
layout(binding = 2) uniform sampler2D visibilities;
layout(std430, binding = 0) buffer Counters { uint counters[STAIRWELL_DEMAND_COUNTERS]; };

layout(location = 0) uniform ivec3 cell;  // x, y of the pixel in its cell, z the cell's edge
layout(location = 1) uniform uint hasKernel;
layout(location = 2) uniform vec4 rule;  // in the order of StairwellDemandRule

shared uint groupCounters[STAIRWELL_DEMAND_COUNTERS];

// -1 where the pixel asks for nothing.
int counterOf(ivec2 pixel) {
    vec4 position = texelFetch(positions, pixel, 0);
    if (position.w == 0.0) return -1;
    float visibility = texelFetch(visibilities, pixel, 0).x;
    ShadowReceiver receiver = shadowReceiver(position.xyz, texelFetch(planes, pixel, 0).xyz, view, shadow);
    bool wide = hasKernel != 0u && max(shadow.kernel.x, shadow.kernel.y) >= receiver.footprintUv;
    if (wide && !inPenumbra(visibility)) return -1;
    bool onMap = all(greaterThanEqual(receiver.uv, vec2(0.0))) && all(lessThanEqual(receiver.uv, vec2(1.0)));
    if (!receiver.facesLight || !onMap) return -1;
    StairwellDemandRule asked = StairwellDemandRule(rule.x, rule.y, rule.z, rule.w);
    return stairwellDemandCounter(stairwellDemand(asked, shadow.kernel.x, receiver.footprintUv, 1.0, 0.0));
}

void main() {
    for (uint i = gl_LocalInvocationIndex; i < uint(STAIRWELL_DEMAND_COUNTERS);
         i += gl_WorkGroupSize.x * gl_WorkGroupSize.y)
        groupCounters[i] = 0u;
    barrier();
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy) * cell.z + cell.xy;
    if (all(lessThan(pixel, ivec2(view.viewport.xy)))) {
        int counter = counterOf(pixel);
        if (counter >= 0) atomicAdd(groupCounters[counter], 1u);
    }
    barrier();
    for (uint i = gl_LocalInvocationIndex; i < uint(STAIRWELL_DEMAND_COUNTERS);
         i += gl_WorkGroupSize.x * gl_WorkGroupSize.y)
        if (groupCounters[i] != 0u) atomicAdd(counters[i], groupCounters[i]);
}
