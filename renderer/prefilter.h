// SPDX-License-Identifier: MIT
// How wide a map is filtered before the lookup. The kernel is given as a fraction of the map's
// extent, so the softness never depends on N, and a box or a Gaussian of radius r has the standard
// deviation r/2 of a disc of radius r: edges come out as soft as with the full disc, in every
// direction. (A box of half-width r would be 1.15 times as soft.)
//
// A filtered map has one kernel, so where the controller sets a least radius it holds everywhere,
// not only where texels show.
#pragma once

#include <glm/glm.hpp>

#include "renderer/technique.h"

namespace renderer {

/// ShadowConstants::prefilter of a technique. Radii as fractions of the map's extent; whatever lies
/// outside [0,1] is moved there. All zero for a technique without a prefilter. A technique with a
/// parameter "gaussian" chooses its kernel by it.
glm::vec4 prefilterConstants(const Technique& technique, const ParameterValues& parameters,
                             float radiusUv, float minRadiusUv, int resolution);

/// How far from a receiver's place on the map a lookup of the filtered map may lie, texels: none
/// but for a technique with `samples` kernels side by side. `prefilter` as above.
float lookupSpreadTexels(const Technique& technique, const ParameterValues& parameters,
                         glm::vec4 prefilter);

}  // namespace renderer
