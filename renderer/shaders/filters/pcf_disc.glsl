// SPDX-License-Identifier: MIT
// Percentage-closer filtering with the full kernel: every texel that the disc touches, weighted by the share of it
// that the disc covers. The result is the exact convolution of the nearest-texel visibility with the disc, so the
// softness is the disc's and does not depend on N; only the staircase of the map does.
//
// Source: W. Reeves, D. Salesin, R. Cook, "Rendering antialiased shadows with depth maps", SIGGRAPH 1987; receiver
// plane: shared/receiver.glsl.
// Map: linear light depth, 0 near. Reads pi (r/a)^2 texels and a rim, four to a gather: 37.8 at r = 3.47 a.
// Parameters: bias_texels, bias_reaches (shared/depth_compare.glsl).

SHARED_FUNCTION real filterVisibility(sampler2D map, ShadowReceiver receiver, ShadowConstants shadow) {
    real radius = kernelRadiusUv(receiver, shadow);
    PlaneCompare plane = planeCompare(
        receiver, shadow, kernelBiasTexels(PARAMETER_bias_texels, PARAMETER_bias_reaches, radius, shadow));
    return discVisibility(map, receiver.uv, radius, shadow, plane);
}
