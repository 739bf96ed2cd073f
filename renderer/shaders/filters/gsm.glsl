// SPDX-License-Identifier: MIT
// Gradient shadow maps with percentage-closer filtering: each tap reads the bilinearly filtered depth and lets light
// fade over one texel's worth of slope behind it, and the receiver's depth follows the gradient to the tap.
//
// Source: C. Schueler, "Multisampling extension for gradient shadow maps", ShaderX5, 2006. Its first PCF listing
// samples the undisplaced place; the factor of its circular-8 regression is 1/8 in units of the displacement, here it
// follows from the taps; the sign of the difference is that of its unrolled listing.
// Map: linear light depth, 0 near. Reads 4 texels a tap and, for the gradient of neighbours, 16 more.
// Parameters: gradient: 0 from the neighbours of the receiver's texel, 1 by regression over all taps, 2 that of the
// receiver's own plane, which alone is right at silhouettes; taps (on Vogel's spiral); bias, in slopes of a texel; offsets: 0 leaves the receiver's depth
// where it is, which darkens slopes by half (the paper's figure 4.2.3); most_slope: a silhouette is not a slope, depth
// ranges per map's extent.

// Bilinearly filtered depth; outside the map nothing is in the way, and a depth that is no number is none.
SHARED_FUNCTION real texelDepth(sampler2D map, int column, int row, ShadowConstants shadow) {
    int last = int(shadow.map.x) - 1;
    if (column < 0 || row < 0 || column > last || row > last) return real(1.0);
    real depth = real(texelFetch(map, int2(column, row), 0).x);
    return depth >= real(0.0) ? min(depth, real(1.0)) : (depth < real(0.0) ? real(0.0) : real(1.0));
}

SHARED_FUNCTION real filteredDepth(sampler2D map, real2 uv, ShadowConstants shadow) {
    real2 place = clamp(uv * shadow.map.x - real2(0.5), real2(-1.0), real2(shadow.map.x));
    int column = int(floor(place.x));
    int row = int(floor(place.y));
    real2 part = place - floor(place);
    real lower = mix(texelDepth(map, column, row, shadow), texelDepth(map, column + 1, row, shadow), part.x);
    real upper = mix(texelDepth(map, column, row + 1, shadow), texelDepth(map, column + 1, row + 1, shadow), part.x);
    return mix(lower, upper, part.y);
}

// Longer gradients are cut to `most`; one whose length is no number is none.
SHARED_FUNCTION real2 limited(real2 gradient, real most) {
    real size = length(gradient);
    if (!(size > real(0.0) && size < real(1e15))) return real2(0.0);
    return gradient * (min(size, most) / size);
}

// d depth / d uv from central differences around a place.
SHARED_FUNCTION real2 neighbourGradient(sampler2D map, real2 uv, ShadowConstants shadow) {
    real2 right = real2(shadow.map.y, 0.0);
    real2 up = real2(0.0, shadow.map.y);
    return real2(filteredDepth(map, uv + right, shadow) - filteredDepth(map, uv - right, shadow),
                 filteredDepth(map, uv + up, shadow) - filteredDepth(map, uv - up, shadow)) *
           (real(0.5) * shadow.map.x);
}

// d depth / d uv of the plane that fits all taps best.
SHARED_FUNCTION real2 regressedGradient(sampler2D map, real2 uv, real radius, int n, ShadowConstants shadow) {
    real centre = filteredDepth(map, uv, shadow);
    real xx = real(0.0);
    real xy = real(0.0);
    real yy = real(0.0);
    real2 xz = real2(0.0);
    for (int i = 0; i < n; ++i) {
        real2 offset = vogelTap(i, n);
        xx += offset.x * offset.x;
        xy += offset.x * offset.y;
        yy += offset.y * offset.y;
        xz += offset * (filteredDepth(map, uv + offset * radius, shadow) - centre);
    }
    real determinant = xx * yy - xy * xy;
    if (!(determinant > real(1e-6)) || !(radius > real(0.0))) return real2(0.0);
    return real2(yy * xz.x - xy * xz.y, xx * xz.y - xy * xz.x) / (determinant * radius);
}

SHARED_FUNCTION real filterVisibility(sampler2D map, ShadowReceiver receiver, ShadowConstants shadow) {
    // At least the half texel of the paper's displacement.
    real radius = max(kernelRadiusUv(receiver, shadow), real(0.5) * shadow.map.y);
    if (!reachesMap(receiver.uv, radius + shadow.map.y)) return real(1.0);
    int n = int(PARAMETER_taps);
    real2 gradient = receiver.depthGradient;
    if (PARAMETER_gradient == real(0.0)) gradient = neighbourGradient(map, receiver.uv, shadow);
    if (PARAMETER_gradient == real(1.0)) gradient = regressedGradient(map, receiver.uv, radius, n, shadow);
    gradient = limited(gradient, PARAMETER_most_slope);
    real slope = length(gradient) * shadow.map.y;
    real depth = min(receiver.depth, real(1.0)) - receiver.depthError - PARAMETER_bias * slope;
    real lit = real(0.0);
    for (int i = 0; i < n; ++i) {
        real2 offset = vogelTap(i, n) * radius;
        real follow = PARAMETER_offsets != real(0.0) ? dot(offset, gradient) : real(0.0);
        real above = filteredDepth(map, receiver.uv + offset, shadow) - min(depth + follow, real(1.0));
        // Without a slope the band is a step.
        if (slope > real(0.0))
            lit += unitRange(real(1.0) + above / slope);
        else
            lit += above < real(0.0) ? real(0.0) : real(1.0);
    }
    return clamp(lit / real(n), real(0.0), real(1.0));
}
