// SPDX-License-Identifier: MIT
#include "analysis/screening.h"

#include <algorithm>
#include <cmath>

#include "quest/observer_screening.h"

namespace analysis {
namespace {

// A proposal that was moved by more than this (log10: 5 %, more than the rounding to pixels does at
// the radii of a threshold) to the end of the radii that the run saw met a limit.
constexpr double kMoved = 0.0212;
constexpr double kShareAtLimit = 0.5;  // of the run's trials

bool atLimit(const Cell& cell) {
    double lowest = 0, highest = 0;
    std::size_t placed = 0;
    for (const StudyTrial& trial : cell.trials) {
        if (trial.catchTrial || !trial.proposedPx) continue;
        lowest = placed == 0 ? trial.radiusPx : std::min(lowest, trial.radiusPx);
        highest = std::max(highest, trial.radiusPx);
        ++placed;
    }
    std::size_t limited = 0;
    for (const StudyTrial& trial : cell.trials) {
        if (trial.catchTrial || !trial.proposedPx) continue;
        const double moved = std::log10(trial.radiusPx / *trial.proposedPx);
        limited += (trial.radiusPx == highest && moved < -kMoved) ||
                           (trial.radiusPx == lowest && moved > kMoved)
                       ? 1
                       : 0;
    }
    return placed > 0 &&
           static_cast<double>(limited) >= kShareAtLimit * static_cast<double>(placed);
}

std::string brokenRule(const ScreenedObserver& row, records::Task task,
                       const ScreeningRules& rules) {
    const quest::ScreeningLimits limits{.falseAlarmRate = rules.limits.falseAlarmRate,
                                        .catchFailureShare = rules.limits.catchFailureShare};
    return task == records::Task::yesNo
               ? quest::falseAlarmProblem(row.falseAlarms, row.references, limits,
                                          rules.falseAlarmConfidence)
               : quest::catchProblem(row.catchFailures, row.catchTrials, limits);
}

}  // namespace

std::vector<ScreenedObserver> screen(const Study& study, const ScreeningRules& rules) {
    std::vector<ScreenedObserver> rows;
    for (const Observer& observer : study.observers) {
        ScreenedObserver row{
            .id = observer.id,
            .references = observer.references,
            .falseAlarms = observer.falseAlarms,
            .falseAlarmLowerBound = quest::rateLowerBound(observer.falseAlarms, observer.references,
                                                          rules.falseAlarmConfidence),
            .catchTrials = observer.catchTrials,
            .catchFailures = observer.catchFailures};
        for (const Cell& cell : observer.cells) {
            row.trials += static_cast<int>(cell.trials.size());
            if (atLimit(cell)) row.runsAtLimit.push_back(conditionName(study, cell.condition));
        }
        row.reason = brokenRule(row, study.task, rules);
        row.excluded = rules.apply && !row.reason.empty();
        rows.push_back(std::move(row));
    }
    return rows;
}

Study withoutExcluded(const Study& study, const std::vector<ScreenedObserver>& screening) {
    std::vector<bool> keep;
    for (const ScreenedObserver& row : screening) keep.push_back(!row.excluded);
    return subset(study, keep, std::vector<bool>(study.conditions.size(), true));
}

}  // namespace analysis
