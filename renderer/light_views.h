// SPDX-License-Identifier: MIT
// The maps of a frame: which windows a light needs. The sun has one, or one for each cascade; a
// spot one; a point lamp six, the faces of a cube. Each has its own size and radius, so to whoever
// chooses sizes every one of them is a light.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "renderer/shadow_window.h"

namespace renderer {

/// One map of a frame.
struct LightView {
    ShadowWindow window;
    std::size_t light = 0;   ///< 0 the sun, then the scene's lamps
    double softnessUv = -1;  ///< of a lamp: radius of its blur on this map; below 0: the frame's
};

/// Room around a window, in softnesses: a kernel that grows with the distance of its casters, as
/// that of PCSS, gets this wide.
inline constexpr double kReachOfSoftness = 4;

/// A sentence that names field, value and rule; empty for a lamp that can be drawn.
std::string validate(const Lamp& lamp);

/// Throws std::invalid_argument for more cascades or lamps than a frame has room for, and for a
/// lamp that cannot be drawn.
void checkLights(int cascades, std::span<const Lamp> lamps);

/// One window of a spot, six of a point. They are wider than what they serve by the reach of a
/// kernel, so that it finds on the same map what lies beyond a face's edge. Throws
/// std::invalid_argument for a lamp that cannot be drawn.
std::vector<LightView> lampViews(const Lamp& lamp, std::size_t light);

/// The depths of one of them: from the nearest of the scene's surfaces to the farthest caster and
/// somewhat behind it, the same for all faces of a point. What lies farther is as a cleared map.
/// Left alone where that is nothing of what is between nearM and farM.
void fitLampDepth(ShadowWindow& window, const Bounds& casters, const Bounds& surfaces);

/// One of them to what narrowLampWindow() finds, with the same blur in the scene.
void narrowLampView(LightView& view, const Bounds& casters, const ConvexBody& seen,
                    std::optional<int>& heldStep);

/// Where the stretches of `count` cascades end, from nearM to farM: count + 1 distances. The
/// practical scheme (F. Zhang et al., "Parallel-split shadow maps for large-scale virtual
/// environments", VRCIA 2006): halfway between equal steps and equal ratios.
std::vector<double> cascadeSplits(double nearM, double farM, int count);

/// The windows of the sun's cascades, or the one of a sun without. All of them have the depth of
/// the whole window, so that a bias or an exponent means the same in each. `heldSteps` is of the
/// frame before and is resized to the number of cascades.
std::vector<LightView> sunViews(const ShadowWindow& whole, const Bounds& casters,
                                const OrbitCamera& camera, double aspect, int cascades,
                                double reachM, std::vector<std::optional<int>>& heldSteps);

/// How near and far a camera sees, m.
float nearestSeenM(const OrbitCamera& camera);
float farthestSeenM(const OrbitCamera& camera);

}  // namespace renderer
