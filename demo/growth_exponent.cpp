// SPDX-License-Identifier: MIT
#include "demo/growth_exponent.h"

#include <cmath>

namespace demo {

GrowthExponent growthExponent(const std::vector<std::pair<double, double>>& points) {
    std::vector<std::pair<double, double>> logs;
    double meanX = 0;
    double meanY = 0;
    for (const auto& [x, cost] : points) {
        if (!(x > 0 && cost > 0 && std::isfinite(x) && std::isfinite(cost))) continue;
        logs.emplace_back(std::log(x), std::log(cost));
        meanX += logs.back().first;
        meanY += logs.back().second;
    }
    if (logs.size() < 3) return {};
    const auto count = static_cast<double>(logs.size());
    meanX /= count;
    meanY /= count;
    double squares = 0;
    double products = 0;
    for (const auto& [x, y] : logs) {
        squares += (x - meanX) * (x - meanX);
        products += (x - meanX) * (y - meanY);
    }
    if (!(squares > 0)) return {};
    GrowthExponent growth{products / squares, 0, static_cast<int>(logs.size())};
    for (const auto& [x, y] : logs) {
        const double off = y - meanY - growth.exponent * (x - meanX);
        growth.residual += off * off / count;
    }
    growth.residual = std::sqrt(growth.residual);
    return growth;
}

}  // namespace demo
