// SPDX-License-Identifier: MIT
// The `.json` file beside a trial table, and the two data-set files of BIDS: what was shown, on
// what, by which software. A session is resumed only with the design that its sidecar holds.
//
// The sidecar's top level is what BIDS defines (TaskName, a description of every column); what is
// ours stands under the one key "stairwell".
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "records/run_context.h"
#include "records/screen_luminance.h"
#include "records/trial_table.h"

namespace records {

inline constexpr int kSidecarMajor = 1;

struct SessionSidecar {
    RunContext context;
    std::string participant;
    std::optional<std::string> session;
    std::string observer = "human";  ///< "human", or the simulated observer's description
    nlohmann::json design;           ///< the whole design, normalised (defaults filled in)
    std::uint64_t seed = 0;
    std::string kernel;  ///< "disc", ... ; "mixed" where the design varies it
    Task task = Task::twoAfc;
    Encoding encoding = Encoding::srgb;
    double beta = 3.5;     ///< psychometric slope that the staircases assumed
    double criterion = 0;  ///< F* of the staircases' threshold
    int displayWidthPx = 0, displayHeightPx = 0;
    std::optional<double> pxPerDeg;
    std::optional<double> displayGamma;
    ScreenLuminance luminance;

    bool operator==(const SessionSidecar&) const = default;
};

std::filesystem::path sidecarPath(const std::filesystem::path& trialTable);  ///< same name, .json

/// Written whole or not at all (temporary file, sync, rename), with the descriptions of the
/// columns. Throws std::invalid_argument for what readSidecar would refuse.
void writeSidecar(const std::filesystem::path& file, const SessionSidecar& sidecar);
/// Throws std::runtime_error with file, field, value and rule; refuses an unknown major schema.
SessionSidecar readSidecar(const std::filesystem::path& file);
/// The same on text that came from `file`.
SessionSidecar parseSidecar(std::string_view text, const std::string& file);

/// Creates dataset_description.json and participants.tsv where they are missing and adds the
/// participant's row where it is missing. Never changes a row that is there: further columns (age,
/// ...) are kept and get n/a. Two programs may register at the same time. Throws std::runtime_error
/// (not writable; a participants.tsv whose first column is not participant_id) and
/// std::invalid_argument for an id that is not letters and digits.
void registerParticipant(const std::filesystem::path& dataFolder, const std::string& participant);

}  // namespace records
