// SPDX-License-Identifier: MIT
#include "demo/spread.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace demo {

Spread spreadOf(std::vector<double> values) {
    if (values.empty()) return {};
    std::sort(values.begin(), values.end());
    const auto quantile = [&](double q) {
        const double place = q * static_cast<double>(values.size() - 1);
        const auto low = static_cast<std::size_t>(place);
        const std::size_t high = std::min(low + 1, values.size() - 1);
        return values[low] + (place - std::floor(place)) * (values[high] - values[low]);
    };
    return {.count = static_cast<int>(values.size()),
            .median = quantile(0.5),
            .p25 = quantile(0.25),
            .p75 = quantile(0.75),
            .least = values.front()};
}

}  // namespace demo
