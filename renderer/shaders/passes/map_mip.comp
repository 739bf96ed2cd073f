// SPDX-License-Identifier: MIT
// A level of a mip chain from the one below it.
#include "shared/filters.glsl"

layout(local_size_x = GROUP) in;

layout(binding = 0) uniform sampler2DArray map;
layout(binding = 0) writeonly uniform image2DArray level;

layout(location = 0) uniform int below;

void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    imageStore(level, ivec3(texel, 0), mipTexel(map, texel, below));
}
