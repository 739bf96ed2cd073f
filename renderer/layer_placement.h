// SPDX-License-Identifier: MIT
// Where the layers of a layered technique lie in depth, and how many they are: few, and cut behind
// the casters' clusters of depth. Bounds bleed light by the variance of the depths that a layer
// holds, so the cuts leave the least variance within the layers (the optimal one-dimensional
// k-means, by dynamic programming), and `auto` takes the fewest layers whose depths deviate by no
// more than the technique's layer_deviation.
//
//   Layers layers = placeLayers(histogram, 0, 0.05);   // auto
//   useLayers(technique, layers, shadowConstants);
#pragma once

#include <array>
#include <cstdint>

#include "renderer/shader_math.h"
#include "renderer/technique.h"

namespace renderer {

/// Casters' depths in equal shares of [0,1]; cleared texels, at 1, are no casters.
inline constexpr int kDepthBins = 64;
using DepthHistogram = std::array<std::uint32_t, kDepthBins>;
DepthHistogram depthHistogram(MapView depths);

inline constexpr int kMostLayers = 16;

struct Layers {
    int count = 1;
    /// Layer i ends at ends[i], where the next one begins; from the last one on they are 1.
    std::array<float, kMostLayers> ends = filledWithOne();

    bool operator==(const Layers&) const = default;

  private:
    static constexpr std::array<float, kMostLayers> filledWithOne() {
        std::array<float, kMostLayers> ends{};
        ends.fill(1);
        return ends;
    }
};

/// `asked`: layers, 1 .. kMostLayers, or 0 for as few as keep the depths' standard deviation within
/// their layers at `mostDeviation`. Fewer than asked where there are not as many depths.
Layers placeLayers(const DepthHistogram& histogram, int asked, double mostDeviation);

/// Equal shares of the range, 1 .. kMostLayers.
Layers evenLayers(int count);

/// Whether a technique is given layers: whether it has a parameter "layers".
bool hasLayers(const Technique& technique);

/// What `values` of the technique ask for, placed by a map's depths.
Layers placeLayers(const Technique& technique, const ParameterValues& values,
                   const DepthHistogram& histogram);

/// Enters layers into the constants and their number in place of what was asked for. Nothing
/// happens to a technique without layers.
template <class Constants>
void useLayers(const Technique& technique, const Layers& layers, Constants& constants) {
    const auto slot = technique.parameterSlot("layers");
    if (!slot) return;
    const auto at = [](std::size_t i) { return static_cast<glm::length_t>(i % 4); };
    using Real = typename decltype(constants.map)::value_type;
    constants.parameters[*slot / 4][at(*slot)] = static_cast<Real>(layers.count);
    for (std::size_t i = 0; i < layers.ends.size(); ++i)
        constants.layerEnds[i / 4][at(i)] = static_cast<Real>(layers.ends[i]);
}

}  // namespace renderer
