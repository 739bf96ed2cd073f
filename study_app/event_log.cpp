// SPDX-License-Identifier: MIT
#include "study_app/event_log.h"

#include <algorithm>
#include <stdexcept>

namespace study_app {

EventLog::EventLog(const std::filesystem::path& file) {
    if (file.empty()) return;
    stream_.open(file, std::ios::app);
    if (!stream_) throw std::runtime_error(file.string() + ": cannot be written");
}

void EventLog::line(const std::string& text) {
    if (stream_.is_open()) stream_ << text << std::endl;
}

void EventLog::stimulus(const records::Trial& trial, bool practice) {
    const char* answer = trial.type == records::TrialType::artifact ? "right" : "left";
    line((practice ? "practice " : "stimulus ") + std::to_string(trial.number) + " " +
         trial.side.value_or(answer));
}

void EventLog::rows(const std::vector<records::Trial>& rows) {
    for (rows_ = std::min(rows_, rows.size()); rows_ < rows.size(); ++rows_) {
        line("row " + std::to_string(rows[rows_].number) + " " +
             std::string(records::toText(rows[rows_].status)));
    }
}

}  // namespace study_app
