// SPDX-License-Identifier: MIT
// Cost of one light's decision in a frame. Goal: at most 1 us with a histogram.
#include <benchmark/benchmark.h>

#include <cmath>
#include <vector>

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

void updateWithHistogram(benchmark::State& state) {
    const auto frames = breathingScene();
    rc::ResolutionController controller({});
    std::size_t frame = 0;
    for (auto _ : state) {
        benchmark::DoNotOptimize(controller.update(frames[frame++ % frames.size()]));
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

}  // namespace
