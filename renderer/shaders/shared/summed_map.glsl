// SPDX-License-Identifier: MIT
// Summed-area tables: a texel holds the sum of all texels up to it, so that the mean over a box of any width is four
// corners. F. Crow, "Summed-area tables for texture mapping", 1984; for shadows A. Lauritzen, "Summed-area variance
// shadow maps", GPU Gems 3, 2007. Needs filtered_map.glsl.
//
// Sums are whole numbers of units modulo 2^32. A box's own sum is less than 2^32 (summedUnits in prefilter.cpp), so the
// difference of the corners is exact however often the sums went round; sums in float32 would have steps of .25 in the
// last texel of a map of 2048.

SHARED_FUNCTION real summedUnits(ShadowConstants shadow) { return -shadow.prefilter.w; }

// A texel's values in units; values are in [0,1].
SHARED_FUNCTION uint4 unitsOf(real4 value, ShadowConstants shadow) {
    return uint4(clamp(value, real4(0.0), real4(1.0)) * summedUnits(shadow) + real4(0.5));
}

// The sum of the texels before `column` and `row`, exclusive.
SHARED_FUNCTION uint4 sumBefore(usampler2DArray map, int column, int row) {
    uint4 sum = texelFetch(map, int3(max(column - 1, 0), max(row - 1, 0), 0), 0);
    return column > 0 && row > 0 ? sum : sum * 0u;
}

// Sums of the three parts of a row of boxes [columns.x, .y), [.y, .z), [.z, .w) between two rows.
struct BoxRow {
    real4 first, middle, last;
};

SHARED_FUNCTION BoxRow boxRow(uint4 upper0, uint4 upper1, uint4 upper2, uint4 upper3, uint4 lower0, uint4 lower1,
                              uint4 lower2, uint4 lower3) {
    BoxRow row;
    row.first = real4((upper1 - upper0) - (lower1 - lower0));
    row.middle = real4((upper2 - upper1) - (lower2 - lower1));
    row.last = real4((upper3 - upper2) - (lower3 - lower2));
    return row;
}

// Mean over the box around uv, cut at the map's texture. Its outermost texels count by the share of them that it
// covers: four corners for each of its nine parts. No narrower than a texel, where it is the bilinear mean.
SHARED_FUNCTION real4 meanOfBox(usampler2DArray map, real2 uv, real halfWidthUv, ShadowConstants shadow) {
    real edge = real(filteredEdge(shadow));
    real halfWidth = halfWidthUv * shadow.map.x;
    real reach = halfWidth > real(0.5) ? halfWidth : real(0.5);  // also where it is no number
    real2 centre = uv * shadow.map.x + real2(shadow.prefilter.z);
    real2 low = clamp(centre - real2(reach), real2(0.0), real2(edge - real(1.0)));
    real2 high = clamp(centre + real2(reach), low + real2(1.0), real2(edge));
    real2 lowFloor = floor(low);
    real2 highFloor = floor(high);
    int x0 = int(lowFloor.x);
    int y0 = int(lowFloor.y);
    int x2 = int(highFloor.x);
    int y2 = int(highFloor.y);
    int x1 = x0 + 1;
    int y1 = y0 + 1;
    int x3 = int(min(real(x2) + real(1.0), edge));
    int y3 = int(min(real(y2) + real(1.0), edge));
    // Rows of corners, 0 the lowest.
    uint4 a0 = sumBefore(map, x0, y0), a1 = sumBefore(map, x1, y0), a2 = sumBefore(map, x2, y0), a3 = sumBefore(map, x3, y0);
    uint4 b0 = sumBefore(map, x0, y1), b1 = sumBefore(map, x1, y1), b2 = sumBefore(map, x2, y1), b3 = sumBefore(map, x3, y1);
    uint4 c0 = sumBefore(map, x0, y2), c1 = sumBefore(map, x1, y2), c2 = sumBefore(map, x2, y2), c3 = sumBefore(map, x3, y2);
    uint4 d0 = sumBefore(map, x0, y3), d1 = sumBefore(map, x1, y3), d2 = sumBefore(map, x2, y3), d3 = sumBefore(map, x3, y3);
    BoxRow bottom = boxRow(b0, b1, b2, b3, a0, a1, a2, a3);
    BoxRow middle = boxRow(c0, c1, c2, c3, b0, b1, b2, b3);
    BoxRow top = boxRow(d0, d1, d2, d3, c0, c1, c2, c3);
    real2 first = lowFloor + real2(1.0) - low;
    real2 last = high - highFloor;
    real4 sum = (bottom.first * first.x + bottom.middle + bottom.last * last.x) * first.y +
                (middle.first * first.x + middle.middle + middle.last * last.x) +
                (top.first * first.x + top.middle + top.last * last.x) * last.y;
    real2 extent = high - low;
    return sum / (extent.x * extent.y * summedUnits(shadow));
}

// What rounding to units may make of a variance of means.
SHARED_FUNCTION real summedVarianceError(ShadowConstants shadow) { return real(2.0) / summedUnits(shadow); }
