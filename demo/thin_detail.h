// SPDX-License-Identifier: MIT
// What becomes of the shadows of thin casters: wires and leaves that slip between the texels of a
// coarse map (Kreuzer, section 7). A caster is thin where it is narrower than the kernel, so that
// its shadow is nowhere full.
#pragma once

#include <cstddef>
#include <vector>

#include "renderer/image.h"

namespace demo {

/// For each pixel of `places` (mapPlaces()) whether a thin caster lies before it under the kernel.
/// `depths` is the light's map, as fine as can be had.
std::vector<bool> behindThinCasters(const renderer::FloatImage& depths,
                                    const renderer::FloatImage& places, double radiusUv);

struct ThinDetail {
    std::size_t pixels = 0;
    double rmse = 0;  ///< of the visibility over these pixels
    double lost = 0;  ///< share of their shadow that is gone; below 0 where there is too much of it
};

/// All zero where there are no thin casters. Throws std::invalid_argument for images of different
/// size.
ThinDetail thinDetail(const renderer::FloatImage& image, const renderer::FloatImage& truth,
                      const std::vector<bool>& thin);

}  // namespace demo
