// SPDX-License-Identifier: MIT
#include "analysis/cell_likelihood.h"

#include <algorithm>
#include <cmath>

#include "analysis/exp_minus.h"

namespace analysis {
namespace {

constexpr double kLn10 = 2.302585092994045684;
// Beyond it exp(ln h) overflows. It bounds the axis 70 log10 units from any data at beta 3.5.
constexpr double kLargestLogHazard = 600.0;
constexpr double kLargestHazard = 700.0;  // exp(-700) is still a normal number
// No product of so many probabilities underflows: the rarest answer, a lapse at its floor on the
// less likely side, has 1e-6 in a study of half a million reference trials.
constexpr std::size_t kFactorsPerLog = 48;

// The loops below are compiled for several widths of vectors, and the processor picks one when the
// program starts: half the time of a fit. No result depends on it, since every element goes through
// the same operations in the same order and nothing is contracted. Sanitizers run before the
// choice is made, and refuse it.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__) && defined(__OPTIMIZE__)
#define STAIRWELL_WIDEST_VECTORS __attribute__((target_clones("arch=x86-64-v4", "avx2", "default")))
#else
#define STAIRWELL_WIDEST_VECTORS
#endif

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

STAIRWELL_WIDEST_VECTORS
void CellPoints::evaluate(const CellTrials& cell, const Curve& curve, std::span<const double> y) {
    const std::size_t n = y.size();
    for (auto* values : {&value, &perY, &perLnBeta, &perLapse}) values->assign(n, 0.0);
    for (auto* values : {&factor_, &hazard_, &undetected_, &inverse_, &slope_}) values->resize(n);
    product_.assign(n, 1.0);
    // ln(hazard) is linear in y and in the strength, so the hazard is a product.
    const double centre = y[n / 2];
    const double offset = quest::criterionOffset(curve.criterion, curve.beta);
    const double steepness = curve.beta * kLn10;
    for (std::size_t c = 0; c < n; ++c) factor_[c] = std::exp(steepness * (y[c] - centre));
    for (const bool yes : {true, false}) {
        const AnswerModel answer(curve.response, yes);
        const std::size_t first = yes ? 0 : cell.yesCount;
        const std::size_t end = yes ? cell.yesCount : cell.strength.size();
        onLapse_.assign(n, 0.0);
        for (std::size_t i = first; i < end; ++i) {
            const double atCentre =
                std::exp(std::min(quest::logHazard(cell.strength[i] + centre + offset, curve.beta),
                                  kLargestLogHazard));
            const double fromThreshold = steepness * cell.strength[i];
            // Short loops over few arrays each, which the compiler vectorises.
            for (std::size_t c = 0; c < n; ++c) {
                const double hazard = atCentre * factor_[c];
                hazard_[c] = hazard < kLargestHazard ? hazard : kLargestHazard;
            }
            for (std::size_t c = 0; c < n; ++c) undetected_[c] = expMinus(hazard_[c]);
            for (std::size_t c = 0; c < n; ++c) {
                const double p = answer.floor + answer.detecting * undetected_[c];
                product_[c] *= p;
                inverse_[c] = 1.0 / p;
            }
            for (std::size_t c = 0; c < n; ++c) {
                onLapse_[c] += inverse_[c];
                slope_[c] = answer.detecting * hazard_[c] * undetected_[c] * inverse_[c];
            }
            for (std::size_t c = 0; c < n; ++c) {
                perY[c] -= slope_[c];
                perLnBeta[c] -= fromThreshold * slope_[c];
            }
            if (i % kFactorsPerLog == kFactorsPerLog - 1 || i + 1 == cell.strength.size()) {
                for (std::size_t c = 0; c < n; ++c) {
                    value[c] += std::log(product_[c]);
                    product_[c] = 1.0;
                }
            }
        }
        for (std::size_t c = 0; c < n; ++c) perLapse[c] += answer.onLapse * onLapse_[c];
    }
    const auto trials = static_cast<double>(cell.strength.size());
    for (std::size_t c = 0; c < n; ++c) {
        // d ln(hazard) / d ln beta is its own distance from the threshold, steepness (x + y).
        perLnBeta[c] += perY[c] * steepness * y[c];
        perY[c] *= steepness;
        // P = lapse onLapse + (1 - lapse) P0 changes by onLapse - P0 = (onLapse - P)/(1 - lapse).
        perLapse[c] = (perLapse[c] - trials) / (1.0 - curve.response.lapse);
    }
}

}  // namespace analysis
