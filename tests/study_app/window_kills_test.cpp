// SPDX-License-Identifier: MIT
// A power cut at any moment, through the real window: started, answered and killed again and again
// until the session is over. STAIRWELL_KILLS=200 makes it 200 times (`./run numbers` does).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <random>

#include "study_app/recorded_session.h"
#include "tests/study_app/window_session.h"

namespace tests {
namespace {

using records::Trial;
using records::TrialStatus;

constexpr int kTrialsPerCondition = 40;
/// Every so many rows the person takes an answer back, which replaces the whole table.
constexpr int kUndoEvery = 9;

int numberIn(const std::string& event) {
    const std::size_t begin = event.find(' ') + 1;
    int number = 0;
    std::from_chars(event.data() + begin, event.data() + event.size(), number);
    return number;
}

/// The answer to a trial follows from its number, so that a row tells whether it holds the answer
/// that was given to it.
bool answersLeft(int number) {
    return (static_cast<unsigned>(number) * 2654435761u >> 16) % 2 == 0;
}

/// Answers until the end or until the program is gone.
void answerUntilKilled(WindowPerson& person) {
    for (int shown = 0;;) {
        const std::string event = person.nextEvent();
        if (event == "screen end") return;
        if (event == "screen instructions") person.press("Return");
        if (!event.starts_with("stimulus")) continue;
        const int number = numberIn(event);
        // Only an answer of this sitting can be taken back.
        const bool undo = ++shown > 1 && number % kUndoEvery == 0;
        person.press(undo ? "BackSpace" : answersLeft(number) ? "Left" : "Right");
    }
}

struct Tally {
    int kills = 0, inTrials = 0, sessions = 0;
    std::size_t rows = 0, acknowledged = 0, undone = 0, lost = 0, duplicate = 0;
};

class WindowKills : public WindowSession {
  protected:
    /// One sitting that ends by a kill; false where the session was over before.
    bool sit(const std::vector<std::string>& with, bool fromTrialsOn);
    void check(const WindowPerson& person);
    std::vector<Trial> rowsSoFar() const {
        return std::filesystem::exists(table()) ? rows() : std::vector<Trial>();
    }

    std::mt19937 rng_{1};
    std::vector<Trial> before_;
    Tally tally_;
};

bool WindowKills::sit(const std::vector<std::string>& with, bool fromTrialsOn) {
    WindowPerson person(server_, folder_.path(), with);
    const auto milliseconds = [&](unsigned below) {
        return std::chrono::microseconds(rng_() % (1000 * below));
    };
    try {
        if (fromTrialsOn) {
            agree(person);
            person.waitFor("screen trials");
        }
        person.killAfter(milliseconds(fromTrialsOn ? 900 : 400));
        answerUntilKilled(person);
    } catch (const std::runtime_error&) {
        // A tool fails as soon as the X server has dropped the window of a program that dies, which
        // may be before that program can be waited for.
        if (!person.killedWithin(std::chrono::milliseconds(500))) throw;
    }
    const bool killed = person.killed();
    if (killed) ++tally_.kills;
    if (killed && fromTrialsOn) ++tally_.inTrials;
    check(person);
    return killed;
}

void WindowKills::check(const WindowPerson& person) {
    const std::vector<Trial> now = rowsSoFar();
    for (std::size_t i = 0; i < now.size(); ++i) {
        if (now[i].number != static_cast<int>(i + 1)) ++tally_.duplicate;
        if (now[i].status != TrialStatus::ok) continue;
        EXPECT_EQ(records::toText(now[i].response.value()),
                  answersLeft(now[i].number) ? "left" : "right");
    }
    // What was there stays: only a status may have changed, to undone.
    for (std::size_t i = 0; i < before_.size(); ++i) {
        Trial kept = before_[i];
        if (i >= now.size()) {
            ++tally_.lost;
            continue;
        }
        if (now[i].status == TrialStatus::undone) kept.status = TrialStatus::undone;
        if (!(now[i] == kept)) ++tally_.lost;
    }
    for (const std::string& event : person.events()) {
        if (!event.starts_with("row") || !event.ends_with("ok")) continue;
        const auto number = static_cast<std::size_t>(numberIn(event));
        if (number > before_.size()) ++tally_.acknowledged;  // the log begins with the old ones
        if (number > now.size()) ++tally_.lost;
    }
    before_ = now;
    // Every proposal since the first row is the one that a session without a kill makes, bit for
    // bit, else this throws.
    if (!now.empty()) {
        EXPECT_NO_THROW(study_app::replayTable(table()));
    }
}

TEST_F(WindowKills, NoAcknowledgedAnswerIsLostAndTheSessionGoesOnTheSame) {
    const char* wanted = std::getenv("STAIRWELL_KILLS");
    const int kills = wanted == nullptr ? 6 : std::atoi(wanted);
    const std::vector<std::string> with = arguments(kQuickPace, kTrialsPerCondition);
    while (tally_.kills < kills && !HasFailure()) {
        // One in four while the program starts.
        const bool killed = sit(with, tally_.kills % 4 != 0);
        if (killed && tally_.kills < kills) continue;
        const auto table = rowsSoFar();
        ++tally_.sessions;
        tally_.rows += table.size();
        tally_.undone += static_cast<std::size_t>(std::ranges::count_if(
            table, [](const Trial& t) { return t.status == TrialStatus::undone; }));
        if (killed) break;
        EXPECT_TRUE(study_app::replayTable(this->table()).session.finished());
        std::filesystem::remove_all(data());
        before_.clear();
    }
    EXPECT_EQ(tally_.lost, 0u);
    EXPECT_EQ(tally_.duplicate, 0u);
    std::printf(
        "%d kills at random moments (%d of them in the trials) over %d sessions: %zu rows, %zu "
        "answers acknowledged, %zu rows undone; %zu lost, %zu duplicate; every table derived again "
        "bit for bit\n",
        tally_.kills, tally_.inTrials, tally_.sessions, tally_.rows, tally_.acknowledged,
        tally_.undone, tally_.lost, tally_.duplicate);
}

}  // namespace
}  // namespace tests
