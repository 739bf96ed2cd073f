// SPDX-License-Identifier: MIT
// The warps of exponential variance shadow maps and the bound behind them (A. Lauritzen, M. McCool, "Layered variance
// shadow maps", GI 2008, section 6). Needs chebyshev.glsl.

// Depth in [0,1] grows from exp(-c) to exp(c).
SHARED_FUNCTION real warpedUp(real depth, real exponent) {
    return exp(exponent * (real(2.0) * clamp(depth, real(0.0), real(1.0)) - real(1.0)));
}

// Grows too, from -exp(k) to -exp(-k).
SHARED_FUNCTION real warpedDown(real depth, real exponent) {
    return -exp(-exponent * (real(2.0) * clamp(depth, real(0.0), real(1.0)) - real(1.0)));
}

// A step of depth is stretched by twice |exponent x warped| here; so is the least deviation.
SHARED_FUNCTION real boundAfterWarp(real mean, real meanSquare, real warped, real exponent, real leastDeviation) {
    real least = real(2.0) * leastDeviation * exponent * warped;
    return chebyshevBound(mean, meanSquare, warped, least * least);
}
