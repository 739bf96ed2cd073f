// SPDX-License-Identifier: MIT
// Where calibrations are kept: one JSON file with a profile per display, told apart by the
// monitor's name and its resolution.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "study_app/viewing_geometry.h"

namespace study_app {

/// $STAIRWELL_DISPLAYS, else stairwell/displays.json in the user's configuration folder
/// ($XDG_CONFIG_HOME, else ~/.config); ./displays.json where there is neither.
std::filesystem::path displayFile();

/// Empty where the file does not exist. Throws std::runtime_error for a malformed one.
std::vector<DisplayProfile> readDisplays(const std::filesystem::path& file);

/// The profile of this monitor at this resolution.
std::optional<DisplayProfile> findDisplay(const std::vector<DisplayProfile>& displays,
                                          const DisplayProfile& monitor);

/// Puts the profile into the file in place of an older one of the same display, whole or not at
/// all. Throws std::runtime_error where it cannot be written, std::invalid_argument for a profile
/// that does not validate.
void storeDisplay(const std::filesystem::path& file, const DisplayProfile& profile);

}  // namespace study_app
