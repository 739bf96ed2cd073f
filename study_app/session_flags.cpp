// SPDX-License-Identifier: MIT
#include "study_app/session_flags.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "quest/observer_screening.h"
#include "quest/quest.h"

namespace study_app {
namespace {

double shareAtLimit(const quest::Quest& staircase, const StrengthRange& shown) {
    const auto history = staircase.history();
    if (history.empty()) return 0;
    const auto atLimit = std::ranges::count_if(history, [&](const quest::QuestTrial& trial) {
        return trial.x == shown.strongest || trial.x == shown.weakest;
    });
    return static_cast<double>(atLimit) / static_cast<double>(history.size());
}

}  // namespace

std::vector<ConditionResult> conditionResults(const Session& session) {
    std::vector<ConditionResult> results;
    const std::vector<Threshold> measured = thresholds(session);
    for (std::size_t k = 0; k < measured.size(); ++k) {
        const quest::Quest& staircase = session.staircase(k);
        ConditionResult r{.threshold = measured[k],
                          .cLow = quest::radiusAt(1.0, staircase.quantile(0.975)),
                          .cHigh = quest::radiusAt(1.0, staircase.quantile(0.025))};
        r.limitShare =
            shareAtLimit(staircase, strengthRange(session.design(), session.conditions()[k]));
        r.atLimit = r.limitShare > kLimitShare;
        r.notConverged = r.threshold.sd > kConvergedSd;
        results.push_back(r);
    }
    return results;
}

CatchResult catchResult(const Design& design, int answered, int failed) {
    return {.answered = answered,
            .failed = failed,
            .problem = design.task == records::Task::twoAfc
                           ? quest::catchProblem(failed, answered, design.screening)
                           : quest::falseAlarmProblem(failed, answered, design.screening)};
}

std::string flagText(const ConditionResult& r) {
    std::string flags;
    char text[80];
    if (r.atLimit) {
        std::snprintf(text, sizeof text, "%.0f %% of trials at a display limit",
                      100 * r.limitShare);
        flags = text;
    }
    if (r.notConverged) {
        std::snprintf(text, sizeof text, "%snot converged (sd %.2f)", flags.empty() ? "" : ", ",
                      r.threshold.sd);
        flags += text;
    }
    return flags;
}

}  // namespace study_app
