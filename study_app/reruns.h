// SPDX-License-Identifier: MIT
// Conditions that are run again because they were flagged. Each rerun is a session of its own
// beside the first one (its id with "rerun1", "rerun2", ...), of the same design with that
// condition alone, so that a fit takes all of them together. What an experimenter sees at the end
// is the first session with its reruns, whichever of them was the last to end.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "study_app/recorded_session.h"
#include "study_app/session_flags.h"

namespace study_app {

/// The first session, or a rerun, as it is on disk.
struct Run {
    std::string rerun;  ///< "rerun1"; empty: the first session
    Session session;
};

/// The first session and its reruns by number, where `request` names any of them. Sessions of
/// another design that happen to have such an id are none. Throws what replayTable throws.
std::vector<Run> runsOf(const SessionRequest& request);

/// A result with the run that it comes from. Where the last run of a condition is flagged, another
/// one is offered.
struct RunResult {
    ConditionResult result;
    std::string rerun;  ///< as of Run
    bool offered = false;
};
/// By condition in the order of the design, then by run.
std::vector<RunResult> runResults(const std::vector<Run>& runs);

/// Attention over all runs, as a fit counts it.
CatchResult catchResult(const std::vector<Run>& runs);

/// The session that runs this condition again: a rerun of it that was left unfinished, else a new
/// one with `freshSeed`.
SessionRequest rerunRequest(const SessionRequest& request, const std::string& condition,
                            std::uint64_t freshSeed);

}  // namespace study_app
