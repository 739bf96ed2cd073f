// SPDX-License-Identifier: MIT
#include "resolution_controller/audience.h"

#include <cmath>
#include <stdexcept>

#include "resolution_controller/sentence.h"

namespace resolution_controller {
namespace {

constexpr double kNinety = 1.2815515655446004;  // z(.9)

/// Quantile of the normal distribution by bisection on erfc: not a call for every frame.
double normalQuantile(double share) {
    double low = -10, high = 10;
    for (int i = 0; i < 100; ++i) {
        const double middle = (low + high) / 2;
        (std::erfc(-middle / std::sqrt(2.0)) / 2 < share ? low : high) = middle;
    }
    return (low + high) / 2;
}

double roundedTo21Bits(double value) {
    int exponent = 0;
    const double mantissa = std::frexp(value, &exponent);
    return std::ldexp(std::nearbyint(std::ldexp(mantissa, 21)), exponent - 21);
}

std::uint32_t bit(Warning warning) {
    return static_cast<std::uint32_t>(warning);
}

std::uint32_t mismatches(const Slope& slope, const RendererTraits& renderer) {
    std::uint32_t result = 0;
    if (slope.encoding == Encoding::unknown) {
        result |= bit(Warning::encodingUnknown);
    } else if (renderer.encoding != Encoding::unknown && renderer.encoding != slope.encoding) {
        result |= bit(Warning::encodingDiffers);
    }
    if (slope.kernel == Kernel::unknown) {
        result |= bit(Warning::kernelUnknown);
    } else if (renderer.kernel != Kernel::unknown && renderer.kernel != slope.kernel) {
        result |= bit(Warning::kernelDiffers);
    }
    return result;
}

}  // namespace

const char* text(Warning warning) noexcept {
    switch (warning) {
        case Warning::encodingDiffers:
            return "the slope was measured with filtering in the other encoding (light or code "
                   "values)";
        case Warning::kernelDiffers:
            return "the slope was measured with another filter kernel";
        case Warning::encodingUnknown:
            return "the slope does not say in which encoding it was measured";
        case Warning::kernelUnknown:
            return "the slope does not say with which filter kernel it was measured";
        case Warning::populationUnknown:
            return "the slope does not say how observers differ: c is the mean observer's";
    }
    return "unknown";
}

AudienceSlope slopeFor(const Slope& slope, const Audience& audience,
                       const RendererTraits& renderer) {
    if (!(audience.detection >= 0 && audience.detection < 1)) {
        throw std::invalid_argument(
            sentence("audience.detection", audience.detection, "must be in [0, 1)"));
    }
    if (!(audience.people >= 0.01 && audience.people <= 0.99)) {
        throw std::invalid_argument(
            sentence("audience.people", audience.people, "must be in [0.01, 0.99]"));
    }
    AudienceSlope result{
        .slope = atCriterion(slope, audience.detection > 0 ? audience.detection : slope.criterion),
        .warnings = mismatches(slope, renderer)};
    Slope& asked = result.slope;
    if (audience.people != 0.5) {
        if (asked.c90 > 0) {
            asked.c *= std::pow(asked.c90 / asked.c, normalQuantile(audience.people) / kNinety);
        } else {
            result.warnings |= bit(Warning::populationUnknown);
        }
    }
    if (asked.c != slope.c) asked.c = roundedTo21Bits(asked.c);
    if (const std::string problem = validate(asked); !problem.empty()) {
        throw std::invalid_argument("for this audience " + problem);
    }
    return result;
}

std::string describe(const Audience& audience) {
    char words[120];
    char how[60] = "detected as often as in the study";
    if (audience.detection > 0) {
        std::snprintf(how, sizeof how, "detected in at most %.3g %% of looks",
                      100 * audience.detection);
    }
    if (audience.people == 0.5) {
        std::snprintf(words, sizeof words, "%s, for the mean observer", how);
    } else {
        std::snprintf(words, sizeof words, "%s, for %.3g %% of people", how, 100 * audience.people);
    }
    return words;
}

}  // namespace resolution_controller
