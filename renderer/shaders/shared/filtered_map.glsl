// SPDX-License-Identifier: MIT
// Maps that are filtered before the lookup: from depths to the values that a technique stores, the separable prefilter,
// and the lookup. Needs receiver.glsl and depth_compare.glsl. ShadowConstants::prefilter says how (prefilter.h).
//
// The map lies in the middle of a texture that is larger by a guard band on every side, as wide as the kernel reaches,
// so that shadows fade out over the map's edge as they do with the full disc. Outside the map nothing is in the way:
// depth 1 there, as in cleared texels.

SHARED_FUNCTION int filteredEdge(ShadowConstants shadow) {
    return int(shadow.map.x) + 2 * int(shadow.prefilter.z);
}

// --- From depth to what is stored ---

// A pass of the GPU that reads a map with several samples of a texel defines its type, sampler2DMS.
#ifndef DEPTH_SAMPLER
#define DEPTH_SAMPLER sampler2D
#endif

// Depth of the caster in a texel of the filtered map. `index` says which sample of the texel; 0 where it has one.
SHARED_FUNCTION real casterDepth(DEPTH_SAMPLER depthMap, int2 texel, int index, ShadowConstants shadow) {
    int guard = int(shadow.prefilter.z);
    int2 inside = texel - int2(guard, guard);
    int last = int(shadow.map.x) - 1;
    int2 at = clamp(inside, int2(0, 0), int2(last, last));
    // Read before it is known to be inside: without a branch a driver sees that neighbours read the same texels.
    real depth = casterOf(real(texelFetch(depthMap, at, index).x));
    return at == inside ? depth : real(1.0);
}

SHARED_FUNCTION real smallerOf(real a, real b) { return abs(a) < abs(b) ? a : b; }

// Change of the caster's depth over one texel: a sample's to the neighbours' in the same place. The smaller of the
// differences to either side: a silhouette is not a slope.
SHARED_FUNCTION real2 casterSlope(DEPTH_SAMPLER depthMap, int2 texel, int index, ShadowConstants shadow) {
    real here = casterDepth(depthMap, texel, index, shadow);
    return real2(smallerOf(casterDepth(depthMap, texel + int2(1, 0), index, shadow) - here,
                           here - casterDepth(depthMap, texel - int2(1, 0), index, shadow)),
                 smallerOf(casterDepth(depthMap, texel + int2(0, 1), index, shadow) - here,
                           here - casterDepth(depthMap, texel - int2(0, 1), index, shadow)));
}

// The hi/lo split of a format with 11 significant bits (Donnelly and Lauritzen 2006, section 5.3): two values in four
// channels, high part in steps of 1/256, which the format holds exactly, rest times 256. What is read is joined again
// before it is filtered, since the parts of a mean are not the means of the parts in 11 bits.
const real kSplitFactor = real(256.0);

// A pass of the GPU is compiled for one way of storing and defines this.
#ifndef MAP_IS_SPLIT
#define MAP_IS_SPLIT (shadow.prefilter.w > real(0.0))
#endif

SHARED_FUNCTION real4 packedTexel(real4 value, ShadowConstants shadow) {
    if (!MAP_IS_SPLIT) return value;
    real2 scaled = real2(value.x, value.y) * kSplitFactor;
    real2 whole = floor(scaled);
    real2 rest = scaled - whole;
    return real4(whole.x / kSplitFactor, whole.y / kSplitFactor, rest.x, rest.y);
}

// A pass of the GPU also says how many channels its map has: what a texture unit gives for the others is nothing, and no
// arithmetic is spent on it.
#ifndef MAP_CHANNELS
#define MAP_CHANNELS 4
#endif

SHARED_FUNCTION real4 unpackedTexel(real4 stored, ShadowConstants shadow) {
    if (MAP_IS_SPLIT)
        return real4(stored.x + stored.z / kSplitFactor, stored.y + stored.w / kSplitFactor, 0.0, 0.0);
    return real4(stored.x, MAP_CHANNELS > 1 ? stored.y : real(0.0), MAP_CHANNELS > 2 ? stored.z : real(0.0),
                 MAP_CHANNELS > 2 ? stored.w : real(0.0));
}

// --- The separable prefilter ---

// How far the kernel reaches from its centre, in texels. x of the constants is the standard deviation of the kernel.
SHARED_FUNCTION real kernelReach(ShadowConstants shadow) {
    bool gaussian = shadow.prefilter.y != real(0.0);
    return shadow.prefilter.x * (gaussian ? real(3.0) : real(1.7320508075688772));
}

// How far a surface may bend away from its tangent within the kernel's reach, in widths of a texel; and what rounding
// adds, in units of depth.
const real kMostBend = real(0.25);
const real kBendOfRounding = real(1e-6);

// In which planes are linear on the map: depth itself, and under a lamp minus the inverse of the distance.
SHARED_FUNCTION real planarDepth(real depth, ShadowConstants shadow) {
    return shadow.map.w > real(0.0) ? real(-1.0) / (real(1.0) + shadow.map.w * depth) : depth;
}

