// SPDX-License-Identifier: MIT
// Random draws that are the same with every standard library. std::mt19937_64 is fixed by the C++
// standard, std::normal_distribution and its relatives are not, so the transforms are written out.
// Each function states how many engine calls it makes, so that a resumed run can skip them with
// discard().
#pragma once

#include <cmath>
#include <cstdint>
#include <random>

namespace quest {

/// Uniform in [0, 1), a multiple of 2^-53. One engine call.
inline double uniform01(std::mt19937_64& rng) {
    return static_cast<double>(rng() >> 11) * 0x1p-53;
}

/// Uniform integer in [0, bound), bound > 0. One engine call; the bias of a multiple of 2^-53 is
/// below 1e-9 for any bound under a million.
inline std::uint64_t uniformBelow(std::mt19937_64& rng, std::uint64_t bound) {
    return static_cast<std::uint64_t>(uniform01(rng) * static_cast<double>(bound));
}

/// Standard normal. G. E. P. Box and M. E. Muller, "A note on the generation of random normal
/// deviates" (1958), the cosine branch. Two engine calls.
inline double standardNormal(std::mt19937_64& rng) {
    constexpr double twoPi = 6.283185307179586477;
    const double radius = std::sqrt(-2 * std::log(1 - uniform01(rng)));
    return radius * std::cos(twoPi * uniform01(rng));
}

}  // namespace quest
