// SPDX-License-Identifier: MIT
#include "analysis/observer_slopes.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "analysis/figure_panels.h"

namespace analysis {

std::vector<ObserverSlope> observerSlopes(const SlopeAnalysis& analysis) {
    const RandomObserverFit& fit = headlineFit(analysis);
    std::vector<ObserverSlope> slopes(analysis.study.observers.size());
    std::vector<double> sum(slopes.size(), 0), weights(slopes.size(), 0);
    const double omega2 = fit.parameters.omega * fit.parameters.omega;
    for (const CellThreshold& cell : analysis.thresholds) {
        ObserverSlope& slope = slopes[cell.observer];
        ++slope.cells;
        if (cell.state != ThresholdState::estimated) {
            ++slope.censored;
            continue;
        }
        const Condition& condition = analysis.study.conditions[cell.condition];
        const double weight = 1 / (omega2 + cell.standardError * cell.standardError);
        sum[cell.observer] +=
            weight * (cell.log10c - fittedLog10c(analysis, condition.group, condition.artifactPx));
        weights[cell.observer] += weight;
    }
    for (std::size_t i = 0; i < slopes.size(); ++i) {
        slopes[i].shrunken = fit.observerEffects[i];
        if (weights[i] == 0) continue;
        slopes[i].own = sum[i] / weights[i];
        slopes[i].standardError = 1 / std::sqrt(weights[i]);
    }
    return slopes;
}

std::vector<std::size_t> observersByRisingSlope(const std::vector<ObserverSlope>& slopes) {
    std::vector<std::size_t> order(slopes.size());
    std::iota(order.begin(), order.end(), 0u);
    std::stable_sort(order.begin(), order.end(), [&](std::size_t one, std::size_t other) {
        return slopes[one].shrunken < slopes[other].shrunken;
    });
    return order;
}

}  // namespace analysis
