// SPDX-License-Identifier: MIT
#include "demo/growth_exponent.h"

#include <cmath>

namespace demo {
namespace {

/// The .975 quantile of Student's t, within 1 %: by Fisher and Cornish's expansion from 3 degrees
/// of freedom on.
double studentQuantile(int degrees) {
    if (degrees == 1) return 12.706;
    if (degrees == 2) return 4.303;
    constexpr double kNormal = 1.960, kFirst = 2.372, kSecond = 2.823, kThird = 2.556;
    const double n = degrees;
    return kNormal + kFirst / n + kSecond / (n * n) + kThird / (n * n * n);
}

}  // namespace

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
    GrowthExponent growth{.exponent = products / squares, .points = static_cast<int>(logs.size())};
    for (const auto& [x, y] : logs) {
        const double off = y - meanY - growth.exponent * (x - meanX);
        growth.residual += off * off / count;
    }
    const int degrees = growth.points - 2;
    growth.halfWidth95 =
        studentQuantile(degrees) * std::sqrt(growth.residual * count / (degrees * squares));
    growth.residual = std::sqrt(growth.residual);
    return growth;
}

}  // namespace demo
