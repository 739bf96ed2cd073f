// SPDX-License-Identifier: MIT
#include "renderer/prefilter.h"

#include <algorithm>
#include <cmath>

#include "renderer/shader_math.h"

namespace renderer {
namespace {

float fraction(float radius) {
    return radius > 0 ? std::min(radius, 1.0F) : 0;
}

// A lookup in the kernel's reach reads the texel beyond it as well, and one more for rounding.
constexpr float kGuardBeyondReach = 2;

}  // namespace

glm::vec4 prefilterConstants(const Technique& technique, const ParameterValues& parameters,
                             float radiusUv, float minRadiusUv, int resolution) {
    if (technique.prefilter == Prefilter::none) return glm::vec4(0);
    const float radius = technique.prefilter == Prefilter::converted
                             ? 0
                             : std::max(fraction(radiusUv), fraction(minRadiusUv));
    const auto gaussian = technique.parameterSlot("gaussian");
    f32::ShadowConstants constants{};
    constants.prefilter.x = 0.5F * radius * static_cast<float>(resolution);
    constants.prefilter.y = gaussian && parameters[*gaussian] != 0 ? 1 : 0;
    constants.prefilter.z = std::ceil(kernelReach(constants)) + kGuardBeyondReach;
    constants.prefilter.w = technique.format == MapFormat::rg16fSplit ? 1 : 0;
    return constants.prefilter;
}

}  // namespace renderer
