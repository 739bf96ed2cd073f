// SPDX-License-Identifier: MIT
// Marks the tiles of a filtered map that a visible surface looks up.
#include "shared/filters.glsl"

layout(local_size_x = 16, local_size_y = 8) in;

layout(binding = 0) uniform sampler2D positions;
layout(binding = 1) uniform sampler2D planes;
layout(std430, binding = 0) writeonly buffer Marks { uint marks[]; };

layout(location = 0) uniform ivec4 pixels;  // xy of the first, zw how many
layout(location = 1) uniform int tilesEdge;
layout(location = 2) uniform float spread;  // texels between a receiver and the lookups around it

// A bilinear lookup reads up to one and a half texels away; and what rounding moves it by.
const float kLookupReach = 2.0;

void main() {
    ivec2 id = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(id, pixels.zw))) return;
    ivec2 pixel = pixels.xy + id;
    vec4 position = texelFetch(positions, pixel, 0);
    if (position.w == 0.0) return;
    ShadowReceiver receiver = shadowReceiver(position.xyz, texelFetch(planes, pixel, 0).xyz, view, shadow);
    if (!receiver.facesLight || !serves(receiver, dot(position.xyz, view.forward.xyz), shadow)) return;
    if (!reachesMap(receiver.uv, (kernelReach(shadow) + spread + kLookupReach) * shadow.map.y)) return;
    vec2 place = receiver.uv * shadow.map.x + vec2(shadow.prefilter.z);
    float last = float(filteredEdge(shadow) - 1);
    ivec2 low = ivec2(clamp(place - vec2(spread + kLookupReach), vec2(0.0), vec2(last))) / TILE;
    ivec2 high = ivec2(clamp(place + vec2(spread + kLookupReach), vec2(0.0), vec2(last))) / TILE;
    for (int y = low.y; y <= high.y; ++y)
        for (int x = low.x; x <= high.x; ++x) marks[y * tilesEdge + x] = 1u;
}
