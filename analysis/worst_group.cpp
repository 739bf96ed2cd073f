// SPDX-License-Identifier: MIT
#include "analysis/worst_group.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "analysis/distributions.h"
#include "quest/random.h"

namespace analysis {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// G. Marsaglia and W. W. Tsang, "A simple method for generating gamma variables", ACM Trans. Math.
// Softw. 26 (2000).
double gammaDraw(double shape, std::mt19937_64& rng) {
    if (shape < 1) {
        const double u = 1 - quest::uniform01(rng);
        return gammaDraw(shape + 1, rng) * std::pow(u, 1 / shape);
    }
    const double d = shape - 1.0 / 3, c = 1 / std::sqrt(9 * d);
    while (true) {
        const double z = quest::standardNormal(rng);
        const double v = std::pow(1 + c * z, 3);
        const double u = 1 - quest::uniform01(rng);
        if (v > 0 && std::log(u) < 0.5 * z * z + d - d * v + d * std::log(v)) return d * v;
    }
}

// L with L L' = covariance, for one that may be singular (targets that share parameters).
MatrixXd squareRoot(const MatrixXd& covariance) {
    const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(covariance);
    return solver.eigenvectors() * solver.eigenvalues().cwiseMax(0).cwiseSqrt().asDiagonal();
}

// The estimates with the spread that remains after the sampling variance.
VectorXd withoutSamplingSpread(const VectorXd& estimates, const MatrixXd& covariance) {
    const auto n = estimates.size();
    if (n < 2) return estimates;
    const double mean = estimates.mean();
    const VectorXd off = estimates.array() - mean;
    const double found = off.squaredNorm() / static_cast<double>(n - 1);
    // Sampling variance of a contrast: tr(C Sigma C) / (n - 1), C the centring matrix.
    const double sampling = (covariance.trace() - covariance.sum() / static_cast<double>(n)) /
                            static_cast<double>(n - 1);
    const double kept = found > 0 ? std::sqrt(std::max(0.0, found - sampling) / found) : 0;
    return (kept * off).array() + mean;
}

double quantileOf(std::vector<double>& draws, double p) {
    const auto at = static_cast<std::ptrdiff_t>(p * static_cast<double>(draws.size() - 1));
    std::nth_element(draws.begin(), draws.begin() + at, draws.end());
    return draws[static_cast<std::size_t>(at)];
}

// What is known of the estimates.
struct Sample {
    VectorXd estimates;
    MatrixXd covariance;
    double df;  // of the largest
    int observers;
    double tau;
    Eigen::Index top;      // the largest
    Eigen::Index highest;  // the one whose own interval reaches highest
};

// Groups that may be the worst: not more than 3 standard errors below the largest estimate.
std::vector<bool> inQuestion(const Sample& sample) {
    std::vector<bool> contender;
    for (Eigen::Index j = 0; j < sample.estimates.size(); ++j) {
        const double variance = sample.covariance(sample.top, sample.top) +
                                sample.covariance(j, j) - 2 * sample.covariance(sample.top, j);
        const double below = sample.estimates[sample.top] - sample.estimates[j];
        contender.push_back(below <= 3 * std::sqrt(std::max(0.0, variance)));
    }
    return contender;
}

struct Draws {
    std::vector<double> plugInError;    // of the maximum, about the estimates drawn together
    std::vector<double> largestError;   // of any group in question
    std::vector<double> low90, high90;  // 90th-percentile observer at each end's worst case
};

// The variance v of a slope is tau^2 / observers + rest; an observer mean of squares gives it n - 1
// degrees of freedom, and its chi-squared redraws tau.
double redrawnTau(const Sample& sample, double shrink) {
    const double variance = sample.covariance(sample.top, sample.top);
    const double rest = std::max(0.0, variance - sample.tau * sample.tau / sample.observers);
    return std::sqrt(std::max(0.0, sample.observers * (variance / shrink - rest)));
}

Draws drawErrors(const Sample& sample, std::uint64_t seed) {
    const VectorXd truth = withoutSamplingSpread(sample.estimates, sample.covariance);
    const double trueMaximum = truth.maxCoeff();
    const MatrixXd root = squareRoot(sample.covariance);
    const std::vector<bool> contender = inQuestion(sample);
    const double fewest = sample.observers - 1;
    std::mt19937_64 rng(seed);
    Draws draws;
    VectorXd z(sample.estimates.size());
    const auto largest = [&](const VectorXd& noise) {
        double most = noise[sample.top];
        for (Eigen::Index j = 0; j < noise.size(); ++j) {
            if (contender[static_cast<std::size_t>(j)]) most = std::max(most, noise[j]);
        }
        return most;
    };
    for (int pair = 0; pair < kBootstrapDraws / 2; ++pair) {
        const double shrink = gammaDraw(sample.df / 2, rng) / (sample.df / 2);  // chi2 / df
        const double shrink90 = gammaDraw(fewest / 2, rng) / (fewest / 2);
        for (Eigen::Index j = 0; j < z.size(); ++j) z[j] = quest::standardNormal(rng);
        const double upTo90 = kPercentile90 * redrawnTau(sample, shrink90);
        for (const double sign : {1.0, -1.0}) {
            const VectorXd noise = sign * (root * z);
            const VectorXd scaled = noise / std::sqrt(shrink);
            draws.plugInError.push_back((truth + scaled).maxCoeff() - trueMaximum);
            draws.largestError.push_back(largest(scaled));
            draws.low90.push_back(sample.estimates[sample.top] -
                                  largest(noise) / std::sqrt(shrink90) + upTo90);
            draws.high90.push_back(sample.estimates[sample.highest] -
                                   noise[sample.highest] / std::sqrt(shrink90) + upTo90);
        }
    }
    return draws;
}

}  // namespace

WorstGroup worstGroup(const RandomObserverFit& fit, const MatrixXd& targets, std::uint64_t seed) {
    Sample sample{.estimates = targets * fit.parameters.fixed,
                  .covariance = {},
                  .df = 0,
                  .observers = fit.observers,
                  .tau = fit.parameters.tau,
                  .top = 0,
                  .highest = 0};
    WorstGroup worst;
    const double largest = sample.estimates.maxCoeff(&sample.top);
    worst.index = static_cast<int>(sample.top);
    worst.value = largest;
    const double upTo90 = kPercentile90 * fit.parameters.tau;
    worst.value90 = largest + upTo90;
    if (fit.covariance.size() == 0 || fit.observers < 2) return worst;

    const auto p = targets.cols();
    sample.covariance = targets * fit.covariance.topLeftCorner(p, p) * targets.transpose();
    sample.df = satterthwaite(fit, targets.row(sample.top).transpose());
    double upper = -std::numeric_limits<double>::infinity();
    for (Eigen::Index j = 0; j < targets.rows(); ++j) {
        const auto own = linearEstimate(fit, targets.row(j).transpose()).ci95();
        if (own && own->high > upper) {
            upper = own->high;
            sample.highest = j;
        }
    }
    Draws draws = drawErrors(sample, seed);
    if (targets.rows() == 1) {  // no maximum was taken
        worst.ci95 = linearEstimate(fit, targets.row(0).transpose()).ci95();
    } else {
        worst.biasCorrection = quantileOf(draws.plugInError, 0.5);
        worst.value = largest - worst.biasCorrection;
        worst.value90 = worst.value + upTo90;
        worst.ci95 = records::Interval{largest - quantileOf(draws.largestError, 0.975), upper};
    }
    worst.ci95For90 =
        records::Interval{quantileOf(draws.low90, 0.025), quantileOf(draws.high90, 0.975)};
    return worst;
}

}  // namespace analysis
