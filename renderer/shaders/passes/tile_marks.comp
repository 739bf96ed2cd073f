// SPDX-License-Identifier: MIT
// Marks the tiles of a filtered map that a visible surface looks up.
#include "shared/filters.glsl"

layout(local_size_x = 16, local_size_y = 8) in;

layout(binding = 0) uniform sampler2D positions;
layout(std430, binding = 0) writeonly buffer Seen { uint seen[]; };

layout(location = 0) uniform ivec4 pixels;  // xy of the first, zw how many
layout(location = 1) uniform int tilesEdge;
layout(location = 2) uniform float reach;  // texels between a receiver's place and what is read around it

void main() {
    ivec2 id = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(id, pixels.zw))) return;
    ivec2 pixel = pixels.xy + id;
    vec4 position = texelFetch(positions, pixel, 0);
    if (position.w == 0.0) return;
    // No more of the receiver than that: all of it takes longer than what is left out would.
    vec4 h = shadow.shadowFromEyeRelative * vec4(position.xyz, 1.0);
    ShadowReceiver receiver;
    receiver.uv = h.xy / h.w;
    receiver.depth = h.z;
    if (!serves(receiver, dot(position.xyz, view.forward.xyz), shadow)) return;
    if (!reachesMap(receiver.uv, (kernelReach(shadow) + reach) * shadow.map.y)) return;
    vec2 place = receiver.uv * shadow.map.x + vec2(shadow.prefilter.z);
    float last = float(filteredEdge(shadow) - 1);
    ivec2 low = ivec2(clamp(place - reach, vec2(0.0), vec2(last))) / TILE;
    ivec2 high = ivec2(clamp(place + reach, vec2(0.0), vec2(last))) / TILE;
    // No wider than a tile: unseenIsWorthIt() of filter_tiles.cpp.
    seen[low.y * tilesEdge + low.x] = 1u;
    seen[low.y * tilesEdge + high.x] = 1u;
    seen[high.y * tilesEdge + low.x] = 1u;
    seen[high.y * tilesEdge + high.x] = 1u;
}
