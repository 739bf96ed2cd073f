// SPDX-License-Identifier: MIT
// What the tests of whole sessions in the window share: a small design, a quick pace, a person.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "records/trial_table.h"
#include "tests/study_app/window_person.h"
#include "tests/temporary_folder.h"

namespace tests {

/// Without practice, and with room for a slow machine.
inline constexpr const char* kQuickPace = R"({"blank_s": 0.02, "fixation_s": 0.05, "too_fast_s": 0,
  "break_every_trials": 0, "practice": {"correct": 0}, "resumed_practice": {"correct": 0}})";

class WindowSession : public testing::Test {
  protected:
    /// A session of participant 01 that begins at the instructions: 10 trials on 240 px windows.
    std::vector<std::string> arguments(const std::string& pace = kQuickPace,
                                       int trialsPerCondition = 2) const;
    std::filesystem::path file(const std::string& name) const { return folder_.path() / name; }
    std::string data() const { return file("data").string(); }
    std::filesystem::path table() const {
        return records::trialTablePath(data(), "01", std::nullopt);
    }
    std::vector<records::Trial> rows() const { return records::readTrialTable(table()).trials; }

    /// Writes a file into the test's folder and returns its name.
    std::string write(const std::string& name, const std::string& text) const;

    /// From the instructions to the first trial.
    static void agree(WindowPerson& person);
    /// Presses the arrow once a stimulus is shown and returns the event of its row.
    static std::string answer(WindowPerson& person, const std::string& side);
    /// The left arrow until the end.
    static void answerAll(WindowPerson& person);

    XServer server_;
    TemporaryFolder folder_;
};

}  // namespace tests
