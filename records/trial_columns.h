// SPDX-License-Identifier: MIT
// The columns of the trial table: the one list from which the reader, the writer and the
// descriptions in the sidecar are made. A new column is one row here and one member of Trial.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "records/trial_table.h"

namespace records {

inline constexpr std::string_view kUnknownCell = "n/a";

struct TrialColumn {
    std::string_view name;
    bool required;  ///< a table without it is refused
    std::string_view description;
    std::string_view units;                                             ///< "" where it has none
    std::vector<std::pair<std::string_view, std::string_view>> levels;  ///< words and their meaning

    /// Stores a cell in the trial; returns the rule that the cell breaks, or an empty text.
    std::string (*read)(std::string_view cell, Trial& trial);
    /// Appends the trial's value to a row.
    void (*write)(const Trial& trial, std::string& row);
};

/// In the order in which they are written.
std::span<const TrialColumn> trialColumns();

/// What must hold between the cells of a row. Nothing where all is well.
struct BrokenRule {
    std::string_view column;
    std::string rule;
};
std::optional<BrokenRule> brokenRule(const Trial& trial);

/// The rule that a text cell (condition, kernel, an extra column) breaks, or an empty text.
std::string brokenTextRule(std::string_view cell);

}  // namespace records
