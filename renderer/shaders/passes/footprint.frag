// SPDX-License-Identifier: MIT
// Footprint pass: for a sparse grid of pixels, the edge of one screen pixel on the shadow map, as a fraction of the
// map's extent. 0 where no stair-step of the map can show: sky, surfaces turned from the light, points outside the
// map and, after a technique with a kernel, everything that is not in penumbra. A penumbra narrower than a pixel falls
// between the pixels' samples, so there every receiver counts, as it does without a kernel.
#include "shared/blocks.glsl"
#include "shared/receiver.glsl"

layout(binding = 0) uniform sampler2D positions;
layout(binding = 1) uniform sampler2D planes;
layout(binding = 2) uniform sampler2D visibilities;
layout(location = 0) uniform ivec3 gridOfPixels;  // x, y offset and spacing
layout(location = 1) uniform uint penumbraOnly;

layout(location = 0) out float outFootprint;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy) * gridOfPixels.z + gridOfPixels.xy;
    vec4 position = texelFetch(positions, pixel, 0);
    outFootprint = 0.0;
    float visibility = texelFetch(visibilities, pixel, 0).x;
    if (position.w == 0.0) return;
    ShadowReceiver receiver = shadowReceiver(position.xyz, texelFetch(planes, pixel, 0).xyz, view, shadow);
    bool wide = penumbraOnly != 0u && max(shadow.kernel.x, shadow.kernel.y) >= receiver.footprintUv;
    if (wide && (visibility <= 0.0 || visibility >= 1.0)) return;
    bool onMap = all(greaterThanEqual(receiver.uv, vec2(0.0))) && all(lessThanEqual(receiver.uv, vec2(1.0)));
    if (receiver.facesLight && onMap) outFootprint = receiver.footprintUv;
}
