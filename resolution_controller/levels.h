// SPDX-License-Identifier: MIT
// The sizes a shadow map may have: few and far apart, because every change of size re-randomises
// the texel grid and a 6 % step pops exactly as much as a factor of two.
//
// Powers of two, and between them, unless the ratio is two, the smallest multiple of 8 that is at
// least sqrt 2 of the one below. Integers only: the same levels on every machine.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
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
    if (need <= kSmallestLevel) return kSmallestLevel;
    if (need > kLargestLevel) return {};
    // 2^octave is the power of two that suffices, at 2 (octave - 4) in the table.
    const int octave = 64 - std::countl_zero(static_cast<std::uint64_t>(need - 1));
    const auto above = static_cast<std::size_t>(2 * (octave - 4));
    const bool between = ratio == LevelRatio::sqrtTwo && kLevels[above - 1] >= need;
    return kLevels[between ? above - 1 : above];
}

/// Largest level that is at most `limit`; absent below kSmallestLevel.
constexpr std::optional<std::int32_t> levelAtMost(std::int64_t limit, LevelRatio ratio) noexcept {
    if (limit < kSmallestLevel) return {};
    if (limit >= kLargestLevel) return kLargestLevel;
    const int octave = 63 - std::countl_zero(static_cast<std::uint64_t>(limit));
    const auto below = static_cast<std::size_t>(2 * (octave - 4));
    const bool between = ratio == LevelRatio::sqrtTwo && kLevels[below + 1] <= limit;
    return kLevels[between ? below + 1 : below];
}

}  // namespace resolution_controller
