// SPDX-License-Identifier: MIT
// Maximises the marginal likelihood of marginal_likelihood.h: estimates, their covariance, degrees
// of freedom and log-likelihood for any design matrix.
//
//     analysis::RandomObserverFit fit = analysis::fitRandomObservers(model, start);
//     if (!fit.converged) std::cerr << fit << '\n';
//     const analysis::LinearEstimate c = analysis::linearEstimate(fit, firstGroup);  // b_0, ...
//
// Intervals use Student's t with Satterthwaite's degrees of freedom for the variance of the
// estimate (F. E. Satterthwaite, Biometrics Bulletin 2, 1946; for mixed models S. G. Fai and P. L.
// Cornelius, J. Stat. Comput. Simul. 54, 1996), at least observers - 1: with n observers of equal
// numbers of trials that is exactly the t test over observers.
#pragma once

#include <Eigen/Core>
#include <iosfwd>
#include <optional>
#include <string>

#include "analysis/marginal_likelihood.h"
#include "records/slope_file.h"

namespace analysis {

struct FitOptions {
    LikelihoodForm form = LikelihoodForm::restricted;
    bool estimateTau = true;    ///< else it stays at its start value (0 with one observer, or where
                                ///< no two share a group), and there are no intervals of c
    bool estimateOmega = true;  ///< else likewise (0 where no observer has two conditions)
    bool estimateCurve = true;  ///< beta and lapse; else they stay
    bool covariance = true;     ///< off: estimates and log-likelihood alone, in half the time
    /// RandomObserverFit::inverseHessian of a fit of like data, of the same design or with the same
    /// patterns: fewer steps.
    Eigen::MatrixXd inverseHessian = {};
};

/// A fit that failed is a result: `converged` is false and `message` says why.
struct RandomObserverFit {
    bool converged = false;
    std::string message;
    ModelParameters parameters;
    double logLikelihood = 0;  ///< priors included; comparable between designs in the plain form
    int evaluations = 0;       ///< of likelihood and gradient
    bool lapseAtBound = false, tauAtZero = false, omegaAtZero = false;
    Eigen::MatrixXd inverseHessian;  ///< of -ln L as the search left it, in its own units

    /// Of (b, ln beta...), tau and omega held, lapse taken into account; from the Hessian of the
    /// marginal likelihood with priors. Empty when it was not asked for or is not positive
    /// definite.
    Eigen::MatrixXd covariance;
    Eigen::MatrixXd fixedInformation;  ///< J
    MarginalLikelihood::SpreadInformation spread;
    int observers = 0;  ///< that the spread between observers rests on; 1 where it is not estimated

    std::vector<double> observerEffects;             ///< posterior means of u_i, log10
    std::vector<std::vector<double>> cellLocations;  ///< of y_ik, log10 c
};
std::ostream& operator<<(std::ostream& out, const RandomObserverFit& fit);

RandomObserverFit fitRandomObservers(const Model& model, const ModelParameters& start,
                                     const FitOptions& options = {});

/// w' b with its standard error.
struct LinearEstimate {
    double value = 0;
    double standardError = 0;
    double degreesOfFreedom = 0;  ///< 0 with one observer: no interval for a population
    std::optional<records::Interval> ci95() const;
};
LinearEstimate linearEstimate(const RandomObserverFit& fit, const Eigen::VectorXd& weights);

/// Degrees of freedom of the variance of w' b, see the head of this file.
double satterthwaite(const RandomObserverFit& fit, const Eigen::VectorXd& weights);

}  // namespace analysis
