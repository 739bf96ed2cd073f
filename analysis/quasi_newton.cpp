// SPDX-License-Identifier: MIT
#include "analysis/quasi_newton.h"

#include <algorithm>
#include <cmath>

namespace analysis {
namespace {

constexpr double kSufficientFall = 1e-4;    // Armijo
constexpr double kShortestStep = 1e-8;      // of the quasi-Newton step
constexpr double kEvaluationNoise = 1e-13;  // relative

void update(Eigen::MatrixXd& inverse, const Eigen::VectorXd& step, const Eigen::VectorXd& change) {
    const double curvature = step.dot(change);
    const Eigen::VectorXd turned = inverse * change;
    // Without positive curvature along the step there is nothing to learn from it.
    if (!(curvature > 1e-10 * std::sqrt(step.squaredNorm() * change.squaredNorm()))) return;
    inverse += (1 + change.dot(turned) / curvature) / curvature * step * step.transpose() -
               (turned * step.transpose() + step * turned.transpose()) / curvature;
}

}  // namespace

Descent descend(const Objective& objective, const Eigen::VectorXd& start,
                Eigen::MatrixXd& inverseHessian, double tolerance, double share, int mostSteps) {
    Descent at;
    at.x = start;
    Eigen::VectorXd gradient, nextGradient;
    at.value = objective(at.x, &gradient);
    if (!std::isfinite(at.value)) return at;
    for (int taken = 0; taken < mostSteps; ++taken) {
        const Eigen::VectorXd direction = -inverseHessian * gradient;
        at.decrement = -direction.dot(gradient);
        if (taken == 0) at.firstDecrement = at.decrement;
        at.converged = at.decrement < std::max(tolerance, share * at.firstDecrement);
        if (at.converged) return at;
        double length = 1;
        at.blocked = false;
        while (true) {
            const Eigen::VectorXd next = at.x + length * direction;
            const double value = objective(next, &nextGradient);
            const double floor = kEvaluationNoise * std::abs(at.value);
            if (value <= at.value - kSufficientFall * length * at.decrement + floor) {
                update(inverseHessian, next - at.x, nextGradient - gradient);
                at.x = next;
                at.value = value;
                gradient = nextGradient;
                break;
            }
            at.blocked = at.blocked || !std::isfinite(value);
            length *= std::isfinite(value) ? 0.4 : 0.5;
            if (length < kShortestStep) return at;
        }
        if (at.blocked) return at;  // one step to the edge; the caller moves the edge
    }
    return at;
}

}  // namespace analysis
