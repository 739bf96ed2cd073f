// SPDX-License-Identifier: MIT
// Demand pass: one pixel of every cell asks for a number of texels, counted in shared memory first. Few pixels lie where
// a shadow begins: those are listed and the list is worked off, so that neither receivers are computed nor blockers
// searched for beside pixels that ask for nothing.
#include "shared/filters.glsl"
#include "shared/shading.glsl"
#include "technique"
#include "shared/pixel_demand.glsl"

layout(local_size_x = 16, local_size_y = 8) in;

layout(std430, binding = 0) buffer Counters { uint counters[STAIRWELL_DEMAND_COUNTERS]; };

layout(location = 2) uniform ivec3 cell;  // x, y of the pixel in the first cell, z the cells' edge

const uint kGroup = gl_WorkGroupSize.x * gl_WorkGroupSize.y;
shared uint groupCounters[STAIRWELL_DEMAND_COUNTERS];
shared uint listed;
shared uint list[kGroup];  // of invocations, whose pixels they are

ivec2 pixelOf(uint invocation) {
    uvec2 inGroup = uvec2(invocation % gl_WorkGroupSize.x, invocation / gl_WorkGroupSize.x);
    return ivec2(gl_WorkGroupID.xy * gl_WorkGroupSize.xy + inGroup) * cell.z + cell.xy;
}

void main() {
    if (gl_LocalInvocationIndex == 0u) listed = 0u;
    for (uint i = gl_LocalInvocationIndex; i < uint(STAIRWELL_DEMAND_COUNTERS); i += kGroup)
        groupCounters[i] = 0u;
    barrier();
    if (mayAsk(pixelOf(gl_LocalInvocationIndex))) list[atomicAdd(listed, 1u)] = gl_LocalInvocationIndex;
    barrier();
    for (uint i = gl_LocalInvocationIndex; i < listed; i += kGroup) {
        PixelDemand asked = pixelDemand(pixelOf(list[i]));
        if (asked.texels >= 0.0) atomicAdd(groupCounters[stairwellDemandCounter(asked.texels)], asked.weight);
    }
    barrier();
    for (uint i = gl_LocalInvocationIndex; i < uint(STAIRWELL_DEMAND_COUNTERS); i += kGroup)
        if (groupCounters[i] != 0u) atomicAdd(counters[i], groupCounters[i]);
}
