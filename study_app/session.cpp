// SPDX-License-Identifier: MIT
#include "study_app/session.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "quest/random.h"
#include "records/number_rule.h"
#include "records/quoted_text.h"
#include "stimulus/tap_kernel.h"
#include "study_app/frame_design.h"
#include "study_app/random_stream.h"
#include "study_app/trial_stimulus.h"

namespace study_app {
namespace {

using records::Response;
using records::Task;
using records::Trial;
using records::TrialStatus;
using records::TrialType;

bool isCorrect(const Trial& trial) {
    if (!trial.response) return false;
    if (trial.task == Task::twoAfc) return records::toText(*trial.response) == *trial.side;
    return (trial.response == Response::seen) == (trial.type == TrialType::artifact);
}

void requireResponse(Task task, const Answer& answer) {
    if (!answer.response) {
        if (answer.status != TrialStatus::ok) return;
        throw std::invalid_argument("response: missing: a trial with status ok needs one");
    }
    const bool isSide = answer.response == Response::left || answer.response == Response::right;
    if (isSide == (task == Task::twoAfc)) return;
    throw std::invalid_argument("response: " + std::string(records::toText(*answer.response)) +
                                ": does not belong to the task " +
                                std::string(records::toText(task)));
}

/// Empty where the click is as the design asks for it, or there is none.
std::string clickProblem(const Design& design, const Answer& answer) {
    if (!answer.clickXPx && !answer.clickYPx) return {};
    if (!design.localise || answer.response != Response::seen) {
        return "click: belongs to the answer seen in a design with \"localise\": true";
    }
    for (const std::optional<double>& place : {answer.clickXPx, answer.clickYPx}) {
        if (place && *place >= 0 && *place <= design.windowPx) continue;
        return "click: " + (place ? records::exactText(*place) : "missing") +
               " px: must lie on the image, from 0 to " + std::to_string(design.windowPx);
    }
    return {};
}

bool hasRandomPixels(const Condition& condition, const Design& design) {
    return design.dither || condition.noiseLevels > 0 ||
           stimulus::tapKernelFromText(condition.kernel).has_value();
}

/// 31 bits, which every reader of tables takes for a whole number.
int imageSeed(std::uint64_t seed, std::size_t row) {
    return static_cast<int>(engineAt(seed, Purpose::image, row)() >> 33);
}

std::vector<std::string_view> cells(std::string_view line) {
    std::vector<std::string_view> result;
    for (std::size_t end = line.find('\t'); end != line.npos; end = line.find('\t')) {
        result.push_back(line.substr(0, end));
        line.remove_prefix(end + 1);
    }
    result.push_back(line);
    return result;
}

/// The cells are compared as the table writes them: numbers are written exactly, so equal text is
/// equal bits.
std::optional<Difference> firstDifference(const Trial& recorded, const Trial& derived) {
    const std::string header = records::trialTableHeader(),
                      recordedRow = records::trialTableRow(recorded),
                      derivedRow = records::trialTableRow(derived);
    if (recordedRow == derivedRow) return {};
    const auto names = cells(header), is = cells(recordedRow), shouldBe = cells(derivedRow);
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (is.at(i) == shouldBe.at(i)) continue;
        return Difference{recorded.number, std::string(names[i]), std::string(is[i]),
                          std::string(shouldBe[i])};
    }
    return {};
}

std::size_t columnOf(const Difference& difference) {
    const std::string header = records::trialTableHeader();
    const auto names = cells(header);
    return static_cast<std::size_t>(std::ranges::find(names, difference.column) - names.begin());
}

}  // namespace

double shownRadius(double proposedPx, const RadiusLimits& limits) {
    return std::clamp(std::round(proposedPx / limits.step) * limits.step, limits.min, limits.max);
}

Session::Session(const Design& design, std::uint64_t seed) : design_(design), seed_(seed) {
    if (const std::string problem = validate(design); !problem.empty()) {
        throw std::invalid_argument("design: " + problem);
    }
    conditions_ = study_app::conditions(design);
    order_ = trialOrder(design, seed);
    staircases_.assign(conditions_.size(), quest::Quest(staircaseParameters(design)));
    prepareNext();
}

