// SPDX-License-Identifier: MIT
#include "tests/analysis/coverage.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <mutex>
#include <thread>

#include "analysis/slope_analysis.h"

namespace tests {
namespace {

bool contains(const std::optional<records::Interval>& interval, double truth) {
    return interval && interval->low <= truth && truth <= interval->high;
}

struct Truth {
    double worst = -1e9, mean = 0;
};

// The largest slope that a plan's study can show: over its sizes where kappa bends the law.
Truth truthOf(const StudyPlan& plan) {
    Truth truth;
    for (const SimulatedGroup& group : plan.groups) {
        truth.mean += group.log10c / static_cast<double>(plan.groups.size());
        for (const double size : plan.sizes) {
            truth.worst =
                std::max(truth.worst, group.log10c + (plan.kappa - 1) * std::log10(size / 10));
        }
    }
    return truth;
}

}  // namespace

StudyOutcome fitOne(const StudyPlan& plan, std::uint64_t seed) {
    const analysis::Study study = simulateStudy(plan, seed);
    const Truth truth = truthOf(plan);
    analysis::AnalysisOptions options;
    options.comparisons = false;
    const auto start = std::chrono::steady_clock::now();
    const analysis::SlopeAnalysis result = analysis::analyseSlope(study, options);
    StudyOutcome outcome;
    outcome.seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    const analysis::SlopeResult& slope = result.slope;
    outcome.fitted = slope.law.converged && slope.headline.ci95.has_value();
    outcome.headlineCovered = contains(slope.headline.ci95, truth.worst);
    outcome.overallCovered = contains(result.overall.ci95(), truth.mean);
    outcome.covered90 =
        contains(slope.headline.ci95For90, truth.worst + analysis::kPercentile90 * plan.tau);
    if (slope.kappa) outcome.kappaCovered = contains(slope.kappa->ci95(), plan.kappa);
    outcome.kappaRejected = slope.lawRejected;
    outcome.headlineError = slope.headline.value - truth.worst;
    outcome.overallError = result.overall.value - truth.mean;
    outcome.error90 = slope.headline.value90 - truth.worst - analysis::kPercentile90 * plan.tau;
    outcome.tau = slope.law.parameters.tau;
    outcome.omega = slope.law.parameters.omega;
    outcome.beta = slope.law.parameters.beta.front();
    return outcome;
}

std::vector<StudyOutcome> fitMany(const StudyPlan& plan, int studies, int threads,
                                  std::uint64_t seed, const std::function<void()>& done) {
    std::vector<StudyOutcome> outcomes(static_cast<std::size_t>(studies));
    std::atomic<std::size_t> next = 0;
    std::mutex reporting;
    const auto work = [&] {
        for (std::size_t i = next++; i < outcomes.size(); i = next++) {
            std::seed_seq sequence{seed, static_cast<std::uint64_t>(i)};
            std::mt19937_64 seeds(sequence);
            outcomes[i] = fitOne(plan, seeds());
            const std::lock_guard lock(reporting);
            if (done) done();
        }
    };
    std::vector<std::thread> others;
    for (int t = 1; t < threads; ++t) others.emplace_back(work);
    work();
    for (std::thread& other : others) other.join();
    return outcomes;
}

double share(const std::vector<StudyOutcome>& outcomes, bool StudyOutcome::*what) {
    const auto count = std::count_if(outcomes.begin(), outcomes.end(),
                                     [what](const StudyOutcome& one) { return one.*what; });
    return static_cast<double>(count) / static_cast<double>(outcomes.size());
}

double median(const std::vector<StudyOutcome>& outcomes, double StudyOutcome::*what) {
    std::vector<double> values;
    for (const StudyOutcome& one : outcomes) values.push_back(one.*what);
    std::sort(values.begin(), values.end());
    const std::size_t half = values.size() / 2;
    return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

double standardDeviation(const std::vector<StudyOutcome>& outcomes, double StudyOutcome::*what) {
    double sum = 0, squares = 0;
    for (const StudyOutcome& one : outcomes) sum += one.*what;
    const auto n = static_cast<double>(outcomes.size());
    for (const StudyOutcome& one : outcomes) squares += std::pow(one.*what - sum / n, 2);
    return std::sqrt(squares / (n - 1));
}

std::vector<StudyPlan> coveragePlans() {
    const auto equal = fourGroups(0.54, 0.54, 0.54, 0.54);
    const auto unequal = fourGroups(0.44, 0.42, 0.54, 0.52);
    const std::vector<SimulatedGroup> two = {{records::Pattern::stair, 1, 0.44},
                                             {records::Pattern::step, 1, 0.54}};
    const std::vector<SimulatedGroup> twoEqual = {{records::Pattern::stair, 1, 0.54},
                                                  {records::Pattern::step, 1, 0.54}};
    return {
        {.name = "small, 1 group: 6 x 4 x 30", .observers = 6, .trials = 30},
        {.name = "small, 2 equal groups: 6 x 4 x 30",
         .observers = 6,
         .groups = twoEqual,
         .sizes = {10, 20},
         .trials = 30},
        {.name = "small, 2 unequal groups: 6 x 4 x 30",
         .observers = 6,
         .groups = two,
         .sizes = {10, 20},
         .trials = 30},
        {.name = "small, 4 equal groups: 5 x 8 x 20",
         .observers = 5,
         .groups = equal,
         .sizes = {10, 20},
         .trials = 20},
        {.name = "small, 4 unequal groups: 5 x 8 x 20",
         .observers = 5,
         .groups = unequal,
         .sizes = {10, 20},
         .trials = 20},
        {.name = "small, 1 size: 6 x 2 x 40", .observers = 6, .groups = two, .sizes = {10}},
        {.name = "small yes/no, 2 groups: 8 x 4 x 30",
         .observers = 8,
         .groups = two,
         .sizes = {10, 20},
         .trials = 30,
         .yesNo = true},
        {.name = "16 conditions, equal: 10 x 16 x 40", .groups = equal},
        {.name = "16 conditions, unequal: 10 x 16 x 40", .groups = unequal},
        {.name = "beta 2, lapses 4 %: 10 x 16 x 40", .groups = equal, .beta = 2, .lapse = 0.04},
        {.name = "20 observers, 20 trials: 20 x 16 x 20",
         .observers = 20,
         .groups = equal,
         .trials = 20},
        {.name = "5 observers, 80 trials: 5 x 16 x 80",
         .observers = 5,
         .groups = equal,
         .trials = 80},
        {.name = "no spread: 10 x 16 x 40", .groups = equal, .tau = 0, .omega = 0},
        {.name = "no spread, unequal: 10 x 16 x 40", .groups = unequal, .tau = 0, .omega = 0},
        {.name = "kappa .9: 10 x 16 x 40", .groups = equal, .kappa = 0.9},
    };
}

}  // namespace tests
