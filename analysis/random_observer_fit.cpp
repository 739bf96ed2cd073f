// SPDX-License-Identifier: MIT
#include "analysis/random_observer_fit.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <ostream>
#include <vector>

#include "analysis/distributions.h"
#include "analysis/quasi_newton.h"

namespace analysis {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Typical sizes of a step, so that the optimiser sees curvatures of like magnitude.
constexpr double kFixedScale = 0.03, kCurveScale = 0.1, kSpreadScale = 0.03;
// Twice the log-likelihood still to gain: 1e-4 standard errors from the maximum.
constexpr double kDecrement = 1e-8;
constexpr double kDifferenceStep = 1e-2;  // of the Hessian, in the same units
// Nearer to a stationary point at a bound than this, a parameter is set on the bound.
constexpr double kZeroSpread = 1e-4;  // log10 units: 0.02 % of r
constexpr double kBoundAngle = 0.02;  // lapse within 6e-5 of the bound
constexpr double kSecondLapse = 0.04, kScaleOfSpread = 0.03;
constexpr double kSameLapse = 0.002;  // two searches that end this near have found one maximum
constexpr int kMostRounds = 40;       // of adapting the points and climbing
constexpr int kFullRounds = 6;
// A round that starts this near to its maximum (.003 standard errors) is the last.
constexpr double kSettled = 1e-5;
constexpr double kEnoughOfARound = 1e-3;  // of its first decrement: the next one moves the maximum
constexpr double kLeastSpread = 0.01;     // log10 units; off zero, where the likelihood is level
constexpr double kHalfPi = 1.57079632679489662;

// Scaled free coordinates <-> all coordinates.
VectorXd picked(const VectorXd& x, const VectorXd& scale, const std::vector<int>& free) {
    VectorXd scaled(static_cast<Eigen::Index>(free.size()));
    for (Eigen::Index j = 0; j < scaled.size(); ++j) {
        const int at = free[static_cast<std::size_t>(j)];
        scaled[j] = x[at] / scale[at];
    }
    return scaled;
}

VectorXd placed(VectorXd x, const VectorXd& scaled, const VectorXd& scale,
                const std::vector<int>& free) {
    for (Eigen::Index j = 0; j < scaled.size(); ++j) {
        const int at = free[static_cast<std::size_t>(j)];
        x[at] = scaled[j] * scale[at];
    }
    return x;
}

// Where a search begins: the information on b is known, and the rest as it was found in like data
// (all coordinates, of which the last ones are the same in every design), or its typical size.
MatrixXd firstInverseHessian(const MatrixXd& information, const VectorXd& scale,
                             const std::vector<int>& free, const MatrixXd& known) {
    const auto p = information.rows();
    const bool sameDesign = known.rows() == scale.size();
    MatrixXd whole = MatrixXd::Identity(scale.size(), scale.size());
    const auto common = std::min(known.rows(), scale.size() - p);
    if (sameDesign) {
        whole = known;
    } else {
        const VectorXd unit = scale.head(p).cwiseInverse();
        whole.topLeftCorner(p, p) = unit.asDiagonal() *
                                    information.ldlt().solve(MatrixXd::Identity(p, p)) *
                                    unit.asDiagonal();
        whole.bottomRightCorner(common, common) = known.bottomRightCorner(common, common);
    }
    return whole(free, free);
}

// Second derivatives of -ln L in the scaled free coordinates, from differences of the exact
// gradient over a hundredth of a standard error: one-sided ones are good to .1 %. Empty where the
// likelihood cannot be had nearby.
MatrixXd scaledHessian(MarginalLikelihood& likelihood, LikelihoodForm form, const VectorXd& x,
                       const VectorXd& scale, const std::vector<int>& free, int& evaluations) {
    const auto n = static_cast<Eigen::Index>(free.size());
    const auto slopes = [&](const VectorXd& at) {
        VectorXd full;
        ++evaluations;
        if (!std::isfinite(likelihood.evaluate(at, form, &full))) return VectorXd();
        return picked(full.cwiseProduct(scale).cwiseProduct(scale), scale, free);
    };
    const VectorXd here = slopes(x);
    MatrixXd hessian(n, n);
    for (Eigen::Index j = 0; j < n; ++j) {
        const int at = free[static_cast<std::size_t>(j)];
        VectorXd moved = x;
        moved[at] += kDifferenceStep * scale[at];
        const VectorXd there = slopes(moved);
        if (here.size() == 0 || there.size() == 0) return {};
        hessian.col(j) = (here - there) / kDifferenceStep;
    }
    return 0.5 * (hessian + hessian.transpose());
}

struct Layout {
    int fixed, beta, lapse, tau, omega;  // first index of each kind of coordinate
    explicit Layout(const Model& model)
        : fixed(0),
          beta(static_cast<int>(model.design.cols())),
          lapse(beta + model.betaCount),
          tau(lapse + 1),
          omega(tau + 1) {}
};

VectorXd coordinateScale(const Layout& layout) {
    VectorXd scale(layout.omega + 1);
    scale.head(layout.beta).setConstant(kFixedScale);
    scale.segment(layout.beta, layout.tau - layout.beta).setConstant(kCurveScale);
    scale.tail(2).setConstant(kSpreadScale);
    return scale;
}

std::vector<int> freeCoordinates(const Layout& layout, const FitOptions& options) {
    std::vector<int> free;
    const int end = options.estimateCurve ? layout.tau : layout.beta;
    for (int j = 0; j < end; ++j) free.push_back(j);
    if (options.estimateTau) free.push_back(layout.tau);
    if (options.estimateOmega) free.push_back(layout.omega);
    return free;
}

// Where a search stands.
struct Search {
    VectorXd x;
    std::vector<int> free;
    MatrixXd inverseHessian;  // of the scaled free coordinates
    double value = 0;         // of the likelihood, its points adapted at x
    bool astray = false;      // where the likelihood cannot be evaluated
    bool converged = false, lapseAtBound = false, tauAtZero = false, omegaAtZero = false;
    std::string message;
};

// The inverse Hessian of the others, one coordinate held.
MatrixXd withoutCoordinate(const MatrixXd& inverse, Eigen::Index held) {
    std::vector<Eigen::Index> others;
    for (Eigen::Index j = 0; j < inverse.rows(); ++j) {
        if (j != held) others.push_back(j);
    }
    const VectorXd column = inverse.col(held)(others);
    return inverse(others, others) - column * column.transpose() / inverse(held, held);
}

// A parameter whose optimum is on its bound is put there and held, so that the Hessian of the rest
// means something. True when one was.
bool holdBounds(const Layout& layout, Search& search) {
    bool held = false;
    const auto hold = [&](int index, double value, bool& flag) {
        const auto found = std::find(search.free.begin(), search.free.end(), index);
        if (found == search.free.end()) return;
        search.inverseHessian =
            withoutCoordinate(search.inverseHessian, found - search.free.begin());
        search.free.erase(found);
        search.x[index] = value;
        flag = held = true;
    };
    if (std::abs(search.x[layout.tau]) < kZeroSpread) hold(layout.tau, 0, search.tauAtZero);
    if (std::abs(search.x[layout.omega]) < kZeroSpread) hold(layout.omega, 0, search.omegaAtZero);
    const double angle = std::abs(std::remainder(search.x[layout.lapse], 2 * kHalfPi));
    if (angle < kBoundAngle) hold(layout.lapse, 0, search.lapseAtBound);
    if (angle > kHalfPi - kBoundAngle) hold(layout.lapse, kHalfPi, search.lapseAtBound);
    return held;
}

// How far a search goes.
struct Effort {
    Quadrature quadrature;
    double decrement, settled;  // as kDecrement and kSettled
    int rounds;
    bool holdsBounds;
};
constexpr Effort kWhole{Quadrature::fine, kDecrement, kSettled, kMostRounds, true};
// At a third of the cost, to where the quadrature's own error begins.
constexpr Effort kApproach{Quadrature::coarse, 1e-2, 0.1, 4, false};

// Adapts the quadrature points and climbs, in turn, until a round starts at its own maximum.
void climb(MarginalLikelihood& likelihood, const FitOptions& options, const Layout& layout,
           const VectorXd& scale, const Effort& effort, Search& search, int& evaluations) {
    likelihood.use(effort.quadrature);
    search.converged = false;
    VectorXd full;
    const auto objective = [&](const VectorXd& scaled, VectorXd* gradient) {
        ++evaluations;
        const VectorXd x = placed(search.x, scaled, scale, search.free);
        const double value = likelihood.evaluate(x, options.form, gradient ? &full : nullptr);
        if (gradient && std::isfinite(value)) {
            *gradient = -picked(full.cwiseProduct(scale).cwiseProduct(scale), scale, search.free);
        }
        return -value;
    };
    for (int round = 0; round < effort.rounds && !search.converged; ++round) {
        search.message = "the likelihood cannot be evaluated";
        search.astray = true;
        if (!likelihood.adapt(search.x)) return;
        if (search.inverseHessian.size() == 0) {
            likelihood.evaluate(search.x, options.form, nullptr);
            ++evaluations;
            search.inverseHessian = firstInverseHessian(likelihood.fixedInformation(), scale,
                                                        search.free, options.inverseHessian);
        }
        const VectorXd from = picked(search.x, scale, search.free);
        const Descent descent =
            descend(objective, from, search.inverseHessian, effort.decrement, kEnoughOfARound);
        if (!std::isfinite(descent.value)) return;
        search.astray = false;
        const bool settled = descent.converged && descent.firstDecrement < effort.settled;
        // Adapting and climbing may chase each other; half steps end that.
        const double share = !settled && round >= kFullRounds ? 0.5 : 1.0;
        search.x = placed(search.x, from + share * (descent.x - from), scale, search.free);
        search.value = -descent.value;
        search.converged = settled && !(effort.holdsBounds && holdBounds(layout, search));
        search.message = descent.converged ? "the maximum moved with every adaptation"
                                           : "the search for the maximum stopped short of it";
    }
    if (search.converged) search.message.clear();
}

// In all coordinates; those that were held at their typical size.
MatrixXd wholeInverseHessian(const Search& search, const Layout& layout) {
    MatrixXd whole = MatrixXd::Identity(layout.omega + 1, layout.omega + 1);
    if (search.inverseHessian.size() > 0) whole(search.free, search.free) = search.inverseHessian;
    return whole;
}

Search startOfSearch(const ModelParameters& start, const FitOptions& options,
                     const Layout& layout) {
    return {.x = toCoordinates(start),
            .free = freeCoordinates(layout, options),
            .inverseHessian = {},
            .message = {}};
}

// From where the approach led, off the bounds, where the likelihood is level in its coordinates.
void finish(MarginalLikelihood& likelihood, const FitOptions& options, const Layout& layout,
            const VectorXd& scale, Search& search, int& evaluations) {
    for (const int spread : {layout.tau, layout.omega}) {
        const bool held =
            std::find(search.free.begin(), search.free.end(), spread) == search.free.end();
        if (!held) search.x[spread] = std::max(kLeastSpread, std::abs(search.x[spread]));
    }
    climb(likelihood, options, layout, scale, kWhole, search, evaluations);
}

Search searchFrom(const ModelParameters& start, MarginalLikelihood& likelihood,
                  const FitOptions& options, const Layout& layout, const VectorXd& scale,
                  int& evaluations) {
    Search search = startOfSearch(start, options, layout);
    climb(likelihood, options, layout, scale, kApproach, search, evaluations);
    if (search.astray) search = startOfSearch(start, options, layout);
    finish(likelihood, options, layout, scale, search, evaluations);
    return search;
}

double lapseOf(const Search& search, const Layout& layout) {
    return std::pow(std::sin(search.x[layout.lapse]), 2) * kLapseLimit;
}

void keepEffects(const Model& model, const MarginalLikelihood& likelihood, RandomObserverFit& fit) {
    for (std::size_t i = 0; i < model.observers.size(); ++i) {
        fit.observerEffects.push_back(likelihood.observerEffect(i));
        fit.cellLocations.emplace_back();
        for (std::size_t k = 0; k < model.observers[i].cells.size(); ++k) {
            fit.cellLocations.back().push_back(likelihood.cellLocation(i, k));
        }
    }
}

// The covariance of b and ln beta from the Hessian of everything but tau and omega. A lapse rate
// whose likelihood is too flat to have a curvature is held, which is said.
void addCovariance(MarginalLikelihood& likelihood, const FitOptions& options, const Layout& layout,
                   const VectorXd& x, const VectorXd& scale, std::vector<int> free,
                   RandomObserverFit& fit) {
    std::erase_if(free, [&](int index) { return index >= layout.tau; });
    MatrixXd hessian = scaledHessian(likelihood, options.form, x, scale, free, fit.evaluations);
    const Eigen::Index named = options.estimateCurve ? layout.lapse : layout.beta;
    if (hessian.rows() > named && hessian.llt().info() != Eigen::Success) {
        hessian = hessian.topLeftCorner(named, named).eval();
        fit.message = "lapse rate held for the intervals: the likelihood is flat in it";
    }
    const Eigen::LLT<MatrixXd> factor(hessian);
    if (hessian.size() == 0 || factor.info() != Eigen::Success) {
        fit.converged = false;
        fit.message = "the likelihood does not fall off in every direction at the estimate";
        return;
    }
    const MatrixXd inverse = factor.solve(MatrixXd::Identity(hessian.rows(), hessian.cols()));
    const VectorXd unit = scale.head(named);
    fit.covariance = unit.asDiagonal() * inverse.topLeftCorner(named, named) * unit.asDiagonal();
}

int observerCount(const Model& model) {
    int count = 0;
    for (const ModelObserver& observer : model.observers) count += observer.copies;
    return count;
}

}  // namespace

