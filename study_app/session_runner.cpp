// SPDX-License-Identifier: MIT
#include "study_app/session_runner.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "study_app/undo.h"

namespace study_app {
namespace {

using records::Response;
using records::Task;

constexpr std::size_t kPaceTrials = 30;

/// Microseconds are far below what a keyboard resolves, and keep the table readable.
double toMicroseconds(double seconds) {
    return std::round(seconds * 1e6) / 1e6;
}

/// Where the session's clock stands when it goes on: after the last row.
double resumeTime(const RecordedSession& recorded) {
    const auto& row = recorded.lastRow();
    return row ? row->onsetS.value_or(0) + row->responseTimeS.value_or(0) : 0;
}

}  // namespace

Response responseFor(Side side, Task task) {
    if (task == Task::twoAfc) return side == Side::left ? Response::left : Response::right;
    return side == Side::left ? Response::notSeen : Response::seen;
}

std::string toText(const Latency& l) {
    char text[160];
    std::snprintf(text, sizeof text,
                  "answer to next stimulus, less the intended pause: %zu trial%s, median %.1f ms, "
                  "p99 %.1f ms, largest %.1f ms",
                  l.trials, l.trials == 1 ? "" : "s", 1e3 * l.median, 1e3 * l.p99, 1e3 * l.largest);
    return text;
}

SessionRunner::SessionRunner(const SessionRequest& request)
    : request_(request),
      recorded_(std::make_unique<RecordedSession>(request)),
      practice_(
          request.design, request.seed,
          recorded_->resumedRows() > 0 ? presentation().resumedPractice : presentation().practice),
      clock_(presentation()),
      prefetcher_(request.design),
      sessionStart_(0),
      rows_(records::readTrialTable(recorded_->table()).trials) {}

bool SessionRunner::practiceNeeded() const {
    return practice_.rule().correct > 0 && !practice_.ruleMet();
}

std::filesystem::path SessionRunner::table() const {
    return records::trialTablePath(request_.dataFolder, request_.participant, request_.session);
}

bool SessionRunner::begin(Stage stage, double now) {
    if (!recorded_ && !reopen()) return false;
    problem_.clear();
    if (!clockStarted_) {
        sessionStart_ = now - resumeTime(*recorded_);
        clockStarted_ = true;
    }
    if (clock_.phase() == TrialPhase::idle) answerPending_.reset();
    stage_ = stage;
    images_.reset();
    lastTooFast_ = lastTimedOut_ = false;
    lastAnswer_.reset();
    prefetcher_.request({trial()});
    clock_.begin(now);
    return true;
}

bool SessionRunner::interrupt() {
    problem_.clear();
    const auto outcome = clock_.disturb();
    lastAnswer_.reset();
    answerPending_.reset();
    if (!outcome) return false;
    if (stage_ == Stage::practice) {
        takeInPractice(*outcome);
    } else {
        record(*outcome);
    }
    images_.reset();
    return true;
}

std::optional<RunnerEvent> SessionRunner::tick(double now) {
    if (clock_.feedbackOver(now)) return proceed(now);
    if (const auto outcome = clock_.tick(now)) return take(*outcome, now);
    return {};
}

void SessionRunner::shown(double now) {
    clock_.shown(now);
    if (answerPending_) {
        latencies_.push_back(now - std::max(*answerPending_, clock_.intendedOnset()));
        answerPending_.reset();
    }
    auto coming = possibleNext(session());
    if (stage_ == Stage::session) prefetcher_.request(std::move(coming));
}

std::optional<RunnerEvent> SessionRunner::answer(Side side, double now) {
    const auto outcome = clock_.answer(responseFor(side, session().design().task), now);
    if (!outcome) return {};
    const bool seen =
        outcome->response == Response::seen && outcome->status == records::TrialStatus::ok;
    if (seen && session().design().localise) {
        clock_.askForPlace(*outcome);
        return RunnerEvent::placeWanted;
    }
    return take(*outcome, now);
}

std::optional<RunnerEvent> SessionRunner::locate(const Place& place, double now) {
    if (!session().design().localise) return {};
    if (clock_.phase() == TrialPhase::stimulus) {
        const auto event = answer(Side::right, now);
        if (event != RunnerEvent::placeWanted) return event;
    }
    const auto outcome = clock_.locate(place);
    return outcome ? take(*outcome, now) : std::nullopt;
}

std::optional<RunnerEvent> SessionRunner::take(const Outcome& outcome, double now) {
    answerPending_ = now;
    images_.reset();
    lastTooFast_ = outcome.status == records::TrialStatus::tooFast;
    lastTimedOut_ = outcome.status == records::TrialStatus::repeated;
    if (stage_ == Stage::practice) {
        takeInPractice(outcome);
    } else if (const auto trouble = record(outcome)) {
        return trouble;
    }
    const bool answered = outcome.status == records::TrialStatus::ok;
    if (answered) notePace(now);
    if (answered && (stage_ == Stage::practice || presentation().feedback)) {
        clock_.giveFeedback(now);
        return RunnerEvent::feedback;
    }
    return proceed(now);
}

void SessionRunner::takeInPractice(const Outcome& outcome) {
    if (outcome.status == records::TrialStatus::ok && outcome.response) {
        lastRight_ = practice_.answer(*outcome.response);
    } else {
        practice_.skip();
    }
}

std::optional<RunnerEvent> SessionRunner::record(const Outcome& outcome) {
    Answer answer{.response = outcome.response,
                  .onsetS = toMicroseconds(outcome.onset - sessionStart_),
                  .status = outcome.status};
    if (outcome.responseTimeS) answer.responseTimeS = toMicroseconds(*outcome.responseTimeS);
    if (outcome.place) {
        answer.clickXPx = outcome.place->xPx;
        answer.clickYPx = outcome.place->yPx;
    }
    try {
        recorded_->answer(answer);
    } catch (const std::runtime_error& error) {
        problem_ = error.what();
        reopen();
        clock_.stop();
        // Of two answers, the one that is lost and the one before, only the first is the last.
        if (outcome.status != records::TrialStatus::repeated) undoable_ = false;
        return RunnerEvent::notRecorded;
    }
    rows_.push_back(*recorded_->lastRow());
    if (outcome.status == records::TrialStatus::ok) {
        lastRight_ = recorded_->lastRow()->correct;
        undoable_ = true;
        ++sinceBreak_;
    }
    return {};
}

std::optional<RunnerEvent> SessionRunner::proceed(double now) {
    const auto stop = [&](RunnerEvent event) {
        clock_.stop();
        answerPending_.reset();
        lastAnswer_.reset();
        return event;
    };
    if (stage_ == Stage::practice) {
        if (practice_.ruleMet()) return stop(RunnerEvent::practiceOver);
        if (practice_.exhausted()) return stop(RunnerEvent::practiceStuck);
    } else {
        if (session().finished()) return stop(RunnerEvent::finished);
        if (presentation().breakEveryTrials > 0 && sinceBreak_ >= presentation().breakEveryTrials) {
            sinceBreak_ = 0;
            return stop(RunnerEvent::breakDue);
        }
    }
    clock_.begin(now);
    return RunnerEvent::nextTrial;
}

void SessionRunner::notePace(double now) {
    if (stage_ != Stage::session) return;
    if (lastAnswer_) paceS_.push_back(now - *lastAnswer_);
    if (paceS_.size() > kPaceTrials) paceS_.pop_front();
    lastAnswer_ = now;
}

records::Trial SessionRunner::trial() const {
    return stage_ == Stage::practice ? practice_.next() : session().next();
}

const TrialImages& SessionRunner::images() {
    if (!images_) images_ = prefetcher_.take(trial());
    return *images_;
}

bool SessionRunner::prepareImages() {
    try {
        images();
        return true;
    } catch (const std::runtime_error& error) {
        problem_ = error.what();
        clock_.stop();
        return false;
    }
}

/// Goes on from what is on disk. A session that is not there any more is not begun anew.
bool SessionRunner::reopen() {
    recorded_.reset();  // gives the lock back first
    try {
        requireNothingLost();
        recorded_ = std::make_unique<RecordedSession>(request_);
        rows_ = records::readTrialTable(recorded_->table()).trials;
        lost_.reset();
        return true;
    } catch (const std::runtime_error& error) {
        problem_ = error.what();
        recorded_.reset();
        lost_.emplace(request_.design, request_.seed);
        for (const records::Trial& row : rows_) lost_->replay(row);
        return false;
    }
}

void SessionRunner::requireNothingLost() const {
    for (const std::filesystem::path& file : {table(), records::sidecarPath(table())}) {
        if (std::filesystem::exists(file)) continue;
        throw std::runtime_error(
            file.string() + ": is missing: the session goes on only from the " +
            std::to_string(rows_.size()) + " rows recorded so far: put it back, then try again");
    }
    const std::size_t there = records::readTrialTable(table()).trials.size();
    if (there >= rows_.size()) return;
    throw std::runtime_error(table().string() + ": holds " + std::to_string(there) +
                             " rows: must hold the " + std::to_string(rows_.size()) +
                             " recorded so far: put them back, then try again");
}

bool SessionRunner::undo() {
    if (!undoable_) throw std::logic_error("study_app: there is no answer that could be undone");
    interrupt();
    if (!problem_.empty() || (!recorded_ && !reopen())) return false;
    images_.reset();
    try {
        requireNothingLost();
        undoLastAnswer(recorded_, request_);
        rows_ = records::readTrialTable(recorded_->table()).trials;
    } catch (const std::runtime_error& error) {
        problem_ = error.what();
        reopen();
        return false;
    }
    undoable_ = false;
    sinceBreak_ = std::max(0, sinceBreak_ - 1);
    return true;
}

std::optional<Latency> SessionRunner::latency() const {
    if (latencies_.empty()) return {};
    std::vector<double> sorted = latencies_;
    std::ranges::sort(sorted);
    const auto quantile = [&](double share) {
        return sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))];
    };
    return Latency{sorted.size(), quantile(0.5), quantile(0.99), sorted.back()};
}

double SessionRunner::secondsLeft() const {
    std::vector<double> pace(paceS_.begin(), paceS_.end());
    double trialS = presentation().blankS + presentation().fixationS + kTypicalAnswerS;
    if (pace.size() >= 5) {
        const auto middle = pace.begin() + static_cast<std::ptrdiff_t>(pace.size() / 2);
        std::nth_element(pace.begin(), middle, pace.end());
        trialS = *middle;
    }
    const auto left = static_cast<double>(session().total() - session().answered());
    const int every = presentation().breakEveryTrials;
    const double breaks = every > 0 ? std::floor((left + sinceBreak_) / every) : 0;
    return left * trialS + breaks * presentation().breakMinimumS;
}

}  // namespace study_app
