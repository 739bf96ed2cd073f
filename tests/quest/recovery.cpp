// SPDX-License-Identifier: MIT
#include "tests/quest/recovery.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

namespace recovery {
namespace {

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

}  // namespace

std::vector<double> errors(const Setting& setting) {
    std::mt19937_64 rng(setting.seed);
    const quest::Quest fresh(setting.staircase);
    std::vector<double> result;
    result.reserve(static_cast<std::size_t>(setting.runs));
    for (int run = 0; run < setting.runs; ++run) {
        quest::Quest staircase = fresh;
        for (int trial = 0; trial < setting.trials; ++trial) {
            const double x = staircase.quantile();
            staircase.update(x, quest::answer(setting.observer, x, rng) ? 1 : 0);
        }
        result.push_back(staircase.mean() - setting.observer.threshold);
    }
    return result;
}

quest::SimulatedObserver matchedObserver(const quest::QuestParameters& staircase, double offset) {
    return {.threshold = staircase.priorMean + offset,
            .criterion = quest::criterion(staircase),
            .beta = staircase.beta,
            .response = {
                .gamma = staircase.gamma, .lapse = staircase.delta, .lapseGuess = staircase.gamma}};
}

double mean(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double rootMeanSquare(const std::vector<double>& values) {
    return std::sqrt(std::inner_product(values.begin(), values.end(), values.begin(), 0.0) /
                     static_cast<double>(values.size()));
}

double robustSd(std::vector<double> values) {
    const double centre = median(values);
    for (double& v : values) v = std::abs(v - centre);
    return 1.4826 * median(std::move(values));
}

}  // namespace recovery
