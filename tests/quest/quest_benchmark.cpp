// SPDX-License-Identifier: MIT
// Cost of a trial, and what staircases recover over 20,000 simulated runs (the counters; the time
// of those rows is that of all runs together).
#include <benchmark/benchmark.h>

#include <cmath>
#include <random>
#include <vector>

#include "tests/quest/recovery.h"

namespace {

/// Answer in, next intensity out, over whole runs of `trials`; the counter is the time of one
/// trial.
void updateAndNextIntensity(benchmark::State& state) {
    const auto trials = static_cast<std::size_t>(state.range(0));
    const quest::Quest fresh(quest::kDefaultParameters);
    const quest::SimulatedObserver observer{.threshold = -0.6};
    std::mt19937_64 rng(1);
    std::vector<int> responses;
    quest::Quest rehearsal = fresh;
    while (responses.size() < trials) {
        const double x = rehearsal.quantile();
        responses.push_back(quest::answer(observer, x, rng) ? 1 : 0);
        rehearsal.update(x, responses.back());
    }
    for (auto _ : state) {
        quest::Quest staircase = fresh;
        for (const int response : responses) staircase.update(staircase.quantile(), response);
        benchmark::DoNotOptimize(staircase.pdf().data());
    }
    state.counters["candidates"] = static_cast<double>(fresh.pdf().size());
    state.counters["per_trial"] = benchmark::Counter(
        static_cast<double>(trials),
        benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
BENCHMARK(updateAndNextIntensity)->Arg(40)->Arg(10000);

void report(benchmark::State& state, const std::vector<double>& errors) {
    state.counters["robust_sd"] = recovery::robustSd(errors);
    state.counters["rmse"] = recovery::rootMeanSquare(errors);
    state.counters["bias"] = recovery::mean(errors);
    state.counters["runs"] = static_cast<double>(errors.size());
}

/// 2AFC, matched observer, prior sd 2, guess right. Goal: robust_sd <= .0555 / .035 at 40 / 80.
void recoveryWithVaguePrior(benchmark::State& state) {
    quest::QuestParameters staircase = quest::kPaperParameters;
    staircase.priorSd = 2;
    const recovery::Setting setting{.staircase = staircase,
                                    .observer = recovery::matchedObserver(staircase, 0),
                                    .trials = static_cast<int>(state.range(0))};
    std::vector<double> errors;
    for (auto _ : state) errors = recovery::errors(setting);
    report(state, errors);
}
BENCHMARK(recoveryWithVaguePrior)->Arg(40)->Arg(80)->Iterations(1)->Unit(benchmark::kMillisecond);

/// The shipped default, threshold twice (below: half) the guess. Goal: rmse <= .055 at 40 trials.
void recoveryWithDefaultPrior(benchmark::State& state, double offset) {
    const recovery::Setting setting{
        .staircase = quest::kDefaultParameters,
        .observer = recovery::matchedObserver(quest::kDefaultParameters, offset)};
    std::vector<double> errors;
    for (auto _ : state) errors = recovery::errors(setting);
    report(state, errors);
}
BENCHMARK_CAPTURE(recoveryWithDefaultPrior, threshold_twice_guess, std::log10(2.0))
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(recoveryWithDefaultPrior, threshold_half_guess, -std::log10(2.0))
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);

}  // namespace
