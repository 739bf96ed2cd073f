// SPDX-License-Identifier: MIT
// Counts the casters' depths in a sparse grid over the map: DepthHistogram of layer_placement.h. DEPTH_BINS are its bins.
layout(local_size_x = 16, local_size_y = 16) in;

layout(binding = 0) uniform sampler2D map;
layout(std430, binding = 0) buffer Counters { uint counters[DEPTH_BINS]; };

layout(location = 0) uniform ivec2 grid;  // x texels from one sample to the next, y N

shared uint group[DEPTH_BINS];

void main() {
    uint own = gl_LocalInvocationIndex;
    if (own < DEPTH_BINS) group[own] = 0u;
    barrier();
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy) * grid.x;
    if (texel.x < grid.y && texel.y < grid.y) {
        float depth = texelFetch(map, texel, 0).x;
        // Not in the negative: a depth that is no number is no caster.
        if (depth < 1.0) atomicAdd(group[int(max(depth, 0.0) * float(DEPTH_BINS))], 1u);
    }
    barrier();
    if (own < DEPTH_BINS && group[own] > 0u) atomicAdd(counters[own], group[own]);
}
