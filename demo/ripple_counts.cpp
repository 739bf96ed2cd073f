// SPDX-License-Identifier: MIT
#include "demo/ripple_counts.h"

#include <charconv>
#include <numeric>
#include <stdexcept>

namespace demo {

std::string rippleCountsText(const std::vector<float>& ripples) {
    std::vector<int> counts(kRippleBins);
    for (const float ripple : ripples) {
        // A NaN is as bad as can be.
        const float level = 255 * ripple;
        const int bin =
            level >= 0 && level < kRippleBins ? static_cast<int>(level) : kRippleBins - 1;
        ++counts[static_cast<std::size_t>(bin)];
    }
    while (counts.size() > 1 && counts.back() == 0) counts.pop_back();
    std::string text;
    for (const int count : counts) text += (text.empty() ? "" : ",") + std::to_string(count);
    return text;
}

std::vector<int> wholeNumbers(const std::string& text) {
    std::vector<int> numbers;
    for (const char *at = text.data(), *end = at + text.size(); at < end; ++at) {
        int number = 0;
        const auto [rest, error] = std::from_chars(at, end, number);
        if (error != std::errc() || (rest != end && *rest != ','))
            throw std::runtime_error("\"" + text.substr(0, 40) +
                                     "\" must be whole numbers with commas between");
        numbers.push_back(number);
        at = rest;
    }
    return numbers;
}

double rippleP95(const RippleCounts& counts) {
    const auto total = std::accumulate(counts.begin(), counts.end(), 0LL);
    if (total == 0) return 0;
    long long below = 0;
    for (std::size_t bin = 0; bin < counts.size(); ++bin) {
        below += counts[bin];
        if (static_cast<double>(below) >= 0.95 * static_cast<double>(total))
            return (static_cast<double>(bin) + 0.5) / 255;
    }
    return 1;
}

void addCounts(RippleCounts& sum, const RippleCounts& counts) {
    if (sum.size() < counts.size()) sum.resize(counts.size());
    for (std::size_t bin = 0; bin < counts.size(); ++bin) sum[bin] += counts[bin];
}

}  // namespace demo
