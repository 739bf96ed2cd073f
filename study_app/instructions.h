// SPDX-License-Identifier: MIT
// What an observer reads before the practice: a text file of paragraphs.
//
//   # Heading
//   A paragraph runs to the next empty line.
//   [examples]                    an edge with stair-steps and a clean one stand here
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "study_app/design.h"

namespace study_app {

struct InstructionBlock {
    enum class Kind { heading, paragraph, examples };
    Kind kind = Kind::paragraph;
    std::string text;
    bool operator==(const InstructionBlock&) const = default;
};
using Instructions = std::vector<InstructionBlock>;

Instructions parseInstructions(std::string_view text);

/// Throws std::runtime_error where the file cannot be read or holds nothing to read.
Instructions readInstructions(const std::filesystem::path& file);

/// The shipped text for a design's task: instructions/2afc.txt, yes_no.txt, or localise.txt where
/// yes is a click, with frames_ before the name for rendered frames, beside the shipped designs.
/// Throws std::runtime_error naming the places searched.
std::filesystem::path shippedInstructions(const Design& design);

}  // namespace study_app
