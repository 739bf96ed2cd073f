// SPDX-License-Identifier: MIT
// Exponential shadow maps: the step of the depth test is replaced by exp(c (z - d)), which can be filtered before d is
// known. Light leaks where occluder and receiver are closer than about 1/c.
//
// Source: T. Annen, T. Mertens, H.-P. Seidel, E. Flerackers, J. Kautz, "Exponential shadow maps", GI 2008; M. Salvi,
// "Rendering filtered shadows with exponential shadow maps", ShaderX6, 2008 (filtering the logarithm).
// Map: x the logarithm of the mean of exp(c z) under the kernel, z linear light depth, 0 near. The exponentials
// themselves overflow at c z > 88.7 in 32 bits and 11.1 in 16; their logarithm is a depth in units of 1/c.
// Parameters: bias_texels, bias_depth (shared/filtered_map.glsl), gaussian (prefilter.h), exponent c.

SHARED_FUNCTION real4 mapTexel(real depth, real2 slope, int layer, ShadowConstants shadow) {
    return real4(PARAMETER_exponent * depth, 0.0, 0.0, 0.0);
}

SHARED_FUNCTION real filterVisibility(sampler2DArray map, ShadowReceiver receiver, ShadowConstants shadow) {
    if (!reachesFilteredMap(receiver.uv, shadow)) return real(1.0);
    real depth = biasedDepth(receiver, shadow, PARAMETER_bias_texels, real(0.0), PARAMETER_bias_depth);
    return filteredExponential(map, receiver.uv, PARAMETER_exponent * depth, shadow);
}
