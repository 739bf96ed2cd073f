// SPDX-License-Identifier: MIT
// Variance shadow maps from a mip chain: the level of the kernel, or of the screen's pixel where that is wider, so that
// maps seen from afar do not alias. Cheap, and boxy: a level's texels lie on a grid.
//
// Source: W. Donnelly, A. Lauritzen, "Variance shadow maps", I3D 2006, sections 4 and 5; shared/mip_map.glsl.
// Map: as for vsm, unfiltered, and its mip chain.
// Parameters: as for vsm; anisotropy: most probes along the longer side of a pixel's footprint, 1 none, where the level
// is that of its longer side instead.

SHARED_FUNCTION real4 mapTexel(real depth, real2 slope, int layer, ShadowConstants shadow) {
    return varianceTexel(depth, slope, PARAMETER_derivative);
}

SHARED_FUNCTION real filterVisibility(sampler2DArray map, ShadowReceiver receiver, ShadowConstants shadow) {
    real radius = real(2.0) * shadow.prefilter.x * shadow.map.y;
    if (!reachesMap(receiver.uv, mipReachUv(radius, shadow))) return real(1.0);
    real longest = length(receiver.longestStep) * shadow.kernel.z;
    real narrow = max(radius, max(receiver.footprintUv * shadow.kernel.z, real(1e-6)));
    real ratio = longest / narrow;
    // A pixel that sees more than the map has no direction worth probing.
    real probes = ratio > real(1.0) && longest < real(1.0) ? min(ceil(ratio), PARAMETER_anisotropy) : real(1.0);
    real2 step = probes > real(1.0) ? receiver.longestStep * (shadow.kernel.z / probes) : real2(0.0);
    real wide = longest > real(0.0) ? max(radius, longest / probes) : radius;
    real4 moments = real4(0.0);
    for (int i = 0; i < int(probes); ++i)
        moments += mipMean(map, receiver.uv + step * (real(i) - real(0.5) * (probes - real(1.0))), wide, shadow);
    moments /= probes;
    real depth = biasedDepth(receiver, shadow, PARAMETER_bias_texels, real(0.0), real(0.0));
    real bound = chebyshevBound(moments.x, moments.y, depth, PARAMETER_least_variance);
    return withoutBleeding(bound, PARAMETER_bleeding);
}
