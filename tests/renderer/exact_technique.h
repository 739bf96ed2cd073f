// SPDX-License-Identifier: MIT
// What a technique's formula comes to in long double, computed from the depths themselves: no map
// in between, no rounding, none of the shaders' rearrangements against cancellation.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "tests/renderer/technique_case.h"

namespace tests {

/// Depths with their shares of a kernel, which sum to 1.
struct Distribution {
    std::vector<long double> depths, weights;

    template <class Value>
    long double mean(const Value& value) const {
        long double sum = 0;
        for (std::size_t i = 0; i < depths.size(); ++i) sum += weights[i] * value(depths[i]);
        return sum;
    }
    template <class Value>
    long double variance(const Value& value) const {
        const long double middle = mean(value);
        return mean([&](long double z) { return (value(z) - middle) * (value(z) - middle); });
    }
};

/// What a filtered technique's lookup joins at the receiver, wherever it lies on the map: of a
/// kernel of one width, a box. Of several smaller kernels all of them, though their planes differ
/// on a slope.
Distribution depthsUnderTheKernel(const renderer::Technique& technique, const DepthMap& map,
                                  const renderer::f64::ShadowReceiver& receiver,
                                  const renderer::f64::ShadowConstants& constants);

/// At the receiver on the middle of a map with an odd edge. The kernel of a filtered map is a box;
/// a tap that turns from pixel to pixel does not; a texel's own slope has no variance: parameters
/// gaussian, rotated and derivative are taken as 0. Absent for a technique whose formula nobody has
/// written down here.
std::optional<long double> exactVisibility(const renderer::Technique& technique,
                                           const DepthMap& map,
                                           const renderer::f64::ShadowReceiver& receiver,
                                           const renderer::f64::ShadowConstants& constants);

}  // namespace tests
