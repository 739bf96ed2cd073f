// SPDX-License-Identifier: MIT
// Exponential variance shadow maps, four moments: the lesser of two Chebyshev bounds, one on depths warped up, which
// is tight far behind occluders, one on depths warped down, which is tight close behind them.
//
// Source: A. Lauritzen, M. McCool, "Layered variance shadow maps", GI 2008, section 6.
// Map: x mean, y mean square of exp(c (2 z - 1)), z mean, w mean square of -exp(-k (2 z - 1)) under the kernel, z
// linear light depth, 0 near. The squares overflow 32 bits at an exponent of 44.
// Parameters: bias_texels, bias_reaches (shared/filtered_map.glsl: the mean of a plane warped down lies before the
// plane), gaussian (prefilter.h), positive_exponent c, negative_exponent k, least_deviation: the least standard
// deviation of depth, in units of depth.

SHARED_FUNCTION real4 mapTexel(real depth, real2 slope, int layer, ShadowConstants shadow) {
    real up = warpedUp(depth, PARAMETER_positive_exponent);
    real down = warpedDown(depth, PARAMETER_negative_exponent);
    return real4(up, up * up, down, down * down);
}

SHARED_FUNCTION real filterVisibility(sampler2DArray map, ShadowReceiver receiver, ShadowConstants shadow) {
    if (!reachesFilteredMap(receiver.uv, shadow)) return real(1.0);
    real4 moments = filteredTexel(map, receiver.uv, 0, shadow);
    real depth = biasedDepth(receiver, shadow, PARAMETER_bias_texels, PARAMETER_bias_reaches, real(0.0));
    real far = boundAfterWarp(moments.x, moments.y, warpedUp(depth, PARAMETER_positive_exponent),
                              PARAMETER_positive_exponent, PARAMETER_least_deviation);
    real close = boundAfterWarp(moments.z, moments.w, warpedDown(depth, PARAMETER_negative_exponent),
                                PARAMETER_negative_exponent, PARAMETER_least_deviation);
    return min(far, close);
}
