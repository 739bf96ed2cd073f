// SPDX-License-Identifier: MIT
#include "analysis/observer_bootstrap.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "analysis/parallel.h"
#include "quest/random.h"

namespace analysis {
namespace {

constexpr double kLeastLapse = 0.005, kMostLapse = 0.145;  // off the bounds, where searches start
constexpr double kLeastSpread = 0.01;
constexpr int kFailuresAllowed = 20;  // one draw in so many

struct Draw {
    bool converged = false;
    double largest = 0, ninetieth = 0, mean = 0;
};

Draw refitted(const Model& model, const RandomObserverFit& fit, const Eigen::MatrixXd& targets,
              std::mt19937_64& rng) {
    Model drawn = model;
    for (ModelObserver& observer : drawn.observers) observer.copies = 0;
    for (std::size_t i = 0; i < model.observers.size(); ++i) {
        ++drawn.observers[quest::uniformBelow(rng, model.observers.size())].copies;
    }
    std::erase_if(drawn.observers, [](const ModelObserver& one) { return one.copies == 0; });
    ModelParameters start = fit.parameters;
    start.lapse = std::clamp(start.lapse, kLeastLapse, kMostLapse);
    const bool spreadOfCells = fit.parameters.omega > 0 || fit.omegaAtZero;
    start.tau = std::max(start.tau, kLeastSpread);
    if (spreadOfCells) start.omega = std::max(start.omega, kLeastSpread);
    const RandomObserverFit again = fitRandomObservers(drawn, start,
                                                       {.estimateOmega = spreadOfCells,
                                                        .covariance = false,
                                                        .inverseHessian = fit.inverseHessian});
    Draw draw{.converged = again.converged};
    if (!draw.converged) return draw;
    const Eigen::VectorXd slopes = targets * again.parameters.fixed;
    draw.largest = slopes.maxCoeff();
    draw.ninetieth = draw.largest + kPercentile90 * again.parameters.tau;
    draw.mean = slopes.mean();
    return draw;
}

records::Interval percentiles(const std::vector<Draw>& draws, double Draw::*what, double less) {
    std::vector<double> values;
    for (const Draw& draw : draws) {
        if (draw.converged) values.push_back(draw.*what - less);
    }
    std::sort(values.begin(), values.end());
    const auto at = [&](double p) {
        return values[static_cast<std::size_t>(
            std::lround(p * static_cast<double>(values.size() - 1)))];
    };
    return {at(0.025), at(0.975)};
}

}  // namespace

ObserverBootstrap bootstrapObservers(const Model& model, const RandomObserverFit& fit,
                                     const Eigen::MatrixXd& targets, const WorstGroup& headline,
                                     int draws, std::uint64_t seed, int threads,
                                     const std::function<void()>& done) {
    ObserverBootstrap result{.draws = draws, .headline = {}, .ninetieth = {}, .overall = {}};
    if (model.observers.size() < 2 || !fit.converged) return result;
    std::vector<Draw> drawn(static_cast<std::size_t>(draws));
    inParallel(drawn.size(), threads, [&](std::size_t d) {
        std::seed_seq sequence{seed, static_cast<std::uint64_t>(d)};
        std::mt19937_64 rng(sequence);
        drawn[d] = refitted(model, fit, targets, rng);
        if (done) done();
    });
    for (const Draw& draw : drawn) result.failed += draw.converged ? 0 : 1;
    if (result.failed * kFailuresAllowed > draws) return result;
    result.headline = percentiles(drawn, &Draw::largest, headline.biasCorrection);
    result.ninetieth = percentiles(drawn, &Draw::ninetieth, headline.biasCorrection);
    result.overall = percentiles(drawn, &Draw::mean, 0);
    return result;
}

}  // namespace analysis