RandomObserverFit fitRandomObservers(const Model& model, const ModelParameters& start,
                                     const FitOptions& options) {
    MarginalLikelihood likelihood(model);
    RandomObserverFit fit;
    // Without tau observers cannot be told from what the design tells apart: as one observer.
    fit.observers = options.estimateTau ? observerCount(model) : 1;
    fit.parameters = start;
    const Layout layout(model);
    const VectorXd scale = coordinateScale(layout);
    Search best = searchFrom(start, likelihood, options, layout, scale, fit.evaluations);
    // Few lapses and a shallow curve, or more of them and a steeper one: small studies may have a
    // maximum at each.
    if (best.lapseAtBound || !best.converged) {
        ModelParameters again = best.converged ? fromCoordinates(best.x, model) : start;
        again.lapse = kSecondLapse;
        if (options.estimateTau) again.tau = std::max(again.tau, kScaleOfSpread);
        if (options.estimateOmega) again.omega = std::max(again.omega, kScaleOfSpread);
        Search other = startOfSearch(again, options, layout);
        other.inverseHessian = wholeInverseHessian(best, layout)(other.free, other.free);
        climb(likelihood, options, layout, scale, kApproach, other, fit.evaluations);
        if (!best.converged || !other.converged ||
            std::abs(lapseOf(other, layout) - lapseOf(best, layout)) > kSameLapse) {
            finish(likelihood, options, layout, scale, other, fit.evaluations);
            if (other.converged && (!best.converged || other.value > best.value)) best = other;
        }
    }
    fit.converged = best.converged;
    fit.message = best.message;
    fit.lapseAtBound = best.lapseAtBound;
    fit.tauAtZero = best.tauAtZero;
    fit.omegaAtZero = best.omegaAtZero;
    fit.inverseHessian = wholeInverseHessian(best, layout);
    likelihood.use(Quadrature::fine);
    if (fit.converged) likelihood.adapt(best.x);
    if (fit.converged && options.covariance) {
        addCovariance(likelihood, options, layout, best.x, scale, best.free, fit);
    }
    VectorXd gradient;
    fit.logLikelihood = likelihood.evaluate(best.x, options.form, &gradient);
    ++fit.evaluations;
    if (!std::isfinite(fit.logLikelihood)) {
        fit.converged = false;
        fit.message = "the likelihood is not finite at the estimate";
        return fit;
    }
    fit.parameters = fromCoordinates(best.x, model);
    fit.fixedInformation = likelihood.fixedInformation();
    if (options.covariance) fit.spread = likelihood.spreadInformation();
    keepEffects(model, likelihood, fit);
    return fit;
}

