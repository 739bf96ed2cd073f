// SPDX-License-Identifier: MIT
// Percentage-closer soft shadows on a variance map: the penumbra's radius from the means over the widest kernel, then
// the bound from the means over that radius, both from a mip chain: boxy where the
// width changes, since a level's texels lie on a grid (compare pcss_sat).
//
// Source: B. Yang, Z. Dong, J. Feng, H.-P. Seidel, J. Kautz, "Variance soft shadow mapping", 2010
// (shared/penumbra_estimate.glsl); A. Lauritzen, "Summed-area variance shadow maps", GPU Gems 3, 2007.
// Map: as for vsm_mip.
// Parameters: bias_texels, least_variance, bleeding, derivative as for vsm; distance as for pcss.

SHARED_FUNCTION real4 mapTexel(real depth, real2 slope, int layer, ShadowConstants shadow) {
    return varianceTexel(depth, slope, PARAMETER_derivative);
}

SHARED_FUNCTION real4 momentsWithin(sampler2DArray map, ShadowReceiver receiver, real radius, ShadowConstants shadow) {
    return mipMean(map, receiver.uv, radius, shadow);
}

SHARED_FUNCTION real penumbraRadiusUv(sampler2D map, ShadowReceiver receiver, ShadowConstants shadow) {
    real depth = biasedDepth(receiver, shadow, PARAMETER_bias_texels, real(0.0), real(0.0));
    return estimatedRadiusUv(map, receiver, depth, PARAMETER_least_variance, PARAMETER_distance, shadow);
}

SHARED_FUNCTION real filterVisibility(sampler2DArray map, ShadowReceiver receiver, ShadowConstants shadow) {
    real widest = widestPenumbraUv(PARAMETER_distance, shadow);
    if (!reachesMap(receiver.uv, mipReachUv(widest, shadow))) return real(1.0);
    real depth = biasedDepth(receiver, shadow, PARAMETER_bias_texels, real(0.0), real(0.0));
    real least = PARAMETER_least_variance;
    real4 around = momentsWithin(map, receiver, widest, shadow);
    real gap = gapToBlockers(around.x, around.y, depth, least);
    real radius = radiusOfGap(gap, PARAMETER_distance, receiver, shadow);
    real4 moments = momentsWithin(map, receiver, radius, shadow);
    return withoutBleeding(chebyshevBound(moments.x, moments.y, depth, least), PARAMETER_bleeding);
}
