// SPDX-License-Identifier: MIT
// Exponential variance shadow maps, two moments: Chebyshev's bound on depths warped by an exponential, which pushes
// occluders far from each other compared with the distance to the receiver, so that less light bleeds.
//
// Source: A. Lauritzen, M. McCool, "Layered variance shadow maps", GI 2008, section 6.
// Map: x mean, y mean square of exp(c (2 z - 1)) under the kernel, z linear light depth, 0 near. The square overflows
// 32 bits at c = 44, 16 bits at 5.5.
// Parameters: bias_texels (shared/filtered_map.glsl), gaussian (prefilter.h), positive_exponent c, least_deviation: the
// least standard deviation of depth, in units of depth.

SHARED_FUNCTION real4 mapTexel(real depth, real2 slope, int layer, ShadowConstants shadow) {
    real warped = warpedUp(depth, PARAMETER_positive_exponent);
    return real4(warped, warped * warped, 0.0, 0.0);
}

SHARED_FUNCTION real filterVisibility(sampler2DArray map, ShadowReceiver receiver, ShadowConstants shadow) {
    if (!reachesFilteredMap(receiver.uv, shadow)) return real(1.0);
    real4 moments = filteredTexel(map, receiver.uv, 0, shadow);
    real depth = biasedDepth(receiver, shadow, PARAMETER_bias_texels, real(0.0), real(0.0));
    return boundAfterWarp(moments.x, moments.y, warpedUp(depth, PARAMETER_positive_exponent),
                          PARAMETER_positive_exponent, PARAMETER_least_deviation);
}
