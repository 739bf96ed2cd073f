// SPDX-License-Identifier: MIT
// Maps and receivers that tests make up, and a technique's answer to them on the CPU.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <type_traits>
#include <vector>

#include "renderer/cpu_filter.h"
#include "renderer/layer_placement.h"
#include "renderer/prefilter.h"

namespace tests {

/// Doubles that every standard library draws alike.
class Random {
  public:
    explicit Random(std::uint64_t seed) : engine_(seed) {}
    double operator()(double low = 0, double high = 1) {
        return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53;
    }
    int whole(int low, int high) {
        return std::min(static_cast<int>((*this)(low, high + 1)), high);
    }

  private:
    std::mt19937_64 engine_;
};

/// A square map of depths, from a function of (u, v).
struct DepthMap {
    int edge;
    std::vector<float> texels;

    template <class Depth>
    DepthMap(int n, const Depth& depth) : edge(n) {
        for (int j = 0; j < n; ++j)
            for (int i = 0; i < n; ++i)
                texels.push_back(static_cast<float>(depth((i + 0.5) / n, (j + 0.5) / n)));
    }
    renderer::MapView view() const { return {texels.data(), edge}; }
};

/// A half-plane at an angle to the texel grid, `near` below the line and `far` above it. The line
/// runs through the map's middle, `phase` texels above it.
inline DepthMap halfPlane(int n, double angleDeg, double phase, double near = 0, double far = 1) {
    const double s = std::sin(angleDeg * std::numbers::pi / 180);
    const double c = std::cos(angleDeg * std::numbers::pi / 180);
    return DepthMap(n, [=](double u, double v) {
        return c * (v - 0.5) - s * (u - 0.5) > phase / n ? far : near;
    });
}

/// Of a technique that would choose its layers by the map: as many, of equal shares.
inline constexpr int kEvenLayers = 4;

inline renderer::f64::ShadowConstants constantsFor(const renderer::Technique& technique, int n,
                                                   double radiusUv,
                                                   const renderer::ParameterValues& parameters) {
    renderer::f64::ShadowConstants c{};
    c.map = {n, 1.0 / n, 1.0 / n, 0};
    c.kernel = {radiusUv, 0, 1, 0};
    for (std::size_t i = 0; i < parameters.size(); ++i)
        c.parameters[i / 4][static_cast<int>(i % 4)] = static_cast<double>(parameters[i]);
    c.prefilter =
        glm::dvec4(prefilterConstants(technique, parameters, static_cast<float>(radiusUv), 0, n));
    if (const auto slot = technique.parameterSlot("layers")) {
        const int asked = static_cast<int>(parameters[*slot]);
        useLayers(technique, renderer::evenLayers(asked == 0 ? kEvenLayers : asked), c);
    }
    return c;
}

inline renderer::f64::ShadowConstants constantsFor(const renderer::Technique& technique, int n,
                                                   double radiusUv) {
    return constantsFor(technique, n, radiusUv, technique.standardParameters());
}

inline renderer::f32::ShadowConstants toFloat(const renderer::f64::ShadowConstants& c) {
    renderer::f32::ShadowConstants f{};
    f.map = glm::vec4(c.map);
    f.kernel = glm::vec4(c.kernel);
    for (int i = 0; i < 2; ++i) f.parameters[i] = glm::vec4(c.parameters[i]);
    f.prefilter = glm::vec4(c.prefilter);
    for (int i = 0; i < 4; ++i) f.layerEnds[i] = glm::vec4(c.layerEnds[i]);
    return f;
}

inline renderer::f64::ShadowReceiver receiverAt(double u, double v, double depth,
                                                glm::dvec2 gradient = glm::dvec2(0)) {
    return {.uv = {u, v},
            .depth = depth,
            .depthGradient = gradient,
            .depthError = 2e-6,
            .footprintUv = 0.001,
            .longestStep = {0.001, 0},
            .facesLight = true};
}

inline renderer::f32::ShadowReceiver toFloat(const renderer::f64::ShadowReceiver& r) {
    return {.uv = glm::vec2(r.uv),
            .depth = static_cast<float>(r.depth),
            .depthGradient = glm::vec2(r.depthGradient),
            .depthError = static_cast<float>(r.depthError),
            .footprintUv = static_cast<float>(r.footprintUv),
            .longestStep = glm::vec2(r.longestStep),
            .facesLight = r.facesLight};
}

/// A technique and a map, ready for any number of receivers. Does not own the depths.
template <class Real>
class CpuTechnique {
  public:
    CpuTechnique(const renderer::Technique& technique, const DepthMap& depths,
                 const renderer::f64::ShadowConstants& constants,
                 renderer::Storage storage = renderer::Storage::asFormat)
        : technique_(technique),
          constants_(narrowed(constants)),
          map_(renderer::cpuMap<Real>(technique, depths.view(), constants_, storage)) {}

    double operator()(const renderer::f64::ShadowReceiver& receiver) const {
        return static_cast<double>(
            renderer::cpuVisibility(technique_, map_, narrowed(receiver), constants_));
    }

  private:
    template <class Wide>
    static auto narrowed(const Wide& wide) {
        if constexpr (std::is_same_v<Real, float>)
            return toFloat(wide);
        else
            return wide;
    }

    const renderer::Technique& technique_;
    renderer::ConstantsOf<Real> constants_;
    renderer::CpuMap<Real> map_;
};

/// At default parameters, with nothing lost between the passes.
template <class Real = double>
CpuTechnique<Real> exactly(const renderer::Technique& technique, const DepthMap& depths,
                           double radiusUv) {
    return CpuTechnique<Real>(technique, depths, constantsFor(technique, depths.edge, radiusUv),
                              renderer::Storage::exact);
}

/// A claim that holds in double and in float.
template <class Claim>
void inBothPrecisions(const Claim& claim) {
    claim.template operator()<double>();
    claim.template operator()<float>();
}

}  // namespace tests
