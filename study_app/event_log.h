// SPDX-License-Identifier: MIT
// What happens in the window, a line for each screen, stimulus, row and problem, flushed at once:
// for scripts that press keys.
//
//   screen trials
//   stimulus 12 left       // or "practice ...": the trial's number and the right answer
//   place 12               // "seen" waits for a click on the artifact
//   row 12 ok              // on disk
//   undo 12                // the row is marked, as are those after it
//   problem study: ...     // what the screen says went wrong
#pragma once

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "records/trial_table.h"

namespace study_app {

class EventLog {
  public:
    /// Appends to the file; without a name nothing is written. Throws std::runtime_error where it
    /// cannot be.
    explicit EventLog(const std::filesystem::path& file);

    void screen(const std::string& name) { line("screen " + name); }
    void problem(const std::string& sentence) { line("problem " + sentence); }
    void stimulus(const records::Trial& trial, bool practice);
    /// The answer of this row is taken back.
    void undo(int row) { line("undo " + std::to_string(row)); }
    void place(const records::Trial& trial) { line("place " + std::to_string(trial.number)); }
    /// The rows that are new since the last call; fewer than then: another session has begun.
    void rows(const std::vector<records::Trial>& rows);

  private:
    void line(const std::string& text);

    std::ofstream stream_;
    std::size_t rows_ = 0;
};

}  // namespace study_app
