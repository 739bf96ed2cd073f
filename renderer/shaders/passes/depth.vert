// SPDX-License-Identifier: MIT
// Depth pass: casters from the light. gl_Position.z / w is the linear light depth (clip control: zero to one).
#include "shared/blocks.glsl"

layout(location = 0) in vec3 position;

void main() {
    vec4 h = shadow.shadowFromWorld * vec4(position, 1.0);
    gl_Position = vec4(2.0 * h.x - h.w, 2.0 * h.y - h.w, h.z * h.w, h.w);
}
