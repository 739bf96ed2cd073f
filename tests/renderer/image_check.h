// SPDX-License-Identifier: MIT
// Compares two images of values in [0,1]. Where they differ by more than they may, rendered,
// expected and difference (amplified, grey is none) are saved beside the build's binaries and named
// in the failure.
#pragma once

#include <string>

#include "renderer/image.h"

namespace tests {

struct ImageLimits {
    double most = 0;              ///< that one pixel may differ by
    double often = 0;             ///< that pixels may commonly differ by
    double shareBeyondOften = 0;  ///< share of the pixels that may differ by more than `often`
};

void expectImagesAgree(const std::string& name, const renderer::FloatImage& rendered,
                       const renderer::FloatImage& expected, const ImageLimits& limits);

}  // namespace tests
