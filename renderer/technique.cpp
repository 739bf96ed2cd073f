// SPDX-License-Identifier: MIT
#include "renderer/technique.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

namespace renderer {

std::string_view toText(MapFormat format) {
    switch (format) {
        case MapFormat::depth32f:
            return "32-bit depth";
        case MapFormat::r32f:
            return "1 x 32-bit float";
        case MapFormat::rg32f:
            return "2 x 32-bit float";
        case MapFormat::rgba32f:
            return "4 x 32-bit float";
        case MapFormat::r16f:
            return "1 x 16-bit float";
        case MapFormat::rg16f:
            return "2 x 16-bit float";
        case MapFormat::rgba16f:
            return "4 x 16-bit float";
        case MapFormat::rg16fSplit:
            return "2 x two 16-bit floats";
        case MapFormat::rgba16:
            return "4 x 16-bit fixed point";
        case MapFormat::rg32ui:
            return "2 x 32-bit integer";
    }
    return "unknown format";
}

int bytesPerTexel(MapFormat format) {
    switch (format) {
        case MapFormat::r16f:
            return 2;
        case MapFormat::depth32f:
        case MapFormat::r32f:
        case MapFormat::rg16f:
            return 4;
        case MapFormat::rg32f:
        case MapFormat::rgba16f:
        case MapFormat::rg16fSplit:
        case MapFormat::rgba16:
        case MapFormat::rg32ui:
            return 8;
        case MapFormat::rgba32f:
            return 16;
    }
    return 16;
}

int channelsOf(MapFormat format) {
    switch (format) {
        case MapFormat::depth32f:
        case MapFormat::r32f:
        case MapFormat::r16f:
            return 1;
        case MapFormat::rg32f:
        case MapFormat::rg16f:
        case MapFormat::rg32ui:
            return 2;
        case MapFormat::rgba32f:
        case MapFormat::rgba16f:
        case MapFormat::rg16fSplit:
        case MapFormat::rgba16:
            return 4;
    }
    return 4;
}

std::string_view toText(Prefilter prefilter) {
    switch (prefilter) {
        case Prefilter::none:
            return "none";
        case Prefilter::mean:
            return "separable mean";
        case Prefilter::logMean:
            return "separable mean of exponentials, in logarithms";
        case Prefilter::minMaxMean:
            return "separable mean, least and greatest";
        case Prefilter::converted:
            return "none; texels converted";
        case Prefilter::mips:
            return "mip chain";
        case Prefilter::sums:
            return "summed-area table";
    }
    return "unknown prefilter";
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
    return std::none_of(doNotHold.begin(), doNotHold.end(),
                        [&](const Exemption& exemption) { return exemption.property == property; });
}

ParameterValues Technique::standardParameters() const {
    ParameterValues values{};
    std::transform(parameters.begin(), parameters.end(), values.begin(),
                   [](const TechniqueParameter& parameter) { return parameter.standard; });
    return values;
}

std::string Technique::shaderFile() const {
    return "filters/" + std::string(fileName()) + ".glsl";
}

std::optional<std::size_t> Technique::parameterSlot(std::string_view parameter) const {
    for (std::size_t i = 0; i < parameters.size(); ++i)
        if (parameters[i].name == parameter) return i;
    return std::nullopt;
}

int Technique::mapLayers(const ParameterValues& values) const {
    const auto slot = parameterSlot(termsParameter);
    return slot ? (static_cast<int>(values[*slot]) + termsPerTexel - 1) / termsPerTexel : 1;
}

int Technique::mapSamples(const ParameterValues& values) const {
    const auto slot = parameterSlot("map_samples");
    return slot ? static_cast<int>(values[*slot]) : 1;
}

std::string valueText(const TechniqueParameter& parameter, float value) {
    if (parameter.zeroIsAuto && value == 0) return "auto";
    char text[32];
    std::snprintf(text, sizeof text, "%g", static_cast<double>(value));
    return text;
}

std::string rangeText(const TechniqueParameter& parameter) {
    if (parameter.whole && parameter.low == 0 && parameter.high == 1) return "0 or 1";
    TechniqueParameter numbers = parameter;
    numbers.zeroIsAuto = false;
    const std::string range = valueText(numbers, parameter.zeroIsAuto ? 1 : parameter.low) +
                              " to " + valueText(numbers, parameter.high) +
                              (parameter.whole ? " in whole numbers" : "");
    return parameter.zeroIsAuto ? "auto or " + range : range;
}

namespace {

template <class Rows>
std::string namesOf(const Rows& rows) {
    std::string names;
    for (const auto& row : rows) names += (names.empty() ? "" : ", ") + std::string(row.name);
    return names.empty() ? "none" : names;
}

void checkParameter(const Technique& technique, const TechniqueParameter& parameter, float value) {
    const bool inRange = value >= parameter.low && value <= parameter.high;
    if (inRange && !(parameter.whole && value != std::floor(value))) return;
    char number[32];
    std::snprintf(number, sizeof number, "%g", static_cast<double>(value));
    throw std::invalid_argument("parameter " + std::string(parameter.name) + " of technique " +
                                std::string(technique.name) + " is " + number + ", must be " +
                                rangeText(parameter));
}

}  // namespace

const Technique& findTechnique(std::string_view name) {
    for (const Technique& technique : techniques())
        if (technique.name == name) return technique;
    throw std::invalid_argument("technique \"" + std::string(name) +
                                "\" is not known; known are: " + namesOf(techniques()));
}

void setParameter(const Technique& technique, ParameterValues& values, std::string_view name,
                  float value) {
    const auto slot = technique.parameterSlot(name);
    if (!slot)
        throw std::invalid_argument("technique " + std::string(technique.name) +
                                    " has no parameter \"" + std::string(name) +
                                    "\"; it has: " + namesOf(technique.parameters));
    checkParameter(technique, technique.parameters[*slot], value);
    values[*slot] = value;
}

void checkParameters(const Technique& technique, const ParameterValues& values) {
    for (std::size_t i = 0; i < technique.parameters.size(); ++i)
        checkParameter(technique, technique.parameters[i], values[i]);
}

}  // namespace renderer
