// SPDX-License-Identifier: MIT
// Power CDF: the distribution of the depths under the kernel is taken to be a power function between the least and the
// greatest, with the mean that was measured. Light does not bleed, since whatever lies behind the greatest depth is
// dark; and the shadow is wider by the kernel, since a receiver that is itself the greatest depth is nearly so.
//
// Source: J. Gumbau, L. Szirmay-Kalos, M. Sbert, M. Chover, "Improving shadow map filtering with statistical analysis",
// Eurographics 2011, equations 1 to 4.
// Map: x mean, y least, z greatest linear light depth, 0 near, under the kernel's footprint; layered as for lvsm, each
// with the depths in it (shared/depth_layers.glsl). The receiver's own layer alone counts: in one before it the receiver
// is the greatest depth, and dark as soon as anything is in the way.
// Parameters: bias_texels, bias_reaches, bias_depth (shared/filtered_map.glsl); gaussian (prefilter.h); layers,
// layer_deviation (layer_placement.h).

// exp(x) - 1 and log(1 + x) for |x| < 1, without the cancellation near 0.
SHARED_FUNCTION real expMinusOne(real x) {
    if (abs(x) > real(0.02)) return exp(x) - real(1.0);
    return x * (real(1.0) + x * real(0.5) * (real(1.0) + x * real(1.0 / 3.0) * (real(1.0) + x * real(0.25))));
}

SHARED_FUNCTION real logOnePlus(real x) {
    if (abs(x) > real(0.02)) return log(real(1.0) + x);
    return x * (real(1.0) - x * (real(0.5) - x * (real(1.0 / 3.0) - x * (real(0.25) - x * real(0.2)))));
}

// Equation 4 at t in (m, 1), with s = 1 - t and n = 1 - m measured, not subtracted: (1 - t^b) / (1 - m^b), b = m / n.
SHARED_FUNCTION real powerVisibility(real t, real s, real m, real n) {
    if (!(m > real(0.0))) return real(0.0);  // all weight on the least depth
    real logT = t < real(0.5) ? log(max(t, real(1e-30))) : logOnePlus(-s);
    real logM = m < real(0.5) ? log(max(m, real(1e-30))) : logOnePlus(-n);
    real b = m / max(n, real(1e-30));
    if (b < real(1e-6)) return logT / logM;
    real below = expMinusOne(max(b * logM, real(-60.0)));
    return below < real(0.0) ? expMinusOne(max(b * logT, real(-60.0))) / below : real(1.0);
}

SHARED_FUNCTION real4 mapTexel(real depth, real2 slope, int layer, ShadowConstants shadow) {
    real within = depthInLayer(depth, layer, shadow);
    return real4(within, within, within, 0.0);
}

SHARED_FUNCTION real filterVisibility(sampler2DArray map, ShadowReceiver receiver, ShadowConstants shadow) {
    if (!reachesFilteredMap(receiver.uv, shadow)) return real(1.0);
    real biased = biasedDepth(receiver, shadow, PARAMETER_bias_texels, PARAMETER_bias_reaches, PARAMETER_bias_depth);
    int layer = layerOf(biased, int(PARAMETER_layers), shadow);
    real4 stored = filteredTexel(map, receiver.uv, layer, shadow);
    real depth = depthInLayer(biased, layer, shadow);
    real mean = clamp(stored.x, min(stored.y, stored.z), max(stored.y, stored.z));  // rounding may take it out
    if (!(depth > mean)) return real(1.0);
    if (!(depth < stored.z)) return real(0.0);
    real range = stored.z - stored.y;
    return unitRange(powerVisibility((depth - stored.y) / range, (stored.z - depth) / range,
                                     (mean - stored.y) / range, (stored.z - mean) / range));
}
