// SPDX-License-Identifier: MIT
#include "quest/simulated_observer.h"

#include <cmath>
#include <stdexcept>

#include "quest/random.h"
#include "quest/sentence.h"

namespace quest {

std::string validate(const SimulatedObserver& observer) {
    if (!std::isfinite(observer.threshold)) {
        return sentence("threshold", observer.threshold, "must be finite");
    }
    if (std::string problem = validateCurve(observer.beta, observer.criterion); !problem.empty()) {
        return problem;
    }
    return validate(observer.response);
}

double yesProbability(const SimulatedObserver& observer, std::optional<double> x) {
    if (const std::string problem = validate(observer); !problem.empty()) {
        throw std::invalid_argument("simulated observer: " + problem);
    }
    if (!x) return responseProbability(0.0, observer.response);
    if (std::isnan(*x)) {
        throw std::invalid_argument(
            sentence("simulated observer: x", *x, "must be a number (log10(a / r))"));
    }
    return responseProbability(
        detectionProbability(*x - observer.threshold, observer.beta, observer.criterion),
        observer.response);
}

bool answer(const SimulatedObserver& observer, std::optional<double> x, std::mt19937_64& rng) {
    const double p = yesProbability(observer, x);
    return uniform01(rng) < p;
}

}  // namespace quest
