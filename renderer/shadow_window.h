// SPDX-License-Identifier: MIT
// The part of the world that a light's map covers: a square across the light's direction, fitted to
// the casters (the sun's) or around what a lamp shines on (light_views.h), and narrowed to what of
// the casters' shadows can be seen. Receivers outside it are lit. The sun's depth is linear along
// the light, 0 at the nearest caster, 1 at the farthest caster or ground point under the casters'
// square; what lies beyond is clamped there. Narrowing leaves the depth alone, so that what counts
// in depth (bias, exponents, a penumbra's width) does not change as the camera moves.
//
// A narrowed window follows the camera in steps: extents are quarter octaves, held until two steps
// fewer are enough, and render() moves the square by whole texels, so that under a still light the
// texel grid does not crawl over the ground (METHODS section 7).
#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "renderer/scene.h"
#include "renderer/view_volume.h"

namespace renderer {

/// Which receivers a map serves (shared/constants.glsl).
struct ViewPart {
    double fromM = -1e30, toM = 1e30;       ///< distance along the view axis
    glm::dvec2 lowUv{-1e30}, highUv{1e30};  ///< on the map

    bool operator==(const ViewPart&) const = default;
};
/// Every receiver.
inline constexpr ViewPart kAllReceivers{};

struct ShadowWindow {
    glm::dmat4 shadowFromWorld{1};    ///< to (u, v, depth, 1)
    double extentM = 1;               ///< edge of the square, m: r_uv = softness in m / extentM
    double depthRangeM = 1;           ///< what depth 0..1 spans, m
    glm::vec3 towardsLight{0, 1, 0};  ///< of the sun
    std::optional<glm::dvec3> lampAt = {};  ///< of a lamp; then shadowFromWorld is a projection,
                                            ///< and extentM the map's width 1 m away
    double nearM = 0;                       ///< of a lamp: where depth 0 is, along the map's axis
    ViewPart part = {};
    bool narrowed = false;  ///< to what is seen: the square moves with the camera
    glm::dvec2 gridUv{0};   ///< of a narrowed one: a place that its texel grid holds fast to
};

/// Throws std::invalid_argument where the bounds are empty or not finite, or the sun is not over
/// the horizon.
ShadowWindow fitShadowWindow(const Bounds& casters, const Sun& sun);

/// Of the casters' window, the part that visible receivers in their shadow can lie in.
/// `seen` is what the camera sees; `reachM` how far across the light a kernel reads beyond the
/// receiver. `heldStep` is the extent of the frame before, as 4 log2 m, absent where that one was
/// not narrowed, and is replaced by this one's. The whole window comes back where nothing that can
/// be in shadow is seen, or where the narrowed one would not be smaller.
ShadowWindow narrowShadowWindow(const ShadowWindow& whole, const Bounds& casters,
                                const ConvexBody& seen, double reachM,
                                std::optional<int>& heldStep);

/// Of what a lamp's whole map covers, the part that visible receivers in a shadow can lie in, on
/// the same steps: `seen` is where visible surfaces are, and a kernel reads as far as the whole map
/// is wider than the receivers that it serves. Its `part` is empty where no caster can throw a
/// shadow on anything that is seen, and then as large as the whole.
ShadowWindow narrowLampWindow(const ShadowWindow& whole, const Bounds& casters,
                              const ConvexBody& seen, std::optional<int>& heldStep);

/// A narrowed window moved by less than a texel of N x N, so that its grid is the same wherever it
/// lies; as it is below kLeastSnapped texels, where a step would be too wide.
inline constexpr int kLeastSnapped = 64;
ShadowWindow snapToTexels(const ShadowWindow& window, int resolution);

/// To what lies between two places on a lamp's map, the lower one first.
void cutToPyramid(ConvexBody& body, const ShadowWindow& window, const glm::dvec2& low,
                  const glm::dvec2& high);

/// What of the scene the window can be narrowed by: points that the casters can throw a shadow on,
/// between the lowest and the highest of them.
ConvexBody shadowedBody(const ShadowWindow& whole, const Bounds& casters);

}  // namespace renderer
