// SPDX-License-Identifier: MIT
#include "analysis/marginal_likelihood.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

namespace analysis {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kMostModeSteps = 200;
// Newton's decrement (twice the log-likelihood still to gain) that is near enough for a centre.
constexpr double kModeReached = 1e-6;
// On a slope, per log10 units squared: a thousandth of what ten trials at the threshold say.
constexpr double kLeastInformation = 0.1;
constexpr std::size_t kFinePoints[] = {5, 7}, kCoarsePoints[] = {3, 4};  // observer, cell

double square(double v) {
    return v * v;
}

double lapseAt(double angle) {
    return kLapseFloor + (kLapseLimit - kLapseFloor) * square(std::sin(angle));
}

double lapseSlope(double angle) {
    return (kLapseLimit - kLapseFloor) * std::sin(2.0 * angle);
}

double logPrior(const ModelParameters& at) {
    double sum = (kLapsePriorB - 1.0) * std::log1p(-at.lapse);
    for (const double beta : at.beta) {
        sum -= 0.5 * square(std::log(beta / kBetaPriorCentre) / kBetaPriorLnSd);
    }
    return sum;
}

// Gauss-Hermite rule for the standard normal: G. H. Golub and J. H. Welsch, Math. Comp. 23 (1969).
// logWeight is relative to the density at the point: the integral of g is the sum of
// exp(logWeight) g(point).
struct HermiteRule {
    std::vector<double> point, logWeight;
};

HermiteRule hermiteRule(std::size_t count) {
    const auto n = static_cast<int>(count);
    MatrixXd jacobi = MatrixXd::Zero(n, n);
    for (int j = 1; j < n; ++j) jacobi(j, j - 1) = jacobi(j - 1, j) = std::sqrt(j);
    const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(jacobi);
    HermiteRule rule;
    for (int j = 0; j < n; ++j) {
        const double point = solver.eigenvalues()[j];
        rule.point.push_back(point);
        rule.logWeight.push_back(2 * std::log(std::abs(solver.eigenvectors()(0, j))) +
                                 0.5 * square(point));
    }
    return rule;
}

struct Rules {
    HermiteRule observer, cell;
};

const Rules& rulesOf(Quadrature quadrature) {
    static const Rules fine{hermiteRule(kFinePoints[0]), hermiteRule(kFinePoints[1])};
    static const Rules coarse{hermiteRule(kCoarsePoints[0]), hermiteRule(kCoarsePoints[1])};
    return quadrature == Quadrature::fine ? fine : coarse;
}

// Turns logarithms into weights that sum to one; returns the logarithm of their sum.
double normalise(std::vector<double>& logs) {
    const double largest = *std::max_element(logs.begin(), logs.end());
    double sum = 0;
    for (double& v : logs) sum += v = std::exp(v - largest);
    for (double& v : logs) v /= sum;
    return largest + std::log(sum);
}

}  // namespace

VectorXd toCoordinates(const ModelParameters& parameters) {
    const auto fixedCount = parameters.fixed.size();
    const auto betaCount = static_cast<Eigen::Index>(parameters.beta.size());
    VectorXd x(fixedCount + betaCount + 3);
    x.head(fixedCount) = parameters.fixed;
    for (Eigen::Index j = 0; j < betaCount; ++j) {
        x[fixedCount + j] = std::log(parameters.beta[static_cast<std::size_t>(j)]);
    }
    const double share = (parameters.lapse - kLapseFloor) / (kLapseLimit - kLapseFloor);
    x[fixedCount + betaCount] = std::asin(std::sqrt(std::clamp(share, 0.0, 1.0)));
    x[fixedCount + betaCount + 1] = parameters.tau;
    x[fixedCount + betaCount + 2] = parameters.omega;
    return x;
}

