// SPDX-License-Identifier: MIT
// Every texel that a disc touches, weighted by the share of it that the disc covers: the exact convolution of the
// nearest-texel visibility with the disc. Needs depth_compare.glsl and disc_kernel.glsl.

// Below this radius in texels the disc is a point.
const real kLeastDiscRadius = real(1.0 / 64.0);

// Weight of the occluded texels in a block of 2 x 2 on the disc's rim. centre is the disc's, in texels.
SHARED_FUNCTION real occludedOnRim(sampler2D map, int column, int row, real2 centre, real radius, PlaneCompare plane,
                                   ShadowConstants shadow) {
    real x = real(column) + real(0.5) - centre.x;
    real y = real(row) + real(0.5) - centre.y;
    real4 weight = discCoverage4(real4(x, x + real(1.0), x + real(1.0), x),
                                 real4(y + real(1.0), y + real(1.0), y, y), radius);
    // A block may stick out of the map by its last column or row; outside the map is lit.
    if (real(column + 1) >= shadow.map.x) weight *= real4(1.0, 0.0, 0.0, 1.0);
    if (real(row + 1) >= shadow.map.x) weight *= real4(0.0, 0.0, 1.0, 1.0);
    real4 stored = real4(textureGather(map, gatherCoordinate(column, row, shadow)));
    return dot(weight, real4(lessThan(stored, planeDepth4(plane, column, row))));
}

SHARED_FUNCTION real discVisibility(sampler2D map, real2 uv, real radiusUv, ShadowConstants shadow,
                                    PlaneCompare plane) {
    real radius = radiusUv * shadow.map.x;
    if (!reachesMap(uv, radiusUv)) return real(1.0);
    if (radius < kLeastDiscRadius) return texelVisibility(map, uv, shadow, plane);

    real2 centre = uv * shadow.map.x;
    real last = shadow.map.x - real(1.0);
    int lastRow = int(min(floor(centre.y + radius), last));
    real rim = real(0.0);
    real4 inside = real4(0.0);
    for (int row = int(max(floor(centre.y - radius), real(0.0))); row <= lastRow; row += 2) {
        real low = real(row) - centre.y;
        real high = low + real(2.0);
        real nearest = max(max(low, -high), real(0.0));
        real farthest = max(-low, high);
        real outer = sqrt(max(radius * radius - nearest * nearest, real(0.0)));
        int column = int(max(floor(centre.x - outer), real(0.0)));
        int lastColumn = int(min(floor(centre.x + outer), last));

        // Columns that lie inside the disc over both rows; none where the block leaves the disc or the map.
        int insideFirst = lastColumn + 1;
        int insideEnd = 0;
        if (farthest < radius && real(row) < last) {
            real inner = sqrt(radius * radius - farthest * farthest);
            insideFirst = int(max(ceil(centre.x - inner), real(0.0)));
            insideEnd = int(clamp(floor(centre.x + inner), real(0.0), shadow.map.x));
        }
        for (; column <= lastColumn && column < insideFirst; column += 2)
            rim += occludedOnRim(map, column, row, centre, radius, plane, shadow);
        for (; column + 2 <= insideEnd; column += 2) {
            real4 stored = real4(textureGather(map, gatherCoordinate(column, row, shadow)));
            inside += real4(lessThan(stored, planeDepth4(plane, column, row)));
        }
        for (; column <= lastColumn; column += 2)
            rim += occludedOnRim(map, column, row, centre, radius, plane, shadow);
    }
    real occluded = rim + inside.x + inside.y + inside.z + inside.w;
    return clamp(real(1.0) - occluded / (real(3.14159265358979) * radius * radius), real(0.0), real(1.0));
}
