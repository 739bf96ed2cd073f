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

/// The mip level whose texels are as large as a radius, rounded up.
float levelsOfKernel(float radiusTexels) {
    return std::ceil(std::log2(std::max(radiusTexels, 1.0F)));
}

/// Units that make 1 in a summed map: as many as still let the sum under the widest box, with the
/// texels that it touches on both sides, be told modulo 2^32. A power of two, so that float32
/// scales without rounding, of at most 2^23, below which it still holds the half that rounding
/// adds.
float summedUnits(float reachTexels) {
    const double edge = 2.0 * static_cast<double>(reachTexels) + 2;
    return static_cast<float>(
        std::exp2(std::min(std::floor(std::log2(0x1p32 / (edge * edge)) - 1e-9), 23.0)));
}

float parameterOr(const Technique& technique, const ParameterValues& parameters,
                  std::string_view name, float absent) {
    const auto slot = technique.parameterSlot(name);
    return slot ? parameters[*slot] : absent;
}

}  // namespace

glm::vec4 prefilterConstants(const Technique& technique, const ParameterValues& parameters,
                             float radiusUv, float minRadiusUv, int resolution) {
    if (technique.prefilter == Prefilter::none) return glm::vec4(0);
    const auto valueOr = [&](std::string_view name, float absent) {
        return parameterOr(technique, parameters, name, absent);
    };
    const float least = fraction(minRadiusUv);
    // Of the widest kernel, where a lookup chooses: a blocker may lie as far before it as the
    // light.
    const float radius =
        technique.prefilter == Prefilter::converted
            ? 0
            : std::max(fraction(fraction(radiusUv) / valueOr("distance", 1)), least);
    f32::ShadowConstants constants{};
    constants.prefilter.x = 0.5F * radius * static_cast<float>(resolution) / valueOr("samples", 1);
    constants.prefilter.y = valueOr("gaussian", 0) != 0 ? 1 : 0;
    float reach = std::ceil(kernelReach(constants));
    if (technique.prefilter == Prefilter::mips) {
        const float levels = levelsOfKernel(2 * constants.prefilter.x);
        reach = std::exp2(levels + 1);  // one texel of the coarsest level outside the map
        // And for pixels that see more of the map than the kernel.
        constants.prefilter.w =
            -std::max(levels, std::floor(std::log2(static_cast<float>(resolution))));
    }
    if (technique.prefilter == Prefilter::sums) constants.prefilter.w = -summedUnits(reach);
    if (technique.format == MapFormat::rg16fSplit) constants.prefilter.w = 1;
    constants.prefilter.z = reach + kGuardBeyondReach;
    return constants.prefilter;
}

float lookupSpreadTexels(const Technique& technique, const ParameterValues& parameters,
                         glm::vec4 prefilter) {
    f32::ShadowConstants constants{};
    constants.prefilter = prefilter;
    return kernelReach(constants) * (parameterOr(technique, parameters, "samples", 1) - 1);
}

}  // namespace renderer
