// SPDX-License-Identifier: MIT
// Percentage-closer filtering with a grid of n x n samples across the kernel, each the compare of the nearest texel or
// the tent-weighted compares of four, all alike or weighted by a Gaussian.
//
// Source: W. Reeves, D. Salesin, R. Cook, "Rendering antialiased shadows with depth maps", SIGGRAPH 1987; the four
// variants: W. Donnelly, A. Lauritzen, "Variance shadow maps", I3D 2006, section 4.
// Map: linear light depth, 0 near. Reads n^2 texels, four times as many bilinearly.
// Parameters: bias_texels, bias_reaches (shared/depth_compare.glsl); samples n along an edge; bilinear; gaussian. The kernel has the
// deviation of the disc: a square of half-width .866 r, or a Gaussian of deviation r/2 out to 1.25 r.

SHARED_FUNCTION real filterVisibility(sampler2D map, ShadowReceiver receiver, ShadowConstants shadow) {
    real radius = kernelRadiusUv(receiver, shadow);
    if (!reachesMap(receiver.uv, real(2.0) * radius + shadow.map.y)) return real(1.0);
    PlaneCompare plane = planeCompare(
        receiver, shadow, kernelBiasTexels(PARAMETER_bias_texels, PARAMETER_bias_reaches, radius, shadow));
    int n = int(PARAMETER_samples);
    bool gaussian = PARAMETER_gaussian != real(0.0);
    real halfWidth = gaussian ? real(1.25) : real(0.8660254037844386);  // in radii
    real lit = real(0.0);
    real total = real(0.0);
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
            real2 offset = (real2(real(i) + real(0.5), real(j) + real(0.5)) * (real(2.0) / real(n)) - real2(1.0)) *
                           halfWidth;
            real weight = gaussian ? exp(real(-2.0) * dot(offset, offset)) : real(1.0);
            lit += weight * tapVisibility(map, receiver.uv + offset * radius, shadow, plane, PARAMETER_bilinear);
            total += weight;
        }
    return clamp(lit / total, real(0.0), real(1.0));
}
