// SPDX-License-Identifier: MIT
// What the heads of two sweeps' journals say otherwise, so that times of two machines or errors of
// two plans are not taken for each other's.
#pragma once

#include <string>
#include <vector>

namespace demo {

/// The text of the line "NAME   text"; empty where there is none.
std::string contextLine(const std::string& context, const std::string& name);

/// For each of these lines that differs: NAME is "before" there and "now" here.
std::vector<std::string> contextDifferences(const std::string& before, const std::string& now,
                                            const std::vector<std::string>& names);

}  // namespace demo
