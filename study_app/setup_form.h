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

inline constexpr const char* kNewDesign = "paper16";

/// As typed.
struct SetupForm {
    std::string dataFolder = "study";
    std::string participant, session;    ///< session may be empty
    std::string age, gender, expertise;  ///< may be empty
    /// A shipped design or a file; empty: the one that the session began with, kNewDesign for a new
    /// session. Design, task and seed that are given hold for a session that exists already, too:
    /// where it began with others it is unusable.
    std::string design;
    std::string seed;                               ///< empty: as it began, or drawn when it starts
    std::optional<records::Task> task;              ///< absent: the design's own
    std::optional<Presentation> presentation = {};  ///< absent: the design's own
    bool operator==(const SetupForm&) const = default;
};

/// The session that participant and session name in the data folder.
struct ExistingSession {
    enum class State { none, unfinished, finished, unusable };
    State state = State::none;
    std::size_t answered = 0, total = 0;
    std::size_t rows = 0;          ///< of any status
    std::optional<Design> design;  ///< that it goes on with; none where it is unusable
    std::uint64_t seed = 0;
    std::string problem;  ///< unusable: why
};
ExistingSession findExisting(const SetupForm& form);

/// Its trial table, there or not.
std::filesystem::path tableOf(const SetupForm& form);

/// The participants of the data folder: "07: finished", "08: 35 of 72 trials", sorted. At most
/// `most` of them are looked into.
std::vector<std::string> describeParticipants(const std::filesystem::path& dataFolder,
                                              std::size_t most = 200);

/// The form's design, else `begun`, else kNewDesign, with the form's task and presentation. Throws
/// like readDesign and findDesign.
Design designOf(const SetupForm& form, const std::optional<Design>& begun = {});

/// A design for the other task at the same criterion.
Design withTask(Design design, records::Task task);

/// In plain words, a line each: what is shown, how many trials, how long.
std::vector<std::string> describeDesign(const Design& design);

/// Why nothing can be written into this folder, which need not exist yet; empty where it can.
std::string notWritable(const std::filesystem::path& folder);

/// Empty when a session can start; else what is missing, as a sentence.
std::string missing(const SetupForm& form);

/// The request with which the session starts or goes on: an unfinished session's own design and
/// seed, else the form's, with `freshSeed` where the form has none. Throws std::runtime_error.
SessionRequest requestFrom(const SetupForm& form, const ExistingSession& existing,
                           const DisplayProfile& display, std::uint64_t freshSeed,
                           const records::RunContext& context);

}  // namespace study_app
