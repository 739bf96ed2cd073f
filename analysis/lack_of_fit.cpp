// SPDX-License-Identifier: MIT
#include "analysis/lack_of_fit.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "analysis/distributions.h"
#include "analysis/slope_model.h"

namespace analysis {
namespace {

constexpr double kHalfPriorSd = 0.3;  // log10: keeps a half without a threshold of its own finite
constexpr int kMostShiftSteps = 100;
constexpr double kShiftReached = 1e-10;  // log-likelihood still to gain

// Of the forecasts: locations to 4.5 sd of the population, finer than a cell of 40 trials knows its
// own (.05 log10).
constexpr int kGridPoints = 121;
constexpr double kGridReach = 4.5;
// Of the strengths at an observer's own threshold, log10 units; a cell of 40 trials knows its
// threshold to .05. The last bin holds catch trials and the first trials of a staircase.
constexpr double kBinEdges[] = {-0.15, -0.05, 0.05, 0.15, 0.4};
constexpr std::size_t kBins = std::size(kBinEdges) + 1;
constexpr double kLeastVariance = 3.0;  // of the number of "yes" in a bin: near enough to normal
constexpr std::size_t kMostResidualBins = 12, kLeastResidualTrials = 20;

ObserverMean meanOver(const std::vector<double>& values) {
    ObserverMean result;
    result.observers = static_cast<int>(values.size());
    const auto n = static_cast<double>(values.size());
    for (const double v : values) result.value += v / n;
    if (values.size() < 2) return result;
    double squares = 0;
    for (const double v : values) squares += (v - result.value) * (v - result.value);
    result.standardError = std::sqrt(squares / (n - 1) / n);
    const double half = studentQuantile(0.975, n - 1) * result.standardError;
    result.ci95 = records::Interval{result.value - half, result.value + half};
    if (result.standardError > 0) {
        result.pValue = 2 * studentCdf(-std::abs(result.value) / result.standardError, n - 1);
    }
    return result;
}

// One cell, its trials cut in two.
struct Halves {
    CellTrials first, second;
    Curve curve;
    double expected;  // location, from the fit of all trials
};

// ln L of a shift and its cells' locations, with what Newton's method needs. The locations lie in
// the middle between the halves, so that the prior on them does not pull at the shift.
struct ShiftTerms {
    double value = 0, gradient = 0, curvature = 0;  // in the shift
    std::vector<double> cellGradient, cellCurvature, mixed;
};

ShiftTerms shiftTerms(const std::vector<Halves>& cells, double shift,
                      const std::vector<double>& location) {
    ShiftTerms sum;
    for (std::size_t k = 0; k < cells.size(); ++k) {
        const LocationTerms a =
            locationTerms(cells[k].first, location[k] - 0.5 * shift, cells[k].curve);
        const LocationTerms b =
            locationTerms(cells[k].second, location[k] + 0.5 * shift, cells[k].curve);
        const double off = (location[k] - cells[k].expected) / kHalfPriorSd;
        const double wa = std::max(0.0, -a.second), wb = std::max(0.0, -b.second);
        sum.value += a.value + b.value - 0.5 * off * off;
        sum.gradient += 0.5 * (b.first - a.first);
        sum.curvature += 0.25 * (wa + wb);
        sum.cellGradient.push_back(a.first + b.first - off / kHalfPriorSd);
        sum.cellCurvature.push_back(wa + wb + 1 / (kHalfPriorSd * kHalfPriorSd));
        sum.mixed.push_back(0.5 * (wb - wa));
    }
    return sum;
}

// The best shift, by Newton's method on an arrow-shaped Hessian with step halving. Nothing where
// the answers do not tell one.
std::optional<double> bestShift(const std::vector<Halves>& cells) {
    double shift = 0;
    std::vector<double> location;
    for (const Halves& cell : cells) location.push_back(cell.expected);
    ShiftTerms at = shiftTerms(cells, shift, location);
    for (int taken = 0; taken < kMostShiftSteps; ++taken) {
        double curvature = at.curvature, gradient = at.gradient;
        for (std::size_t k = 0; k < cells.size(); ++k) {
            curvature -= at.mixed[k] * at.mixed[k] / at.cellCurvature[k];
            gradient -= at.mixed[k] * at.cellGradient[k] / at.cellCurvature[k];
        }
        if (!(curvature > 1e-6)) return std::nullopt;
        const double step = gradient / curvature;
        double gain = step * at.gradient;
        std::vector<double> cellStep;
        for (std::size_t k = 0; k < cells.size(); ++k) {
            cellStep.push_back((at.cellGradient[k] - at.mixed[k] * step) / at.cellCurvature[k]);
            gain += cellStep.back() * at.cellGradient[k];
        }
        if (gain < kShiftReached) return shift;
        for (double length = 1; length > 1e-6; length /= 2) {
            std::vector<double> moved = location;
            for (std::size_t k = 0; k < cells.size(); ++k) moved[k] += length * cellStep[k];
            ShiftTerms there = shiftTerms(cells, shift + length * step, moved);
            if (!(there.value > at.value)) continue;
            shift += length * step;
            location = std::move(moved);
            at = std::move(there);
            break;
        }
    }
    return shift;
}

Curve curveOf(const Model& model, const ModelParameters& at, const ModelObserver& observer,
              int condition) {
    const auto beta =
        static_cast<std::size_t>(model.betaIndex[static_cast<std::size_t>(condition)]);
    return {.beta = at.beta[beta],
            .criterion = model.criterion,
            .response = {observer.gamma, at.lapse, observer.lapseGuess}};
}

double yesProbability(double strength, const Curve& curve) {
    return quest::responseProbability(
        quest::detectionProbability(strength, curve.beta, curve.criterion), curve.response);
}

// An answer and what was expected of it.
struct Forecast {
    std::size_t observer;
    double strength, p;  // at the expected threshold; probability of "yes"
    bool yes;
};

// Distributions over a grid of locations, relative to a condition's mean.
class LocationGrid {
  public:
    explicit LocationGrid(const ModelParameters& at) {
        const double reach = kGridReach * std::hypot(at.tau, at.omega);
        const int points = reach > 0 ? kGridPoints : 1;
        for (int j = 0; j < points; ++j) {
            point_.push_back(points == 1 ? 0 : reach * (2.0 * j / (points - 1) - 1));
        }
        observers_ = bell(0, at.tau);
        for (const double u : point_) fromObserver_.push_back(bell(u, at.omega));
    }

