// SPDX-License-Identifier: MIT
#include "quest/quest.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "quest/sentence.h"

namespace quest {
namespace {

/// Candidates below this share of the posterior are set to 0. They could never come back into view;
/// as denormal numbers they would stick and slow every later trial.
constexpr double kNegligible = 1e-290;

/// Running sums are kept at the end of each block, and blocks are summed side by side: one chain of
/// additions over all candidates would be the longest part of a trial.
constexpr std::size_t kBlock = 16;
constexpr std::size_t kBlocksAtOnce = 4;

/// No stimulus is there; keeps the arithmetic of absurd parameters finite.
constexpr double kLargestPlace = 1e6;

std::size_t roundUp(std::size_t value, std::size_t multiple) {
    return (value + multiple - 1) / multiple * multiple;
}

double effectiveGamma(const QuestParameters& p) {
    return p.gamma > p.pThreshold ? 0.5 : p.gamma;
}

ResponseModel responseModel(const QuestParameters& p) {
    const double gamma = effectiveGamma(p);
    return {.gamma = gamma, .lapse = p.delta, .lapseGuess = gamma};
}

/// D, the number of intervals, as a real number, so that validate() can look at it.
double intervalCount(const QuestParameters& p) {
    return p.range ? 2 * std::ceil(*p.range / p.grain / 2) : 500;
}

/// W(u), the curve in its natural place.
double curve(double u, const QuestParameters& p) {
    return responseProbability(weibull(u, p.beta), responseModel(p));
}

std::string validateNumbers(const QuestParameters& p) {
    const auto positive = [](double v) { return v > 0 && std::isfinite(v); };
    const auto probability = [](double v) { return v >= 0 && v <= 1; };
    const char* const kPositive = "must be finite and greater than 0";
    const char* const kProbability = "must be a probability in [0, 1]";
    const auto onTheAxis = [](double v) { return std::abs(v) <= kLargestPlace; };
    const char* const kOnTheAxis = "must be within 1000000 log10 units";
    if (!std::isfinite(p.priorMean)) return sentence("priorMean", p.priorMean, "must be finite");
    if (!onTheAxis(p.priorMean)) return sentence("priorMean", p.priorMean, kOnTheAxis);
    if (!positive(p.priorSd)) return sentence("priorSd", p.priorSd, kPositive);
    if (!positive(p.beta)) return sentence("beta", p.beta, kPositive);
    if (!positive(p.grain)) return sentence("grain", p.grain, kPositive);
    if (!onTheAxis(p.grain)) return sentence("grain", p.grain, kOnTheAxis);
    if (p.range && !positive(*p.range)) return sentence("range", *p.range, kPositive);
    if (p.range && !onTheAxis(*p.range)) return sentence("range", *p.range, kOnTheAxis);
    if (!probability(p.pThreshold)) return sentence("pThreshold", p.pThreshold, kProbability);
    if (!probability(p.delta)) return sentence("delta", p.delta, kProbability);
    if (!probability(p.gamma)) return sentence("gamma", p.gamma, kProbability);
    return {};
}

/// u where the table w over u(k) reaches `probability`, by linear interpolation between the two
/// points of that rise. The caller has made sure that it is reached.
template <typename Place>
double offsetOfThreshold(std::span<const double> w, double probability, Place u) {
    std::size_t k = 1;
    while (w[k] < probability) ++k;
    return u(k - 1) + (probability - w[k - 1]) / (w[k] - w[k - 1]) * (u(k) - u(k - 1));
}

/// Quantile order of the most informative placement; depends on the ends of the curve alone.
double idealOrder(double pL, double pH) {
    constexpr double tiny = 2.2e-16;  // keeps 0 ln 0 at 0
    const auto xlogx = [](double p) { return p * std::log(p + tiny); };
    const auto qlogq = [](double q) { return (q + tiny) * std::log(q + tiny); };
    const double entropies = xlogx(pH) - xlogx(pL) + qlogq(1 - pH) - qlogq(1 - pL);
    const double z = 1 / (1 + std::exp(entropies / (pL - pH)));
    return (z - pL) / (pH - pL);
}

}  // namespace

std::string validate(const QuestParameters& p) {
    if (std::string problem = validateNumbers(p); !problem.empty()) return problem;
    if (p.priorSd < p.grain / 20) {
        return sentence("priorSd", p.priorSd,
                        "must be at least a twentieth of grain, or a single candidate holds the "
                        "whole prior");
    }
    const double intervals = intervalCount(p);
    if (intervals > kMaxIntervals) {
        return sentence("range / grain", intervals, "must be at most 1000000 intervals");
    }
    const double low = curve(-intervals * p.grain, p);
    const double high = curve(intervals * p.grain, p);
    if (!(p.pThreshold > low && p.pThreshold < high)) {
        char rule[160];
        std::snprintf(rule, sizeof rule,
                      "must lie inside the curve, whose table runs from %.15g to %.15g", low, high);
        return sentence("pThreshold", p.pThreshold, rule);
    }
    return {};
}

double criterion(const QuestParameters& p) {
    const double gamma = effectiveGamma(p);
    return ((p.pThreshold - p.delta * gamma) / (1 - p.delta) - gamma) / (1 - gamma);
}

double thresholdProbability(double criterion, double gamma, double delta) {
    return responseProbability(criterion,
                               ResponseModel{.gamma = gamma, .lapse = delta, .lapseGuess = gamma});
}

QuestParameters forYesNo(QuestParameters parameters, double falseAlarmRate) {
    const double sameCriterion = criterion(parameters);
    parameters.gamma = falseAlarmRate;
    parameters.pThreshold = thresholdProbability(sameCriterion, falseAlarmRate, parameters.delta);
    return parameters;
}

std::optional<QuestParameters> presetNamed(std::string_view name) {
    for (const QuestPreset& preset : kPresets) {
        if (preset.name == name) return preset.parameters;
    }
    return {};
}

std::string toSentence(const QuestWarning& w) {
    char text[200];
    switch (w.kind) {
        case QuestWarning::Kind::gammaReplaced:
            return sentence("gamma", w.value, "above pThreshold, 0.5 is used instead");
        case QuestWarning::Kind::outOfRange:
            std::snprintf(text, sizeof text,
                          "trial %zu: x is %.15g: outside %.6g to %.6g, the nearest end is used "
                          "and the posterior is inexact; a larger range avoids it",
                          w.trial, w.value, w.low, w.high);
            return text;
        case QuestWarning::Kind::impossibleResponse:
            std::snprintf(text, sizeof text,
                          "trial %zu: x is %.15g: no candidate threshold allows the answer, the "
                          "posterior is kept; delta > 0 avoids it",
                          w.trial, w.value);
            return text;
    }
    return {};
}

Quest::Quest(const QuestParameters& parameters) : parameters_(parameters) {
    if (const std::string problem = validate(parameters); !problem.empty()) {
        throw std::invalid_argument("QUEST: " + problem);
    }
    intervals_ = static_cast<std::size_t>(intervalCount(parameters));
    if (effectiveGamma(parameters) != parameters.gamma) {
        warnings_.push_back({.kind = QuestWarning::Kind::gammaReplaced, .value = parameters.gamma});
    }
    setPrior();
    tabulateCurve();
}

double Quest::offset(std::size_t index) const {
    return (static_cast<double>(index) - static_cast<double>(intervals_ / 2)) * parameters_.grain;
}

void Quest::setPrior() {
    const std::size_t padded = roundUp(intervals_ + 1, kBlock * kBlocksAtOnce);
    pdf_.resize(intervals_ + 1);
    weights_.resize(padded);
    blockEnd_.resize(padded / kBlock);
    for (std::size_t j = 0; j < pdf_.size(); ++j) {
        const double deviation = offset(j) / parameters_.priorSd;
        weights_[j] = std::exp(-0.5 * deviation * deviation);
    }
    normalise(sumWeights());
}

/// Leaves the running sums of weights_ in blockEnd_ and returns the total.
double Quest::sumWeights() {
    double sum = 0;
    for (std::size_t b = 0; b < blockEnd_.size(); b += kBlocksAtOnce) {
        const double* const first = &weights_[b * kBlock];
        std::array<double, kBlocksAtOnce> within{};
        for (std::size_t j = 0; j < kBlock; ++j) {
            for (std::size_t i = 0; i < kBlocksAtOnce; ++i) within[i] += first[i * kBlock + j];
        }
        for (std::size_t i = 0; i < kBlocksAtOnce; ++i) blockEnd_[b + i] = sum += within[i];
    }
    return sum;
}

void Quest::normalise(double sum) {
    const double scale = 1 / sum;
    for (std::size_t j = 0; j < pdf_.size(); ++j) {
        const double p = weights_[j] * scale;
        pdf_[j] = p < kNegligible ? 0.0 : p;
    }
}

void Quest::tabulateCurve() {
    const std::size_t points = 2 * intervals_ + 1;
    const auto u = [this](std::size_t k) {
        return (static_cast<double>(k) - static_cast<double>(intervals_)) * parameters_.grain;
    };
    std::vector<double> w(points);
    for (std::size_t k = 0; k < points; ++k) w[k] = curve(u(k), parameters_);
    const double eps = offsetOfThreshold(w, parameters_.pThreshold, u);

    const ResponseModel model = responseModel(parameters_);
    yes_.resize(points);
    no_.resize(points);
    for (std::size_t k = 0; k < points; ++k) {
        const double shifted = u(k) + eps;
        const double hazard = std::exp(logHazard(shifted, parameters_.beta));
        yes_[points - 1 - k] = responseProbability(-std::expm1(-hazard), model);
        no_[points - 1 - k] = missProbability(std::exp(-hazard), model);
    }
    quantileOrder_ = idealOrder(yes_.back(), yes_.front());
}

void Quest::update(double x, int response) {
    if (!std::isfinite(x)) {
        throw std::invalid_argument(sentence("QUEST: x", x, "must be finite"));
    }
    if (response != 0 && response != 1) {
        throw std::invalid_argument(sentence("QUEST: response", response, "must be 0 or 1"));
    }
    history_.push_back({.x = x, .response = response});

    const double half = static_cast<double>(intervals_ / 2);
    const double step = std::round((x - parameters_.priorMean) / parameters_.grain);
    if (std::abs(step) > half) {
        warn(QuestWarning::Kind::outOfRange, x);
    }
    // Candidate j reads the curve at index D + step - (j - D/2), which is D/2 - step + j from the
    // other end.
    const auto first = static_cast<std::size_t>(half - std::clamp(step, -half, half));
    const double* const likelihood = (response == 1 ? yes_ : no_).data() + first;

    for (std::size_t j = 0; j < pdf_.size(); ++j) weights_[j] = pdf_[j] * likelihood[j];
    const double sum = sumWeights();
    if (sum > kNegligible) {
        normalise(sum);
        return;
    }
    warn(QuestWarning::Kind::impossibleResponse, x);
    std::copy(pdf_.begin(), pdf_.end(), weights_.begin());
    sumWeights();
}

void Quest::warn(QuestWarning::Kind kind, double x) {
    warnings_.push_back({.kind = kind,
                         .trial = history_.size(),
                         .value = x,
                         .low = candidate(0),
                         .high = candidate(intervals_)});
}

double Quest::quantile(double order) const {
    if (!(order >= 0 && order <= 1)) {
        throw std::invalid_argument(sentence("QUEST: quantile order", order, "must be in [0, 1]"));
    }
    const double target = order * blockEnd_.back();
    const RunningSum upper = firstReaching(target);
    if (upper.index == 0) return candidate(0);
    // Only points where the sum rises carry the interpolation: below the rise, the first point that
    // has the sum from which it rises.
    const RunningSum lower = firstReaching(upper.before);
    const double share = (target - lower.sum) / (upper.sum - lower.sum);
    return candidate(lower.index) + share * (candidate(upper.index) - candidate(lower.index));
}

/// The first candidate whose running sum is at least `target`, which is at most the total.
Quest::RunningSum Quest::firstReaching(double target) const {
    const auto block = static_cast<std::size_t>(
        std::lower_bound(blockEnd_.begin(), blockEnd_.end(), target) - blockEnd_.begin());
    const double start = block == 0 ? 0.0 : blockEnd_[block - 1];
    std::size_t j = block * kBlock;
    double within = 0, before = start, sum = start + weights_[j];
    while (sum < target) {
        within += weights_[j++];
        before = sum;
        sum = start + (within + weights_[j]);
    }
    return {.index = j, .before = before, .sum = sum};
}

double Quest::mean() const {
    return parameters_.priorMean + meanOffset();
}

double Quest::meanOffset() const {
    double sum = 0, moment = 0;
    for (std::size_t j = 0; j < pdf_.size(); ++j) {
        sum += pdf_[j];
        moment += pdf_[j] * offset(j);
    }
    return moment / sum;
}

double Quest::sd() const {
    const double centre = meanOffset();
    double sum = 0, moment = 0;
    for (std::size_t j = 0; j < pdf_.size(); ++j) {
        const double deviation = offset(j) - centre;
        sum += pdf_[j];
        moment += pdf_[j] * deviation * deviation;
    }
    return std::sqrt(moment / sum);
}

}  // namespace quest
