// SPDX-License-Identifier: MIT
// Lit pass: sun and lamps times visibility, sky and ground light, haze and tone. The target holds sRGB codes.
#include "shared/blocks.glsl"
#include "shared/shading.glsl"

layout(binding = 0) uniform sampler2D positions;
layout(binding = 1) uniform sampler2D planes;
layout(binding = 2) uniform sampler2D normals;
layout(binding = 3) uniform sampler2D albedos;
layout(binding = 4) uniform sampler2D visibilities;

#ifdef MOST_LAMPS
layout(binding = 5) uniform sampler2DArray lampVisibilities;

// Three for each lamp: place relative to the eye with the cosine of half the cone's angle (-2: to all sides); axis;
// colour at 1 m.
layout(location = 0) uniform int lampCount;
layout(location = 1) uniform vec4 lamps[3 * MOST_LAMPS];

// What falls on a surface, without its albedo.
vec3 lampLight(int lamp, SurfaceLook surface, float visibility) {
    vec3 way = lamps[3 * lamp].xyz - surface.eyeRelative;
    float distance = max(length(way), 0.1);
    float cone = lamps[3 * lamp].w;
    // The edge of the cone over a tenth of what its cosine leaves, chosen by eye.
    float inCone = cone < -1.5 ? 1.0
                               : smoothstep(cone, mix(cone, 1.0, 0.1), dot(-way / distance, lamps[3 * lamp + 1].xyz));
    return lamps[3 * lamp + 2].rgb *
           (visibility * inCone * max(dot(surface.normal, way / distance), 0.0) / (distance * distance));
}
#endif

layout(location = 0) out vec4 outColour;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec4 position = texelFetch(positions, pixel, 0);
    vec3 ray = pixelRay(gl_FragCoord.xy);
    vec3 colour = skyColour(ray);
    if (position.w != 0.0) {
        SurfaceLook surface = SurfaceLook(position.xyz, texelFetch(normals, pixel, 0).xyz,
                                          texelFetch(albedos, pixel, 0).rgb, texelFetch(planes, pixel, 0).w);
        vec3 fromLamps = vec3(0.0);
#ifdef MOST_LAMPS
        for (int lamp = 0; lamp < lampCount; ++lamp)
            fromLamps += lampLight(lamp, surface, texelFetch(lampVisibilities, ivec3(pixel, lamp), 0).x);
#endif
        colour = surfaceColour(surface, ray, texelFetch(visibilities, pixel, 0).x, fromLamps);
    }
    outColour = vec4(displayCode(colour), 1.0);
}
