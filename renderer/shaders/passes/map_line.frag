// SPDX-License-Identifier: MIT
// The prefilter along one axis. PREFILTER is a Prefilter of technique.h.
#include "shared/filters.glsl"

layout(binding = 0) uniform sampler2DArray map;
layout(location = 0) uniform int layer;
layout(location = 1) uniform ivec2 axis;

layout(location = 0) out vec4 outTexel;

void main() {
    outTexel = packedTexel(filteredLine(map, ivec2(gl_FragCoord.xy), axis, layer, PREFILTER, shadow), shadow);
}
