// SPDX-License-Identifier: MIT
#include "resolution_controller/slope.h"

#include <cmath>
#include <stdexcept>

#include "resolution_controller/sentence.h"

namespace resolution_controller {

std::string validate(const Slope& slope) {
    if (!(slope.c > 0 && std::isfinite(slope.c))) {
        return sentence("slope.c", slope.c, "must be finite and greater than 0");
    }
    if (!(slope.criterion > 0 && slope.criterion < 1)) {
        return sentence("slope.criterion", slope.criterion, "must be in (0, 1)");
    }
    if (!(slope.beta > 0 && std::isfinite(slope.beta))) {
        return sentence("slope.beta", slope.beta, "must be finite and greater than 0");
    }
    return {};
}

Slope atCriterion(const Slope& slope, double criterion) {
    if (const std::string problem = validate(slope); !problem.empty()) {
        throw std::invalid_argument(problem);
    }
    if (!(criterion > 0 && criterion < 1)) {
        throw std::invalid_argument(sentence("criterion", criterion, "must be in (0, 1)"));
    }
    Slope result = slope;
    result.criterion = criterion;
    result.c *= std::pow(std::log1p(-slope.criterion) / std::log1p(-criterion), 1 / slope.beta);
    return result;
}

std::string describe(const Slope& slope) {
    char text[200];
    std::snprintf(text, sizeof text,
                  "c = %.3g (detected with probability %.4g at r = c a; %s, filtered in %s, beta "
                  "%.3g)",
                  slope.c, slope.criterion, slope.task == Task::twoAfc ? "2AFC" : "yes/no",
                  slope.encoding == Encoding::srgb ? "light (sRGB)" : "code values", slope.beta);
    return text;
}

}  // namespace resolution_controller
