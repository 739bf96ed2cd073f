// SPDX-License-Identifier: MIT
// A page of Markdown with a paper's figures and tables as ours came out, beside the paper's
// numbers: docs/papers.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "records/run_context.h"
#include "renderer/gl_context.h"

namespace demo {

struct PaperTitle {
    std::string name;  ///< of its page
    std::string title;
};
const std::vector<PaperTitle>& paperTitles();

/// Draws, measures and writes `name`.md and its pictures into the folder, created where it is
/// missing. Tables and timed figures take `rounds` rounds. Throws std::invalid_argument for a paper
/// that is not known, std::runtime_error where a file cannot be written.
void writePaperPage(const std::filesystem::path& folder, const std::string& name,
                    const renderer::GlInfo& info, const records::RunContext& context, int rounds);

}  // namespace demo