    const std::vector<double>& point() const { return point_; }
    const std::vector<double>& observers() const { return observers_; }

    // Of a cell, for an observer known up to a distribution.
    std::vector<double> cellPrior(const std::vector<double>& observer) const {
        std::vector<double> prior(point_.size(), 0.0);
        for (std::size_t u = 0; u < point_.size(); ++u) {
            for (std::size_t z = 0; z < point_.size(); ++z) {
                prior[z] += observer[u] * fromObserver_[u][z];
            }
        }
        return prior;
    }

    // What a cell's likelihood says of the observer.
    void learn(std::vector<double>& observer, const std::vector<double>& likelihood) const {
        for (std::size_t u = 0; u < point_.size(); ++u) {
            double sum = 0;
            for (std::size_t z = 0; z < point_.size(); ++z) {
                sum += fromObserver_[u][z] * likelihood[z];
            }
            observer[u] *= sum;
        }
        normalise(observer);
    }

    static void normalise(std::vector<double>& weights) {
        double sum = 0;
        for (const double w : weights) sum += w;
        for (double& w : weights) w /= sum;
    }

  private:
    // Normal around a grid point; all of it there where the sd is below the grid.
    std::vector<double> bell(double centre, double sd) const {
        const double step = point_.size() > 1 ? point_[1] - point_[0] : 1;
        std::vector<double> weights;
        for (const double z : point_) {
            const double off = z - centre;
            weights.push_back(sd > 0.5 * step ? std::exp(-0.5 * off * off / (sd * sd))
                                              : (std::abs(off) < 0.5 * step ? 1 : 0));
        }
        normalise(weights);
        return weights;
    }

