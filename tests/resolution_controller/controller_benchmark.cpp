// SPDX-License-Identifier: MIT
// Cost of the decisions of a frame. Goals: at most 1 us for one light with a histogram, at most 50
// us for 64 lights under a budget.
#include <benchmark/benchmark.h>

#include <cmath>
#include <vector>

#include "resolution_controller/light_set.h"
#include "resolution_controller/resolution_controller.h"

namespace {

namespace rc = resolution_controller;

/// Penumbrae from contact to wide, breathing over the frames so that sizes rise and fall.
std::vector<rc::DemandHistogram> breathingScene() {
    std::vector<rc::DemandHistogram> frames(256);
    for (std::size_t f = 0; f < frames.size(); ++f) {
        const double breath = 2 + std::sin(6.283 * static_cast<double>(f) / 256);
        for (int i = 1; i <= 2000; ++i) {
            frames[f].add(rc::demand(3.47f, static_cast<float>(1e-5 * i * breath), 1.0f / 3000));
        }
    }
    return frames;
}

/// A frame of one light, from the newest histogram to the decision.
void updateWithHistogram(benchmark::State& state) {
    const auto frames = breathingScene();
    rc::RecentDemand recent(16);
    rc::ResolutionController controller({});
    std::size_t frame = 0;
    for (auto _ : state) {
        recent.add(frames[frame++ % frames.size()]);
        benchmark::DoNotOptimize(controller.update(recent.sum()));
    }
}
BENCHMARK(updateWithHistogram);

void updateWithRadius(benchmark::State& state) {
    rc::ResolutionController controller({});
    double radius = 0.001;
    for (auto _ : state) {
        radius = radius > 0.05 ? 0.001 : radius * 1.01;
        benchmark::DoNotOptimize(controller.update(radius));
    }
}
BENCHMARK(updateWithRadius);

void addOneDemand(benchmark::State& state) {
    rc::DemandHistogram histogram;
    float radius = 0.001f;
    for (auto _ : state) {
        radius = radius > 0.05f ? 0.001f : radius * 1.01f;
        const float footprint =
            rc::pixelFootprint({.dudx = radius, .dvdx = 0.001f, .dudy = 0, .dvdy = 0.002f});
        histogram.add(rc::demand(3.47f, radius, footprint));
        benchmark::DoNotOptimize(histogram);
    }
}
BENCHMARK(addOneDemand);

/// Half with histograms, half with radii, all of them moving; the budget is what they want over the
/// second argument.
void updateLightsUnderBudget(benchmark::State& state) {
    const auto frames = breathingScene();
    const auto count = static_cast<std::size_t>(state.range(0));
    const std::vector<rc::Settings> settings(count);
    rc::LightSet lights(settings);
    std::vector<rc::LightData> data(count);
    std::vector<rc::Decision> decisions(count);
    std::size_t frame = 0;
    const auto step = [&](const rc::Budget& budget) {
        ++frame;
        for (std::size_t i = 0; i < count; ++i) {
            data[i].kind = i % 2 ? rc::LightData::Kind::radius : rc::LightData::Kind::histogram;
            data[i].histogram = &frames[(frame + 4 * i) % frames.size()];
            data[i].radiusUv = 0.002 * (2 + std::sin(0.02 * static_cast<double>(frame + 31 * i)));
        }
        return lights.update(data, decisions, budget);
    };
    const std::uint64_t wanted = step({}).budget.used;
    const rc::Budget budget{.texels = static_cast<std::int64_t>(wanted) / (state.range(1))};
    for (auto _ : state) benchmark::DoNotOptimize(step(budget));
}
BENCHMARK(updateLightsUnderBudget)->Args({64, 1})->Args({64, 2})->Args({64, 16})->Args({64, 256});

}  // namespace
