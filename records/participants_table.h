// SPDX-License-Identifier: MIT
// What participants.tsv says about a participant beyond the id: age, gender, expertise, each
// optional. Columns of others are kept as they are.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace records {

/// Empty texts and a missing age are written as n/a.
struct ParticipantDetails {
    std::optional<double> age;  ///< years, [0, 150]
    std::string gender;         ///< free text of one line
    std::string expertise;      ///< with images and graphics, free text of one line
    bool operator==(const ParticipantDetails&) const = default;
};

/// Nothing where the table or the participant's row is missing. Throws std::runtime_error with file
/// and line for a row that has not as many cells as the header, or an age that is no number.
std::optional<ParticipantDetails> readParticipant(const std::filesystem::path& dataFolder,
                                                  const std::string& participant);

/// Registers the participant where that has not happened and writes the details into its row,
/// adding the columns where they are missing; the table is replaced whole or not at all. Throws
/// like registerParticipant (session_sidecar.h), and std::invalid_argument for details that do not
/// fit into a cell.
void writeParticipant(const std::filesystem::path& dataFolder, const std::string& participant,
                      const ParticipantDetails& details);

/// The cell of any column in the participant's row. Nothing where table, row or column is missing;
/// throws like readParticipant.
std::optional<std::string> participantCell(const std::filesystem::path& dataFolder,
                                           const std::string& participant,
                                           const std::string& column);
/// Names of the columns beyond the id; none where the table is missing. Throws likewise.
std::vector<std::string> participantColumns(const std::filesystem::path& dataFolder);

}  // namespace records
