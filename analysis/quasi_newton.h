// SPDX-License-Identifier: MIT
// BFGS with backtracking (J. Nocedal and S. J. Wright, "Numerical Optimization", 2006, chapters 3
// and 6) for the few parameters of a likelihood: it starts from a given inverse Hessian, which
// spares most of the steps, and takes "cannot be evaluated there" for an answer, both of which
// Ceres' line search does not.
#pragma once

#include <Eigen/Core>
#include <functional>

namespace analysis {

/// The function to minimise: value, and its gradient unless null. Not finite where it cannot be
/// had; the search then shortens its step.
using Objective = std::function<double(const Eigen::VectorXd&, Eigen::VectorXd*)>;

struct Descent {
    Eigen::VectorXd x;
    double value = 0;
    double decrement = 0;       ///< g' H g: about twice the fall in value still to come
    double firstDecrement = 0;  ///< the same at the start
    bool converged = false;
    bool blocked = false;  ///< stopped where the function cannot be evaluated further on
};

/// Until the decrement is below `tolerance`, or below that share of the first one. `inverseHessian`
/// is used and updated.
Descent descend(const Objective& objective, const Eigen::VectorXd& start,
                Eigen::MatrixXd& inverseHessian, double tolerance, double share = 0,
                int mostSteps = 200);

}  // namespace analysis
