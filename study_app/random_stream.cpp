// SPDX-License-Identifier: MIT
#include "study_app/random_stream.h"

namespace study_app {
namespace {

/// SplitMix64 (G. Steele, D. Lea and C. Flood, "Fast splittable pseudorandom number generators",
/// OOPSLA 2014): neighbouring seeds and indices become unrelated ones.
std::uint64_t mixed(std::uint64_t z) {
    z += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

}  // namespace

std::mt19937_64 engineAt(std::uint64_t seed, Purpose purpose, std::uint64_t index) {
    return std::mt19937_64(mixed(mixed(mixed(seed) ^ static_cast<std::uint64_t>(purpose)) ^ index));
}

}  // namespace study_app
