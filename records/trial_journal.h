// SPDX-License-Identifier: MIT
// The one writer of trial tables: appends a row and has it on disk before it returns, so that a session killed at
// any moment loses no recorded trial.
//
// The file is locked (flock) while the journal is open: a second program on the same session is refused. Opening
// an existing table cuts a torn last line off (its text goes into `notices`), never a complete row. When a write
// fails (disk full), what was written of the row is cut off again, so the file stays valid, and a
// std::runtime_error says so.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "records/trial_table.h"

namespace records {

class TrialJournal {
  public:
    /// Creates the folders and the file with its header, or opens an existing one to append to it. Throws
    /// std::runtime_error: not writable, already open elsewhere, not a trial table.
    explicit TrialJournal(const std::filesystem::path& file);
    ~TrialJournal();
    TrialJournal(const TrialJournal&) = delete;
    TrialJournal& operator=(const TrialJournal&) = delete;

    /// What the file held when it was opened.
    const TrialTable& existing() const { return existing_; }

    /// Writes, flushes and syncs one row (write + fdatasync).
    void append(const Trial& trial);

  private:
    TrialTable existing_;
    int descriptor_ = -1;
};

}  // namespace records
