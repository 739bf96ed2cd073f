// SPDX-License-Identifier: MIT
// Surface patterns, drawn from the world position and filtered to the pixel. The numbers are Pattern in scene.h.

// Coverage of a pixel of width w at x by lines of the given half-width at every whole number: a box filter in x.
float lineCoverage(float x, float halfWidth, float w) {
    float left = x - 0.5 * w;
    float right = x + 0.5 * w;
    // Integral of the line indicator from 0.
    float a = floor(left + 0.5) * 2.0 * halfWidth + clamp(left - floor(left + 0.5), -halfWidth, halfWidth);
    float b = floor(right + 0.5) * 2.0 * halfWidth + clamp(right - floor(right + 0.5), -halfWidth, halfWidth);
    return clamp((b - a) / w, 0.0, 1.0);
}

float hash(vec2 cell) { return fract(sin(dot(cell, vec2(12.9898, 78.233))) * 43758.5453); }

vec3 patternColour(uint pattern, vec3 first, vec3 second, float period, vec3 world) {
    if (pattern == PATTERN_TILES) {  // slabs of slightly different shades with joints between them, on the ground
        vec2 p = world.xz / period;
        vec2 w = max(fwidth(p), vec2(1e-5));
        float joint = max(lineCoverage(p.x, 0.012, w.x), lineCoverage(p.y, 0.012, w.y));
        float sharp = clamp(1.5 - max(w.x, w.y) * 2.0, 0.0, 1.0);  // shades average out with distance
        vec3 slab = first * (1.0 + 0.10 * sharp * (hash(floor(p)) - 0.5));
        return mix(slab, second, joint);
    }
    if (pattern == PATTERN_BANDS) {  // bands around the vertical
        float p = world.y / period;
        return mix(first, second, lineCoverage(p, 0.25, max(fwidth(p), 1e-5)));
    }
    return first;
}
