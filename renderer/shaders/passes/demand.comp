// SPDX-License-Identifier: MIT
// Demand pass: one pixel of every cell asks for a number of texels, counted in shared memory first.
#include "shared/filters.glsl"
#include "shared/shading.glsl"
#include "technique"
#include "shared/pixel_demand.glsl"

layout(local_size_x = 16, local_size_y = 8) in;

layout(std430, binding = 0) buffer Counters { uint counters[STAIRWELL_DEMAND_COUNTERS]; };

layout(location = 2) uniform ivec3 cell;  // x, y of the pixel in its cell, z the cell's edge

shared uint groupCounters[STAIRWELL_DEMAND_COUNTERS];

void main() {
    for (uint i = gl_LocalInvocationIndex; i < uint(STAIRWELL_DEMAND_COUNTERS);
         i += gl_WorkGroupSize.x * gl_WorkGroupSize.y)
        groupCounters[i] = 0u;
    barrier();
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy) * cell.z + cell.xy;
    if (all(lessThan(pixel, ivec2(view.viewport.xy)))) {
        PixelDemand asked = pixelDemand(pixel);
        if (asked.texels >= 0.0) atomicAdd(groupCounters[stairwellDemandCounter(asked.texels)], asked.weight);
    }
    barrier();
    for (uint i = gl_LocalInvocationIndex; i < uint(STAIRWELL_DEMAND_COUNTERS);
         i += gl_WorkGroupSize.x * gl_WorkGroupSize.y)
        if (groupCounters[i] != 0u) atomicAdd(counters[i], groupCounters[i]);
}
