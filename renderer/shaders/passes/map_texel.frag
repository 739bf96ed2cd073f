// SPDX-License-Identifier: MIT
// From the depth of the casters to what the technique stores of it, guard band included.
#include "shared/filters.glsl"
#include "technique"

layout(binding = 0) uniform sampler2D depthMap;

layout(location = 0) uniform int layer;

layout(location = 0) out vec4 outTexel;

void main() {
    ivec2 texel = ivec2(gl_FragCoord.xy);
    vec4 value = mapTexel(casterDepth(depthMap, texel, shadow), casterSlope(depthMap, texel, shadow), layer, shadow);
    outTexel = packedTexel(value, shadow);
}
