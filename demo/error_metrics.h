// SPDX-License-Identifier: MIT
// How wrong a visibility image is against a reference of the same size. Measured on visibility, not
// on shaded colour, and over penumbra pixels of either, where stair-steps are seen (METHODS section
// 8): a 1e-7 of light that rounding leaves in a full shadow is none. A *resolution error* has the
// same technique and radius on the largest map as its reference; it says nothing about the
// technique itself.
#pragma once

#include <cstddef>

#include "renderer/image.h"

namespace demo {

struct VisibilityError {
    std::size_t penumbraPixels = 0;  ///< over which all the following is taken
    double rmse = 0;
    double most = 0;              ///< largest |difference|
    double p95 = 0;               ///< 95th percentile of |difference|
    double bias = 0;              ///< mean difference; positive where light leaks into shadow
    double shareBeyondLevel = 0;  ///< share of the pixels off by more than 1/255
    double shareBeyond2Percent = 0;
    double shareBeyond5Percent = 0;
};

/// Penumbra pixels are those where either image lies strictly between 0 and 1, or the two differ by
/// more than half an 8-bit level: a shadow that is missing altogether counts. All zero where there
/// are none. Throws std::invalid_argument for images of different size.
VisibilityError compareVisibility(const renderer::FloatImage& image,
                                  const renderer::FloatImage& reference);

/// A frame and the one before it, with the truth of both.
struct FramePair {
    const renderer::FloatImage& before;
    const renderer::FloatImage& now;
    const renderer::FloatImage& truthBefore;
    const renderer::FloatImage& truthNow;
};
/// Flicker and crawl: RMS of what changed from frame to frame less what changed in the truth, over
/// the pixels that are in penumbra in any of the four or change otherwise than the truth does. 0
/// where there are none. Throws std::invalid_argument for images of different size.
double temporalError(const FramePair& frames);

/// Mean structural similarity of two visibility images (Wang, Bovik, Sheikh, Simoncelli 2004, as
/// OpenCV's quality module has it); 1 for equal ones. Throws std::invalid_argument for images of
/// different size.
double structuralSimilarity(const renderer::FloatImage& image,
                            const renderer::FloatImage& reference);

}  // namespace demo
