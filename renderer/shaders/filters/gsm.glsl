// SPDX-License-Identifier: MIT
// Gradient shadow maps with percentage-closer filtering: each tap reads the bilinearly filtered depth and lets light
// fade over one texel's worth of slope behind it, and the receiver's depth follows the gradient to the tap.
//
// Source: C. Schueler, "Multisampling extension for gradient shadow maps", ShaderX5, 2006. Its first PCF listing
// samples the undisplaced place; the sign of the difference is that of its unrolled listing;
// shared/gradient_compare.glsl.
// Map: linear light depth, 0 near. Reads four texels a tap, eight with regression, for neighbours 16 more.
// Parameters: bias, in slopes of a texel; gradient: 0 from the neighbours of the receiver's texel, 1 by regression over
// all taps, 2 that of the receiver's own plane, which alone is right at silhouettes; pattern: 0 `taps` on Vogel's
// spiral, 1 the paper's circle of eight, 2 sixteen of Poisson's; offsets: 0 leaves the receiver's depth where it is,
// which darkens slopes by half (the paper's figure 4.2.3); most_slope: of the map's
// gradients, depth ranges per map's extent.

SHARED_FUNCTION real filterVisibility(sampler2D map, ShadowReceiver receiver, ShadowConstants shadow) {
    // At least the half texel of the paper's displacement.
    real radius = max(kernelRadiusUv(receiver, shadow), real(0.5) * shadow.map.y);
    if (!reachesMap(receiver.uv, radius + shadow.map.y)) return real(1.0);
    int pattern = int(PARAMETER_pattern);
    int n = gradientTaps(pattern, int(PARAMETER_taps));
    real2 gradient = receiver.depthGradient;
    // Over the map's edge there is no surface that has a slope, only depth 1: the receiver's own gradient there.
    bool ofTheMap = PARAMETER_gradient != real(2.0) && liesInMap(receiver.uv, radius + shadow.map.y);
    if (ofTheMap && PARAMETER_gradient == real(0.0)) gradient = neighbourGradient(map, receiver.uv, shadow);
    if (ofTheMap && PARAMETER_gradient == real(1.0))
        gradient = regressedGradient(map, receiver.uv, radius, pattern, n, shadow);
    // The receiver's plane has no silhouettes: its gradient is right however steep.
    gradient = limitedGradient(gradient, ofTheMap ? PARAMETER_most_slope : kSteepestGradient);
    real slope = length(gradient) * shadow.map.y;
    real depth = min(receiver.depth, real(1.0)) - receiver.depthError - PARAMETER_bias * slope;
    real2 follow = PARAMETER_offsets != real(0.0) ? gradient : real2(0.0);
    return gradientVisibility(map, receiver.uv, radius, depth, follow, slope, pattern, n, shadow);
}
