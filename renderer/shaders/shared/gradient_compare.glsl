// SPDX-License-Identifier: MIT
// What gradient shadow maps share: bilinearly filtered depth, the slope of the map, and the compare that lets light fade
// over one texel's worth of slope. Four taps at a time. Needs depth_compare.glsl and taps.glsl.
//
// C. Schueler, "Multisampling extension for gradient shadow maps", ShaderX5, 2006.

// Outside the map nothing is in the way.
SHARED_FUNCTION real filteredDepth(sampler2D map, real2 uv, ShadowConstants shadow) {
    real2 place = clamp(uv * shadow.map.x - real2(0.5), real2(-2.0), real2(shadow.map.x + real(1.0)));
    real2 low = floor(place);
    real2 part = place - low;
    int column = int(low.x);
    int row = int(low.y);
    int last = int(shadow.map.x) - 1;
    bool left = column >= 0 && column <= last;
    bool right = column >= -1 && column < last;
    bool lower = row >= 0 && row <= last;
    bool upper = row >= -1 && row < last;
    real4 stored = real4(textureGather(map, gatherCoordinate(column, row, shadow)));
    real lowerRow = mix(left && lower ? casterOf(stored.w) : real(1.0),
                        right && lower ? casterOf(stored.z) : real(1.0), part.x);
    real upperRow = mix(left && upper ? casterOf(stored.x) : real(1.0),
                        right && upper ? casterOf(stored.y) : real(1.0), part.x);
    return mix(lowerRow, upperRow, part.y);
}

SHARED_FUNCTION real4 filteredDepth4(sampler2D map, real2 uv, real4 x, real4 y, ShadowConstants shadow) {
    return real4(filteredDepth(map, uv + real2(x.x, y.x), shadow), filteredDepth(map, uv + real2(x.y, y.y), shadow),
                 filteredDepth(map, uv + real2(x.z, y.z), shadow), filteredDepth(map, uv + real2(x.w, y.w), shadow));
}

// Beyond this one the arithmetic has no numbers.
const real kSteepestGradient = real(1e15);

// Longer gradients are cut to `most`: a silhouette is not a slope. One whose length is no number is none.
SHARED_FUNCTION real2 limitedGradient(real2 gradient, real most) {
    real size = length(gradient);
    if (!(size > real(0.0) && size < kSteepestGradient)) return real2(0.0);
    return gradient * (min(size, most) / size);
}

// d depth / d uv from central differences around a place.
SHARED_FUNCTION real2 neighbourGradient(sampler2D map, real2 uv, ShadowConstants shadow) {
    real t = shadow.map.y;
    real4 depth = filteredDepth4(map, uv, real4(t, -t, 0.0, 0.0), real4(0.0, 0.0, t, -t), shadow);
    return real2(depth.x - depth.y, depth.z - depth.w) * (real(0.5) * shadow.map.x);
}

// Light where the map lies `beyond` a receiver: all of it there, none from one texel's slope before it on, and without a
// slope a step.
SHARED_FUNCTION real fuzzyVisibility(real beyond, real slope) {
    if (!(slope > real(0.0))) return beyond < real(0.0) ? real(0.0) : real(1.0);
    return unitRange(real(1.0) + beyond / slope);
}

// Patterns of taps in the unit disc, each with the disc's deviation but for the scatter of Poisson's.
const int kVogelPattern = 0;
const int kCirclePattern = 1;   // eight on a circle
const int kPoissonPattern = 2;  // the first sixteen
const real kCircleRadius = real(0.70710678118654752);

SHARED_FUNCTION int gradientTaps(int pattern, int vogelTaps) {
    return pattern == kCirclePattern ? 8 : (pattern == kPoissonPattern ? 16 : vogelTaps);
}

SHARED_FUNCTION real2 gradientTap(int pattern, int i, int n) {
    if (pattern == kVogelPattern) return vogelTap(i, n);
    if (pattern == kPoissonPattern) return poissonTap(i);
    real angle = real(0.78539816339744831) * real(i);
    return real2(cos(angle), sin(angle)) * kCircleRadius;
}

// The inverse of the sum of o o^T over a pattern's taps, as xx, xy, yy. That of Vogel's is found with the taps: 0 here.
// The circle's is the paper's 1 / 8 in units of a diagonal tap's displacement, half of the disc's radius (it prints 1 / 4,
// with which every tilted plane is dark by a fifth).
SHARED_FUNCTION real3 inverseCovariance(int pattern) {
    if (pattern == kCirclePattern) return real3(0.5, 0.0, 0.5);
    if (pattern == kPoissonPattern) return real3(0.23088476378469966, -0.01423755846160821, 0.27099555030256434);
    return real3(0.0);
}

// d depth / d uv of the plane that fits all taps best: the average gradient of the kernel. Under a kernel of about a
// texel, the paper's, concave corners are less dark with it than with the gradient of the receiver; under wider ones
// and between walls that face each other they are darker.
SHARED_FUNCTION real2 regressedGradient(sampler2D map, real2 uv, real radius, int pattern, int n,
                                        ShadowConstants shadow) {
    if (!(radius > real(0.0))) return real2(0.0);
    real centre = filteredDepth(map, uv, shadow);
    real3 squares = real3(0.0);
    real2 product = real2(0.0);
    for (int i = 0; i < n; ++i) {
        real2 offset = gradientTap(pattern, i, n);
        squares += real3(offset.x * offset.x, offset.x * offset.y, offset.y * offset.y);
        product += offset * (filteredDepth(map, uv + offset * radius, shadow) - centre);
    }
    real3 inverse = inverseCovariance(pattern);
    if (pattern == kVogelPattern) {
        real determinant = squares.x * squares.z - squares.y * squares.y;
        if (!(determinant > real(1e-6))) return real2(0.0);
        inverse = real3(squares.z, -squares.y, squares.x) / determinant;
    }
    return real2(inverse.x * product.x + inverse.y * product.y, inverse.y * product.x + inverse.z * product.y) / radius;
}

// Mean of the compares at the pattern's taps. `depth`: the receiver's, its bias taken off; `follow`: how the compared
// depth changes with uv; `slope`: that of the map over one texel.
SHARED_FUNCTION real gradientVisibility(sampler2D map, real2 uv, real radius, real depth, real2 follow, real slope,
                                        int pattern, int n, ShadowConstants shadow) {
    real lit = real(0.0);
    for (int i = 0; i < n; i += 4) {
        real2 first = gradientTap(pattern, i, n) * radius;
        real2 second = gradientTap(pattern, min(i + 1, n - 1), n) * radius;
        real2 third = gradientTap(pattern, min(i + 2, n - 1), n) * radius;
        real2 fourth = gradientTap(pattern, min(i + 3, n - 1), n) * radius;
        real4 x = real4(first.x, second.x, third.x, fourth.x);
        real4 y = real4(first.y, second.y, third.y, fourth.y);
        real4 compared = min(real4(depth) + x * follow.x + y * follow.y, real4(1.0));
        real4 weight = real4(1.0, i + 1 < n ? 1.0 : 0.0, i + 2 < n ? 1.0 : 0.0, i + 3 < n ? 1.0 : 0.0);
        real4 beyond = filteredDepth4(map, uv, x, y, shadow) - compared;
        lit += dot(weight, real4(fuzzyVisibility(beyond.x, slope), fuzzyVisibility(beyond.y, slope),
                                 fuzzyVisibility(beyond.z, slope), fuzzyVisibility(beyond.w, slope)));
    }
    return unitRange(lit / real(n));
}
