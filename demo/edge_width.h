// SPDX-License-Identifier: MIT
// Sharpness: how wide a shadow's edge is between 10 % and 90 % of the light, across the truth's
// half-way contour.
#pragma once

#include <cstddef>

#include "renderer/image.h"

namespace demo {

struct EdgeWidth {
    std::size_t places = 0;   ///< contour pixels at which image and truth both have a whole edge
    double widthPx = 0;       ///< median of the image, screen px
    double truthWidthPx = 0;  ///< median of the truth
    double ratio = 0;         ///< median of image over truth: above 1 the edge is softer
};

/// All zero where no edge is whole: narrower penumbrae run into each other or out of the picture.
/// `places` is mapPlaces(). Throws std::invalid_argument for images of different size.
EdgeWidth edgeWidth(const renderer::FloatImage& image, const renderer::FloatImage& truth,
                    const renderer::FloatImage& places);

}  // namespace demo
