// SPDX-License-Identifier: MIT
// The one-tailed Chebyshev bound: at most this share of a distribution with these two moments lies at `depth` or
// beyond. W. Donnelly, A. Lauritzen, "Variance shadow maps", I3D 2006, equations 3 to 5; needs filtered_map.glsl.

SHARED_FUNCTION real chebyshevBound(real mean, real meanSquare, real depth, real leastVariance) {
    // First, since depth = mean without variance is 0 / 0 below; and a mean that is no number is lit.
    if (!(depth > mean)) return real(1.0);
    real variance = max(meanSquare - mean * mean, leastVariance);
    real beyond = depth - mean;
    // Divided through, since the square of a small distance underflows.
    real ratio = variance / beyond;
    return unitRange(ratio / (ratio + beyond));
}

// Light bleeding is cut off with everything below `cut` and the rest stretched (Real-Time Rendering, "Filtered shadow
// maps", after Lauritzen). cut < 1.
SHARED_FUNCTION real withoutBleeding(real visibility, real cut) {
    return unitRange((visibility - cut) / (real(1.0) - cut));
}

// Mean and mean square over a texel whose depth changes by `slope` across it: a quarter of the squared derivatives more
// than the square, times `weight` (A. Lauritzen, "Summed-area variance shadow maps", GPU Gems 3, 2007).
SHARED_FUNCTION real4 varianceTexel(real depth, real2 slope, real weight) {
    real within = real(0.25) * dot(slope, slope) * weight;
    return real4(depth, min(depth * depth + within, real(1.0)), 0.0, 0.0);
}
