// SPDX-License-Identifier: MIT
// How results are written for people: the same number looks the same in the terminal, the report
// and a figure.
#pragma once

#include <optional>
#include <string>

#include "analysis/random_observer_fit.h"
#include "records/slope_file.h"

namespace analysis {

std::string fixedText(double value, int decimals);  ///< "3.41"
std::string shortText(double value);                ///< up to six digits: "0.6465", "10"
std::string pValueText(double p);                   ///< "p = .043", "p < .001"

/// "3.41 [3.20, 3.63]", "3.41 (no interval)".
std::string estimateText(double value, const std::optional<records::Interval>& ci95);
/// 10^ of a log10 estimate: "3.41 [3.20, 3.63]", "3.41 (no interval)".
std::string slopeText(double log10c, const std::optional<records::Interval>& ci95);
std::string slopeText(const LinearEstimate& estimate);
/// As it is: "0.98 [0.93, 1.03]".
std::string plainText(const LinearEstimate& estimate);

/// 10^ of both ends, and of an estimate with them.
std::optional<records::Interval> powerOfTen(const std::optional<records::Interval>& log10Interval);
records::Estimate slopeEstimate(double log10c, const std::optional<records::Interval>& ci95);

}  // namespace analysis
