// SPDX-License-Identifier: MIT
// Further factors that groups are divided by (fit_slope --by): what stands in a column of the trial
// tables, or about the participant in participants.tsv.
//
//   kernel, encoding, noise_levels, ...   any column of the trial table, own and extra ones;
//                                         "noise" for noise_levels. A column that a table lacks is
//                                         n/a there.
//   design, session                       name of the design in the sidecar; of the session
//   expertise, age, ...                   any column of participants.tsv, beside the flat folder of
//                                         the table or at the top of its BIDS tree
//
// The task cannot be one: a guess is not the same thing in both, nor is a lapse.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "records/session_sidecar.h"
#include "records/trial_table.h"

namespace analysis {

/// The names as the columns have them ("noise" replaced), each once. Throws std::invalid_argument
/// for an empty one, the task and what numbers or answers a trial.
std::vector<std::string> factorNames(std::span<const std::string> asked);

/// Gives every table the columns that it does not hold itself, as extra columns: design (of
/// `sidecars`, one per table), session, and those of participants.tsv. Throws
/// std::invalid_argument, naming what there is, for a factor that is nowhere.
void addFactorColumns(std::span<records::TrialTable> tables,
                      std::span<const std::optional<records::SessionSidecar>> sidecars,
                      std::span<const std::string> factors);

/// Reads the factors' values off the trials of one table.
class FactorReader {
  public:
    FactorReader(const records::TrialTable& table, std::span<const std::string> factors);
    std::vector<std::string> levels(const records::Trial& trial) const;

  private:
    struct Source {
        void (*write)(const records::Trial& trial, std::string& row) = nullptr;
        std::optional<std::size_t> extra;  // neither: n/a throughout
    };
    std::vector<Source> sources_;
};

}  // namespace analysis
