// SPDX-License-Identifier: MIT
// The radius of a penumbra from the gap between blockers and receiver, and that gap from means over the widest kernel,
// without looking at one blocker. Needs receiver.glsl, depth_compare.glsl and taps.glsl.
//
// From the gap to the radius: R. Fernando, "Percentage-closer soft shadows", SIGGRAPH 2005 sketches. In distances from
// a light of radius l m, b of the blocker and d of the receiver, the penumbra's radius is l (d - b) / (b d) on a map
// that is 1 m wide at 1 m. With depths z = (distance - n) / range, s = range / n, and l such that in the middle of the
// range a gap makes the same radius as under the sun, whose penumbrae grow with the gap alone (s = 0), that is the gap
// times
//   (1 + s/2)^2 / ((1 + s zb) (1 + s z)).
// It comes to no end as the near plane comes to the lamp: l = softness middle^2 / range in metres.
//
// From means to the gap: B. Yang, Z. Dong, J. Feng, H.-P. Seidel, J. Kautz, "Variance soft shadow mapping", 2010,
// equations 3 to 5: what lies before the receiver has the mean z_b, the rest lies at the receiver d, and Chebyshev's
// bound p is the rest's share: mean = p d + (1 - p) z_b, so d - z_b = (d - mean) / (1 - p), which is
// (d - mean) + variance / (d - mean).
// Exact for a planar occluder over a parallel receiver.

// In radii of a penumbra of the whole depth range under the sun. `gap` is to the receiver's depth, which for that
// counts as 1 where it is beyond the map's; for a lamp what lies beyond is added here. No wider than one: that near to
// a lamp a blocker is larger than what the search could find.
SHARED_FUNCTION real penumbraOfGap(real gap, real depth, ShadowConstants shadow) {
    real spread = shadow.map.w;
    if (!(spread > real(0.0))) return gap;
    real blocker = max(min(depth, real(1.0)) - gap, real(0.0));
    real receiver = max(depth, blocker);
    real middle = real(1.0) + real(0.5) * spread;
    return min((receiver - blocker) * (middle / (real(1.0) + spread * blocker)) *
                   (middle / (real(1.0) + spread * receiver)),
               real(1.0));
}

// Distance of the receiver from the mean of what lies before it; 0 where nothing does.
SHARED_FUNCTION real gapToBlockers(real mean, real meanSquare, real depth, real leastVariance) {
    if (!(depth > mean)) return real(0.0);
    real variance = max(meanSquare - mean * mean, leastVariance);
    real beyond = depth - mean;
    return clamp(beyond + variance / beyond, real(0.0), real(1.0));
}

SHARED_FUNCTION real radiusOfGap(real gap, real distance, ShadowReceiver receiver, ShadowConstants shadow) {
    real radius = shadow.kernel.x / distance * penumbraOfGap(gap, receiver.depth, shadow);
    return shownRadiusUv(min(radius, real(1.0)), receiver, shadow);
}

// The widest one: no blocker lies farther before the receiver than the light does. As in prefilterConstants().
SHARED_FUNCTION real widestPenumbraUv(real distance, ShadowConstants shadow) {
    return clamp(max(shadow.kernel.x / distance, shadow.kernel.y), real(0.0), real(1.0));
}

// Vogel's taps stand for the filter where a pass has the depths alone.
const int kEstimateTaps = 32;

// The radius from the depths that the map is made of, before any least radius; negative where nothing is in the way.
// Without what a map may add to the squares for the slope of its texels.
SHARED_FUNCTION real estimatedRadiusUv(sampler2D map, ShadowReceiver receiver, real depth, real leastVariance,
                                       real distance, ShadowConstants shadow) {
    real widest = widestPenumbraUv(distance, shadow);
    if (!reachesMap(receiver.uv, widest)) return real(-1.0);
    real mean = real(0.0);
    real meanSquare = real(0.0);
    for (int i = 0; i < kEstimateTaps; ++i) {
        real2 texel = floor((receiver.uv + vogelTap(i, kEstimateTaps) * widest) * shadow.map.x);
        bool inside = texel.x >= real(0.0) && texel.y >= real(0.0) && texel.x < shadow.map.x && texel.y < shadow.map.x;
        real caster = inside ? casterOf(real(texelFetch(map, int2(int(texel.x), int(texel.y)), 0).x)) : real(1.0);
        mean += caster;
        meanSquare += caster * caster;
    }
    real gap = gapToBlockers(mean / real(kEstimateTaps), meanSquare / real(kEstimateTaps), depth, leastVariance);
    real radius = shadow.kernel.x / distance * penumbraOfGap(gap, receiver.depth, shadow);
    return gap > real(0.0) ? min(radius, real(1.0)) : real(-1.0);
}
