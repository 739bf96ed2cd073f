// SPDX-License-Identifier: MIT
// The share of a texel that a disc covers: the weight with which a full-kernel disc filter counts the texel, so that
// the filtered map is the convolution of the nearest-texel visibility with the disc.
//
// The disc is symmetric, so let M >= m >= 0 be the texel's distances from the disc's centre along the axes, larger
// first. Across m the disc's edge is no steeper than 45 degrees: the length of the row piece [M-1/2, M+1/2] inside
// the disc is integrated over m by the midpoint rule. Against the exact overlap (tests/renderer) a single weight is
// off by at most .012; a half-plane under the whole kernel by .0006 from 3.47 texels on, .0012 from 2.5 on, and .004,
// one 8-bit level, below. The exact area needs asin, which drivers round to about 2^-11.

// Rows of the midpoint rule. Small discs need more of them, and have few texels.
SHARED_FUNCTION int discRows(real radius) { return radius < real(1.25) ? 24 : (radius < real(2.5) ? 8 : 4); }

// For the four texels with the given centres relative to the disc's, in texels; radius in texels.
SHARED_FUNCTION real4 discCoverage4(real4 x, real4 y, real radius) {
    real4 larger = max(abs(x), abs(y));
    real4 smaller = min(abs(x), abs(y));
    real4 low = max(smaller - real4(0.5), real4(-radius));
    real4 high = min(smaller + real4(0.5), real4(radius));
    int rows = discRows(radius);
    real4 rowHeight = max(high - low, real4(0.0)) / real(rows);
    real4 length4 = real4(0.0);
    for (int k = 0; k < rows; ++k) {
        real4 t = low + rowHeight * (real(k) + real(0.5));
        real4 halfChord = sqrt(max(real4(radius * radius) - t * t, real4(0.0)));
        length4 += max(min(larger + real4(0.5), halfChord) - max(larger - real4(0.5), -halfChord), real4(0.0));
    }
    return length4 * rowHeight;
}
