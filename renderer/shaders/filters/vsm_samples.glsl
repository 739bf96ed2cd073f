// SPDX-License-Identifier: MIT
// Variance shadow maps from several smaller kernels: light bleeds only where occluders overlap under one of them, and
// with ever more samples it is percentage-closer filtering.
//
// Source: T. Akenine-Moeller, E. Haines, N. Hoffman, "Real-Time Rendering", section "Filtered shadow maps": "by taking
// more samples over smaller areas".
// Map: as for vsm, under a kernel `samples` times narrower. Samples lie side by side: together they are as soft.
// Parameters: as for vsm; samples along the kernel's edge.

SHARED_FUNCTION real4 mapTexel(real depth, real2 slope, int layer, ShadowConstants shadow) {
    return varianceTexel(depth, slope, PARAMETER_derivative);
}

SHARED_FUNCTION real filterVisibility(sampler2DArray map, ShadowReceiver receiver, ShadowConstants shadow) {
    int samples = int(PARAMETER_samples);
    real reach = sqrt(real(3.0)) * shadow.prefilter.x;  // of one box, in texels
    if (!reachesMap(receiver.uv, (kernelReach(shadow) + reach * real(samples - 1) + real(1.0)) * shadow.map.y))
        return real(1.0);
    real depth = biasedDepth(receiver, shadow, PARAMETER_bias_texels, real(0.0), real(0.0));
    real sum = real(0.0);
    for (int i = 0; i < samples * samples; ++i) {
        real2 step = real2(real(2 * (i % samples) + 1 - samples), real(2 * (i / samples) + 1 - samples));
        real2 offset = step * (reach * shadow.map.y);
        real4 moments = filteredTexel(map, receiver.uv + offset, 0, shadow);
        // Each sample compares the receiver's plane where it lies.
        real there = min(depth + dot(offset, receiver.depthGradient), real(1.0));
        sum += chebyshevBound(moments.x, moments.y, there, PARAMETER_least_variance);
    }
    return withoutBleeding(unitRange(sum / real(samples * samples)), PARAMETER_bleeding);
}
