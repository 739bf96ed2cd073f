// SPDX-License-Identifier: MIT
// Designs in which values were replaced at random, with a fixed seed: most break a rule, some do
// not.
#pragma once

#include <nlohmann/json.hpp>
#include <random>

namespace tests {

/// A design that uses every field but frames.
nlohmann::json fullDesign();

/// One to three values, fields or items of it replaced, added or taken away.
nlohmann::json mutated(std::mt19937_64& random, const nlohmann::json& design);

}  // namespace tests