ModelParameters fromCoordinates(const VectorXd& x, const Model& model) {
    const auto fixedCount = model.design.cols();
    ModelParameters parameters;
    parameters.fixed = x.head(fixedCount);
    for (int j = 0; j < model.betaCount; ++j) {
        parameters.beta.push_back(std::exp(x[fixedCount + j]));
    }
    parameters.lapse = lapseAt(x[fixedCount + model.betaCount]);
    parameters.tau = std::abs(x[fixedCount + model.betaCount + 1]);
    parameters.omega = std::abs(x[fixedCount + model.betaCount + 2]);
    return parameters;
}

MarginalLikelihood::MarginalLikelihood(const Model& model) : model_(model) {
    for (const ModelObserver& observer : model.observers) {
        const std::size_t cells = observer.cells.size();
        Points points;
        for (auto* values : {&points.cell, &points.cellSlope, &points.cellSd, &points.curvature}) {
            values->assign(cells, 0.0);
        }
        points_.push_back(points);
        cellLocation_.emplace_back(cells, 0.0);
        observerEffect_.push_back(0.0);
    }
}

int MarginalLikelihood::coordinateCount() const {
    return static_cast<int>(model_.design.cols()) + model_.betaCount + 3;
}

Curve MarginalLikelihood::curve(std::size_t i, int condition, const ModelParameters& at) const {
    const ModelObserver& observer = model_.observers[i];
    const int betaIndex = model_.betaIndex[static_cast<std::size_t>(condition)];
    return {.beta = at.beta[static_cast<std::size_t>(betaIndex)],
            .criterion = model_.criterion,
            .response = {observer.gamma, at.lapse, observer.lapseGuess}};
}

double MarginalLikelihood::location(std::size_t i, std::size_t k, const ModelParameters& at,
                                    double bigU, double bigN) const {
    return model_.design.row(model_.observers[i].cells[k].condition).dot(at.fixed) + at.tau * bigU +
           at.omega * bigN;
}

// Newton's method in U and N_k; the Hessian is an arrow, solved in one pass over the cells. Off the
// mode the log-likelihood of a lapsing observer may curve upwards: there the prior's curvature
// alone makes the step. The first start is the centre of the prior, later ones the last mode.
bool MarginalLikelihood::findMode(std::size_t i, const ModelParameters& at) {
    const auto& cells = model_.observers[i].cells;
    const double tau = at.tau, omega = at.omega;
    Points& mode = points_[i];
    Points best = mode;
    std::vector<double> gradientCell(cells.size()), stepCell(cells.size());
    double stepObserver = 0, stepLength = 1, bestValue = -kInfinity;
    for (int iteration = 0; iteration < kMostModeSteps; ++iteration) {
        double value = -0.5 * square(mode.observer), gradientObserver = -mode.observer;
        for (std::size_t k = 0; k < cells.size(); ++k) {
            const LocationTerms terms =
                locationTerms(cells[k].trials, location(i, k, at, mode.observer, mode.cell[k]),
                              curve(i, cells[k].condition, at));
            value += terms.value - 0.5 * square(mode.cell[k]);
            gradientObserver += tau * terms.first;
            gradientCell[k] = omega * terms.first - mode.cell[k];
            mode.curvature[k] = std::max(0.0, -terms.second);
        }
        if (!(value >= bestValue - 1e-11 * std::abs(bestValue))) {
            stepLength /= 2;
            if (stepLength < 1e-9 || !std::isfinite(bestValue)) return false;
            mode.observer = best.observer + stepLength * stepObserver;
            for (std::size_t k = 0; k < cells.size(); ++k) {
                mode.cell[k] = best.cell[k] + stepLength * stepCell[k];
            }
            continue;
        }
        bestValue = value;
        best = mode;
        stepLength = 1;
        double schur = 1, rightSide = gradientObserver;
        for (std::size_t k = 0; k < cells.size(); ++k) {
            const double reduced = mode.curvature[k] / (1 + square(omega) * mode.curvature[k]);
            schur += square(tau) * reduced;
            rightSide -= tau * omega * reduced * gradientCell[k];
        }
        stepObserver = rightSide / schur;
        double decrement = stepObserver * gradientObserver;
        for (std::size_t k = 0; k < cells.size(); ++k) {
            stepCell[k] = (gradientCell[k] - tau * omega * mode.curvature[k] * stepObserver) /
                          (1 + square(omega) * mode.curvature[k]);
            decrement += stepCell[k] * gradientCell[k];
        }
        if (decrement < kModeReached) return true;
        mode.observer += stepObserver;
        for (std::size_t k = 0; k < cells.size(); ++k) mode.cell[k] += stepCell[k];
    }
    return false;
}

