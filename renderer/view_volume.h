// SPDX-License-Identifier: MIT
// What a camera sees, as a convex body of half-spaces that can be cut further.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "renderer/scene.h"

namespace renderer {

/// All points p with dot(plane.xyz, p) + plane.w >= 0 for every plane.
using ConvexBody = std::vector<glm::dvec4>;

/// Between two distances along the view axis, m. `aspect` is width over height.
ConvexBody viewVolume(const OrbitCamera& camera, double aspect, double nearM, double farM);

/// To a box, with room for the rounding of a plane on which everything stands.
void cutToBox(ConvexBody& body, const Bounds& bounds);

/// Where three planes meet within the body; none where it is empty. For a body of n planes it takes
/// n^3 / 6 small steps.
std::vector<glm::dvec3> cornersOf(const ConvexBody& body);

}  // namespace renderer
