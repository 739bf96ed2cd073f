// SPDX-License-Identifier: MIT
#include "analysis/cell_likelihood.h"

#include <algorithm>
#include <cmath>

namespace analysis {
namespace {

constexpr double kLn10 = 2.302585092994045684;
constexpr double kPi = 3.14159265358979323846;
// Beyond it exp(ln h) overflows. It bounds the axis 70 log10 units from any data at beta 3.5.
constexpr double kLargestLogHazard = 600.0;
constexpr double kLargestHazard = 700.0;  // exp(-700) is still a normal number
// Points per unit of ln(hazard) on an interval: ln P(no) has its nearest singularity .7 off the
// real axis (where lapses take over), which the number of points resolves.
constexpr double kPointsPerUnit = 3.0;
constexpr int kFewestPoints = 8, kMostPoints = 64;
constexpr std::size_t kFactorsPerLog = 16;  // no product of so many probabilities underflows

// The probability of one kind of answer as floor + detecting * exp(-hazard), with what that makes
// of its derivatives. Both terms of "no" are non-negative, so that nothing cancels near certainty.
struct AnswerModel {
    double floor, detecting;
    double onLapse;  // probability of the answer on a lapse

    AnswerModel(const quest::ResponseModel& model, bool yes)
        : floor(yes ? quest::responseProbability(1.0, model) : quest::missProbability(0.0, model)),
          detecting(
              (yes ? quest::responseProbability(0.0, model) : quest::missProbability(1.0, model)) -
              floor),
          onLapse(yes ? model.lapseGuess : 1.0 - model.lapseGuess) {}
};

}  // namespace

LocationTerms locationTerms(const CellTrials& cell, double y, const Curve& curve) {
    const AnswerModel answers[] = {{curve.response, false}, {curve.response, true}};
    const double offset = quest::criterionOffset(curve.criterion, curve.beta);
    LocationTerms sum;
    for (std::size_t i = 0; i < cell.strength.size(); ++i) {
        const AnswerModel& answer = answers[i < cell.yesCount ? 1 : 0];
        const double hazard = std::exp(std::min(
            quest::logHazard(cell.strength[i] + y + offset, curve.beta), kLargestLogHazard));
        const double undetected = std::exp(-hazard);
        const double p = answer.floor + answer.detecting * undetected;
        sum.value += std::log(p);
        if (undetected > 0) {
            const double first = -answer.detecting * hazard * undetected / p;  // by ln(hazard)
            sum.first += first;
            sum.second += first * (1.0 - hazard) - first * first;
        }
    }
    const double perY = curve.beta * kLn10;  // d ln(hazard) / dy
    sum.first *= perY;
    sum.second *= perY * perY;
    return sum;
}

void LocationCurve::setInterval(double centre, double halfWidth, double beta) {
    centre_ = centre;
    halfWidth_ = halfWidth;
    const double units = halfWidth * beta * kLn10;
    const int wanted = kFewestPoints + static_cast<int>(kPointsPerUnit * std::min(units, 1e3));
    const auto n = static_cast<std::size_t>(std::min(wanted, kMostPoints));
    if (nodes_.size() >= n) return;  // never fewer than before: see the header
    nodes_.resize(n);
    cosines_.resize(n * n);
    for (std::size_t i = 0; i < n; ++i) {
        const double angle = kPi * (static_cast<double>(i) + 0.5) / static_cast<double>(n);
        nodes_[i] = std::cos(angle);
        for (std::size_t order = 0; order < n; ++order) {
            cosines_[order * n + i] = (order == 0 ? 1.0 : 2.0) / static_cast<double>(n) *
                                      std::cos(static_cast<double>(order) * angle);
        }
    }
}

bool LocationCurve::contains(double y) const {
    return std::abs(y - centre_) <= halfWidth_;
}

void LocationCurve::tabulate(const CellTrials& cell, const Curve& curve) {
    const std::size_t n = nodes_.size();
    const double offset = quest::criterionOffset(curve.criterion, curve.beta);
    const double steepness = curve.beta * kLn10;
    const double lapse = curve.response.lapse;
    std::vector<double> factor(n), product(n, 1.0);
    for (std::size_t c = 0; c < n; ++c) factor[c] = std::exp(steepness * halfWidth_ * nodes_[c]);
    value_.assign(n, 0.0);
    perLnBeta_.assign(n, 0.0);
    perLapse_.assign(n, 0.0);
    for (const bool yes : {true, false}) {
        const AnswerModel answer(curve.response, yes);
        const std::size_t first = yes ? 0 : cell.yesCount;
        const std::size_t end = yes ? cell.yesCount : cell.strength.size();
        for (std::size_t i = first; i < end; ++i) {
            // ln(hazard) is linear in y and in the strength, so the hazard is a product.
            const double atCentre =
                std::exp(std::min(quest::logHazard(cell.strength[i] + centre_ + offset, curve.beta),
                                  kLargestLogHazard));
            // d ln(hazard) / d ln beta is its own distance from the threshold.
            const double fromThreshold = steepness * (cell.strength[i] + centre_);
            for (std::size_t c = 0; c < n; ++c) {
                const double hazard = std::min(atCentre * factor[c], kLargestHazard);
                const double undetected = std::exp(-hazard);
                const double p = answer.floor + answer.detecting * undetected;
                const double inverse = 1.0 / p;
                product[c] *= p;
                perLnBeta_[c] -= answer.detecting * hazard * undetected * inverse *
                                 (fromThreshold + steepness * halfWidth_ * nodes_[c]);
                perLapse_[c] += answer.onLapse * inverse;
            }
            if ((i - first) % kFactorsPerLog == kFactorsPerLog - 1 || i + 1 == end) {
                for (std::size_t c = 0; c < n; ++c) {
                    value_[c] += std::log(product[c]);
                    product[c] = 1.0;
                }
            }
        }
    }
    // P = lapse onLapse + (1 - lapse) P0 changes by onLapse - P0 = (onLapse - P) / (1 - lapse).
    const auto trials = static_cast<double>(cell.strength.size());
    for (double& v : perLapse_) v = (v - trials) / (1.0 - lapse);
    for (std::vector<double>* series : {&value_, &perLnBeta_, &perLapse_}) {
        std::vector<double> coefficients(n, 0.0);
        for (std::size_t order = 0; order < n; ++order) {
            for (std::size_t c = 0; c < n; ++c) {
                coefficients[order] += cosines_[order * n + c] * (*series)[c];
            }
        }
        *series = std::move(coefficients);
    }
}

// Clenshaw's recurrence for the three series at once, and its derivative for the first.
LocationCurve::Point LocationCurve::at(double y) const {
    const double t = (y - centre_) / halfWidth_;
    double v1 = 0, v2 = 0, s1 = 0, s2 = 0, b1 = 0, b2 = 0, l1 = 0, l2 = 0;
    for (std::size_t order = nodes_.size() - 1; order > 0; --order) {
        const double s = 2 * (v1 + t * s1) - s2;
        const double v = value_[order] + 2 * t * v1 - v2;
        const double b = perLnBeta_[order] + 2 * t * b1 - b2;
        const double l = perLapse_[order] + 2 * t * l1 - l2;
        s2 = s1, s1 = s;
        v2 = v1, v1 = v;
        b2 = b1, b1 = b;
        l2 = l1, l1 = l;
    }
    return {value_[0] + t * v1 - v2, (v1 + t * s1 - s2) / halfWidth_, perLnBeta_[0] + t * b1 - b2,
            perLapse_[0] + t * l1 - l2};
}

}  // namespace analysis
