// SPDX-License-Identifier: MIT
// Taking back the last answer. The table stays append-only in what it tells: the row stays, marked
// `undone`, and so do the rows after it (too fast, repeated), which were derived from the answer
// that is taken back. The session is then replayed from the table, so that staircases, order and
// roving are those of a session in which the answer was never given.
#pragma once

#include <memory>

#include "study_app/recorded_session.h"

namespace study_app {

/// Whether there is an answer that counts. One is taken back at a time, the last one.
bool canUndo(const RecordedSession& session);

/// Closes the session, marks the rows (the table is replaced whole or not at all) and opens it
/// again. Throws std::runtime_error where the table cannot be written or another program took the
/// session in between; what was recorded stays, and nothing is undone unless the marks are on disk.
/// `session` must hold one for which canUndo(); it holds none after an exception.
void undoLastAnswer(std::unique_ptr<RecordedSession>& session, const SessionRequest& request);

}  // namespace study_app
