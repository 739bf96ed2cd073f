// SPDX-License-Identifier: MIT
// Depth pass: casters from the light (clip control: zero to one). Of the sun gl_Position.z is the linear light depth
// itself; of a lamp it would not stay linear between the corners of a triangle, so the fragments write it (LAMP).
#include "shared/blocks.glsl"

layout(location = 0) in vec3 position;

#ifdef LAMP
out float lightDepth;
#endif

void main() {
    vec4 h = shadow.shadowFromWorld * vec4(position, 1.0);
    float z = h.z;
#ifdef LAMP
    lightDepth = h.z;
    z = (h.w - shadow.scale.x) * (shadow.scale.x + shadow.scale.y) / shadow.scale.y;  // for clipping alone
#endif
    gl_Position = vec4(2.0 * h.x - h.w, 2.0 * h.y - h.w, z, h.w);
}