    std::vector<double> point_, observers_;
    std::vector<std::vector<double>> fromObserver_;
};

// One cell after another, the observer known from the cells before.
std::vector<Forecast> forecasts(const Study& study, const Model& model,
                                const RandomObserverFit& fit) {
    const LocationGrid grid(fit.parameters);
    const std::size_t points = grid.point().size();
    std::vector<Forecast> all;
    std::vector<double> yes(points);
    for (std::size_t i = 0; i < study.observers.size(); ++i) {
        std::vector<double> observer = grid.observers();
        for (const Cell& cell : study.observers[i].cells) {
            const auto condition = static_cast<int>(cell.condition);
            const Curve curve = curveOf(model, fit.parameters, model.observers[i], condition);
            const double mean = model.design.row(condition).dot(fit.parameters.fixed);
            const double a = study.conditions[cell.condition].artifactPx;
            std::vector<double> now = grid.cellPrior(observer), likelihood(points, 1.0);
            for (const StudyTrial& trial : cell.trials) {
                const double x = quest::strength(a, trial.radiusPx) + mean;
                double p = 0, expected = 0;
                for (std::size_t z = 0; z < points; ++z) {
                    yes[z] = yesProbability(x + grid.point()[z], curve);
                    p += now[z] * yes[z];
                    expected += now[z] * grid.point()[z];
                }
                all.push_back({i, x + expected, p, trial.yes});
                for (std::size_t z = 0; z < points; ++z) {
                    const double factor = trial.yes ? yes[z] : 1 - yes[z];
                    now[z] *= factor;
                    likelihood[z] *= factor;
                }
                LocationGrid::normalise(now);
                LocationGrid::normalise(likelihood);
            }
            grid.learn(observer, likelihood);
        }
    }
    return all;
}

std::optional<Dispersion> dispersionOf(const std::vector<Forecast>& forecasts,
                                       std::size_t observers) {
    struct Bin {
        double excess = 0, variance = 0;
    };
    std::vector<Bin> bins(kBins * observers);
    for (const Forecast& one : forecasts) {
        const auto edge =
            std::upper_bound(std::begin(kBinEdges), std::end(kBinEdges), one.strength);
        Bin& bin =
            bins[one.observer * kBins + static_cast<std::size_t>(edge - std::begin(kBinEdges))];
        bin.excess += (one.yes ? 1 : 0) - one.p;
        bin.variance += one.p * (1 - one.p);
    }
    // A bin that is too small is joined with the next observers' at that strength, or with the next
    // strength. Leaving it out would choose by the answers: where a staircase goes depends on them.
    std::vector<Bin> joined;
    Bin open;
    for (std::size_t strength = 0; strength < kBins; ++strength) {
        for (std::size_t i = 0; i < observers; ++i) {
            const Bin& bin = bins[i * kBins + strength];
            open.excess += bin.excess;
            open.variance += bin.variance;
            if (open.variance < kLeastVariance) continue;
            joined.push_back(open);
            open = {};
        }
    }
    if (!joined.empty()) {
        joined.back().excess += open.excess;
        joined.back().variance += open.variance;
    }
    Dispersion result;
    for (const Bin& bin : joined) {
        result.pearson += bin.excess * bin.excess / bin.variance;
        ++result.degreesOfFreedom;
    }
    if (result.degreesOfFreedom == 0) return std::nullopt;
    result.pValue = chiSquaredSurvival(result.pearson, result.degreesOfFreedom);
    return result;
}

std::vector<ResidualBin> residualBins(std::vector<Forecast> forecasts) {
    std::stable_sort(forecasts.begin(), forecasts.end(),
                     [](const Forecast& a, const Forecast& b) { return a.strength < b.strength; });
    const std::size_t bins =
        std::clamp(forecasts.size() / kLeastResidualTrials, std::size_t{1}, kMostResidualBins);
    std::vector<ResidualBin> result;
    for (std::size_t b = 0; b < bins; ++b) {
        const std::size_t from = b * forecasts.size() / bins,
                          to = (b + 1) * forecasts.size() / bins;
        const auto n = static_cast<double>(to - from);
        ResidualBin bin;
        bin.trials = static_cast<int>(to - from);
        double variance = 0;
        for (std::size_t t = from; t < to; ++t) {
            const Forecast& one = forecasts[t];
            bin.strength += one.strength / n;
            bin.expected += one.p / n;
            bin.observed += one.yes ? 1 / n : 0;
            variance += one.p * (1 - one.p);
        }
        bin.standardError = std::sqrt(variance) / n;
        result.push_back(bin);
    }
    return result;
}

}  // namespace

std::optional<ObserverMean> secondHalfShift(const Study& study, const Model& model,
                                            const RandomObserverFit& fit) {
    std::vector<double> shifts;
    for (std::size_t i = 0; i < study.observers.size(); ++i) {
        std::vector<Halves> cells;
        const auto& own = study.observers[i].cells;
        for (std::size_t k = 0; k < own.size(); ++k) {
            const std::span<const StudyTrial> trials(own[k].trials);
            const std::size_t half = trials.size() / 2;
            if (half == 0) continue;
            const double a = study.conditions[own[k].condition].artifactPx;
            cells.push_back({cellTrials(trials.first(half), a), cellTrials(trials.subspan(half), a),
                             curveOf(model, fit.parameters, model.observers[i],
                                     static_cast<int>(own[k].condition)),
                             fit.cellLocations[i][k]});
        }
        if (cells.empty()) continue;
        if (const auto shift = bestShift(cells)) shifts.push_back(*shift);
    }
    if (shifts.empty()) return std::nullopt;
    return meanOver(shifts);
}

FitCheck checkFit(const Study& study, const Model& model, const RandomObserverFit& fit) {
    const std::vector<Forecast> all = forecasts(study, model, fit);
    return {dispersionOf(all, study.observers.size()), residualBins(all)};
}

std::optional<StaircaseComparison> compareStaircases(const Study& study,
                                                     const std::vector<CellThreshold>& thresholds,
                                                     double criterion, std::string& why) {
    if (!study.staircases) {
        why = "no sidecar says which threshold the staircases looked for, or the sidecars differ";
        return std::nullopt;
    }
    const double toCriterion = std::log10(
        quest::slopeFactor(study.staircases->criterion, criterion, study.staircases->beta));
    std::map<std::size_t, std::vector<double>> byObserver;
    StaircaseComparison result;
    result.assumedBeta = study.staircases->beta;
    double sum = 0, squares = 0;
    for (const CellThreshold& threshold : thresholds) {
        if (threshold.state != ThresholdState::estimated) continue;
        const auto& cells = study.observers[threshold.observer].cells;
        const auto cell = std::find_if(cells.begin(), cells.end(), [&](const Cell& one) {
            return one.condition == threshold.condition;
        });
        if (cell == cells.end() || !cell->staircaseLog10c) continue;
        const double difference = *cell->staircaseLog10c + toCriterion - threshold.log10c;
        byObserver[threshold.observer].push_back(difference);
        sum += difference;
        squares += difference * difference;
        ++result.cells;
    }
    if (result.cells == 0) {
        why = "the tables hold no posterior of a staircase";
        return std::nullopt;
    }
    std::vector<double> means;
    for (const auto& [observer, differences] : byObserver) {
        double own = 0;
        for (const double d : differences) own += d / static_cast<double>(differences.size());
        means.push_back(own);
    }
    result.difference = meanOver(means);
    if (result.cells > 1) {
        const double mean = sum / result.cells;
        result.scatter =
            std::sqrt(std::max(0.0, squares - result.cells * mean * mean) / (result.cells - 1));
    }
    return result;
}

}  // namespace analysis
