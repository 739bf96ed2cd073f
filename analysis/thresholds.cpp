// SPDX-License-Identifier: MIT
#include "analysis/thresholds.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "analysis/distributions.h"

namespace analysis {
namespace {

constexpr double kGridStep = 0.02, kBeyondShown = 1.0;
constexpr double kBetterThanNone = 0.05;  // ln L above the ends of the axis

double mean(const std::vector<double>& values) {
    double sum = 0;
    for (const double v : values) sum += v;
    return sum / static_cast<double>(values.size());
}

// The maximum between the grid point before and after the best one, by golden section: as exact as
// doubles allow a maximum to be (1e-8).
double refine(const CellTrials& cell, const Curve& curve, double low, double high) {
    const double golden = 0.6180339887498949;
    while (high - low > 1e-10) {
        const double a = high - golden * (high - low), b = low + golden * (high - low);
        if (locationTerms(cell, a, curve).value < locationTerms(cell, b, curve).value) {
            low = a;
        } else {
            high = b;
        }
    }
    return 0.5 * (low + high);
}

void estimate(const CellTrials& cell, const Curve& curve, CellThreshold& result) {
    const auto [least, most] = std::minmax_element(cell.strength.begin(), cell.strength.end());
    const double low = -*most - kBeyondShown, high = -*least + kBeyondShown;
    const double ends =
        std::max(locationTerms(cell, low, curve).value, locationTerms(cell, high, curve).value);
    double best = ends, bestAt = low;
    for (double y = low + kGridStep; y < high; y += kGridStep) {
        const double value = locationTerms(cell, y, curve).value;
        if (value > best) {
            best = value;
            bestAt = y;
        }
    }
    if (result.yes == result.trials) result.state = ThresholdState::allYes;
    if (result.yes == 0) result.state = ThresholdState::allNo;
    if (result.state != ThresholdState::estimated) return;
    const double y = refine(cell, curve, bestAt - kGridStep, bestAt + kGridStep);
    const double curvature = -locationTerms(cell, y, curve).second;
    if (best - ends < kBetterThanNone || !(curvature > 0)) {
        result.state = ThresholdState::noMaximum;
        return;
    }
    result.log10c = y;
    result.standardError = 1 / std::sqrt(curvature);
}

bool inGroup(const Study& study, const CellThreshold& cell, std::optional<std::size_t> group) {
    return !group || study.conditions[cell.condition].group == *group;
}

}  // namespace

std::string toText(ThresholdState state) {
    switch (state) {
        case ThresholdState::estimated:
            return "estimated";
        case ThresholdState::allYes:
            return "censored: every answer yes";
        case ThresholdState::allNo:
            return "censored: every answer no";
        case ThresholdState::noMaximum:
            return "censored: no best threshold";
    }
    return "";
}

std::vector<CellThreshold> cellThresholds(const Study& study, const Model& model,
                                          const ModelParameters& curve) {
    std::vector<CellThreshold> thresholds;
    for (std::size_t i = 0; i < model.observers.size(); ++i) {
        const ModelObserver& observer = model.observers[i];
        for (const ModelCell& cell : observer.cells) {
            const auto condition = static_cast<std::size_t>(cell.condition);
            const auto beta = static_cast<std::size_t>(model.betaIndex[condition]);
            CellThreshold threshold{.observer = i,
                                    .condition = condition,
                                    .trials = static_cast<int>(cell.trials.strength.size()),
                                    .yes = static_cast<int>(cell.trials.yesCount)};
            estimate(cell.trials,
                     {.beta = curve.beta[beta],
                      .criterion = model.criterion,
                      .response = {observer.gamma, curve.lapse, observer.lapseGuess}},
                     threshold);
            threshold.radiusPx =
                std::pow(10.0, threshold.log10c) * study.conditions[condition].artifactPx;
            thresholds.push_back(threshold);
        }
    }
    return thresholds;
}

TwoStage twoStage(const Study& study, const std::vector<CellThreshold>& thresholds,
                  std::optional<std::size_t> group) {
    TwoStage result;
    std::map<std::size_t, std::map<std::size_t, std::vector<double>>> byObserverAndGroup;
    for (const CellThreshold& cell : thresholds) {
        if (!inGroup(study, cell, group)) continue;
        if (cell.state != ThresholdState::estimated) {
            ++result.censored;
            continue;
        }
        byObserverAndGroup[cell.observer][study.conditions[cell.condition].group].push_back(
            cell.log10c);
    }
    std::vector<double> observers;
    for (const auto& [observer, groups] : byObserverAndGroup) {
        std::vector<double> groupMeans;
        for (const auto& [g, values] : groups) groupMeans.push_back(mean(values));
        observers.push_back(mean(groupMeans));
    }
    result.observers = static_cast<int>(observers.size());
    if (observers.empty()) return result;
    const double centre = mean(observers);
    result.log10c = centre;
    std::sort(observers.begin(), observers.end());
    const std::size_t half = observers.size() / 2;
    result.medianLog10c =
        observers.size() % 2 == 1 ? observers[half] : 0.5 * (observers[half - 1] + observers[half]);
    if (observers.size() < 2) return result;
    double squares = 0;
    for (const double v : observers) squares += (v - centre) * (v - centre);
    const auto n = static_cast<double>(observers.size());
    const double reach = studentQuantile(0.975, n - 1) * std::sqrt(squares / (n - 1) / n);
    result.ci95 = records::Interval{centre - reach, centre + reach};
    return result;
}

}  // namespace analysis
