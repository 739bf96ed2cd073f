// SPDX-License-Identifier: MIT
// Depth pass: nothing but depth is stored.
#ifdef LAMP
in float lightDepth;
#endif

void main() {
#ifdef LAMP
    gl_FragDepth = lightDepth;
#endif
}
