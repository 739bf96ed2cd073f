// SPDX-License-Identifier: MIT
// Whole sessions with simulated observers, recorded like those of people: every row is written and
// synced before the next trial is proposed. Several sessions run side by side, each on its own
// thread with its own files; their syncs overlap, which is what makes a study of 6,400 synced rows
// fast. Nothing that is recorded depends on the number of threads.
//
// A participant's files follow from the design, the population and the session's seed (the command
// line and date in the sidecar's context aside).
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "study_app/recorded_session.h"
#include "study_app/simulated_population.h"

namespace study_app {

struct SimulatedSession {
    std::string participant;
    std::filesystem::path table;
    std::vector<std::string> notices;
    std::size_t resumedRows = 0;  ///< found on disk
    std::size_t newRows = 0;      ///< answered now; 0: the session was finished already
    Session session;
    SimulatedParticipant observer;
};

/// Runs or resumes one session to its end. `onTrial` is called after every recorded row.
SimulatedSession runSimulatedSession(const SessionRequest& request,
                                     const SimulatedPopulation& population,
                                     const std::function<void()>& onTrial = {});

/// Participants 01 .. N, each with a seed of its own drawn from request.seed; request.participant
/// is not used. Sessions that are finished are left as they are. Where sessions fail, the others
/// are finished first and the first participant's error is thrown. `onTrial` may be called from
/// several threads at once.
std::vector<SimulatedSession> runSimulatedStudy(const SessionRequest& request,
                                                const SimulatedPopulation& population,
                                                std::size_t participants,
                                                const std::function<void()>& onTrial = {});

/// "01", "02", ...: as many digits as the last participant needs, at least two.
std::string participantName(std::size_t index, std::size_t participants);

/// The seed of participant `index` (from 0) of a simulated study.
std::uint64_t participantSeed(std::uint64_t studySeed, std::size_t index);

}  // namespace study_app
