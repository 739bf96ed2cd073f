// SPDX-License-Identifier: MIT
// Sampled kernels: where to take a fixed number of taps, and what one tap says. Needs depth_compare.glsl.

// Progressive best-candidate points in the unit disc: the first n are spread well for every n from 8. Scaled so that
// from 16 on their deviation is that of an even disc.
const int kPoissonTaps = 64;
const real kPoissonScale = real(0.93);
const real2 kPoisson[kPoissonTaps] = {
    real2(-0.3523, -0.6983), real2(0.6386, 0.7280), real2(-0.7077, 0.6530), real2(0.8031, -0.4203),
    real2(-0.0853, 0.1030), real2(-0.9734, -0.1628), real2(-0.0042, 0.9255), real2(0.8424, 0.1667),
    real2(0.3131, -0.8999), real2(0.2589, -0.3198), real2(-0.5960, 0.1710), real2(0.2989, 0.3747),
    real2(-0.7722, -0.5548), real2(-0.4219, -0.2539), real2(-0.1899, 0.5325), real2(0.5117, -0.0263),
    real2(-0.4022, 0.9088), real2(-0.0836, -0.9765), real2(0.6483, -0.7572), real2(-0.9455, 0.2739),
    real2(-0.0404, -0.5061), real2(0.3110, 0.7993), real2(0.6262, 0.4113), real2(0.9691, -0.1113),
    real2(0.3728, -0.6066), real2(0.2247, 0.0751), real2(-0.0566, -0.2163), real2(-0.3384, 0.2842),
    real2(0.0992, 0.5989), real2(-0.6906, -0.1712), real2(0.0989, -0.7374), real2(0.5584, -0.2900),
    real2(-0.4630, 0.5274), real2(-0.6143, -0.7864), real2(0.8995, 0.4351), real2(-0.3513, 0.0176),
    real2(-0.8308, 0.0428), real2(-0.0002, 0.3506), real2(-0.5144, -0.4966), real2(-0.7134, 0.3862),
    real2(0.4327, 0.5879), real2(-0.2754, -0.4669), real2(-0.2018, 0.7919), real2(-0.3412, -0.9399),
    real2(0.7242, -0.1200), real2(0.5256, 0.2064), real2(0.5998, -0.5339), real2(-0.8512, -0.3484),
    real2(-0.1275, -0.7300), real2(0.2002, 0.9759), real2(0.1613, -0.1255), real2(0.1792, -0.5264),
    real2(0.1230, -0.9880), real2(-0.3829, 0.7088), real2(-0.5332, -0.0501), real2(-0.5689, 0.7966),
    real2(0.7887, -0.6143), real2(0.7669, 0.5789), real2(-0.2465, -0.1578), real2(0.3946, -0.1856),
    real2(-0.8452, 0.5202), real2(-0.6491, -0.3612), real2(0.4255, -0.4255), real2(0.6804, 0.0701)};

SHARED_FUNCTION real2 poissonTap(int i) { return kPoisson[min(i, kPoissonTaps - 1)] * kPoissonScale; }

// H. Vogel, "A better way to construct the sunflower head", 1979: n points of equal area in the unit disc.
SHARED_FUNCTION real2 vogelTap(int i, int n) {
    real radius = sqrt((real(i) + real(0.5)) / real(n));
    real angle = real(i) * real(2.3999632297286533);
    return real2(cos(angle), sin(angle)) * radius;
}

// Of n taps in the unit disc, the i-th of one of the two patterns: 0 Poisson's, 1 Vogel's.
SHARED_FUNCTION real2 patternTap(real pattern, int i, int n) {
    return pattern == real(0.0) ? poissonTap(i) : vogelTap(i, n);
}

SHARED_FUNCTION real2 turned(real2 v, real2 turn) {
    return real2(v.x * turn.x - v.y * turn.y, v.x * turn.y + v.y * turn.x);
}

SHARED_FUNCTION real fractionOf(real x) { return x - floor(x); }

// Cosine and sine of a turn that changes from pixel to pixel. It is fixed to places on the map, in cells of about a
// pixel, so that the noise sticks to the surface instead of crawling over it. The hash is the gradient noise of J.
// Jimenez, "Next generation post processing in Call of Duty: Advanced Warfare", SIGGRAPH 2014.
SHARED_FUNCTION real2 turnAt(ShadowReceiver receiver) {
    real pixel = receiver.footprintUv;
    if (!(pixel > real(1e-5))) pixel = real(1e-5);
    real cell = exp2(floor(log2(min(pixel, real(1.0)))));
    real2 place = receiver.uv / cell;
    // Within 64 cells: larger numbers would lose the bits that the hash needs.
    real2 index = floor(real2(fractionOf(place.x / real(64.0)), fractionOf(place.y / real(64.0))) * real(64.0));
    real angle = real(6.283185307179586) *
                 fractionOf(real(52.9829189) * fractionOf(real(0.06711056) * index.x + real(0.00583715) * index.y));
    return real2(cos(angle), sin(angle));
}

// Tent-weighted compares of the four texels around a place. Outside the map is lit.
SHARED_FUNCTION real bilinearVisibility(sampler2D map, real2 uv, ShadowConstants shadow, PlaneCompare plane) {
    real2 place = uv * shadow.map.x - real2(0.5);
    real2 low = floor(place);
    if (!(low.x >= real(-1.0) && low.y >= real(-1.0) && low.x < shadow.map.x && low.y < shadow.map.x))
        return real(1.0);
    real2 part = place - low;
    int column = int(low.x);
    int row = int(low.y);
    real4 weight = real4((real(1.0) - part.x) * part.y, part.x * part.y, part.x * (real(1.0) - part.y),
                         (real(1.0) - part.x) * (real(1.0) - part.y));
    if (column < 0) weight *= real4(0.0, 1.0, 1.0, 0.0);
    if (real(column + 1) >= shadow.map.x) weight *= real4(1.0, 0.0, 0.0, 1.0);
    if (row < 0) weight *= real4(1.0, 1.0, 0.0, 0.0);
    if (real(row + 1) >= shadow.map.x) weight *= real4(0.0, 0.0, 1.0, 1.0);
    real4 stored = real4(textureGather(map, gatherCoordinate(column, row, shadow)));
    return real(1.0) - dot(weight, real4(lessThan(stored, planeDepth4(plane, column, row))));
}

SHARED_FUNCTION real tapVisibility(sampler2D map, real2 uv, ShadowConstants shadow, PlaneCompare plane,
                                   real bilinear) {
    return bilinear != real(0.0) ? bilinearVisibility(map, uv, shadow, plane)
                                 : texelVisibility(map, uv, shadow, plane);
}
