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
