// SPDX-License-Identifier: MIT
#include "demo/frame_facts.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <tuple>

#include "demo/demand_glsl.h"
#include "demo/gpu_demand.h"
#include "demo/map_places.h"
#include "renderer/demand_pass.h"

namespace demo {
namespace {

namespace rc = resolution_controller;

std::size_t coveredPixels(renderer::Renderer& frame) {
    const renderer::FloatImage places = mapPlaces(frame);
    std::size_t covered = 0;
    for (std::size_t i = 0; i < places.values.size(); i += 4) {
        const auto inside = [&](MapPlace channel) {
            const float at = places.values[i + static_cast<std::size_t>(channel)];
            return at >= 0 && at <= 1;
        };
        covered += places.values[i + kPlaceIsSurface] != 0 && inside(kPlaceU) && inside(kPlaceV);
    }
    return covered;
}

/// Counts each rule once: policies that differ in their percentile alone ask the same.
class DemandCounter {
  public:
    explicit DemandCounter(const renderer::Renderer& frame)
        : frame_(frame), pass_(renderer::ShaderLibrary::embedded(), kDemandGlsl) {}

    rc::DemandHistogram of(const rc::DemandRule& rule) {
        const auto key = std::tuple(rule.c, rule.pixelBound, rule.contrastExponent);
        const auto [found, isNew] = counted_.try_emplace(key);
        // Every pixel, as the automatic size adds them up.
        const int edge = renderer::DemandPass::cellEdge(frame_.widthPx(), frame_.heightPx());
        for (int i = 0; isNew && i < edge * edge; ++i) {
            pass_.submit(frame_, gpuRule(rule));
            glFinish();
            while (const auto counters = pass_.next()) found->second += histogramOf(*counters);
        }
        return found->second;
    }

  private:
    const renderer::Renderer& frame_;
    renderer::DemandPass pass_;
    std::map<std::tuple<float, float, float>, rc::DemandHistogram> counted_;
};

}  // namespace

FrameFacts frameFacts(renderer::Renderer& frame, const resolution_controller::Slope& slope) {
    const renderer::Scene& scene = frame.scene();
    const glm::vec3 middle = 0.5F * (scene.casters.low + scene.casters.high);
    const double radiusM =
        0.5 * static_cast<double>(glm::distance(scene.casters.low, scene.casters.high));
    FrameFacts facts;
    facts.screenEdgePx = std::max(frame.widthPx(), frame.heightPx());
    facts.coveredPx = static_cast<double>(coveredPixels(frame));
    facts.mapExtentM = frame.window().extentM;
    // Within the casters' sphere there is no distance to it.
    facts.distanceM =
        std::max(static_cast<double>(glm::distance(scene.camera.eye(), middle)), 0.1 * radiusM);
    const double field =
        static_cast<double>(scene.camera.verticalFieldDeg) * std::numbers::pi / 180;
    const double pixelsPerTangent = 0.5 * frame.heightPx() / std::tan(0.5 * field);
    facts.casterRadiusPx = pixelsPerTangent * radiusM / facts.distanceM;
    facts.slope = slope;
    auto counter = std::make_shared<DemandCounter>(frame);
    facts.demand = [counter](const rc::DemandRule& rule) { return counter->of(rule); };
    return facts;
}

}  // namespace demo