const Trial& Session::next() const {
    if (finished()) throw std::logic_error("study_app: a finished session has no next trial");
    return next_;
}

bool Session::nextIsCatch() const {
    next();
    return order_[answered_].isCatch;
}

std::size_t Session::nextCondition() const {
    next();
    return order_[answered_].condition;
}

void Session::prepareNext() {
    if (finished()) return;
    const auto [index, isCatch] = order_[answered_];
    const Condition& condition = conditions_[index];
    next_ = Trial{};
    next_.number = static_cast<int>(rows_ + 1);
    next_.condition = condition.name;
    next_.pattern = condition.silhouette.pattern;
    if (condition.frames.empty()) next_.angleDeg = condition.angleDeg;
    next_.artifactPx = condition.artifactPx;
    next_.litLevel = condition.litLevel;
    next_.kernel = condition.kernel;
    next_.task = design_.task;
    next_.encoding = design_.encoding;
    if (design_.noiseLevels != std::vector<double>{0}) next_.noiseLevels = condition.noiseLevels;
    if (design_.dither) next_.dither = true;
    if (hasRandomPixels(condition, design_)) next_.imageSeed = imageSeed(seed_, rows_);
    place(next_, index, isCatch);
    rove(next_, condition);
}

void Session::place(Trial& trial, std::size_t condition, bool isCatch) const {
    const std::vector<records::FramePair>& frames = conditions_[condition].frames;
    if (isCatch && design_.task == Task::twoAfc) {
        trial.filterRadiusPx = design_.radius.min;
        if (!frames.empty()) show(trial, frames.front());
        return;
    }
    const double x = staircases_[condition].quantile();
    if (!frames.empty()) show(trial, nearestFrame(conditions_[condition], quest::radiusAt(1, x)));
    const double proposed = quest::radiusAt(trial.artifactPx, x);
    trial.proposedRadiusPx = proposed;
    if (frames.empty()) trial.filterRadiusPx = shownRadius(proposed, design_.radius);
    if (isCatch) {
        trial.type = TrialType::reference;
    } else {
        trial.staircase = conditions_[condition].name;
    }
}

/// Every draw is made for every trial, so that what one design roves does not shift the others.
void Session::rove(Trial& trial, const Condition& condition) const {
    std::mt19937_64 rng = engineAt(seed_, Purpose::roving, rows_);
    const bool left = quest::uniformBelow(rng, 2) == 0;
    const int quarter = static_cast<int>(quest::uniformBelow(rng, 4));
    const bool mirror = quest::uniformBelow(rng, 2) == 1;
    const int most = condition.artifactPx / 2;
    const int shift =
        static_cast<int>(quest::uniformBelow(rng, static_cast<std::uint64_t>(2 * most + 1))) - most;
    const double tilt = (2 * quest::uniform01(rng) - 1) * condition.angleDeg;

    const bool vertical = condition.silhouette.orientation == Orientation::vertical;
    const bool directed = condition.silhouette.orientation != Orientation::any;
    const int turned = directed ? quarter / 2 * 2 : quarter;
    const bool twoPanels = design_.task == Task::twoAfc;
    if (twoPanels) trial.side = left ? "left" : "right";
    trial.orientationQuarter = (design_.roving.quarterTurn ? turned : 0) + (vertical ? 1 : 0);
    trial.mirror = design_.roving.mirror && mirror;
    trial.shiftPx = design_.roving.shift ? shift : 0;
    if (twoPanels && trial.pattern == records::Pattern::step) {
        trial.tiltDeg = design_.roving.tilt ? tilt : 0;
    }
}

