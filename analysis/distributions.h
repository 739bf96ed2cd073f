// SPDX-License-Identifier: MIT
// The few distribution functions that intervals and tests need.
//
// Sources: the incomplete beta function by its continued fraction (modified Lentz), the incomplete
// gamma function by series and continued fraction (W. H. Press et al., "Numerical Recipes",
// sections 6.2 and 6.4); quantiles by bisection on them, so that a quantile and its probability
// agree to the last digits. Relative error of the probabilities about 1e-13.
#pragma once

namespace analysis {

double normalCdf(double z);
/// 0 < p < 1.
double normalQuantile(double p);

/// P(T <= t) for Student's t; df > 0, not necessarily an integer. df = infinity is the normal.
double studentCdf(double t, double df);
/// t with studentCdf(t, df) = p; 0 < p < 1.
double studentQuantile(double p, double df);

/// P(X > x) for chi-squared with df > 0 degrees of freedom; 1 for x <= 0.
double chiSquaredSurvival(double x, double df);

/// Regularised incomplete beta function I_x(a, b); a, b > 0, 0 <= x <= 1.
double incompleteBeta(double a, double b, double x);

}  // namespace analysis
