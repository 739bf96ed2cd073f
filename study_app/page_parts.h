// SPDX-License-Identifier: MIT
// What the screens have in common: a calm column of text with its buttons at the foot.
#pragma once

#include <optional>
#include <string>

#include "study_app/screens.h"

namespace study_app {

/// ImGui lays out what it shows for the first time over two frames.
inline constexpr int kFramesToSettle = 3;

/// The grey behind the pages, code value.
inline constexpr int kPageGrey = 33;

/// A column in the middle of the window, as wide as `width` (px at scale 1) or the window allows.
/// Everything until endPage() belongs to it.
void beginPage(const Page& page, const char* title, float width = 760);

struct Footer {
    const char* primary = nullptr;  ///< Return presses it
    bool enabled = true;
    const char* secondary = nullptr;
    bool secondaryEnabled = true;
    const char* tertiary = nullptr;
    std::string note{};  ///< beside the buttons
};
enum class Pressed { primary, secondary, tertiary };
std::optional<Pressed> endPage(const Page& page, const Footer& footer);

void paragraph(const std::string& text);
void faint(const Page& page, const std::string& text);
/// Something that a person should not overlook.
void warning(const std::string& text);

/// Progress through the session and minutes left, in a line at the foot of the window.
void drawProgress(const Page& page, const SessionRunner& runner);
/// "about 12 minutes"
std::string minutesText(double seconds);

/// Draws codes at the cursor, pixel for pixel.
void image(const Page& page, const cv::Mat& codes);

}  // namespace study_app
