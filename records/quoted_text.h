// SPDX-License-Identifier: MIT
// Text as it enters and leaves files, and as an error sentence may show it.
#pragma once

#include <string>
#include <string_view>

namespace records {

/// The text in double quotes for an error sentence: control characters and broken UTF-8 shown as
/// \xNN, and cut with "..." where it is longer than 60 bytes.
std::string quotedText(std::string_view text);

/// Valid UTF-8 without control characters (so no tab, no line end): what a text cell may hold.
bool isPlainText(std::string_view text);

/// The shortest decimal text that reads back as the same bits (std::to_chars), independent of
/// locale.
std::string exactText(double value);

}  // namespace records
