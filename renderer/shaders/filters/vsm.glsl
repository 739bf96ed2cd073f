// SPDX-License-Identifier: MIT
// Variance shadow maps: an upper bound on the light from mean and mean square of the depths under the kernel, exact
// for a planar occluder over a parallel receiver. Where occluders overlap, light bleeds through by the bound.
//
// Source: W. Donnelly, A. Lauritzen, "Variance shadow maps", I3D 2006; the quarter of the squared derivatives: A.
// Lauritzen, "Summed-area variance shadow maps", GPU Gems 3, 2007.
// Map: x mean, y mean square of linear light depth, 0 near, under the kernel; 32 or 16 bits, or 16 bits in two halves.
// Parameters: bias_texels, bias_depth (shared/filtered_map.glsl); gaussian (prefilter.h); least_variance floors the
// variance, which rounding may make negative; bleeding is cut off; derivative weighs the variance that a texel's own
// slope has.

SHARED_FUNCTION real4 mapTexel(real depth, real2 slope, int layer, ShadowConstants shadow) {
    return varianceTexel(depth, slope, PARAMETER_derivative);
}

SHARED_FUNCTION real filterVisibility(sampler2DArray map, ShadowReceiver receiver, ShadowConstants shadow) {
    if (!reachesFilteredMap(receiver.uv, shadow)) return real(1.0);
    real4 moments = filteredTexel(map, receiver.uv, 0, shadow);
    real depth = biasedDepth(receiver, shadow, PARAMETER_bias_texels, real(0.0), PARAMETER_bias_depth);
    real bound = chebyshevBound(moments.x, moments.y, depth, PARAMETER_least_variance);
    return withoutBleeding(bound, PARAMETER_bleeding);
}
