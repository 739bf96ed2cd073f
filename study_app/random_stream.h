// SPDX-License-Identifier: MIT
// Random numbers that depend on a seed and a place alone, never on what was drawn before: trial k
// of a resumed session draws what it would have drawn without the interruption, and a simulated
// observer's answer to trial k is the same however often the session was killed.
//
//   std::mt19937_64 rng = study_app::engineAt(seed, Purpose::roving, trialIndex);
//   const auto quarter = quest::uniformBelow(rng, 4);
#pragma once

#include <cstdint>
#include <random>

namespace study_app {

/// What the numbers are for; streams of different purposes are unrelated. The values are part of
/// the file format: a recorded session replays only while they stay.
enum class Purpose : std::uint64_t {
    order = 1,        ///< order of the trials
    roving = 2,       ///< side, quarter turn, mirror, shift, tilt
    observer = 3,     ///< a simulated observer's own thresholds
    answer = 4,       ///< a simulated observer's answers
    participant = 5,  ///< seeds of the sessions of a simulated study
    image = 6,        ///< seeds of turned taps, noise and dither
};

/// The generator at `index` of a purpose.
std::mt19937_64 engineAt(std::uint64_t seed, Purpose purpose, std::uint64_t index);

}  // namespace study_app
