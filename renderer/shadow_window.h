// SPDX-License-Identifier: MIT
// The part of the world that a light's map covers: a square across the light's direction, fitted to
// the casters. Receivers outside it are lit. Depth is linear along the light, 0 at the nearest
// caster, 1 at the farthest caster or ground point under the square; what lies beyond is clamped
// there.
#pragma once

#include <glm/glm.hpp>

#include "renderer/scene.h"

namespace renderer {

struct ShadowWindow {
    glm::dmat4 shadowFromWorld{1};  ///< to (u, v, depth, 1)
    double extentM = 1;             ///< edge of the square, m: r_uv = softness in m / extentM
    double depthRangeM = 1;         ///< what depth 0..1 spans, m
    glm::vec3 towardsLight{0, 1, 0};
};

/// Throws std::invalid_argument where the bounds are empty or not finite, or the sun is not over
/// the horizon.
ShadowWindow fitShadowWindow(const Bounds& casters, const Sun& sun);

}  // namespace renderer
