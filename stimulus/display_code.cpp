// SPDX-License-Identifier: MIT
#include "stimulus/display_code.h"

#include "stimulus/sentence.h"

namespace stimulus {

void validateLitLevel(double litLevel) {
    require(litLevel >= 0 && litLevel <= 1, "lit level", litLevel, "", "must be in [0, 1]");
}

}  // namespace stimulus
