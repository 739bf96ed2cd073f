// SPDX-License-Identifier: MIT
// A session on disk: the state machine of session.h with its trial table and sidecar. This is the
// thin shell that both a window and a simulated observer use.
//
//   RecordedSession recorded(request);                 // starts, or resumes an unfinished session
//   while (!recorded.session().finished()) {
//       show(recorded.session().next());
//       recorded.answer({.response = pressed});        // on disk when it returns
//   }
//
// Nothing but the trial table and its sidecar is kept. Resuming replays the table, so the next
// proposal is bit-identical to the one that an uninterrupted session would have made; a table that
// does not replay is refused, not continued.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "records/run_context.h"
#include "records/session_sidecar.h"
#include "records/trial_journal.h"
#include "study_app/design.h"
#include "study_app/session.h"

namespace study_app {

struct SessionRequest {
    std::filesystem::path dataFolder;  ///< the data set's folder, created where it is missing
    std::string participant;           ///< letters and digits
    std::optional<std::string> session = {};  ///< letters and digits
    std::string observer = "human";           ///< or the simulated population's description
    Design design;
    std::uint64_t seed = 0;
    int displayWidthPx = 0, displayHeightPx = 0;  ///< > 0
    records::RunContext context;
    /// Of a calibrated display; what is not known stays out of the sidecar.
    std::optional<double> pxPerDeg = {}, displayGamma = {};
    records::ScreenLuminance luminance = {};
};

class RecordedSession {
  public:
    /// Throws std::runtime_error: what the journal and the sidecar throw (another program has the
    /// session open, disk full, malformed files), a table without a sidecar, and a sidecar of
    /// another participant, observer, seed or design, naming what differs.
    explicit RecordedSession(const SessionRequest& request);

    const Session& session() const { return session_; }

    /// Takes the answer to session().next() and returns when its row is written and synced. Throws
    /// what TrialJournal::append throws; the rows before stay as they are, and a new
    /// RecordedSession goes on from them.
    void answer(const Answer& answer);

    const std::filesystem::path& table() const { return table_; }
    const std::optional<records::Trial>& lastRow() const { return lastRow_; }
    std::size_t resumedRows() const { return resumedRows_; }  ///< found on disk at the start
    /// What the experimenter should hear about: a torn last line that was cut off.
    const std::vector<std::string>& notices() const { return journal_.existing().notices; }

  private:
    void requireSameSession(const SessionRequest& request) const;
    void replayRows();

    std::filesystem::path table_;
    records::TrialJournal journal_;
    Session session_;
    std::optional<records::Trial> lastRow_;
    std::size_t resumedRows_ = 0;
};

/// Whether a session has begun in this table: false where there is none, and where a program that
/// was killed as it began left the table's first line, or part of it, and no sidecar yet, with no
/// complete row after it. Nothing was recorded then, and a RecordedSession begins there as in an
/// empty folder. Any other file counts as begun: it is for who reads it to refuse. Throws
/// std::runtime_error where the table cannot be read.
bool hasBegun(const std::filesystem::path& table);

struct ReplayedSession {
    records::SessionSidecar sidecar;
    records::TrialTable table;
    Session session;
};

/// Reconstructs a session from its table and sidecar, deriving every row again. Throws
/// std::runtime_error with file, line and column of the first cell that is not the same bit for
/// bit.
ReplayedSession replayTable(const std::filesystem::path& table);

}  // namespace study_app
