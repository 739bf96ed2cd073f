// SPDX-License-Identifier: MIT
// The one writer of trial tables: appends a row and has it on disk before it returns, so that a
// session killed at any moment loses no recorded trial.
//
//   records::TrialJournal journal(records::trialTablePath(data, "07", std::nullopt));
//   replay(journal.existing().trials);
//   journal.append(trial);           // on disk when it returns; only then show the next stimulus
//
// The file is locked (flock) while the journal is open: a second program on the same session is
// refused. Opening an existing table cuts a torn last line off (its text goes into the notices of
// `existing`), never a complete row. When a write fails (disk full), what was written of the row is
// cut off again, so the file stays valid, and a std::runtime_error says so; the same row may be
// appended again once there is room. A row that would not read back as it is, or whose number does
// not rise, is refused with std::invalid_argument before anything is written. A file that someone
// else changes, replaces or deletes meanwhile is an error at the next row, not a silent loss.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "records/file_descriptor.h"
#include "records/trial_table.h"

namespace records {

/// When a row is forced to the disk. `everyRow` survives a power cut and is what a session with a
/// person needs; `atClose` still loses no row to a kill (the operating system has it), and spares a
/// simulated session the disk.
enum class SyncRows { everyRow, atClose };

class TrialJournal {
  public:
    /// Creates the folders and the file with its header, or opens an existing one to append to it.
    /// Throws std::runtime_error: not writable, already open elsewhere, not a trial table, other
    /// columns than trialTableHeader(extraColumns) or in another order.
    explicit TrialJournal(const std::filesystem::path& file,
                          const std::vector<std::string>& extraColumns = {},
                          SyncRows sync = SyncRows::everyRow);
    ~TrialJournal();
    TrialJournal(const TrialJournal&) = delete;
    TrialJournal& operator=(const TrialJournal&) = delete;

    /// What the file held when it was opened.
    const TrialTable& existing() const { return existing_; }

    /// Writes one row and, with SyncRows::everyRow, syncs it (write + fdatasync).
    void append(const Trial& trial);

    /// Syncs what was written; throws std::runtime_error where the disk refuses.
    void sync();

  private:
    void openLocked();
    void readExisting(const std::vector<std::string>& extraColumns);
    void startTable(const std::string& header);
    void requireUntouched() const;
    void write(std::string_view line);
    [[noreturn]] void cutBack(int error);

    std::filesystem::path file_;
    SyncRows sync_;
    FileDescriptor descriptor_;
    TrialTable existing_;
    std::size_t extraColumns_ = 0;
    std::size_t bytes_ = 0;  // size of the file that holds complete rows only
    int lastOk_ = 0;         // number of the last `ok` row
    bool synced_ = true;
    bool broken_ = false;  // the state of the file is not known any more
};

}  // namespace records
