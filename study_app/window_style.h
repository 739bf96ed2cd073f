// SPDX-License-Identifier: MIT
// How the study's windows look: quiet greys with one accent, so that the grey behind the stimuli
// goes on behind every other screen.
#pragma once

#include <string>
#include <vector>

struct ImFont;

namespace study_app {

struct Fonts {
    ImFont* text = nullptr;
    ImFont* heading = nullptr;
    ImFont* small = nullptr;
};

/// Of the current ImGui context, with every length times `scale`.
void setStyle(float scale);

/// Into the current ImGui context's atlas. A font that is missing is replaced by a built-in bitmap
/// font, which `notices` says.
Fonts loadFonts(float scale, std::vector<std::string>& notices);

}  // namespace study_app
