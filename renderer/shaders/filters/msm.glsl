// SPDX-License-Identifier: MIT
// Moment shadow maps with four moments in 32 bits: the least shadow that the moments of the depths under the kernel
// allow.
//
// Source: C. Peters, R. Klein, "Moment shadow mapping", I3D 2015; shared/hamburger.glsl.
// Map: means of z, z^2, z^3, z^4 under the kernel, z = 2 x linear light depth - 1.
// Parameters: bias_texels, bias_reaches (shared/filtered_map.glsl: a sloped plane under the kernel is a distribution
// that lies before its own middle), gaussian (prefilter.h), moment_bias alpha.

SHARED_FUNCTION real4 mapTexel(real depth, real2 slope, int layer, ShadowConstants shadow) {
    return momentsOfDepth(depth);
}

SHARED_FUNCTION real filterVisibility(sampler2DArray map, ShadowReceiver receiver, ShadowConstants shadow) {
    if (!reachesFilteredMap(receiver.uv, shadow)) return real(1.0);
    real depth = biasedDepth(receiver, shadow, PARAMETER_bias_texels, PARAMETER_bias_reaches, PARAMETER_bias_depth);
    return hamburgerVisibility(filteredTexel(map, receiver.uv, 0, shadow), depth, PARAMETER_moment_bias);
}
