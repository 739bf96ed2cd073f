// SPDX-License-Identifier: MIT
// The log-likelihood of one cell (one observer x one condition) as a function of its location.
//
// A trial shown at strength x = log10(a / r) is answered "yes" (correct in 2AFC, seen in yes/no)
// with quest's P at L = y + x, where y = log10 c is the cell's location: r = c a is the radius at
// which detection reaches the criterion. Then
//
//     l(y) = sum over trials of ln P(answer).
//
// locationTerms() gives l with two derivatives, for Newton's method. A LocationCurve holds l, and
// its derivatives in ln beta and in the lapse rate, on an interval of y as Chebyshev series (L. N.
// Trefethen, "Approximation Theory and Approximation Practice", 2013, chapters 3 and 4): one pass
// over the trials, after which any number of quadrature points cost nothing but the series.
#pragma once

#include <cstddef>
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

class LocationCurve {
  public:
    struct Point {
        double value;      ///< l
        double perY;       ///< dl/dy
        double perLnBeta;  ///< dl/d ln beta
        double perLapse;   ///< dl/d lapse
    };

    /// Sets the interval, centre +- halfWidth (> 0), and the number of points on it by its width in
    /// units of the curve's steepness: the error is below 1e-4 per trial. The number only ever
    /// grows, so that a search that adapts the interval again and again settles.
    void setInterval(double centre, double halfWidth, double beta);
    /// One pass over the trials at the points of the interval.
    void tabulate(const CellTrials& cell, const Curve& curve);
    /// Requires contains(y).
    Point at(double y) const;
    bool contains(double y) const;

  private:
    double centre_ = 0, halfWidth_ = 1;
    std::vector<double> nodes_;                         // on [-1, 1]
    std::vector<double> cosines_;                       // transform from values to coefficients
    std::vector<double> value_, perLnBeta_, perLapse_;  // values, then coefficients
};

}  // namespace analysis
