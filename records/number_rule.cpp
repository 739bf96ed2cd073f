// SPDX-License-Identifier: MIT
#include "records/number_rule.h"

#include <cmath>

#include "records/quoted_text.h"

namespace records {

bool NumberRule::holds(double value) const {
    if (!std::isfinite(value)) return false;
    const bool aboveLow = lowIncluded ? value >= low : value > low;
    const bool belowHigh = highIncluded ? value <= high : value < high;
    return aboveLow && belowHigh;
}

std::string NumberRule::text(const std::string& kind) const {
    const bool hasLow = std::isfinite(low), hasHigh = std::isfinite(high);
    std::string sentence = "must be a " + kind;
    if (!hasLow && !hasHigh) return kind == "number" ? "must be a finite number" : sentence;
    if (hasLow && hasHigh && lowIncluded && highIncluded)
        return sentence + " from " + exactText(low) + " to " + exactText(high);
    if (hasLow) sentence += (lowIncluded ? " of at least " : " greater than ") + exactText(low);
    if (hasLow && hasHigh) sentence += " and";
    if (hasHigh) sentence += (highIncluded ? " of at most " : " less than ") + exactText(high);
    return sentence;
}

}  // namespace records
