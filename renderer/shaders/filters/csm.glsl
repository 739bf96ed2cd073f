// SPDX-License-Identifier: MIT
// Convolution shadow maps: the step of the depth test is expanded in a Fourier series, whose terms can be filtered
// before the receiver's depth is known. Few terms leak light close behind occluders and ring farther behind them.
//
// Source: T. Annen, T. Mertens, P. Bekaert, H.-P. Seidel, J. Kautz, "Convolution shadow maps", EGSR 2007.
// Map: for each term k = 1..M the means of sin(c_k z) and cos(c_k z) under the kernel, c_k = pi (2 k - 1), two terms to
// a layer; z is linear light depth moved to [.05, .95], since the series has period 2 and is 1/2 again at a distance
// of 1.
// Parameters: bias_texels, bias_depth (shared/filtered_map.glsl); gaussian (prefilter.h); terms M; damping a of the
// terms by exp(-a (k/M)^2), against ringing; scale: the series is 1/2 where a receiver is its own occluder, so it is
// scaled by 2 and cut at 1.

SHARED_FUNCTION real seriesDepth(real depth) { return real(0.05) + real(0.9) * depth; }

SHARED_FUNCTION real termFrequency(int k) { return real(3.14159265358979) * real(2 * k - 1); }

SHARED_FUNCTION real4 mapTexel(real depth, real2 slope, int layer, ShadowConstants shadow) {
    real first = termFrequency(2 * layer + 1) * seriesDepth(depth);
    real second = termFrequency(2 * layer + 2) * seriesDepth(depth);
    return real4(sin(first), cos(first), sin(second), cos(second));
}

// 2 sin(c_k (z - d)) / c_k, damped, from the means of sine and cosine.
SHARED_FUNCTION real seriesTerm(int k, int terms, real meanSine, real meanCosine, real depth, real damping) {
    if (k > terms) return real(0.0);
    real c = termFrequency(k);
    real share = real(k) / real(terms);
    return real(2.0) * exp(-damping * share * share) * (meanSine * cos(c * depth) - meanCosine * sin(c * depth)) / c;
}

SHARED_FUNCTION real filterVisibility(sampler2DArray map, ShadowReceiver receiver, ShadowConstants shadow) {
    if (!reachesFilteredMap(receiver.uv, shadow)) return real(1.0);
    real biased = biasedDepth(receiver, shadow, PARAMETER_bias_texels, real(0.0), PARAMETER_bias_depth);
    real depth = seriesDepth(max(biased, real(0.0)));
    int terms = int(PARAMETER_terms);
    real sum = real(0.5);
    for (int k = 1; k <= terms; k += 2) {
        real4 means = filteredTexel(map, receiver.uv, k / 2, shadow);
        sum += seriesTerm(k, terms, means.x, means.y, depth, PARAMETER_damping) +
               seriesTerm(k + 1, terms, means.z, means.w, depth, PARAMETER_damping);
    }
    return unitRange(sum * PARAMETER_scale);
}
