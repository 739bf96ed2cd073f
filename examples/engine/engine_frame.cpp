// SPDX-License-Identifier: MIT
// An engine's frames without the engine: a sun with PCF whose filter narrows, and a lamp with PCSS
// whose penumbrae come as a histogram, under a budget. Prints the sizes when they change.
#include <cstdint>
#include <cstdio>
#include <vector>

#include "resolution_controller/audience.h"
#include "resolution_controller/light_set.h"

namespace rc = resolution_controller;

namespace {

// What a demand pass on the GPU would have counted: one entry for each sampled pixel in penumbra.
rc::DemandHistogram demandOfLamp(const rc::Settings& settings, int frame) {
    const rc::DemandRule rule = rc::demandRule(settings);
    rc::DemandHistogram histogram;
    for (int pixel = 1; pixel <= 1000; ++pixel) {
        const float radiusUv = 0.00002f * static_cast<float>(pixel + frame);
        histogram.add(rc::demand(rule, {.radiusUv = radiusUv, .footprint = 1.0f / 2000}),
                      rc::demandWeight(radiusUv, 1.0f / 2000));
    }
    return histogram;
}

}  // namespace

int main() {
    // The slope for this renderer and its audience; a study's slope.json gives another one.
    const rc::AudienceSlope slope =
        rc::slopeFor({}, rc::kHidden, {rc::Encoding::code, rc::Kernel::disc});
    const std::vector<rc::Settings> settings(
        2, {.slope = slope.slope, .driverMaxSize = 16384, .crossFadeFrames = 8});
    rc::LightSet lights(settings);
    std::vector<rc::LightData> data(2);
    std::vector<rc::Decision> choices(2);

    for (int frame = 0; frame < 200; ++frame) {
        const rc::DemandHistogram histogram = demandOfLamp(settings[1], frame);
        data[0] = {.kind = rc::LightData::Kind::radius, .radiusUv = 0.02 / (1 + frame % 100 / 8)};
        data[1] = {.kind = rc::LightData::Kind::histogram, .histogram = &histogram};
        lights.update(data, choices, {.texels = 8 << 20});
        for (std::size_t light = 0; light < choices.size(); ++light) {
            const rc::Decision& choice = choices[light];
            if (!choice.changed) continue;
            std::printf("frame %3d, light %d: %5d texels (%s), filter at least %.6f\n", frame,
                        static_cast<int>(light), choice.size, rc::text(choice.reason),
                        choice.minRadiusUv);
        }
    }
}
