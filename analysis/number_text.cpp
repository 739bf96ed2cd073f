// SPDX-License-Identifier: MIT
#include "analysis/number_text.h"

#include <cmath>
#include <cstdio>

namespace analysis {
std::string estimateText(double value, const std::optional<records::Interval>& ci95) {
    if (!ci95) return fixedText(value, 2) + " (no interval)";
    return fixedText(value, 2) + " [" + fixedText(ci95->low, 2) + ", " + fixedText(ci95->high, 2) +
           "]";
}

std::string fixedText(double value, int decimals) {
    char text[64];
    std::snprintf(text, sizeof text, "%.*f", decimals, value);
    return text;
}

std::string shortText(double value) {
    char text[64];
    std::snprintf(text, sizeof text, "%.6g", value);
    return text;
}

std::string pValueText(double p) {
    if (p < 0.001) return "p < .001";
    const std::string text = fixedText(p, p < 0.1 ? 3 : 2);
    return text.starts_with("0") ? "p = " + text.substr(1) : "p = " + text;
}

std::optional<records::Interval> powerOfTen(const std::optional<records::Interval>& log10Interval) {
    if (!log10Interval) return std::nullopt;
    return records::Interval{std::pow(10.0, log10Interval->low),
                             std::pow(10.0, log10Interval->high)};
}

records::Estimate slopeEstimate(double log10c, const std::optional<records::Interval>& ci95) {
    return {.estimate = std::pow(10.0, log10c), .ci95 = powerOfTen(ci95)};
}

std::string slopeText(double log10c, const std::optional<records::Interval>& ci95) {
    return estimateText(std::pow(10.0, log10c), powerOfTen(ci95));
}

std::string slopeText(const LinearEstimate& estimate) {
    return slopeText(estimate.value, estimate.ci95());
}

std::string plainText(const LinearEstimate& estimate) {
    return estimateText(estimate.value, estimate.ci95());
}

}  // namespace analysis
