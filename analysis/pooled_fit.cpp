// SPDX-License-Identifier: MIT
#include "analysis/pooled_fit.h"

#include <ceres/ceres.h>

#include <cmath>
#include <ostream>
#include <stdexcept>

namespace analysis {
namespace {

// Below it the root's derivative would overflow: an answer this certain (ln P = -5e-13) says
// nothing more.
constexpr double kRootFloor = 1e-12;
// And above it -ln P itself would: an answer this unlikely says nothing more either.
constexpr double kMostSurprise = 600;

template <typename T>
T deviance(const T& negativeLog) {
    using std::sqrt;
    if (!(negativeLog < kMostSurprise)) return T(sqrt(2 * kMostSurprise));
    const T squared = 2.0 * negativeLog;
    return squared > kRootFloor ? T(sqrt(squared)) : T(sqrt(kRootFloor));
}

struct Trial {
    double strength;
    bool yes;
    double gamma, lapseGuess, criterion;
};

template <typename T>
quest::ResponseModelOf<T> response(const Trial& trial, const T& lapse) {
    return {T(trial.gamma), lapse, T(trial.lapseGuess)};
}

struct TrialDeviance {
    Trial trial;

    template <typename T>
    bool operator()(const T* log10c, const T* lnBeta, const T* lapse, T* residual) const {
        using std::exp;
        const T x = log10c[0] + trial.strength;
        const T beta = exp(lnBeta[0]);
        const auto model = response(trial, lapse[0]);
        residual[0] = deviance(T(-(trial.yes ? quest::logYes(x, beta, trial.criterion, model)
                                             : quest::logNo(x, beta, trial.criterion, model))));
        return true;
    }
};

// The same trial for the covariance: (y - p) with p0's standard deviation frozen.
struct FrozenWeight {
    Trial trial;
    double sd;

