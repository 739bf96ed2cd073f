// SPDX-License-Identifier: MIT
// What an experimenter should look at when a session is over: thresholds with intervals, catch
// performance, and flags by rules that were fixed before any threshold is seen.
#pragma once

#include <string>
#include <vector>

#include "study_app/session.h"

namespace study_app {

/// Posterior sd, log10 units, above which a staircase has not converged: its 95 % interval is then
/// wider than a factor of 2 to either side.
inline constexpr double kConvergedSd = 0.15;

struct ConditionResult {
    Threshold threshold;
    double cLow = 0, cHigh = 0;  ///< central 95 % of the posterior
    double limitShare = 0;       ///< of the trials shown at the least or the largest radius
    bool atLimit = false, notConverged = false;
    bool flagged() const { return atLimit || notConverged; }
};

struct CatchResult {
    int answered = 0, failed = 0;
    std::string problem;  ///< why the fit will leave this observer out; empty where it will not
};

std::vector<ConditionResult> conditionResults(const Session& session);
/// Of a session of this design, or of several.
CatchResult catchResult(const Design& design, int answered, int failed);

/// "stuck at a display limit (12 of 15 trials)", "not converged (sd .14)"; empty without a flag.
std::string flagText(const ConditionResult& result);

}  // namespace study_app
