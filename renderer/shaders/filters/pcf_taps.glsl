// SPDX-License-Identifier: MIT
// Percentage-closer filtering with a fixed number of taps in the disc, Poisson's or Vogel's, turned from pixel to pixel
// if asked: a fixed cost, with noise in place of bands.
//
// Source: W. Reeves, D. Salesin, R. Cook, "Rendering antialiased shadows with depth maps", SIGGRAPH 1987;
// shared/taps.glsl.
// Map: linear light depth, 0 near. Reads one texel a tap, four bilinearly.
// Parameters: bias_texels, bias_reaches (shared/depth_compare.glsl); pattern 0 Poisson, 1 Vogel; taps; bilinear; rotated.

SHARED_FUNCTION real filterVisibility(sampler2D map, ShadowReceiver receiver, ShadowConstants shadow) {
    real radius = kernelRadiusUv(receiver, shadow);
    if (!reachesMap(receiver.uv, radius + shadow.map.y)) return real(1.0);
    PlaneCompare plane = planeCompare(
        receiver, shadow, kernelBiasTexels(PARAMETER_bias_texels, PARAMETER_bias_reaches, radius, shadow));
    real2 turn = PARAMETER_rotated != real(0.0) ? turnAt(receiver) : real2(1.0, 0.0);
    int n = int(PARAMETER_taps);
    real lit = real(0.0);
    for (int i = 0; i < n; ++i) {
        real2 uv = receiver.uv + turned(patternTap(PARAMETER_pattern, i, n), turn) * radius;
        lit += tapVisibility(map, uv, shadow, plane, PARAMETER_bilinear);
    }
    return clamp(lit / real(n), real(0.0), real(1.0));
}
