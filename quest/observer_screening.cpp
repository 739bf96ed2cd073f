// SPDX-License-Identifier: MIT
#include "quest/observer_screening.h"

#include <cmath>
#include <cstdio>

namespace quest {
namespace {

/// P(at least `events` of n) at a rate of at most events / n, where the first term is the largest.
double tail(int events, int n, double rate) {
    const double odds = rate / (1 - rate);
    double term =
        std::exp(std::lgamma(n + 1.0) - std::lgamma(events + 1.0) - std::lgamma(n - events + 1.0) +
                 events * std::log(rate) + (n - events) * std::log1p(-rate));
    double sum = term;
    for (int k = events; k < n && term > 1e-17 * sum; ++k) {
        term *= odds * (n - k) / (k + 1);
        sum += term;
    }
    return sum;
}

std::string percent(double share) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g %%", 100 * share);
    return text;
}

}  // namespace

double rateLowerBound(int events, int n, double confidence) {
    if (events <= 0 || n <= 0) return 0;
    if (events >= n) return std::pow(1 - confidence, 1.0 / n);
    // At the rate seen the tail holds at least one half: np, where it is whole, is the median.
    double low = 0, high = static_cast<double>(events) / n;
    while (true) {
        const double middle = low + (high - low) / 2;
        if (middle <= low || middle >= high) return middle;
        (tail(events, n, middle) < 1 - confidence ? low : high) = middle;
    }
}

std::string falseAlarmProblem(int falseAlarms, int references, const ScreeningLimits& limits,
                              double confidence) {
    if (references == 0) return "no reference trial, so the false-alarm rate is unknown";
    const double bound = rateLowerBound(falseAlarms, references, confidence);
    if (!(bound > limits.falseAlarmRate)) return {};
    return std::to_string(falseAlarms) + " false alarms in " + std::to_string(references) +
           " reference trials: lower " + percent(confidence) + " bound " + percent(bound) +
           ", limit " + percent(limits.falseAlarmRate);
}

std::string catchProblem(int failures, int catchTrials, const ScreeningLimits& limits) {
    if (!(failures > limits.catchFailureShare * catchTrials)) return {};
    return std::to_string(failures) + " of " + std::to_string(catchTrials) +
           " catch trials failed, limit " + percent(limits.catchFailureShare);
}

}  // namespace quest
