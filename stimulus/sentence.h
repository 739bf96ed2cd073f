// SPDX-License-Identifier: MIT
// One form for every complaint about a number: "filter radius is -1 px: must be finite and not
// negative", thrown as std::invalid_argument.
#pragma once

#include <cstdio>
#include <stdexcept>
#include <string>
#include <string_view>

namespace stimulus {

inline std::string sentence(std::string_view name, double value, std::string_view unit,
                            std::string_view rule) {
    char number[32];
    std::snprintf(number, sizeof number, "%.15g", value);
    return std::string(name) + " is " + number + std::string(unit) + ": " + std::string(rule);
}

/// Throws unless `holds`. Write `holds` so that NaN makes it false.
inline void require(bool holds, std::string_view name, double value, std::string_view unit,
                    std::string_view rule) {
    if (!holds) throw std::invalid_argument(sentence(name, value, unit, rule));
}

}  // namespace stimulus
