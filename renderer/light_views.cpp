// SPDX-License-Identifier: MIT
#include "renderer/light_views.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_access.hpp>
#include <stdexcept>

namespace renderer {
namespace {

void setRow(ShadowWindow& window, int row, const glm::dvec4& plane) {
    for (int column = 0; column < 4; ++column) window.shadowFromWorld[column][row] = plane[column];
}

/// Along the map's axis, whose row is set.
void setDepths(ShadowWindow& window, double nearM, double farM) {
    window.nearM = nearM;
    window.depthRangeM = farM - nearM;
    const glm::dvec4 along = glm::row(window.shadowFromWorld, 3);
    setRow(window, 2, (along - glm::dvec4(0, 0, 0, nearM)) / window.depthRangeM);
}

/// A pyramid from the lamp around a way that it looks. `served` is the tangent of half the angle
/// that it is for; the map is wider by the reach, at most to 1.5 times as much.
LightView pyramid(const Lamp& lamp, glm::dvec3 forward, double served, std::size_t light) {
    const glm::dvec3 level = std::abs(forward.y) < 0.99 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
    const glm::dvec3 right = glm::normalize(glm::cross(forward, level));
    const glm::dvec3 up = glm::cross(right, forward);
    const auto softness = static_cast<double>(lamp.softness);
    const double halfWidth = served + std::min(kReachOfSoftness * softness, 0.5 * served);
    const glm::dvec3 at(lamp.position);

    LightView view;
    view.light = light;
    view.softnessUv = std::min(softness / (2 * halfWidth), 1.0);
    ShadowWindow& window = view.window;
    window.extentM = 2 * halfWidth;
    window.lampAt = at;
    // A little more than half, or rounding could leave points on an edge to no face.
    const double halfWidthUv = 0.5 * served / halfWidth + 1e-6;
    window.part.lowUv = glm::dvec2(0.5 - halfWidthUv);
    window.part.highUv = glm::dvec2(0.5 + halfWidthUv);
    // (u w, v w, depth, w) with w the distance along the axis.
    const glm::dvec3 u = right / window.extentM + 0.5 * forward;
    const glm::dvec3 v = up / window.extentM + 0.5 * forward;
    setRow(window, 0, {u, -glm::dot(u, at)});
    setRow(window, 1, {v, -glm::dot(v, at)});
    setRow(window, 3, {forward, -glm::dot(forward, at)});
    setDepths(window, static_cast<double>(lamp.nearM), static_cast<double>(lamp.farM));
    return view;
}

}  // namespace

std::string validate(const Lamp& lamp) {
    const auto wrong = [](const char* field, float value, const char* rule) {
        return std::string("lamp: ") + field + " is " + std::to_string(value) + ", must be " + rule;
    };
    for (int axis = 0; axis < 3; ++axis)
        for (const auto& [field, value] :
             {std::pair{"position", lamp.position[axis]}, std::pair{"target", lamp.target[axis]},
              std::pair{"colour", lamp.colour[axis]}})
            if (!std::isfinite(value)) return wrong(field, value, "finite");
    if (!(lamp.nearM > 0)) return wrong("nearM", lamp.nearM, "above 0");
    if (!(lamp.farM > lamp.nearM) || !std::isfinite(lamp.farM))
        return wrong("farM", lamp.farM, "finite and above nearM");
    if (!(lamp.softness >= 0) || !std::isfinite(lamp.softness))
        return wrong("softness", lamp.softness, "finite and at least 0");
    if (lamp.kind == Lamp::Kind::point) return "";
    if (!(lamp.coneDeg > 0 && lamp.coneDeg <= 150))
        return wrong("coneDeg", lamp.coneDeg, "in (0, 150]");
    if (!(glm::distance(lamp.target, lamp.position) > 0))
        return "lamp: target is its position, must be another point";
    return "";
}

void checkLights(int cascades, std::span<const Lamp> lamps) {
    if (cascades < 1 || cascades > kMostCascades)
        throw std::invalid_argument("cascades is " + std::to_string(cascades) +
                                    ", must be in [1, " + std::to_string(kMostCascades) + "]");
    if (lamps.size() > kMostLamps)
        throw std::invalid_argument("the scene has " + std::to_string(lamps.size()) +
                                    " lamps, must be at most " + std::to_string(kMostLamps));
    for (const Lamp& lamp : lamps)
        if (const std::string problem = validate(lamp); !problem.empty())
            throw std::invalid_argument(problem);
}

std::vector<LightView> lampViews(const Lamp& lamp, std::size_t light) {
    if (const std::string problem = validate(lamp); !problem.empty())
        throw std::invalid_argument(problem);
    if (lamp.kind == Lamp::Kind::spot) {
        const glm::dvec3 axis = glm::normalize(glm::dvec3(lamp.target) - glm::dvec3(lamp.position));
        return {pyramid(lamp, axis, std::tan(glm::radians(static_cast<double>(lamp.coneDeg)) / 2),
                        light)};
    }
    std::vector<LightView> faces;
    for (int axis = 0; axis < 3; ++axis)
        for (const double side : {1.0, -1.0}) {
            glm::dvec3 forward(0);
            forward[axis] = side;
            faces.push_back(pyramid(lamp, forward, 1, light));
        }
    return faces;
}

void fitLampDepth(ShadowWindow& window, const Bounds& casters, const Bounds& surfaces) {
    // Room for receivers behind the farthest caster, so that a depth near 1 is told from it.
    constexpr double kRoomBehind = 1.25;
    const glm::dvec3 at = *window.lampAt;
    const glm::dvec3 low(casters.low), high(casters.high);
    if (!glm::all(glm::lessThanEqual(low, high))) return;
    // Ground that is no caster is drawn too: cut away before it, the map would hold nothing there.
    const double nearest = glm::distance(
        at, glm::clamp(at, glm::min(low, glm::dvec3(surfaces.low)),
                       glm::max(high, glm::dvec3(surfaces.high))));
    const double farthest = glm::length(glm::max(glm::abs(low - at), glm::abs(high - at)));
    // In the corner of the map a distance along its axis is the least share of the whole one.
    const double halfWidth = 0.5 * window.extentM;
    const double cornerShare = 0.99 / std::sqrt(1 + 2 * halfWidth * halfWidth);
    const double nearM = std::max(window.nearM, cornerShare * nearest);
    const double farM = std::min(window.nearM + window.depthRangeM, kRoomBehind * farthest);
    if (nearM < farM) setDepths(window, nearM, farM);
}

void narrowLampView(LightView& view, const Bounds& casters, const ConvexBody& seen,
                    std::optional<int>& heldStep) {
    const double wholeM = view.window.extentM;
    view.window = narrowLampWindow(view.window, casters, seen, heldStep);
    view.softnessUv = std::min(view.softnessUv * wholeM / view.window.extentM, 1.0);
}

std::vector<double> cascadeSplits(double nearM, double farM, int count) {
    std::vector<double> splits;
    for (int i = 0; i <= count; ++i) {
        const double share = static_cast<double>(i) / count;
        splits.push_back(0.5 * nearM * std::pow(farM / nearM, share) +
                         0.5 * (nearM + (farM - nearM) * share));
    }
    return splits;
}

float nearestSeenM(const OrbitCamera& camera) {
    return 0.02F * camera.distanceM;
}

float farthestSeenM(const OrbitCamera& camera) {
    return std::max(200.0F, 40 * camera.distanceM);
}

std::vector<LightView> sunViews(const ShadowWindow& whole, const Bounds& casters,
                                const OrbitCamera& camera, double aspect, int cascades,
                                double reachM, std::vector<std::optional<int>>& heldSteps) {
    heldSteps.resize(static_cast<std::size_t>(cascades));
    const double nearM = static_cast<double>(nearestSeenM(camera));
    const double farM = static_cast<double>(farthestSeenM(camera));
    ConvexBody receivers = viewVolume(camera, aspect, nearM, farM);
    if (cascades == 1) {
        LightView view;
        view.window = narrowShadowWindow(whole, casters, receivers, reachM, heldSteps[0]);
        return {view};
    }
    // Only as far as there is something to shadow.
    const ConvexBody shadowed = shadowedBody(whole, casters);
    receivers.insert(receivers.end(), shadowed.begin(), shadowed.end());
    const glm::dvec3 eye(camera.eye());
    const glm::dvec3 forward = glm::normalize(glm::dvec3(camera.target) - eye);
    double nearest = farM;
    double farthest = nearM;
    for (const glm::dvec3& corner : cornersOf(receivers)) {
        nearest = std::min(nearest, glm::dot(corner - eye, forward));
        farthest = std::max(farthest, glm::dot(corner - eye, forward));
    }
    if (!(nearest < farthest)) {
        nearest = nearM;
        farthest = farM;
    }
    const std::vector<double> splits = cascadeSplits(std::max(nearest, nearM), farthest, cascades);
    std::vector<LightView> views;
    for (std::size_t i = 0; i + 1 < splits.size(); ++i) {
        LightView view;
        view.window =
            narrowShadowWindow(whole, casters, viewVolume(camera, aspect, splits[i], splits[i + 1]),
                               reachM, heldSteps[i]);
        if (i > 0) view.window.part.fromM = splits[i];
        if (i + 2 < splits.size()) view.window.part.toM = splits[i + 1];
        views.push_back(view);
    }
    return views;
}

}  // namespace renderer
