// SPDX-License-Identifier: MIT
// What an experimenter fills in before a session, and what it means: which session exists already,
// what a design amounts to, the request with which the session starts. No window; the set-up screen
// and the command line fill in the same form.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "study_app/design.h"
#include "study_app/presentation.h"
#include "study_app/recorded_session.h"
#include "study_app/viewing_geometry.h"

namespace study_app {

/// As typed.
struct SetupForm {
    std::string dataFolder = "study";
    std::string participant, session;               ///< session may be empty
    std::string age, gender, expertise;             ///< may be empty
    std::string design = "paper16";                 ///< a shipped design or a file
    std::string seed;                               ///< empty: drawn when the session starts
    std::optional<records::Task> task;              ///< absent: the design's own
    std::optional<Presentation> presentation = {};  ///< absent: the design's own
    bool operator==(const SetupForm&) const = default;
};

/// The session that participant and session name in the data folder.
struct ExistingSession {
    enum class State { none, unfinished, finished, unusable };
    State state = State::none;
    std::size_t answered = 0, total = 0;
    std::optional<Design> design;  ///< of its sidecar; a session goes on only as it began
    std::uint64_t seed = 0;
    std::string problem;  ///< unusable: why
};
ExistingSession findExisting(const SetupForm& form);

/// The participants of the data folder: "07: finished", "08: 35 of 72 trials", sorted. At most
/// `most` of them are looked into.
std::vector<std::string> describeParticipants(const std::filesystem::path& dataFolder,
                                              std::size_t most = 200);

/// The form's design with the form's task and presentation. Throws like readDesign and findDesign.
Design designOf(const SetupForm& form);

/// A design for the other task at the same criterion.
Design withTask(Design design, records::Task task);

/// In plain words, a line each: what is shown, how many trials, how long.
std::vector<std::string> describeDesign(const Design& design);

/// Empty when a session can start; else what is missing, as a sentence.
std::string missing(const SetupForm& form);

/// The request with which the session starts or goes on: an unfinished session's own design and
/// seed, else the form's, with `freshSeed` where the form has none. Throws std::runtime_error.
SessionRequest requestFrom(const SetupForm& form, const ExistingSession& existing,
                           const DisplayProfile& display, std::uint64_t freshSeed,
                           const records::RunContext& context);

}  // namespace study_app
