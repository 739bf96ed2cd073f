// SPDX-License-Identifier: MIT
// Variance shadow maps from a summed-area table: the box of the kernel by its corners, whatever its width.
//
// Source: A. Lauritzen, "Summed-area variance shadow maps", GPU Gems 3, 2007; shared/summed_map.glsl.
// Map: sums of depth and of its square up to a texel, in whole units, modulo 2^32.
// Parameters: as for vsm.

SHARED_FUNCTION real4 mapTexel(real depth, real2 slope, int layer, ShadowConstants shadow) {
    return varianceTexel(depth, slope, PARAMETER_derivative);
}

SHARED_FUNCTION real filterVisibility(usampler2DArray map, ShadowReceiver receiver, ShadowConstants shadow) {
    if (!reachesFilteredMap(receiver.uv, shadow)) return real(1.0);
    real4 moments = meanOfBox(map, receiver.uv, kernelReach(shadow) * shadow.map.y, shadow);
    real depth = biasedDepth(receiver, shadow, PARAMETER_bias_texels, real(0.0), real(1.0) / summedUnits(shadow));
    real bound = chebyshevBound(moments.x, moments.y, depth, PARAMETER_least_variance + summedVarianceError(shadow));
    return withoutBleeding(bound, PARAMETER_bleeding);
}
