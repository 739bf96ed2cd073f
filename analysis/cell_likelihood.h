// SPDX-License-Identifier: MIT
// The log-likelihood of one cell (one observer x one condition) as a function of its location.
//
// A trial shown at strength x = log10(a / r) is answered "yes" (correct in 2AFC, seen in yes/no)
// with quest's P at L = y + x, where y = log10 c is the cell's location: r = c a is the radius at
// which detection reaches the criterion. Then
//
//     l(y) = sum over trials of ln P(answer).
//
// locationTerms() gives l with two derivatives, for Newton's method; CellPoints gives l and its
// first derivatives in y, ln beta and the lapse rate at many locations in one pass over the trials,
// for quadrature. (A Chebyshev series through fewer locations is no cheaper and leaves ripples that
// spoil second derivatives: where lapses are rare, ln P(no) has a kink.)
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "quest/psychometric.h"

namespace analysis {

/// The trials of one cell, those answered "yes" before those answered "no".
struct CellTrials {
    std::vector<double> strength;  ///< x = log10(a / r)
    std::size_t yesCount = 0;      ///< the first yesCount of them were answered "yes"
};

/// Shape of the curve for the trials of one cell. response.lapse > 0 keeps ln P finite.
struct Curve {
    double beta = 3.5;
    double criterion = quest::kPaperCriterion;
    quest::ResponseModel response;
};

struct LocationTerms {
    double value = 0, first = 0, second = 0;  ///< l, dl/dy, d2l/dy2
};
LocationTerms locationTerms(const CellTrials& cell, double y, const Curve& curve);

/// At each of the locations given to the last evaluate().
struct CellPoints {
    std::vector<double> value;      ///< l
    std::vector<double> perY;       ///< dl/dy
    std::vector<double> perLnBeta;  ///< dl/d ln beta
    std::vector<double> perLapse;   ///< dl/d lapse

    /// Keeps its memory between calls. At least one location.
    void evaluate(const CellTrials& cell, const Curve& curve, std::span<const double> y);

  private:
    std::vector<double> factor_, hazard_, undetected_, inverse_, slope_, product_, onLapse_;
};

}  // namespace analysis