// Whether at this texel one surface ends before another, seen from the light, or bends by as much along rows or
// columns: only there a kernel holds depths in front of a receiver and behind it that are not of the receiver's own
// plane. A slope is no gap, however steep.
SHARED_FUNCTION bool hasGap(DEPTH_SAMPLER depthMap, int2 texel, ShadowConstants shadow) {
    real here = casterDepth(depthMap, texel, 0, shadow);
    real planar = planarDepth(here, shadow);
    real across = planarDepth(casterDepth(depthMap, texel + int2(1, 0), 0, shadow), shadow) +
                  planarDepth(casterDepth(depthMap, texel - int2(1, 0), 0, shadow), shadow) - real(2.0) * planar;
    real along = planarDepth(casterDepth(depthMap, texel + int2(0, 1), 0, shadow), shadow) +
                 planarDepth(casterDepth(depthMap, texel - int2(0, 1), 0, shadow), shadow) - real(2.0) * planar;
    // A lamp's texels are wider the farther away.
    bool lamp = shadow.map.w > real(0.0);
    real distance = lamp ? shadow.scale.x + here * shadow.scale.y : real(1.0);
    real texelWidth = shadow.scale.z * shadow.map.y * distance / shadow.scale.y;
    real reach = max(kernelReach(shadow), real(1.0));
    real most = real(2.0) * kMostBend * texelWidth / (reach * reach) + kBendOfRounding;
    real perDepth = lamp ? shadow.map.w * planar * planar : real(1.0);
    return max(abs(across), abs(along)) > most * perDepth;
}

// Texels to either side of the middle one that the kernel touches.
SHARED_FUNCTION int kernelTaps(ShadowConstants shadow) { return int(ceil(max(kernelReach(shadow) - real(0.5), real(0.0)))); }

// The kernel's shares of the texels from its middle outwards, up to a factor: 1, and from each to the next times
// `ratio`, which itself changes by `change`; the outermost also times `rim`. The box is even up to the part of the
// outermost texel that it covers; a Gaussian averaged over a texel is nearly one with the texel's variance added.
struct TapWeights {
    real ratio;
    real change;
    real rim;
};

SHARED_FUNCTION TapWeights tapWeights(ShadowConstants shadow) {
    TapWeights weights;
    real variance = shadow.prefilter.x * shadow.prefilter.x + real(1.0 / 12.0);
    bool gaussian = shadow.prefilter.y != real(0.0);
    weights.ratio = gaussian ? exp(real(-0.5) / variance) : real(1.0);
    weights.change = gaussian ? exp(real(-1.0) / variance) : real(1.0);
    weights.rim = gaussian ? real(1.0) : kernelReach(shadow) + real(0.5) - real(kernelTaps(shadow));
    return weights;
}

// How taps join: the numbers are Prefilter in technique.h. Some taps joined are
// mean: all four channels times their weights. logMean: x the largest of the logarithms, y the sum of weighted
// exponentials in units of the largest one, since the exponentials themselves overflow. minMaxMean: x mean times
// weights, y least, z greatest.
const int kPrefilterMean = 1;
const int kPrefilterLogMean = 2;
const int kPrefilterMinMaxMean = 3;

SHARED_FUNCTION real4 emptyTaps(int prefilter) {
    if (prefilter == kPrefilterMean) return real4(0.0);
    if (prefilter == kPrefilterLogMean) return real4(-1e30, 0.0, 0.0, 0.0);
    return real4(0.0, 2.0, -1.0, 0.0);
}

SHARED_FUNCTION real4 weightedTaps(int prefilter, real4 taps, real weight) {
    if (prefilter == kPrefilterMean) return taps * weight;
    if (prefilter == kPrefilterLogMean) return real4(taps.x, taps.y * weight, 0.0, 0.0);
    return real4(taps.x * weight, taps.y, taps.z, 0.0);
}

// One tap.
SHARED_FUNCTION real4 tapOf(int prefilter, real4 value, real weight) {
    return weightedTaps(prefilter, prefilter == kPrefilterLogMean ? real4(value.x, 1.0, 0.0, 0.0) : value, weight);
}

SHARED_FUNCTION real4 joinedTaps(int prefilter, real4 a, real4 b) {
    if (prefilter == kPrefilterMean) return a + b;
    if (prefilter == kPrefilterLogMean) {
        real most = max(a.x, b.x);
        return real4(most, a.y * exp(a.x - most) + b.y * exp(b.x - most), 0.0, 0.0);
    }
    return real4(a.x + b.x, min(a.y, b.y), max(a.z, b.z), 0.0);
}

// What the joined taps come to; total is the sum of their weights.
SHARED_FUNCTION real4 valueOfTaps(int prefilter, real4 taps, real total) {
    if (prefilter == kPrefilterMean) return taps / total;
    if (prefilter == kPrefilterLogMean) return real4(taps.x + log(taps.y / total), 0.0, 0.0, 0.0);
    return real4(taps.x / total, taps.y, taps.z, 0.0);
}