double satterthwaite(const RandomObserverFit& fit, const VectorXd& weights) {
    const double fewest = fit.observers - 1;
    if (fit.spread.perTau2.size() == 0) return fewest;
    const VectorXd solved = fit.fixedInformation.ldlt().solve(weights);
    const double variance = weights.dot(solved);
    const Eigen::Vector2d slope(solved.dot(fit.spread.perTau2 * solved),
                                solved.dot(fit.spread.perOmega2 * solved));
    // Where one of the two cannot be told (one condition, say) its information is 0.
    Eigen::Matrix2d information = fit.spread.information;
    double spread = 0;
    if (information.determinant() > 1e-12 * information(0, 0) * information(1, 1)) {
        spread = slope.dot(information.inverse() * slope);
    } else if (information(0, 0) > 0) {
        spread = slope[0] * slope[0] / information(0, 0);
    }
    if (!(spread > 0)) return fewest;
    return std::max(fewest, 2 * variance * variance / spread);
}

LinearEstimate linearEstimate(const RandomObserverFit& fit, const VectorXd& weights) {
    LinearEstimate estimate;
    estimate.value = weights.dot(fit.parameters.fixed);
    if (fit.covariance.size() == 0) return estimate;
    const auto n = weights.size();
    estimate.standardError = std::sqrt(weights.dot(fit.covariance.topLeftCorner(n, n) * weights));
    if (fit.observers >= 2) estimate.degreesOfFreedom = satterthwaite(fit, weights);
    return estimate;
}

std::optional<records::Interval> LinearEstimate::ci95() const {
    if (!(degreesOfFreedom > 0) || !(standardError > 0)) return std::nullopt;
    const double half = studentQuantile(0.975, degreesOfFreedom) * standardError;
    return records::Interval{value - half, value + half};
}

std::ostream& operator<<(std::ostream& out, const RandomObserverFit& fit) {
    out << (fit.converged ? "converged" : "not converged: " + fit.message) << "; ln L "
        << fit.logLikelihood << ", " << fit.evaluations << " evaluations; beta";
    for (const double beta : fit.parameters.beta) out << ' ' << beta;
    out << ", lapse " << fit.parameters.lapse << (fit.lapseAtBound ? " (on its bound)" : "")
        << ", tau " << fit.parameters.tau << (fit.tauAtZero ? " (none found)" : "") << ", omega "
        << fit.parameters.omega << (fit.omegaAtZero ? " (none found)" : "");
    return out;
}

}  // namespace analysis
