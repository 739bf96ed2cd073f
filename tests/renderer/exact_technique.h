// SPDX-License-Identifier: MIT
// What a technique's formula comes to in long double, computed from the depths themselves: no map
// in between, no rounding, none of the shaders' rearrangements against cancellation.
#pragma once

#include <optional>

#include "tests/renderer/technique_case.h"

namespace tests {

/// At the receiver on the middle of a map with an odd edge. The kernel of a filtered map is a box;
/// a tap that turns from pixel to pixel does not; a texel's own slope has no variance: parameters
/// gaussian, rotated and derivative are taken as 0. Absent for a technique whose formula nobody has
/// written down here.
std::optional<long double> exactVisibility(const renderer::Technique& technique,
                                           const DepthMap& map,
                                           const renderer::f64::ShadowReceiver& receiver,
                                           const renderer::f64::ShadowConstants& constants);

}  // namespace tests
