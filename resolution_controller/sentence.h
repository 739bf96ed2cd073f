// SPDX-License-Identifier: MIT
// One form for every complaint about a number: "slope.c is -1: must be finite and greater than 0".
#pragma once

#include <cstdio>
#include <string>
#include <string_view>

namespace resolution_controller {

inline std::string sentence(std::string_view name, double value, std::string_view rule) {
    char number[32];
    std::snprintf(number, sizeof number, "%.15g", value);
    return std::string(name) + " is " + number + ": " + std::string(rule);
}

}  // namespace resolution_controller
