// SPDX-License-Identifier: MIT
// Random contents of our files: everything that the formats allow, with the odd values in it (texts
// in any script, numbers of any exponent, absent fields).
#pragma once

#include <random>
#include <string>
#include <vector>

#include "records/session_sidecar.h"
#include "records/slope_file.h"
#include "records/trial_table.h"

namespace tests {

/// A trial that the writers accept.
records::Trial randomTrial(std::mt19937_64& random, int number, std::size_t extraCells = 0);
std::vector<records::Trial> randomTrials(std::mt19937_64& random, int count,
                                         std::size_t extraCells = 0);
/// Header and rows, as the journal writes them.
std::string tableText(const std::vector<records::Trial>& trials,
                      const std::vector<std::string>& extraColumns = {});

records::RunContext randomContext(std::mt19937_64& random);
records::Slope randomSlope(std::mt19937_64& random);
records::SessionSidecar randomSidecar(std::mt19937_64& random);

}  // namespace tests