void MarginalLikelihood::placePoints(std::size_t i, const ModelParameters& at) {
    const auto& cells = model_.observers[i].cells;
    Points& points = points_[i];
    points.information = 0;
    points.rows = VectorXd::Zero(model_.design.cols());
    for (std::size_t k = 0; k < cells.size(); ++k) {
        const double w = points.curvature[k] / (1 + square(at.omega) * points.curvature[k]);
        points.information += w;
        points.rows += w * model_.design.row(cells[k].condition).transpose();
    }
    const double precision = 1 + square(at.tau) * points.information;
    points.score = at.tau > 0 ? points.observer * precision / at.tau : 0;
    points.observerSd = 1 / std::sqrt(precision);
    for (std::size_t k = 0; k < cells.size(); ++k) {
        const double t = 1 / (1 + square(at.omega) * points.curvature[k]);
        points.cellSd[k] = std::sqrt(t);
        points.cellSlope[k] = -at.tau * at.omega * points.curvature[k] * t;
    }
}

bool MarginalLikelihood::adapt(const VectorXd& x) {
    if (!x.allFinite()) return false;
    const ModelParameters at = fromCoordinates(x, model_);
    adaptedFixed_ = at.fixed;
    for (std::size_t i = 0; i < model_.observers.size(); ++i) {
        if (!findMode(i, at)) {
            // The last mode may have led astray; once more from the centre of the prior.
            points_[i].observer = 0;
            std::fill(points_[i].cell.begin(), points_[i].cell.end(), 0.0);
            if (!findMode(i, at)) return false;
        }
        placePoints(i, at);
    }
    return true;
}

