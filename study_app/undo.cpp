// SPDX-License-Identifier: MIT
#include "study_app/undo.h"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "records/trial_table.h"
#include "records/whole_file.h"

namespace study_app {
namespace {

using records::Trial;
using records::TrialStatus;

void markUndone(const std::filesystem::path& file) {
    records::TrialTable table = records::readTrialTable(file);
    const auto lastOk = std::find_if(table.trials.rbegin(), table.trials.rend(),
                                     [](const Trial& t) { return t.status == TrialStatus::ok; });
    if (lastOk == table.trials.rend()) {
        throw std::runtime_error(file.string() + ": holds no answer that could be undone");
    }
    for (auto row = table.trials.rbegin(); row != std::next(lastOk); ++row) {
        row->status = TrialStatus::undone;
    }
    std::string text = records::trialTableHeader(table.extraColumns) + "\n";
    for (const Trial& trial : table.trials) text += records::trialTableRow(trial) + "\n";
    records::writeWholeFile(file, text);
}

}  // namespace

bool canUndo(const RecordedSession& session) {
    return session.session().answered() > 0;
}

void undoLastAnswer(std::unique_ptr<RecordedSession>& session, const SessionRequest& request) {
    const std::filesystem::path table = session->table();
    session.reset();  // the journal would take our change for someone else's
    markUndone(table);
    session = std::make_unique<RecordedSession>(request);
}

}  // namespace study_app
