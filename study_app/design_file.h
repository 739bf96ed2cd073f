// SPDX-License-Identifier: MIT
// Design files (JSON): one reader, one writer, and where the shipped ones lie. docs/design-files.md
// lists the fields with their meaning, range and default.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "study_app/design.h"

namespace study_app {

inline constexpr int kDesignMajor = 1;

/// Throws std::runtime_error "<file>: field <field>: <value>: <rule>" for an unknown field, a wrong
/// type, a missing or contradictory value, an unknown major schema.
Design readDesign(const std::filesystem::path& file);

/// The same from JSON that is already there (a session's sidecar); `where` stands for the file, and
/// a folder of frames is looked for in `beside`.
Design designFromJson(const nlohmann::json& json, const std::string& where,
                      const std::filesystem::path& beside = {});

/// The design with every default filled in: two files mean the same design where these are equal.
/// Reading it gives the same design again.
nlohmann::ordered_json normalisedJson(const Design& design);

/// Where two normalised designs differ: "trials_per_condition is 40 there and 20 here"; empty where
/// a session of one may go on with the other. The description is free to change, and so is the
/// place of frames.
std::string designDifference(const nlohmann::json& there, const nlohmann::json& here);

/// The folders in which shipped designs are looked for: `designs` in $STAIRWELL_DATA where that is
/// set; else in the source tree that the program was built in (build/<preset>/bin lies in it), in
/// the installation (<prefix>/share/stairwell) and in ./data.
std::vector<std::filesystem::path> designFolders();

struct ShippedDesign {
    std::filesystem::path file;
    std::string name, description;
};
/// All designs of designFolders(), sorted by name; of two with one name, the folder found first.
/// Throws where one of them cannot be read or there is none.
std::vector<ShippedDesign> shippedDesigns();

/// The file that `--design` means: a path where it exists, has a folder or ends in .json; else the
/// shipped design of that name. Throws std::runtime_error naming the places searched.
std::filesystem::path findDesign(const std::string& nameOrPath);

}  // namespace study_app
