// SPDX-License-Identifier: MIT
// A frame's visibility as the CPU evaluates it: the same map, constants and receivers, so that what
// differs from the GPU's is the rounding of the lookup alone.
#pragma once

#include <algorithm>
#include <numbers>
#include <string_view>
#include <utility>

#include "renderer/cpu_filter.h"
#include "renderer/renderer.h"
#include "tests/renderer/image_check.h"

namespace tests {

/// What the GPU's lookup reads of a view's map. Does not own the depths.
inline renderer::CpuMap<float> mapOf(const renderer::FloatImage& depths,
                                     renderer::FilteredTexels filtered) {
    return {.depths = {depths.values.data(), depths.width},
            .edge = filtered.edge,
            .layers = 1,
            .texels = std::move(filtered.texels),
            .sums = std::move(filtered.sums)};
}

/// Of one of the lights: each pixel from the map that serves it.
inline renderer::FloatImage cpuImage(renderer::Renderer& frame,
                                     const renderer::Technique& technique, std::size_t light = 0) {
    const renderer::FloatImage positions = frame.readPositions();
    const renderer::FloatImage planes = frame.readPlanes();
    renderer::FloatImage cpu(positions.width, positions.height);
    for (float& visibility : cpu.values) visibility = 1;
    for (std::size_t view = 0; view < frame.lightViews().size(); ++view) {
        if (frame.lightViews()[view].light != light) continue;
        const renderer::FloatImage depths = frame.readShadowMap(view);
        const renderer::CpuMap<float> map = mapOf(depths, frame.readFilteredMap(view));
        if (technique.prefilter != renderer::Prefilter::none && map.edge == 0)
            continue;  // no pixel is for it
        const renderer::f32::ShadowConstants& shadow = frame.shadowConstants(view);
        for (int y = 0; y < cpu.height; ++y)
            for (int x = 0; x < cpu.width; ++x) {
                if (positions.at(x, y, 3) == 0) continue;
                const glm::vec3 eyeRelative(positions.at(x, y, 0), positions.at(x, y, 1),
                                            positions.at(x, y, 2));
                const auto receiver = renderer::f32::shadowReceiver(
                    eyeRelative, {planes.at(x, y, 0), planes.at(x, y, 1), planes.at(x, y, 2)},
                    frame.viewConstants(), shadow);
                if (!serves(receiver,
                            glm::dot(eyeRelative, glm::vec3(frame.viewConstants().forward)),
                            shadow))
                    continue;
                cpu.at(x, y) = !receiver.facesLight
                                   ? 0
                                   : renderer::cpuVisibility(technique, map, receiver, shadow);
            }
    }
    return cpu;
}

/// The largest difference of a single pixel that reconstructions from filtered maps and gradients
/// may have: about twice the worst one of all scenes, cascades and lamps on maps of up to 1024 on
/// llvmpipe, which stands beside it. They are steep where a depth is nearly the mean.
struct SteepLookup {
    std::string_view nameBegins;
    double most;
};
inline constexpr SteepLookup kSteepLookups[] = {
    {"msm16", 0.002},  // .00094
    // .0110. The equations are so badly conditioned that single precision is off by up to .0099
    // (docs/results/technique-errors.md), here on either side.
    {"msm", 0.022},
    {"lvsm", 0.021},  // .0103: a layer stretches a part of the depths, and what is rounded off them
    // .0031: of two squares that are nearly the same the difference is the variance.
    {"vsm", 0.0063},
    {"pcss_mip", 0.0063},
    {"pcss_sat", 0.0063},
    {"esm", 0.0018},  // .00030, evsm .00086: exponents multiply what is rounded off a depth
    {"evsm", 0.0018},
    {"gsm", 0.0014},        // .00070: a compare over the slope of one texel
    {"csm", 0.00015},       // .00002
    {"power_cdf", 0.00015}  // .00008
};

/// How far the GPU may be from it on a map of n texels under a kernel of `texels` radius. A compare
/// that falls the other way moves one texel's weight: all of it for a hard shadow, at most 1 / (pi
/// (r/a)^2) of a disc, a tap's (1/16 with the fewest taps of a default), with the tents of taps
/// that lie closer than texels up to a half more. On llvmpipe a few do at N = 1024, none below.
/// PCSS's radius is as exact as the gap to its blockers, which at a contact is the difference of
/// depths that are nearly alike: single precision is off by up to .0009.
inline ImageLimits limitsAgainstCpu(const renderer::Technique& technique, double texels) {
    for (const SteepLookup& lookup : kSteepLookups)
        if (technique.name.starts_with(lookup.nameBegins))
            // MSM: many pixels of a terrain at grazing light are beyond .001.
            return {.most = lookup.most,
                    .often = technique.name.starts_with("msm") ? lookup.most
                                                               : std::min(1e-3, lookup.most),
                    .shareBeyondOften = 0.002};
    const double kernelTexel = 1.0 / (std::numbers::pi * texels * texels + 1e-9);
    const double oneTexel = !technique.soft                ? 1.0
                            : technique.name == "pcf_disc" ? kernelTexel
                                                           : std::max(kernelTexel, 1.0 / 16);
    return {.most = std::min(1.0, 1.5 * oneTexel + 1e-4),
            .often = technique.name == "pcss" ? 1e-3 : 1e-4,
            .shareBeyondOften = 0.002};
}

}  // namespace tests
