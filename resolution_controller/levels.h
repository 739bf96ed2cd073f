// SPDX-License-Identifier: MIT
// The sizes a shadow map may have: few and far apart, because every change of size re-randomises
// the texel grid and a 6 % step pops exactly as much as a factor of two.
//
// Powers of two, and between them, unless the ratio is two, the smallest multiple of 8 that is at
// least sqrt 2 of the one below. Integers only: the same levels on every machine.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

namespace resolution_controller {

enum class LevelRatio : std::uint8_t { sqrtTwo, two };

inline constexpr std::array<std::int32_t, 23> kLevels{
    16,   24,   32,   48,   64,   96,   128,  184,   256,   368,   512,  728,
    1024, 1456, 2048, 2904, 4096, 5800, 8192, 11592, 16384, 23176, 32768};

inline constexpr std::int32_t kSmallestLevel = kLevels.front();
inline constexpr std::int32_t kLargestLevel = kLevels.back();

/// Smallest level that is at least `need`; absent above kLargestLevel.
constexpr std::optional<std::int32_t> levelAtLeast(std::int64_t need, LevelRatio ratio) noexcept {
    const std::size_t step = ratio == LevelRatio::two ? 2 : 1;
    for (std::size_t i = 0; i < kLevels.size(); i += step) {
        if (kLevels[i] >= need) return kLevels[i];
    }
    return {};
}

/// Largest level that is at most `limit`; absent below kSmallestLevel.
constexpr std::optional<std::int32_t> levelAtMost(std::int64_t limit, LevelRatio ratio) noexcept {
    const std::size_t step = ratio == LevelRatio::two ? 2 : 1;
    std::optional<std::int32_t> result;
    for (std::size_t i = 0; i < kLevels.size() && kLevels[i] <= limit; i += step) {
        result = kLevels[i];
    }
    return result;
}

}  // namespace resolution_controller