Trial Session::answer(const Answer& answer) {
    Trial row = next();
    requireResponse(row.task, answer);
    if (const std::string problem = clickProblem(design_, answer); !problem.empty()) {
        throw std::invalid_argument(problem);
    }
    row.response = answer.response;
    row.correct = isCorrect(row);
    row.responseTimeS = answer.responseTimeS;
    row.onsetS = answer.onsetS;
    row.status = answer.status;
    if (answer.clickXPx) {
        row.clickXPx = answer.clickXPx;
        row.clickYPx = answer.clickYPx;
        row.clickDistancePx =
            clickDistancePx(row, design_.windowPx, *answer.clickXPx, *answer.clickYPx);
    }
    if (row.status == TrialStatus::ok) take(row);
    ++rows_;
    prepareNext();
    beforeUndo_.clear();
    return row;
}

void Session::take(Trial& row) {
    const auto [condition, isCatch] = order_[answered_];
    ++answered_;
    if (isCatch) {
        ++catchAnswered_;
        if (!row.correct) ++catchFailed_;
        return;
    }
    quest::Quest& staircase = staircases_[condition];
    staircase.update(quest::strength(row.artifactPx, row.filterRadiusPx), row.correct ? 1 : 0);
    row.thresholdMean = staircase.mean();
    row.thresholdSd = staircase.sd();
}

std::optional<Difference> Session::replay(const Trial& row) {
    return row.status == TrialStatus::undone ? replayUndone(row) : replayOne(row);
}

std::optional<Difference> Session::replayOne(const Trial& row) {
    if (finished()) {
        return Difference{row.number, "trial", std::to_string(row.number),
                          "no such row, the session ends before it"};
    }
    if (row.task != design_.task) {
        return Difference{row.number, "task", std::string(records::toText(row.task)),
                          std::string(records::toText(design_.task))};
    }
    const Answer recorded{.response = row.response,
                          .responseTimeS = row.responseTimeS,
                          .onsetS = row.onsetS,
                          .status = row.status,
                          .clickXPx = row.clickXPx,
                          .clickYPx = row.clickYPx};
    if (!clickProblem(design_, recorded).empty()) {
        return Difference{row.number, "click_x_px", records::exactText(row.clickXPx.value_or(0)),
                          "n/a"};
    }
    Trial derived = answer(recorded);
    derived.extra = row.extra;
    return firstDifference(row, derived);
}

/// Undoing marks the last answer that counted, and what came after it. So an undone row is such an
/// answer to what is next here, or a row without an answer that counts in the session after it.
std::optional<Difference> Session::replayUndone(const Trial& row) {
    std::vector<Session> left;
    std::optional<Difference> difference;
    const auto attempt = [&](Session session, TrialStatus status) {
        Trial asRecorded = row;
        asRecorded.status = status;
        const auto found = session.replayOne(asRecorded);
        if (!found) {
            left.push_back(std::move(session));
        } else if (!difference || columnOf(*difference) < columnOf(*found)) {
            difference = found;  // of the session that the row fits better
        }
    };
    std::vector<Session> before = std::exchange(beforeUndo_, {});
    if (row.response) attempt(*this, TrialStatus::ok);
    for (Session& session : before) {
        attempt(std::move(session), row.response ? TrialStatus::tooFast : TrialStatus::repeated);
    }
    if (left.empty()) {
        return difference ? difference
                          : Difference{row.number, "response", "n/a",
                                       "an answer, the one that was taken back"};
    }
    beforeUndo_ = std::move(left);
    ++rows_;
    prepareNext();
    return {};
}

std::vector<Threshold> thresholds(const Session& session) {
    std::vector<Threshold> result;
    for (std::size_t k = 0; k < session.conditions().size(); ++k) {
        const Condition& condition = session.conditions()[k];
        const quest::Quest& staircase = session.staircase(k);
        const double mean = staircase.mean();
        const double radius = condition.frames.empty() ? quest::radiusAt(condition.artifactPx, mean)
                                                       : condition.frames.front().radiusPx;
        result.push_back({.condition = condition.name,
                          .trials = staircase.history().size(),
                          .mean = mean,
                          .sd = staircase.sd(),
                          .c = quest::radiusAt(1.0, mean),
                          .radiusPx = radius});
    }
    return result;
}

}  // namespace study_app
