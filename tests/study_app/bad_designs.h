// SPDX-License-Identifier: MIT
// Designs that must be refused: by the reader all of them, by the published schema those whose rule
// looks at one field.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace tests {

nlohmann::json smallDesign();  ///< a valid one
nlohmann::json patched(const std::string& pointer, const nlohmann::json& value);
nlohmann::json without(const std::string& key);

struct BadDesign {
    const char* claim;
    nlohmann::json design;
    std::vector<std::string> parts;  ///< of the reader's sentence: field, value, rule
};
std::vector<BadDesign> badDesigns();

}  // namespace tests