// Beyond the guard band everything is as on its rim.
SHARED_FUNCTION real4 lineTexel(sampler2DArray map, int2 texel, int layer, int last, ShadowConstants shadow) {
    int2 at = clamp(texel, int2(0, 0), int2(last, last));
    return unpackedTexel(texelFetch(map, int3(at.x, at.y, layer), 0), shadow);
}

// One line of the prefilter through a texel, axis (1,0) or (0,1).
SHARED_FUNCTION real4 filteredLine(sampler2DArray map, int2 texel, int2 axis, int layer, int prefilter,
                                   ShadowConstants shadow) {
    int last = filteredEdge(shadow) - 1;
    int taps = kernelTaps(shadow);
    real4 sum = tapOf(prefilter, lineTexel(map, texel, layer, last, shadow), real(1.0));
    TapWeights weights = tapWeights(shadow);
    real weight = real(1.0);
    real total = real(1.0);
    for (int i = 1; i <= taps; ++i) {
        weight *= i == taps ? weights.ratio * weights.rim : weights.ratio;
        weights.ratio *= weights.change;
        real4 before = tapOf(prefilter, lineTexel(map, texel - axis * i, layer, last, shadow), weight);
        real4 after = tapOf(prefilter, lineTexel(map, texel + axis * i, layer, last, shadow), weight);
        sum = joinedTaps(prefilter, sum, joinedTaps(prefilter, before, after));
        total += real(2.0) * weight;
    }
    return valueOfTaps(prefilter, sum, total);
}

// --- The lookup ---

// The four texels around a place: columns and rows from low to high, and how far the place lies from the low ones. In
// the arithmetic of the shader: the weights of texture units have 8 bits, and split texels must be joined first.
struct FourTexels {
    int2 low;
    int2 high;
    real2 part;
};

SHARED_FUNCTION FourTexels fourTexels(real2 uv, ShadowConstants shadow) {
    real last = real(filteredEdge(shadow) - 1);
    real2 place = uv * shadow.map.x + real2(shadow.prefilter.z - real(0.5));
    place = clamp(place, real2(0.0), real2(last));
    FourTexels four;
    four.low = int2(int(place.x), int(place.y));
    four.high = int2(min(four.low.x + 1, int(last)), min(four.low.y + 1, int(last)));
    four.part = place - real2(real(four.low.x), real(four.low.y));
    return four;
}

// Bilinear.
SHARED_FUNCTION real4 filteredTexel(sampler2DArray map, real2 uv, int layer, ShadowConstants shadow) {
    FourTexels at = fourTexels(uv, shadow);
    real4 lower = mix(unpackedTexel(texelFetch(map, int3(at.low.x, at.low.y, layer), 0), shadow),
                      unpackedTexel(texelFetch(map, int3(at.high.x, at.low.y, layer), 0), shadow), at.part.x);
    real4 upper = mix(unpackedTexel(texelFetch(map, int3(at.low.x, at.high.y, layer), 0), shadow),
                      unpackedTexel(texelFetch(map, int3(at.high.x, at.high.y, layer), 0), shadow), at.part.x);
    return mix(lower, upper, at.part.y);
}

// Of a map of logarithms: exp(stored - depth), bilinear between the exponentials, at most 1. Means of the logarithms
// would be geometric ones, which are less. Each is cut where four of them are still finite, far above 1, and not at a
// share of the largest: the share of a texel with nearly no weight would leave nothing of the others.
SHARED_FUNCTION real filteredExponential(sampler2DArray map, real2 uv, real depth, ShadowConstants shadow) {
    FourTexels at = fourTexels(uv, shadow);
    real4 stored = real4(
        texelFetch(map, int3(at.low.x, at.low.y, 0), 0).x, texelFetch(map, int3(at.high.x, at.low.y, 0), 0).x,
        texelFetch(map, int3(at.low.x, at.high.y, 0), 0).x, texelFetch(map, int3(at.high.x, at.high.y, 0), 0).x);
    real4 ratios = exp(min(stored - real4(depth), real4(80.0)));
    return unitRange(mix(mix(ratios.x, ratios.y, at.part.x), mix(ratios.z, ratios.w, at.part.x), at.part.y));
}

SHARED_FUNCTION bool reachesFilteredMap(real2 uv, ShadowConstants shadow) {
    return reachesMap(uv, (kernelReach(shadow) + real(1.0)) * shadow.map.y);
}

// The depth that a receiver is compared at: its own, less what float32, the map's rounding (depthBias) and the kernel
// may have moved it by. texels and reaches count along the receiver's plane, reaches in distances to the farthest texel
// centre that the kernel counts, with the texel that the bilinear lookup adds: a plane that rises towards the light lies
// before its own point by up to one reach. Never beyond 1, so that a cleared map is lit.
SHARED_FUNCTION real biasedDepth(ShadowReceiver receiver, ShadowConstants shadow, real texels, real reaches,
                                 real depthBias) {
    real span = (texels + reaches * real(kernelTaps(shadow) + 1)) * shadow.map.y;
    real steepness = abs(receiver.depthGradient.x) + abs(receiver.depthGradient.y);
    return min(receiver.depth, real(1.0)) - receiver.depthError - depthBias - span * steepness;
}