// ln of the integral over u_i of the product over k of the integrals over v_ik. Its derivatives are
// those of l, averaged over the posterior of the points (R. A. Fisher's identity).
double MarginalLikelihood::integrate(std::size_t i, const ModelParameters& at, VectorXd* gradient) {
    const auto& cells = model_.observers[i].cells;
    const Points& points = points_[i];
    const HermiteRule& outer = rulesOf(quadrature_).observer;
    const HermiteRule& inner = rulesOf(quadrature_).cell;
    const std::size_t outers = outer.point.size(), inners = inner.point.size();
    for (auto* values : {&logOuter_, &bigU_}) values->resize(outers);
    for (auto* values : {&bigN_, &y_}) values->resize(outers * inners);
    weight_.resize(inners);
    means_.assign(gradient ? cells.size() * outers : 0, {});
    const double variance = 1 / (1 + square(at.tau) * points.information);
    const double sd = std::sqrt(variance);
    const double score = points.score - points.rows.dot(at.fixed - adaptedFixed_);
    for (std::size_t a = 0; a < outers; ++a) {
        bigU_[a] = at.tau * score * variance + sd * outer.point[a];
        logOuter_[a] = outer.logWeight[a] + std::log(sd) - 0.5 * square(bigU_[a]);
    }
    for (std::size_t k = 0; k < cells.size(); ++k) {
        const double centre = location(i, k, at, 0, 0), logSd = std::log(points.cellSd[k]);
        for (std::size_t a = 0; a < outers; ++a) {
            for (std::size_t j = 0; j < inners; ++j) {
                const std::size_t p = a * inners + j;
                bigN_[p] = points.cell[k] +
                           points.cellSlope[k] * points.observerSd * outer.point[a] +
                           points.cellSd[k] * inner.point[j];
                y_[p] = centre + at.tau * bigU_[a] + at.omega * bigN_[p];
            }
        }
        cellPoints_.evaluate(cells[k].trials, curve(i, cells[k].condition, at), y_);
        for (std::size_t a = 0; a < outers; ++a) {
            for (std::size_t j = 0; j < inners; ++j) {
                const std::size_t p = a * inners + j;
                weight_[j] =
                    inner.logWeight[j] + logSd - 0.5 * square(bigN_[p]) + cellPoints_.value[p];
            }
            logOuter_[a] += normalise(weight_);
            if (!gradient) continue;
            Mean& mean = means_[k * outers + a];
            for (std::size_t j = 0; j < inners; ++j) {
                const std::size_t p = a * inners + j;
                mean.y += weight_[j] * y_[p];
                mean.perY += weight_[j] * cellPoints_.perY[p];
                mean.perYN += weight_[j] * cellPoints_.perY[p] * bigN_[p];
                mean.perLnBeta += weight_[j] * cellPoints_.perLnBeta[p];
                mean.perLapse += weight_[j] * cellPoints_.perLapse[p];
            }
        }
    }
    const double copies = model_.observers[i].copies;
    const double value = copies * normalise(logOuter_);
    if (!gradient) return value;

    const auto fixedCount = model_.design.cols();
    const auto lapseIndex = fixedCount + model_.betaCount;
    observerEffect_[i] = 0;
    double perU = 0, perTau = -at.tau * points.information * variance;  // by way of the points
    for (std::size_t a = 0; a < outers; ++a) {
        observerEffect_[i] += logOuter_[a] * at.tau * bigU_[a];
        double own = -bigU_[a];
        for (std::size_t k = 0; k < cells.size(); ++k) {
            own += at.tau * means_[k * outers + a].perY;
        }
        perU += logOuter_[a] * own;
        perTau += logOuter_[a] * own *
                  (score * variance * (2 * variance - 1) -
                   at.tau * points.information * variance * sd * outer.point[a]);
    }
    (*gradient)[lapseIndex + 1] += copies * perTau;
    gradient->head(fixedCount) -= copies * perU * at.tau * variance * points.rows;
    for (std::size_t k = 0; k < cells.size(); ++k) {
        double perY = 0, perLnBeta = 0;
        cellLocation_[i][k] = 0;
        for (std::size_t a = 0; a < outers; ++a) {
            const Mean& mean = means_[k * outers + a];
            cellLocation_[i][k] += logOuter_[a] * mean.y;
            const double weight = copies * logOuter_[a];
            perY += weight * mean.perY;
            perLnBeta += weight * mean.perLnBeta;
            (*gradient)[lapseIndex] += weight * mean.perLapse;
            (*gradient)[lapseIndex + 1] += weight * mean.perY * bigU_[a];
            (*gradient)[lapseIndex + 2] += weight * mean.perYN;
        }
        const int condition = cells[k].condition;
        gradient->head(fixedCount) += perY * model_.design.row(condition).transpose();
        (*gradient)[fixedCount + model_.betaIndex[static_cast<std::size_t>(condition)]] +=
            perLnBeta;
    }
    return value;
}

// One observer of the linear mixed model with the curvatures w_k as weights: M = (1/W + V)^-1 =
// diag(m) - s m m', V = omega^2 I + tau^2 1 1'.
struct MarginalLikelihood::Mixed {
    VectorXd m;
    double s, bigS;  // s = tau^2 / S, S = 1 + tau^2 sum m; M 1 = m / S
    VectorXd xm;     // X' m

    MatrixXd timesM(const MatrixXd& of) const {
        return m.asDiagonal() * of - s * m * (m.transpose() * of);
    }
};

