// SPDX-License-Identifier: MIT
// Time of one stimulus pair, artifact and straight, 600 x 600 px, 8-bit codes, on one core.
#include <benchmark/benchmark.h>

#include "stimulus/stimulus_image.h"

namespace {

using namespace stimulus;

void makePairs(benchmark::State& state, const StimulusOptions& options) {
    for (auto _ : state) {
        benchmark::DoNotOptimize(artifactImage(options).data);
        benchmark::DoNotOptimize(straightImage(options).data);
    }
}

StimulusOptions options(const SilhouetteOptions& silhouette, KernelShape shape,
                        Encoding encoding = Encoding::srgb) {
    return {.silhouette = silhouette, .kernel = {shape, 100}, .encoding = encoding};
}

constexpr SilhouetteOptions kStair{.pattern = Pattern::stair, .artifactPx = 10};
constexpr SilhouetteOptions kStep{.pattern = Pattern::step, .artifactPx = 10};
constexpr SilhouetteOptions kUnevenStair{.pattern = Pattern::stair, .artifactPx = 10.3};
constexpr SilhouetteOptions kUnevenStep{.pattern = Pattern::step, .artifactPx = 10.3};

SilhouetteOptions line(double angleDeg, double artifactPx = 10) {
    return {.pattern = Pattern::line, .artifactPx = artifactPx, .angleDeg = angleDeg};
}

StimulusOptions withTaps(const SilhouetteOptions& silhouette, int taps) {
    StimulusOptions o = options(silhouette, KernelShape::disc);
    o.taps = TapKernel{.taps = taps};
    return o;
}

StimulusOptions withNoise(const SilhouetteOptions& silhouette, double noiseLevels, bool dither) {
    StimulusOptions o = options(silhouette, KernelShape::disc);
    o.noiseLevels = noiseLevels;
    o.dither = dither;
    return o;
}

#define PAIR(name, ...) \
    BENCHMARK_CAPTURE(makePairs, name, __VA_ARGS__)->Unit(benchmark::kMillisecond)
PAIR(stair_disc, options(kStair, KernelShape::disc));
PAIR(stair_disc_code, options(kStair, KernelShape::disc, Encoding::code));
PAIR(stair_box, options(kStair, KernelShape::box));
PAIR(stair_gaussian, options(kStair, KernelShape::gaussian));
PAIR(step_disc, options(kStep, KernelShape::disc));
PAIR(step_disc_code, options(kStep, KernelShape::disc, Encoding::code));
PAIR(step_box, options(kStep, KernelShape::box));
PAIR(step_gaussian, options(kStep, KernelShape::gaussian));
PAIR(line_1_disc, options(line(1), KernelShape::disc));
PAIR(line_22_5_disc, options(line(22.5), KernelShape::disc));
PAIR(line_40_5_disc, options(line(40.5), KernelShape::disc));
PAIR(line_40_5_disc_a5, options(line(40.5, 5), KernelShape::disc));
PAIR(line_40_5_disc_a1, options(line(40.5, 1), KernelShape::disc));
PAIR(line_40_5_gaussian, options(line(40.5), KernelShape::gaussian));
PAIR(stair_a10_3_disc, options(kUnevenStair, KernelShape::disc));
PAIR(step_a10_3_disc, options(kUnevenStep, KernelShape::disc));
PAIR(stair_poisson16, withTaps(kStair, 16));
PAIR(step_poisson16, withTaps(kStep, 16));
PAIR(line_22_5_poisson16, withTaps(line(22.5), 16));
PAIR(stair_poisson64, withTaps(kStair, 64));
PAIR(stair_poisson256, withTaps(kStair, 256));
PAIR(stair_disc_noise, withNoise(kStair, 4, false));
PAIR(stair_disc_dither, withNoise(kStair, 0, true));
#undef PAIR

}  // namespace
