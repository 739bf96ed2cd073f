// SPDX-License-Identifier: MIT
// An engine's frames without the engine: a sun with PCF whose filter narrows, and a lamp with PCSS
// whose penumbrae come as a histogram, under a budget. Prints the sizes when they change.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <vector>

#include "resolution_controller/audience.h"
#include "resolution_controller/light_set.h"

namespace rc = resolution_controller;

namespace {

constexpr int kAskedIn = 16;  // frames in which every pixel is asked once

// What a demand pass on the GPU would have counted of the frame that was drawn with that decision:
// one pixel in 16 of those in penumbra, another one each frame.
rc::DemandHistogram demandOfLamp(const rc::Settings& settings, const rc::Decision& drawn,
                                 int frame) {
    constexpr float kFootprint = 1.0f / 2000;
    const rc::DemandRule rule = rc::demandRule(settings);
    // Filters are enlarged where a texel is larger than a pixel.
    const float enlargedTo =
        kFootprint * static_cast<float>(drawn.size) < 1 ? static_cast<float>(drawn.minRadiusUv) : 0;
    rc::DemandHistogram histogram;
    for (int pixel = 1 + frame % kAskedIn; pixel <= 1000; pixel += kAskedIn) {
        const float radiusUv = 0.00002f * static_cast<float>(pixel + frame);
        const float shownRadiusUv = std::max(radiusUv, enlargedTo);
        histogram.add(rc::demand(rule, {.radiusUv = radiusUv, .footprint = kFootprint}),
                      rc::demandWeight(shownRadiusUv, kFootprint));
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
    rc::RecentDemand recent(kAskedIn);

    for (int frame = 0; frame < 200; ++frame) {
        recent.add(demandOfLamp(settings[1], choices[1], frame));
        data[0] = {.kind = rc::LightData::Kind::radius, .radiusUv = 0.02 / (1 + frame % 100 / 8)};
        data[1] = {.kind = rc::LightData::Kind::histogram, .histogram = &recent.sum()};
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