    template <typename T>
    bool operator()(const T* log10c, const T* lnBeta, const T* lapse, T* residual) const {
        using std::exp;
        const T x = log10c[0] + trial.strength;
        const T beta = exp(lnBeta[0]);
        const T p = quest::responseProbability(
            quest::detectionProbability(x, beta, trial.criterion), response(trial, lapse[0]));
        residual[0] = ((trial.yes ? 1.0 : 0.0) - p) / sd;
        return true;
    }
};

struct BetaPrior {
    template <typename T>
    bool operator()(const T* lnBeta, T* residual) const {
        residual[0] = (lnBeta[0] - std::log(kBetaPriorCentre)) / kBetaPriorLnSd;
        return true;
    }
};

struct LapsePrior {
    template <typename T>
    bool operator()(const T* lapse, T* residual) const {
        using std::log1p;
        residual[0] = deviance(T(-(kLapsePriorB - 1.0) * log1p(-lapse[0])));
        return true;
    }
};

struct Parameters {
    Eigen::VectorXd fixed;
    std::vector<double> lnBeta;
    double lapse;
};

template <typename Functor>
ceres::CostFunction* costFunction(const Functor& functor) {
    return new ceres::AutoDiffCostFunction<Functor, 1, 1, 1, 1>(new Functor(functor));
}

// The column of a condition's slope.
Eigen::Index slopeColumn(const Eigen::MatrixXd& design, int condition) {
    Eigen::Index column = 0;
    const auto row = design.row(condition);
    if (row.maxCoeff(&column) != 1.0 || row.cwiseAbs().sum() != 1.0) {
        throw std::invalid_argument("pooled fit: row " + std::to_string(condition) +
                                    " of the design: must be one slope and nothing else");
    }
    return column;
}

// add(trial, its slope, its ln beta)
template <typename Add>
void forEachTrial(const Model& model, Parameters& at, Add add) {
    for (const ModelObserver& observer : model.observers) {
        for (const ModelCell& cell : observer.cells) {
            double* log10c = &at.fixed[slopeColumn(model.design, cell.condition)];
            const int beta = model.betaIndex[static_cast<std::size_t>(cell.condition)];
            double* lnBeta = &at.lnBeta[static_cast<std::size_t>(beta)];
            for (std::size_t t = 0; t < cell.trials.strength.size(); ++t) {
                add(Trial{cell.trials.strength[t], t < cell.trials.yesCount, observer.gamma,
                          observer.lapseGuess, model.criterion},
                    log10c, lnBeta);
            }
        }
    }
}

void addPriors(ceres::Problem& problem, Parameters& at) {
    for (double& lnBeta : at.lnBeta) {
        problem.AddResidualBlock(new ceres::AutoDiffCostFunction<BetaPrior, 1, 1>(new BetaPrior),
                                 nullptr, &lnBeta);
    }
}

Eigen::MatrixXd frozenWeightCovariance(const Model& model, Parameters at, bool holdLapse) {
    ceres::Problem problem;
    forEachTrial(model, at, [&](const Trial& trial, double* log10c, double* lnBeta) {
        const quest::ResponseModel shape{trial.gamma, at.lapse, trial.lapseGuess};
        const double x = *log10c + trial.strength, beta = std::exp(*lnBeta);
        const double yes = quest::responseProbability(
            quest::detectionProbability(x, beta, trial.criterion), shape);
        const double no = std::exp(quest::logNo(x, beta, trial.criterion, shape));
        if (!(yes * no > 0)) return;  // a certain answer carries no information
        problem.AddResidualBlock(costFunction(FrozenWeight{trial, std::sqrt(yes * no)}), nullptr,
                                 log10c, lnBeta, &at.lapse);
    });
    addPriors(problem, at);
    std::vector<const double*> blocks;
    for (const double& log10c : at.fixed) blocks.push_back(&log10c);
    for (const double& lnBeta : at.lnBeta) blocks.push_back(&lnBeta);
    if (holdLapse) {
        problem.SetParameterBlockConstant(&at.lapse);
    } else {
        blocks.push_back(&at.lapse);
    }
    ceres::Covariance::Options options;
    options.algorithm_type = ceres::DENSE_SVD;
    options.num_threads = 1;
    ceres::Covariance covariance(options);
    if (!covariance.Compute(blocks, &problem)) return {};
    const auto n = static_cast<Eigen::Index>(blocks.size());
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> matrix(n, n);
    if (!covariance.GetCovarianceMatrix(blocks, matrix.data())) return {};
    return matrix;
}

}  // namespace

PooledFit fitPooled(const Model& model, const ModelParameters& start) {
    Parameters at{start.fixed, {}, start.lapse};
    for (const double beta : start.beta) at.lnBeta.push_back(std::log(beta));
    ceres::Problem problem;
    forEachTrial(model, at, [&](const Trial& trial, double* log10c, double* lnBeta) {
        problem.AddResidualBlock(costFunction(TrialDeviance{trial}), nullptr, log10c, lnBeta,
                                 &at.lapse);
    });
    addPriors(problem, at);
    problem.AddResidualBlock(new ceres::AutoDiffCostFunction<LapsePrior, 1, 1>(new LapsePrior),
                             nullptr, &at.lapse);
    problem.SetParameterLowerBound(&at.lapse, 0, kLapseFloor);
    problem.SetParameterUpperBound(&at.lapse, 0, kLapseLimit);

    ceres::Solver::Options options;
    options.linear_solver_type = ceres::DENSE_QR;
    options.num_threads = 1;  // more would not give the same digits each time
    options.max_num_iterations = 500;
    options.function_tolerance = 1e-16;
    options.gradient_tolerance = 1e-10;
    options.parameter_tolerance = 1e-12;
    options.logging_type = ceres::SILENT;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem, &summary);

    PooledFit fit;
    fit.converged = summary.termination_type == ceres::CONVERGENCE;
    fit.message = summary.message;
    fit.fixed = at.fixed;
    for (const double lnBeta : at.lnBeta) fit.beta.push_back(std::exp(lnBeta));
    fit.lapse = at.lapse;
    fit.lapseAtBound = at.lapse <= 2 * kLapseFloor || at.lapse >= kLapseLimit * (1 - 1e-9);
    fit.logLikelihood = -summary.final_cost;
    fit.iterations = static_cast<int>(summary.iterations.size());
    if (summary.IsSolutionUsable())
        fit.covariance = frozenWeightCovariance(model, at, fit.lapseAtBound);
    return fit;
}

std::ostream& operator<<(std::ostream& out, const PooledFit& fit) {
    out << (fit.converged ? "converged" : "not converged: " + fit.message) << " in "
        << fit.iterations << " iterations; ln L " << fit.logLikelihood << "; beta";
    for (const double beta : fit.beta) out << ' ' << beta;
    return out << ", lapse " << fit.lapse << (fit.lapseAtBound ? " (on its bound)" : "");
}

}  // namespace analysis
