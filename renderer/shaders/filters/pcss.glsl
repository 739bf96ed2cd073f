// SPDX-License-Identifier: MIT
// Percentage-closer soft shadows: the kernel is as wide as the penumbra of an area light, from how far before the
// receiver the blockers lie. Hard at contacts.
//
// Source: R. Fernando, "Percentage-closer soft shadows", SIGGRAPH 2005 sketches. The light is the sun, a disc at
// infinity: a blocker at distance h before the receiver throws a penumbra of radius tan(angular radius) h, wherever it
// is.
// Map: linear light depth, 0 near. Reads search_taps texels and those of the full disc of the radius found.
// Parameters: bias_texels (shared/depth_compare.glsl); distance: how far before the receiver, as a share of the map's
// depth range, a blocker throws a penumbra of the kernel's radius; search_taps.

SHARED_FUNCTION real filterVisibility(sampler2D map, ShadowReceiver receiver, ShadowConstants shadow) {
    PlaneCompare plane = planeCompare(receiver, shadow, PARAMETER_bias_texels);
    real perDepth = shadow.kernel.x / PARAMETER_distance;
    // As far as the nearest possible blocker's penumbra reaches, and never less than the texel itself.
    real search = clamp(perDepth * receiver.depth, real(0.5) * shadow.map.y, real(1.0));
    if (!reachesMap(receiver.uv, search)) return real(1.0);
    int n = int(PARAMETER_search_taps);
    real before = real(0.0);
    real blockers = real(0.0);
    for (int i = 0; i < n; ++i) {
        real2 texel = floor((receiver.uv + vogelTap(i, n) * search) * shadow.map.x);
        if (!(texel.x >= real(0.0) && texel.y >= real(0.0) && texel.x < shadow.map.x && texel.y < shadow.map.x))
            continue;
        int2 index = int2(int(texel.x), int(texel.y));
        // Measured from the receiver's plane, so that a slope is not its own blocker.
        real gap = planeDepth(plane, index.x, index.y) -
                   max(real(texelFetch(map, index, 0).x), real(0.0));
        if (gap > real(0.0)) {
            before += gap;
            blockers += real(1.0);
        }
    }
    if (blockers == real(0.0)) return real(1.0);
    real radius = shownRadiusUv(perDepth * (before / blockers), receiver, shadow);
    return discVisibility(map, receiver.uv, radius, shadow, plane);
}
