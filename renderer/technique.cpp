// SPDX-License-Identifier: MIT
#include "renderer/technique.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace renderer {
namespace {

constexpr TechniqueParameter kBiasTexels{
    .name = "bias_texels",
    .meaning = "depth bias: change of the receiver plane's depth over this many texels",
    .low = 0,
    .high = 4,
    .standard = 1.0F / 32};

constexpr TechniqueParameter kDepthMapParameters[] = {kBiasTexels};
constexpr Property kHardDoesNot[] = {Property::softnessIndependentOfN};

constexpr Technique kTechniques[] = {
    {.name = "hard",
     .title = "Hard shadow",
     .paper = "Williams 1978, Casting curved shadows on curved surfaces",
     .soft = false,
     .parameters = kDepthMapParameters,
     .doNotHold = kHardDoesNot,
     .doNotHoldBecause = "it has no kernel: its edge is as wide as a texel",
     .cost = "1 texel a pixel"},
    {.name = "pcf_disc",
     .title = "PCF, full disc",
     .paper = "Reeves, Salesin, Cook 1987, Rendering antialiased shadows with depth maps",
     .parameters = kDepthMapParameters,
     .cost = "pi (r/a)^2 texels a pixel, four to a gather: grows with N^2 at constant softness"},
};

}  // namespace

std::string_view toText(MapFormat) {
    return "32-bit depth";
}

int bytesPerTexel(MapFormat) {
    return 4;
}

std::string_view toText(Prefilter) {
    return "none";
}

std::string_view toText(Property property) {
    switch (property) {
        case Property::finiteInUnitRange:
            return "a number in [0,1] for any input";
        case Property::softnessIndependentOfN:
            return "softness independent of N";
        case Property::biasFollowsN:
            return "bias follows N in the same frame";
        case Property::planeLit:
            return "a plane does not shadow itself";
        case Property::monotoneInDepth:
            return "monotone in the receiver's depth";
        case Property::errorFallsWithN:
            return "error falls as N grows";
    }
    return "unknown property";
}

bool Technique::holds(Property property) const {
    return std::find(doNotHold.begin(), doNotHold.end(), property) == doNotHold.end();
}

ParameterValues Technique::standardParameters() const {
    ParameterValues values{};
    std::transform(parameters.begin(), parameters.end(), values.begin(),
                   [](const TechniqueParameter& parameter) { return parameter.standard; });
    return values;
}

std::string Technique::shaderFile() const {
    return "filters/" + std::string(name) + ".glsl";
}

std::span<const Technique> techniques() {
    return kTechniques;
}

const Technique& findTechnique(std::string_view name) {
    std::string known;
    for (const Technique& technique : techniques()) {
        if (technique.name == name) return technique;
        known += (known.empty() ? "" : ", ") + std::string(technique.name);
    }
    throw std::invalid_argument("technique \"" + std::string(name) +
                                "\" is not known; known are: " + known);
}

void setParameter(const Technique& technique, ParameterValues& values, std::string_view name,
                  float value) {
    std::string known;
    for (std::size_t i = 0; i < technique.parameters.size(); ++i) {
        const TechniqueParameter& parameter = technique.parameters[i];
        if (parameter.name == name) {
            if (!(value >= parameter.low && value <= parameter.high))
                throw std::invalid_argument("parameter " + std::string(name) + " of technique " +
                                            std::string(technique.name) + " is " +
                                            std::to_string(value) + ", must be in [" +
                                            std::to_string(parameter.low) + ", " +
                                            std::to_string(parameter.high) + "]");
            values[i] = value;
            return;
        }
        known += (known.empty() ? "" : ", ") + std::string(parameter.name);
    }
    throw std::invalid_argument("technique " + std::string(technique.name) +
                                " has no parameter \"" + std::string(name) +
                                "\"; it has: " + (known.empty() ? "none" : known));
}

}  // namespace renderer
