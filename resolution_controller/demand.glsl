// SPDX-License-Identifier: MIT
// What a visible point asks of the shadow map, and the counter of the histogram that takes it:
// demand.h in GLSL, for the pass of an engine that fills the histogram on the GPU. Depends on
// nothing; GLSL 3.30 or ES 3.00.
//
//     shared uint counts[STAIRWELL_DEMAND_COUNTERS];  // zeroed; not 64: the last counts rejects
//     ... for one pixel in 16, another one each frame, where 0 < share of blockers < 1:
//     float sigma = stairwellPixelFootprint(dFdx(uv), dFdy(uv));
//     float texels = stairwellDemand(rule, radiusUv, sigma, contrast, casterWidthUv);
//     uint weight = stairwellDemandWeight(shownRadiusUv, sigma);  // enlarged to minRadiusUv
//     atomicAdd(counts[stairwellDemandCounter(texels)], weight);
//
// The counters, as 65 uints, are a DemandHistogram. Without the contrast term they equal those of
// demand.h wherever the GPU divides and takes roots as IEEE 754 says; elsewhere a demand within a
// rounding step of a bin's edge may fall to the neighbour.

#define STAIRWELL_DEMAND_COUNTERS 65

struct StairwellDemandRule {
    float c;                 // slope of r = c a
    float pixelBound;        // k: texels per pixel that can still be seen
    float contrastExponent;  // e of c(C) = c max(C, .02)^e; 0: off
    float texelsPerCaster;   // texels across the thinnest caster; 0: off
};

const float kStairwellLargest = 3.402823466e38f;  // of the finite floats

bool stairwellPositiveAndFinite(float value) { return value > 0.0f && value <= kStairwellLargest; }

// The smaller singular value of d(uv)/d(pixel), but at least a quarter of the larger one; 0, which
// stands for "no bound", where the derivatives are all zero or not finite.
float stairwellPixelFootprint(vec2 alongX, vec2 alongY) {
    vec2 sum = vec2(alongX.x + alongY.y, alongX.y - alongY.x);
    vec2 difference = vec2(alongX.x - alongY.y, alongX.y + alongY.x);
    float larger = sqrt(sum.x * sum.x + sum.y * sum.y) / 2.0f;
    float other = sqrt(difference.x * difference.x + difference.y * difference.y) / 2.0f;
    float largest = larger + other;
    if (!stairwellPositiveAndFinite(largest)) return 0.0f;
    return max(abs(larger - other), largest / 4.0f);
}

// N(p) = min(max(c C^e / r, texels per caster / its width), k / sigma), in texels. 0, which is
// counted as rejected, where the radius is NaN, negative or infinite. A contrast outside [0, 1]
// counts as 1; a footprint or a caster's width that is not positive and finite as not known.
// Radius, footprint and width are fractions of the map's extent.
float stairwellDemand(StairwellDemandRule rule, float radiusUv, float footprintUv, float contrast,
                      float casterWidthUv) {
    float c = rule.c;
    if (rule.contrastExponent != 0.0f && contrast >= 0.0f && contrast <= 1.0f) {
        c *= pow(max(contrast, 0.02f), rule.contrastExponent);
    }
    if (!stairwellPositiveAndFinite(c)) return 0.0f;
    if (!(radiusUv >= 0.0f && radiusUv <= kStairwellLargest)) return 0.0f;
    bool contact = !(radiusUv > 0.0f);
    float texels = contact ? kStairwellLargest : c / radiusUv;
    if (!(texels > 0.0f)) return 0.0f;  // underflow
    if (stairwellPositiveAndFinite(casterWidthUv) &&
        stairwellPositiveAndFinite(rule.texelsPerCaster)) {
        texels = max(texels, rule.texelsPerCaster / casterWidthUv);
    }
    if (stairwellPositiveAndFinite(footprintUv) && stairwellPositiveAndFinite(rule.pixelBound)) {
        texels = min(texels, rule.pixelBound / footprintUv);
    }
    return texels;
}

// How much of a shadow's edge the point stands for, in 64ths of a pixel: what its demand counts. A
// point in a penumbra forty pixels across, as it is shown, stands for a fortieth of a pixel of
// edge. 1 where radius or footprint cannot be used.
uint stairwellDemandWeight(float shownRadiusUv, float footprintUv) {
    if (!stairwellPositiveAndFinite(footprintUv)) return 1u;
    if (!(shownRadiusUv >= 0.0f && shownRadiusUv <= kStairwellLargest)) return 1u;
    if (footprintUv / 2.0f >= shownRadiusUv) return 64u;
    return uint(max(footprintUv / 2.0f / shownRadiusUv * 64.0f + 0.5f, 1.0f));
}

// Which counter takes a demand: bin b holds N in (2^(b/4), 2^((b+1)/4)], the first also what is
// smaller and the last also what is larger; 64 counts NaN, zero and negative numbers. From the
// bits, without a logarithm.
int stairwellDemandCounter(float texels) {
    uint bits = floatBitsToUint(texels);
    if (bits == 0u || bits > 0x7f800000u) return 64;
    // The mantissas of the largest floats up to 2^(1/4), 2^(1/2) and 2^(3/4).
    uint mantissa = bits & 0x7fffffu;
    int quarter = (mantissa > 0u ? 1 : 0) + (mantissa > 1587184u ? 1 : 0) +
                  (mantissa > 3474675u ? 1 : 0) + (mantissa > 5719292u ? 1 : 0);
    int bin = 4 * (int(bits >> 23) - 127) + quarter - 1;
    return clamp(bin, 0, 63);
}
