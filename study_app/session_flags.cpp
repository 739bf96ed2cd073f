// SPDX-License-Identifier: MIT
#include "study_app/session_flags.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "quest/quest.h"

namespace study_app {
namespace {

/// E. B. Wilson, "Probable inference, the law of succession, and statistical inference" (1927).
double wilsonLowerBound(int successes, int n) {
    if (n == 0) return 0;
    constexpr double z = 1.96;
    const double p = static_cast<double>(successes) / n, zz = z * z / n;
    return (p + zz / 2 - z * std::sqrt(p * (1 - p) / n + zz / (4 * n))) / (1 + zz);
}

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

CatchResult catchResult(const Session& session) {
    CatchResult r{.answered = session.catchAnswered(), .failed = session.catchFailed()};
    const ScreeningLimits& limits = session.design().screening;
    r.lowerBound = wilsonLowerBound(r.failed, r.answered);
    r.flagged = session.design().task == records::Task::twoAfc
                    ? r.failed > limits.catchFailureShare * r.answered
                    : r.lowerBound > limits.falseAlarmRate;
    return r;
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

Design rerunDesign(const Design& design, std::size_t condition) {
    const Condition c = conditions(design).at(condition);
    Design rerun = design;
    rerun.name = design.name + "-rerun";
    if (design.frames) {
        rerun.frames->pairs = c.frames;
        return rerun;
    }
    rerun.artifactPx = {c.artifactPx};
    rerun.patterns = {c.silhouette};
    rerun.litLevels = {c.litLevel};
    rerun.kernels = {c.kernel};
    rerun.noiseLevels = {c.noiseLevels};
    return rerun;
}

}  // namespace study_app
