// SPDX-License-Identifier: MIT
// The lines along which a visibility image is one half: where people see a shadow's edge, and along
// which METHODS section 8 measures stair-steps.
#pragma once

#include <vector>

#include "renderer/image.h"

namespace demo {

/// A place between two neighbouring pixels, `share` of the way from the first to the second.
struct ContourPoint {
    std::size_t first = 0, second = 0;  ///< y * width + x
    float share = 0;                    ///< [0, 1]
};

/// The value that an image has at such a place.
double valueAt(const renderer::FloatImage& image, const ContourPoint& point, int channel = 0);

struct Contour {
    std::vector<ContourPoint> points;  ///< neighbours along the line are less than two pixels apart
    bool closed = false;               ///< the first comes after the last
};

/// Marching squares over the cells whose corners belong to one surface: where an object hides
/// another, visibility jumps without there being an edge of a shadow. `places` is mapPlaces().
/// Throws std::invalid_argument for images of different size.
std::vector<Contour> shadowContours(const renderer::FloatImage& visibility,
                                    const renderer::FloatImage& places);

}  // namespace demo
