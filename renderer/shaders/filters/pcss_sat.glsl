// SPDX-License-Identifier: MIT
// Percentage-closer soft shadows on a variance map: the penumbra's radius from the means over the widest kernel, then
// the bound from the means over that radius, both from a summed-area table,
// which has every width.
//
// Source: B. Yang, Z. Dong, J. Feng, H.-P. Seidel, J. Kautz, "Variance soft shadow mapping", 2010
// (shared/penumbra_estimate.glsl); A. Lauritzen, "Summed-area variance shadow maps", GPU Gems 3, 2007.
// Map: as for vsm_sat.
// Parameters: bias_texels, least_variance, bleeding, derivative as for vsm; distance as for pcss.

SHARED_FUNCTION real4 mapTexel(real depth, real2 slope, int layer, ShadowConstants shadow) {
    return varianceTexel(depth, slope, PARAMETER_derivative);
}

SHARED_FUNCTION real4 momentsWithin(usampler2DArray map, ShadowReceiver receiver, real radius, ShadowConstants shadow) {
    return meanOfBox(map, receiver.uv, real(0.86602540378443865) * radius, shadow);  // a box as soft as the disc
}

SHARED_FUNCTION real penumbraRadiusUv(sampler2D map, ShadowReceiver receiver, ShadowConstants shadow) {
    real depth = biasedDepth(receiver, shadow, PARAMETER_bias_texels, real(0.0), real(1.0) / summedUnits(shadow));
    real least = PARAMETER_least_variance + summedVarianceError(shadow);
    return estimatedRadiusUv(map, receiver, depth, least, PARAMETER_distance, shadow);
}

SHARED_FUNCTION real filterVisibility(usampler2DArray map, ShadowReceiver receiver, ShadowConstants shadow) {
    real widest = widestPenumbraUv(PARAMETER_distance, shadow);
    if (!reachesMap(receiver.uv, mipReachUv(widest, shadow))) return real(1.0);
    real depth = biasedDepth(receiver, shadow, PARAMETER_bias_texels, real(0.0), real(1.0) / summedUnits(shadow));
    real least = PARAMETER_least_variance + summedVarianceError(shadow);
    real4 around = momentsWithin(map, receiver, widest, shadow);
    real gap = gapToBlockers(around.x, around.y, depth, least);
    real radius = radiusOfGap(gap, PARAMETER_distance, receiver, shadow);
    real4 moments = momentsWithin(map, receiver, radius, shadow);
    return withoutBleeding(chebyshevBound(moments.x, moments.y, depth, least), PARAMETER_bleeding);
}
