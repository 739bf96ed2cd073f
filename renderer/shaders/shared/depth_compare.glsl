// SPDX-License-Identifier: MIT
// The compare that every technique on a depth map shares: a texel against the receiver's plane at that texel's own
// centre. The bias follows N in the same frame, since everything in it is counted in texels of this frame's map.

// What every reconstruction ends with. A number that is none says nothing against light.
SHARED_FUNCTION real unitRange(real visibility) {
    return visibility >= real(0.0) ? min(visibility, real(1.0)) : (visibility < real(0.0) ? real(0.0) : real(1.0));
}

// A texel's depth as a caster's: depth that is no number casts nothing.
SHARED_FUNCTION real casterOf(real depth) {
    return depth >= real(0.0) ? min(depth, real(1.0)) : (depth < real(0.0) ? real(0.0) : real(1.0));
}

struct PlaneCompare {
    real atOrigin;  // depth of the receiver's plane at texel coordinates (0,0), bias taken off
    real2 perTexel; // its change from texel to texel
};

// biasTexels: how far along the steepest descent, in texels, a stored depth may be off: rasterisers snap vertices to
// 1/256 texel, and within a wide kernel hollow ground rises over the receiver's plane (kernelBiasTexels()).
SHARED_FUNCTION PlaneCompare planeCompare(ShadowReceiver receiver, ShadowConstants shadow, real biasTexels) {
    PlaneCompare plane;
    plane.perTexel = receiver.depthGradient * shadow.map.y;
    real bias = receiver.depthError + biasTexels * (abs(plane.perTexel.x) + abs(plane.perTexel.y));
    plane.atOrigin = receiver.depth - bias - dot(receiver.depthGradient, receiver.uv);
    return plane;
}

// Counted in texels: a part of the map's own, and one of the kernel's radius that is the same whatever N.
SHARED_FUNCTION real kernelBiasTexels(real texels, real reaches, real radiusUv, ShadowConstants shadow) {
    return texels + reaches * radiusUv * shadow.map.x;
}

// The receiver's depth at a texel's centre. Never beyond 1, so that a cleared texel is always lit; ties are lit.
SHARED_FUNCTION real planeDepth(PlaneCompare plane, int column, int row) {
    real depth = plane.atOrigin + plane.perTexel.x * (real(column) + real(0.5)) +
                 plane.perTexel.y * (real(row) + real(0.5));
    return min(depth, real(1.0));
}

// The same for the four texels of one textureGather whose lower left texel is (column, row): order
// (0,1) (1,1) (1,0) (0,0).
SHARED_FUNCTION real4 planeDepth4(PlaneCompare plane, int column, int row) {
    real base = plane.atOrigin + plane.perTexel.x * (real(column) + real(0.5)) +
                plane.perTexel.y * (real(row) + real(0.5));
    real4 depth = real4(base) + real4(0.0, plane.perTexel.x, plane.perTexel.x, 0.0) +
                  real4(plane.perTexel.y, plane.perTexel.y, 0.0, 0.0);
    return min(depth, real4(1.0));
}

// The texture coordinate whose gather reads that block: its middle.
SHARED_FUNCTION real2 gatherCoordinate(int column, int row, ShadowConstants shadow) {
    return real2(real(column + 1), real(row + 1)) * shadow.map.z;
}

// Whether a point can be anything but lit by its place alone: false off the map, and for uv that is no number.
SHARED_FUNCTION bool reachesMap(real2 uv, real radiusUv) {
    return uv.x > -radiusUv && uv.x < real(1.0) + radiusUv && uv.y > -radiusUv && uv.y < real(1.0) + radiusUv;
}

// Whether everything within a radius of a point is on the map; false for uv that is no number.
SHARED_FUNCTION bool liesInMap(real2 uv, real radiusUv) { return reachesMap(uv, -radiusUv); }

// Lit or not in the one texel that holds a place. Outside the map is lit.
SHARED_FUNCTION real texelVisibility(sampler2D map, real2 uv, ShadowConstants shadow, PlaneCompare plane) {
    real2 texel = floor(uv * shadow.map.x);
    if (!(texel.x >= real(0.0) && texel.y >= real(0.0) && texel.x < shadow.map.x && texel.y < shadow.map.x))
        return real(1.0);
    int2 index = int2(int(texel.x), int(texel.y));
    return real(texelFetch(map, index, 0).x) < planeDepth(plane, index.x, index.y) ? real(0.0) : real(1.0);
}
