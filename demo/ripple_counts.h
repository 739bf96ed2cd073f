// SPDX-License-Identifier: MIT
// Edge ripples as counts, one for each 8-bit level, so that those of many frames can be taken
// together from a table: the last level also counts what is larger.
#pragma once

#include <string>
#include <vector>

namespace demo {

inline constexpr int kRippleBins = 256;

using RippleCounts = std::vector<int>;
/// Whole numbers with commas between, without the zeros at the end.
std::string rippleCountsText(const std::vector<float>& ripples);
/// Back from such a text; throws std::runtime_error for another one.
std::vector<int> wholeNumbers(const std::string& text);

/// 95th percentile, in the middle of its level; 0 for no counts.
double rippleP95(const RippleCounts& counts);
void addCounts(RippleCounts& sum, const RippleCounts& counts);

}  // namespace demo
