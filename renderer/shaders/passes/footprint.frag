// SPDX-License-Identifier: MIT
// Footprint pass: for a sparse grid of pixels, the edge of one screen pixel on the shadow map, as a fraction of the
// map's extent. 0 where the map cannot matter: sky, surfaces turned from the light, points outside the map.
#include "shared/blocks.glsl"
#include "shared/receiver.glsl"

layout(binding = 0) uniform sampler2D positions;
layout(binding = 1) uniform sampler2D planes;
layout(location = 0) uniform ivec3 gridOfPixels;  // x, y offset and spacing

layout(location = 0) out float outFootprint;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy) * gridOfPixels.z + gridOfPixels.xy;
    vec4 position = texelFetch(positions, pixel, 0);
    outFootprint = 0.0;
    if (position.w == 0.0) return;
    ShadowReceiver receiver = shadowReceiver(position.xyz, texelFetch(planes, pixel, 0).xyz, view, shadow);
    bool onMap = all(greaterThanEqual(receiver.uv, vec2(0.0))) && all(lessThanEqual(receiver.uv, vec2(1.0)));
    if (receiver.facesLight && onMap) outFootprint = receiver.footprintUv;
}
