// SPDX-License-Identifier: MIT
// Runs gnuplot on scripts that hold their data inline, so that a figure can be drawn again, or
// changed, from its script alone.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace analysis {

/// Draws all scripts in one run, in their folder (so that the names in them are relative). Throws
/// std::runtime_error where gnuplot is missing, or fails, with what it said.
void runGnuplot(const std::filesystem::path& folder, const std::vector<std::string>& scripts);

/// A text between single quotes of a script, in enhanced mode: its quotes doubled, the characters
/// that enhanced mode takes for itself escaped.
std::string quotedForGnuplot(const std::string& text);

}  // namespace analysis
