// SPDX-License-Identifier: MIT
// Prepass: writes where the surface is, the plane of its triangle, its shading normal and its material.
#include "shared/blocks.glsl"
#include "shared/patterns.glsl"

in vec3 eyeRelative;
in vec3 shadingNormal;

layout(location = 0) uniform vec4 materialAlbedo;   // rgb, w gloss in [0,1]
layout(location = 1) uniform vec4 materialSecond;   // rgb of the pattern's other colour, w its period in m
layout(location = 2) uniform uint materialPattern;

layout(location = 0) out vec4 outPosition;  // xyz relative to the eye, w 1 where there is a surface
layout(location = 1) out vec4 outPlane;     // xyz unit normal of the triangle, turned to the viewer; w gloss
layout(location = 2) out vec4 outNormal;    // xyz unit shading normal
layout(location = 3) out vec4 outAlbedo;

void main() {
    vec3 plane = normalize(cross(dFdx(eyeRelative), dFdy(eyeRelative)));
    if (dot(plane, eyeRelative) > 0.0) plane = -plane;
    vec3 smoothNormal = normalize(shadingNormal);
    if (dot(smoothNormal, plane) < 0.0) smoothNormal = -smoothNormal;

    vec3 world = view.eye.xyz + eyeRelative;
    vec3 albedo = patternColour(materialPattern, materialAlbedo.rgb, materialSecond.rgb, materialSecond.w, world);
    outPosition = vec4(eyeRelative, 1.0);
    outPlane = vec4(plane, materialAlbedo.w);
    outNormal = vec4(smoothNormal, 0.0);
    outAlbedo = vec4(albedo, 1.0);
}
