// SPDX-License-Identifier: MIT
// Gradient shadow maps whose gradient is stored beside the depth: one lookup says both, where gsm reads sixteen texels
// for the slope of neighbours. The map is four times as large.
//
// Source: C. Schueler, "Multisampling extension for gradient shadow maps", ShaderX5, 2006: "generated ... in the first
// pass and stored with the depth map"; shared/gradient_compare.glsl. The differences are those to the nearer neighbour
// in depth, not the rasteriser's derivatives: they are the same inside a triangle, and a silhouette is not a slope.
// Map: x linear light depth, 0 near; yz its change from texel to texel. Reads four texels a tap and four more.
// Parameters: as for gsm; pattern: 0 `taps` on Vogel's spiral, 1 a circle of eight, 2 sixteen of Poisson's.

SHARED_FUNCTION real4 mapTexel(real depth, real2 slope, int layer, ShadowConstants shadow) {
    return real4(depth, slope.x, slope.y, 0.0);
}

SHARED_FUNCTION real filterVisibility(sampler2DArray map, ShadowReceiver receiver, ShadowConstants shadow) {
    real radius = max(kernelRadiusUv(receiver, shadow), real(0.5) * shadow.map.y);
    if (!reachesMap(receiver.uv, radius + shadow.map.y)) return real(1.0);
    real4 here = filteredTexel(map, receiver.uv, 0, shadow);
    real2 gradient = limitedGradient(real2(here.y, here.z) * shadow.map.x, PARAMETER_most_slope);
    real slope = length(gradient) * shadow.map.y;
    real depth = min(receiver.depth, real(1.0)) - receiver.depthError - PARAMETER_bias * slope;
    int pattern = int(PARAMETER_pattern);
    int n = gradientTaps(pattern, int(PARAMETER_taps));
    real lit = real(0.0);
    for (int i = 0; i < n; ++i) {
        real2 offset = gradientTap(pattern, i, n) * radius;
        real compared = min(depth + dot(offset, gradient), real(1.0));
        lit += fuzzyVisibility(filteredTexel(map, receiver.uv + offset, 0, shadow).x - compared, slope);
    }
    return unitRange(lit / real(n));
}
