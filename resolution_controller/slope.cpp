// SPDX-License-Identifier: MIT
#include "resolution_controller/slope.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "resolution_controller/portable_power.h"
#include "resolution_controller/sentence.h"

namespace resolution_controller {
namespace {

constexpr double kLargestContrastExponent = 4;

bool positiveAndFinite(double value) {
    return value > 0 && std::isfinite(value);
}

std::string validateWords(const Slope& s) {
    const auto number = [](auto word) { return static_cast<double>(word); };
    if (s.task > Task::yesNo) return sentence("slope.task", number(s.task), "must be 0 or 1");
    if (s.encoding > Encoding::unknown) {
        return sentence("slope.encoding", number(s.encoding), "must be in 0 to 2");
    }
    if (s.kernel > Kernel::unknown) {
        return sentence("slope.kernel", number(s.kernel), "must be in 0 to 4");
    }
    return {};
}

const char* text(Encoding encoding) {
    switch (encoding) {
        case Encoding::srgb:
            return "light (sRGB)";
        case Encoding::code:
            return "code values";
        case Encoding::unknown:
            break;
    }
    return "an unknown encoding";
}

}  // namespace

std::string validate(const Slope& slope) {
    if (slope.major != kSlopeMajor) {
        return sentence("slope.major", slope.major,
                        "must be " + std::to_string(kSlopeMajor) +
                            ", the version of the slope file that is understood here");
    }
    if (!positiveAndFinite(slope.c)) {
        return sentence("slope.c", slope.c, "must be finite and greater than 0");
    }
    if (!(slope.criterion > 0 && slope.criterion < 1)) {
        return sentence("slope.criterion", slope.criterion, "must be in (0, 1)");
    }
    if (!positiveAndFinite(slope.beta)) {
        return sentence("slope.beta", slope.beta, "must be finite and greater than 0");
    }
    if (slope.c90 != 0 && !positiveAndFinite(slope.c90)) {
        return sentence("slope.c90", slope.c90, "must be finite and greater than 0, or 0");
    }
    if (!(std::abs(slope.contrastExponent) <= kLargestContrastExponent)) {
        return sentence("slope.contrastExponent", slope.contrastExponent, "must be in [-4, 4]");
    }
    return validateWords(slope);
}

Slope atCriterion(const Slope& slope, double criterion) {
    if (const std::string problem = validate(slope); !problem.empty()) {
        throw std::invalid_argument(problem);
    }
    if (!(criterion > 0 && criterion < 1)) {
        throw std::invalid_argument(sentence("criterion", criterion, "must be in (0, 1)"));
    }
    const double factor =
        std::pow(std::log1p(-slope.criterion) / std::log1p(-criterion), 1 / slope.beta);
    Slope result = slope;
    result.criterion = criterion;
    result.c *= factor;
    result.c90 *= factor;
    return result;
}

double contrastFactor(double contrast, double exponent) noexcept {
    if (exponent == 0 || !std::isfinite(exponent)) return 1;
    if (!(contrast >= 0 && contrast <= 1)) return 1;
    const double e = std::clamp(exponent, -kLargestContrastExponent, kLargestContrastExponent);
    return portablePower(std::max(contrast, kLeastContrast), e);
}

std::string describe(const Slope& slope) {
    char words[200];
    std::snprintf(words, sizeof words,
                  "c = %.3g (detected with probability %.4g at r = c a; %s, filtered in %s, beta "
                  "%.3g)",
                  slope.c, slope.criterion, slope.task == Task::twoAfc ? "2AFC" : "yes/no",
                  text(slope.encoding), slope.beta);
    return words;
}

}  // namespace resolution_controller
