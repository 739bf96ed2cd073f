// SPDX-License-Identifier: MIT
// Lookup pass: the technique's visibility of every pixel, into a target of its own, so that errors are measured on
// visibility and not on shaded colour. 1 is lit; the sky is lit. PART: of a map that serves some receivers only; the
// other pixels keep what they have.
#include "shared/filters.glsl"
#include "technique"

layout(binding = 0) uniform sampler2D positions;
layout(binding = 1) uniform sampler2D planes;
layout(binding = 2) uniform MAP_SAMPLER shadowMap;

layout(location = 0) out float outVisibility;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec4 position = texelFetch(positions, pixel, 0);
    outVisibility = 1.0;
    if (position.w == 0.0) return;
    ShadowReceiver receiver = shadowReceiver(position.xyz, texelFetch(planes, pixel, 0).xyz, view, shadow);
#ifdef PART
    if (!serves(receiver, dot(position.xyz, view.forward.xyz), shadow)) {
        discard;
        return;  // some drivers let what is discarded go through the loops of the lookup
    }
#endif
    outVisibility = receiver.facesLight ? filterVisibility(shadowMap, receiver, shadow) : 0.0;
}
