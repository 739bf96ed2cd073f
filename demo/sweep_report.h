// SPDX-License-Identifier: MIT
// The report of a sweep: policies at equal quality first, then speed against error, what the slope
// buys, cost by pass, stair-steps against r/a, flicker; one self-contained page, and every table
// beside it as TSV.
#pragma once

#include <filesystem>
#include <optional>

#include "demo/sweep_table.h"

namespace demo {

/// Writes sweep.html and its tables into the folder; returns the page's path. `stability` is the
/// table that technique_errors prints. Throws std::runtime_error where something cannot be read or
/// written.
std::filesystem::path writeSweepReport(const std::filesystem::path& folder, const SweepTable& table,
                                       const std::optional<std::filesystem::path>& stability);

/// What is wrong with a technique, so that the page begins with it: errors that are no numbers, or
/// a map next to the reference that is far from it. Empty where nothing is.
std::vector<std::string> brokenTechniques(const SweepTable& table);

}  // namespace demo
