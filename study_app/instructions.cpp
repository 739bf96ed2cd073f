// SPDX-License-Identifier: MIT
#include "study_app/instructions.h"

#include <stdexcept>

#include "records/quoted_text.h"
#include "records/whole_file.h"
#include "study_app/design_file.h"

namespace study_app {
namespace {

namespace fs = std::filesystem;

std::string_view trimmed(std::string_view line) {
    const auto isSpace = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
    while (!line.empty() && isSpace(line.front())) line.remove_prefix(1);
    while (!line.empty() && isSpace(line.back())) line.remove_suffix(1);
    return line;
}

}  // namespace

Instructions parseInstructions(std::string_view text) {
    using Kind = InstructionBlock::Kind;
    Instructions blocks;
    bool paragraphOpen = false;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        const std::string_view line = trimmed(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
        if (line.starts_with("# ")) {
            blocks.push_back({Kind::heading, std::string(trimmed(line.substr(2)))});
        } else if (line == "[examples]") {
            blocks.push_back({Kind::examples, {}});
        } else if (!line.empty() && paragraphOpen) {
            blocks.back().text.append(" ").append(line);
            continue;
        } else if (!line.empty()) {
            blocks.push_back({Kind::paragraph, std::string(line)});
            paragraphOpen = true;
            continue;
        }
        paragraphOpen = false;
    }
    return blocks;
}

Instructions readInstructions(const fs::path& file) {
    Instructions blocks = parseInstructions(records::readWholeFile(file));
    if (blocks.empty()) throw std::runtime_error(file.string() + ": empty: holds no instructions");
    return blocks;
}

fs::path shippedInstructions(const Design& design) {
    const std::string name =
        (design.frames ? "frames_" : "") +
        (design.localise ? "localise" : std::string(records::toText(design.task))) + ".txt";
    std::string searched;
    for (const fs::path& designs : designFolders()) {
        const fs::path file = designs.parent_path() / "instructions" / name;
        if (fs::exists(file)) return file;
        searched += (searched.empty() ? "" : ", ") + file.string();
    }
    throw std::runtime_error("instructions: " + name + ": not found, looked for " + searched);
}

}  // namespace study_app
