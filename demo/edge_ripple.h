// SPDX-License-Identifier: MIT
// Edge ripple: the stair-steps that a too coarse shadow map leaves along a shadow's edge, as the
// study asks people to see them (METHODS section 8). At each pixel of the truth's half-way contour
// it is max - min of (visibility - truth) over one riser period along the contour, the length in
// which the edge crosses one row or column of the map's texels.
//
// A straight edge under a disc of r/a = 3.47 texels leaves .161 at 1 degree to the texels, .140 at
// 2, .117 at 3, .072 at 5.5; towards 0 degrees 2 / (pi 3.47) = .183.
#pragma once

#include <cstddef>
#include <vector>

#include "demo/shadow_contour.h"
#include "renderer/image.h"

namespace demo {

/// Edges at less than 0.9 degrees to the texels have longer periods; no more than this many texels
/// of them are taken together.
inline constexpr double kLongestRiserPeriodTexels = 64;

/// One value for each point of the truth's contours. The images have the size of `places`, which is
/// mapPlaces(); `resolution` is that of the map behind `image`. Throws std::invalid_argument for
/// images of different size and a resolution below 1.
std::vector<float> edgeRipples(const renderer::FloatImage& image, const renderer::FloatImage& truth,
                               const renderer::FloatImage& places, double resolution);

/// The same for contours that were traced before, since many images share a truth.
std::vector<float> edgeRipples(const renderer::FloatImage& image, const renderer::FloatImage& truth,
                               const renderer::FloatImage& places,
                               const std::vector<Contour>& contours, double resolution);

struct EdgeRipple {
    std::size_t contourPixels = 0;
    double p95 = 0;
    double most = 0;
};
/// Of all contour pixels of one or many frames; all zero for none. A NaN counts as infinite.
EdgeRipple summarised(std::vector<float> ripples);

}  // namespace demo