MarginalLikelihood::Mixed MarginalLikelihood::mixed(std::size_t i,
                                                    const ModelParameters& at) const {
    const auto& cells = model_.observers[i].cells;
    Mixed mixed;
    mixed.m.resize(static_cast<Eigen::Index>(cells.size()));
    mixed.xm = VectorXd::Zero(model_.design.cols());
    for (std::size_t k = 0; k < cells.size(); ++k) {
        const double w = points_[i].curvature[k];
        const double m = w / (1 + square(at.omega) * w);
        mixed.m[static_cast<Eigen::Index>(k)] = m;
        mixed.xm += m * model_.design.row(cells[k].condition).transpose();
    }
    mixed.bigS = 1 + square(at.tau) * mixed.m.sum();
    mixed.s = square(at.tau) / mixed.bigS;
    return mixed;
}

// - 1/2 ln det J, and its slopes in tau and omega: with J = sum X' M X, dJ / d tau^2 =
// -sum X' M 1 1' M X and dJ / d omega^2 = -sum X' M M X.
double MarginalLikelihood::restriction(const ModelParameters& at, VectorXd* gradient) {
    const auto fixedCount = model_.design.cols();
    std::vector<Mixed> all;
    // Sum over observers of m_k, m_k^2 by condition: X' diag(.) X is cheap from these.
    VectorXd m = VectorXd::Zero(model_.design.rows()), m2 = m;
    for (std::size_t i = 0; i < model_.observers.size(); ++i) {
        all.push_back(mixed(i, at));
        const auto& cells = model_.observers[i].cells;
        const double copies = model_.observers[i].copies;
        for (std::size_t k = 0; k < cells.size(); ++k) {
            const double mk = all.back().m[static_cast<Eigen::Index>(k)];
            m[cells[k].condition] += copies * mk;
            m2[cells[k].condition] += copies * mk * mk;
        }
    }
    const auto squareForm = [&](const VectorXd& weights) {
        return MatrixXd(model_.design.transpose() * weights.asDiagonal() * model_.design);
    };
    information_ = squareForm(m);
    for (std::size_t i = 0; i < all.size(); ++i) {
        information_ -= model_.observers[i].copies * all[i].s * all[i].xm * all[i].xm.transpose();
    }
    Eigen::LLT<MatrixXd> factor(information_);
    if (factor.info() != Eigen::Success) {
        // Where a search begins a condition's likelihood may curve upwards and say nothing of b.
        information_.diagonal().array() += kLeastInformation;
        factor.compute(information_);
        if (factor.info() != Eigen::Success) return kNaN;
    }
    if (gradient) {
        const MatrixXd inverse = factor.solve(MatrixXd::Identity(fixedCount, fixedCount));
        double perTau2 = 0, perOmega2 = inverse.cwiseProduct(squareForm(m2)).sum();
        for (std::size_t i = 0; i < all.size(); ++i) {
            const Mixed& one = all[i];
            const VectorXd solved = inverse * one.xm;
            const double leverage = one.xm.dot(solved);
            double cross = 0;
            for (std::size_t k = 0; k < model_.observers[i].cells.size(); ++k) {
                cross += square(one.m[static_cast<Eigen::Index>(k)]) *
                         model_.design.row(model_.observers[i].cells[k].condition).dot(solved);
            }
            const double copies = model_.observers[i].copies;
            perTau2 += copies * leverage / square(one.bigS);
            perOmega2 +=
                copies * (-2 * one.s * cross + square(one.s) * one.m.squaredNorm() * leverage);
        }
        const auto tauIndex = fixedCount + model_.betaCount + 1;
        (*gradient)[tauIndex] += at.tau * perTau2;
        (*gradient)[tauIndex + 1] += at.omega * perOmega2;
    }
    return -factor.matrixLLT().diagonal().array().log().sum();
}

