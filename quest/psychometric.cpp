// SPDX-License-Identifier: MIT
#include "quest/psychometric.h"

#include "quest/sentence.h"

namespace quest {

std::string validate(const ResponseModel& model) {
    if (!(model.gamma >= 0 && model.gamma <= 1)) {
        return sentence("gamma", model.gamma, "must be a probability in [0, 1]");
    }
    if (!(model.lapse >= 0 && model.lapse < 1)) {
        return sentence("lapse", model.lapse, "must be a probability in [0, 1)");
    }
    if (!(model.lapseGuess >= 0 && model.lapseGuess <= 1)) {
        return sentence("lapseGuess", model.lapseGuess, "must be a probability in [0, 1]");
    }
    return {};
}

std::string validateCurve(double beta, double criterion) {
    if (!(beta > 0 && std::isfinite(beta))) {
        return sentence("beta", beta, "must be finite and greater than 0");
    }
    if (!(criterion > 0 && criterion < 1)) {
        return sentence("criterion", criterion, "must be in (0, 1)");
    }
    return {};
}

}  // namespace quest
