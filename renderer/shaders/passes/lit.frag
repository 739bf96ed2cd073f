// SPDX-License-Identifier: MIT
// Lit pass: sun times visibility, sky and ground light, haze and tone. The target holds sRGB codes.
#include "shared/blocks.glsl"
#include "shared/shading.glsl"

layout(binding = 0) uniform sampler2D positions;
layout(binding = 1) uniform sampler2D planes;
layout(binding = 2) uniform sampler2D normals;
layout(binding = 3) uniform sampler2D albedos;
layout(binding = 4) uniform sampler2D visibilities;

layout(location = 0) out vec4 outColour;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec4 position = texelFetch(positions, pixel, 0);
    vec3 ray = pixelRay(gl_FragCoord.xy);
    vec3 colour = skyColour(ray);
    if (position.w != 0.0) {
        SurfaceLook surface = SurfaceLook(position.xyz, texelFetch(normals, pixel, 0).xyz,
                                          texelFetch(albedos, pixel, 0).rgb, texelFetch(planes, pixel, 0).w);
        colour = surfaceColour(surface, ray, texelFetch(visibilities, pixel, 0).x);
    }
    outColour = vec4(displayCode(colour), 1.0);
}
