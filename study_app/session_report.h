// SPDX-License-Identifier: MIT
// What a finished or resumed session tells the experimenter, as plain text tables.
#pragma once

#include <string>
#include <vector>

#include "study_app/session.h"
#include "study_app/simulated_study.h"

namespace study_app {

/// Columns of equal width, the first to the left, the others (numbers) to the right; a line each.
std::string aligned(const std::vector<std::vector<std::string>>& rows);

/// One row per condition: trials, threshold x0 with its posterior sd, c, threshold radius; with a
/// simulated observer also the c that it really has. `participant` may be null.
std::string thresholdTable(const Session& session, const SimulatedParticipant* participant);

/// "72 of 72 trials, 8 of them catch trials (1 failed); c at criterion F* = 0.6465, 2afc, srgb,
/// beta 3.5": everything without which c means nothing.
std::string contextLine(const Session& session);

/// One row per condition over the participants of a simulated study: geometric mean of the
/// staircases' c, sd between participants (log10 units), geometric mean of the c they really have.
std::string studyTable(const std::vector<SimulatedSession>& sessions);

}  // namespace study_app
