// SPDX-License-Identifier: MIT
// Percentage-closer soft shadows: the kernel is as wide as the penumbra of an area light, from how far before the
// receiver the blockers lie. Hard at contacts.
//
// Source: R. Fernando, "Percentage-closer soft shadows", SIGGRAPH 2005 sketches; shared/penumbra_estimate.glsl. A
// blocker before the near plane lies on it.
// Map: linear light depth, 0 near. Reads search_taps texels and those of the full disc of the radius found.
// Parameters: bias_texels (shared/depth_compare.glsl); distance: a blocker at that share of the depth range before the
// receiver throws a penumbra of the kernel's radius, under a lamp in the middle of its range; search_taps.

SHARED_FUNCTION real penumbraRadiusUv(sampler2D map, ShadowReceiver receiver, ShadowConstants shadow) {
    PlaneCompare plane = planeCompare(receiver, shadow, PARAMETER_bias_texels);
    real softness = shadow.kernel.x / PARAMETER_distance;
    // As far as the nearest possible blocker's penumbra reaches, and never less than the texel itself.
    real search = clamp(softness * penumbraOfGap(receiver.depth, receiver.depth, shadow), real(0.5) * shadow.map.y,
                        real(1.0));
    if (!reachesMap(receiver.uv, search)) return real(-1.0);
    int n = int(PARAMETER_search_taps);
    real gaps = real(0.0);
    real blockers = real(0.0);
    for (int i = 0; i < n; ++i) {
        real2 texel = floor((receiver.uv + vogelTap(i, n) * search) * shadow.map.x);
        if (!(texel.x >= real(0.0) && texel.y >= real(0.0) && texel.x < shadow.map.x && texel.y < shadow.map.x))
            continue;
        int2 index = int2(int(texel.x), int(texel.y));
        real blocker = casterOf(real(texelFetch(map, index, 0).x));
        // Measured from the receiver's plane, so that a slope is not its own blocker.
        real gap = planeDepth(plane, index.x, index.y) - blocker;
        if (gap > real(0.0)) {
            gaps += gap;
            blockers += real(1.0);
        }
    }
    if (blockers == real(0.0)) return real(-1.0);
    return softness * penumbraOfGap(gaps / blockers, receiver.depth, shadow);
}

SHARED_FUNCTION real filterVisibility(sampler2D map, ShadowReceiver receiver, ShadowConstants shadow) {
    real radius = penumbraRadiusUv(map, receiver, shadow);
    if (radius < real(0.0)) return real(1.0);
    return discVisibility(map, receiver.uv, shownRadiusUv(radius, receiver, shadow), shadow,
                          planeCompare(receiver, shadow, PARAMETER_bias_texels));
}
