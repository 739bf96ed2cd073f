// SPDX-License-Identifier: MIT
// Fences: rows of thin casters.
#pragma once

#include "renderer/mesh.h"

namespace renderer {

/// Pointed pickets on two rails between two places of the ground.
Mesh picketFence(glm::vec3 from, glm::vec3 to, float height, float spacing);
/// Wires of the given thickness, crossing at right angles, in a frame of posts and a rail.
Mesh wireFence(glm::vec3 from, glm::vec3 to, float height, float mesh, float thickness);

}  // namespace renderer
