// SPDX-License-Identifier: MIT
// Prepass: the visible surface of every pixel, once.
#include "shared/blocks.glsl"

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;

out vec3 eyeRelative;
out vec3 shadingNormal;

void main() {
    eyeRelative = position - view.eye.xyz;
    shadingNormal = normal;
    gl_Position = view.clipFromEyeRelative * vec4(eyeRelative, 1.0);
}
