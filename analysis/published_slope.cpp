// SPDX-License-Identifier: MIT
#include "analysis/published_slope.h"

#include <cmath>

#include "analysis/number_text.h"
#include "quest/psychometric.h"

namespace analysis {
namespace {

// Two decimals of c do not tell these criteria apart.
constexpr double kSameCriterion = 5e-4;

}  // namespace

double publishedAt(double criterion, double slope) {
    return slope * quest::slopeFactor(quest::kPaperCriterion, criterion, kPublishedBeta);
}

std::string publishedText(double criterion) {
    const std::string text = fixedText(publishedAt(criterion), 2);
    if (std::abs(criterion - quest::kPaperCriterion) < kSameCriterion) return text;
    return text + " (" + fixedText(kPublishedSlope, 2) +
           " at F* = " + fixedText(quest::kPaperCriterion, 4) + ")";
}

}  // namespace analysis
