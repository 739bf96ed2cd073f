// SPDX-License-Identifier: MIT
// How well a power function stands for the depths under a kernel: J. Gumbau et al., "Improving
// shadow map filtering with statistical analysis", 2011, Fig. 1 and Eq. 2 and 3.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "renderer/gl_context.h"
#include "renderer/image.h"

namespace demo {

struct PowerFit {
    double beta = 0;
    double most = 0;  ///< largest distance of t^beta from the share of depths that lie before t
};
/// Depths in any order; absent where they are all alike.
std::optional<PowerFit> fitPower(std::vector<float> depths);

/// Depths under the kernel of 2 half + 1 texels squared that falls into `groups` of depth most
/// evenly; for one group the one that spans most. Empty where there is none.
std::vector<float> kernelOfGroups(const renderer::FloatImage& map, int half, int groups);

/// Markdown with a plot, written into the folder.
std::string depthDistributionText(const std::filesystem::path& folder,
                                  const renderer::GlInfo& info);

}  // namespace demo