double MarginalLikelihood::evaluate(const VectorXd& x, LikelihoodForm form, VectorXd* gradient) {
    if (!x.allFinite()) return kNaN;
    last_ = fromCoordinates(x, model_);
    const auto fixedCount = model_.design.cols();
    const auto lapseIndex = fixedCount + model_.betaCount;
    if (gradient) *gradient = VectorXd::Zero(x.size());
    double value = logPrior(last_);
    for (std::size_t i = 0; i < model_.observers.size(); ++i) {
        value += integrate(i, last_, gradient);
        if (!std::isfinite(value)) return kNaN;
    }
    const bool restricted = form == LikelihoodForm::restricted;
    const double extra = restriction(last_, restricted ? gradient : nullptr);
    if (restricted) value += extra;
    if (!gradient || !std::isfinite(value)) return value;

    for (int j = 0; j < model_.betaCount; ++j) {
        (*gradient)[fixedCount + j] -=
            std::log(last_.beta[static_cast<std::size_t>(j)] / kBetaPriorCentre) /
            square(kBetaPriorLnSd);
    }
    (*gradient)[lapseIndex] -= (kLapsePriorB - 1.0) / (1.0 - last_.lapse);
    (*gradient)[lapseIndex] *= lapseSlope(x[lapseIndex]);
    // tau and omega were differentiated as absolute values.
    for (const auto spread : {lapseIndex + 1, lapseIndex + 2}) {
        if (x[spread] < 0) (*gradient)[spread] *= -1;
    }
    return value;
}

MarginalLikelihood::SpreadInformation MarginalLikelihood::spreadInformation() const {
    const auto fixedCount = model_.design.cols();
    const MatrixXd inverse = information_.ldlt().solve(MatrixXd::Identity(fixedCount, fixedCount));
    // tr(P A P B) / 2 with P = M - M X J^-1 X' M, for A, B in {1 1' (tau^2), I (omega^2)}.
    double tt = 0, tw = 0, ww = 0;
    MatrixXd kTau = MatrixXd::Zero(fixedCount, fixedCount), kOmega = kTau;
    MatrixXd cubeTT = kTau, cubeTW = kTau, cubeWW = kTau;  // X' M A M B M X
    for (std::size_t i = 0; i < model_.observers.size(); ++i) {
        const auto& cells = model_.observers[i].cells;
        const Mixed one = mixed(i, last_);
        MatrixXd x(one.m.size(), fixedCount);
        for (std::size_t k = 0; k < cells.size(); ++k) {
            x.row(static_cast<Eigen::Index>(k)) = model_.design.row(cells[k].condition);
        }
        const MatrixXd mx = one.timesM(x);
        const VectorXd mOne = one.m / one.bigS;
        const VectorXd xmOne = one.xm / one.bigS;
        const double sum2 = one.m.squaredNorm();
        const double copies = model_.observers[i].copies;
        tt += copies * square(mOne.sum());
        tw += copies * mOne.squaredNorm();
        ww += copies * (sum2 - 2.0 * one.s * one.m.array().cube().sum() + square(one.s * sum2));
        kTau += copies * xmOne * xmOne.transpose();
        kOmega += copies * mx.transpose() * mx;
        cubeTT += copies * mOne.sum() * xmOne * xmOne.transpose();
        cubeTW += copies * xmOne * (mOne.transpose() * mx);
        cubeWW += copies * mx.transpose() * one.timesM(mx);
    }
    const auto correction = [&](const MatrixXd& cube, const MatrixXd& kA, const MatrixXd& kB) {
        return -2.0 * (inverse * cube).trace() + (inverse * kA * inverse * kB).trace();
    };
    tt += correction(cubeTT, kTau, kTau);
    tw += correction(cubeTW, kTau, kOmega);
    ww += correction(cubeWW, kOmega, kOmega);
    SpreadInformation result;
    result.information << 0.5 * tt, 0.5 * tw, 0.5 * tw, 0.5 * ww;
    result.perTau2 = kTau;
    result.perOmega2 = kOmega;
    return result;
}

}  // namespace analysis
