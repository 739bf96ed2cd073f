// SPDX-License-Identifier: MIT
#include "records/participants_table.h"

#include <algorithm>
#include <charconv>
#include <stdexcept>
#include <string_view>

#include "records/number_rule.h"
#include "records/quoted_text.h"
#include "records/session_sidecar.h"
#include "records/whole_file.h"

namespace records {
namespace {

namespace fs = std::filesystem;
using Row = std::vector<std::string>;

constexpr std::string_view kUnknown = "n/a";
constexpr NumberRule kAge = between(0, 150);

Row split(std::string_view text, char separator) {
    Row parts;
    for (std::size_t end = text.find(separator); end != text.npos; end = text.find(separator)) {
        parts.emplace_back(text.substr(0, end));
        text.remove_prefix(end + 1);
    }
    parts.emplace_back(text);
    return parts;
}

/// Every row with as many cells as the first, which names the columns.
std::vector<Row> readRows(const fs::path& file) {
    std::string text = readWholeFile(file);
    if (text.starts_with("\xef\xbb\xbf")) text.erase(0, 3);
    std::erase(text, '\r');
    if (text.ends_with('\n')) text.pop_back();
    std::vector<Row> rows;
    for (const std::string& line : split(text, '\n')) {
        rows.push_back(split(line, '\t'));
        if (rows.back().size() == rows.front().size()) continue;
        throw std::runtime_error(file.string() + ": line " + std::to_string(rows.size()) + ": " +
                                 std::to_string(rows.back().size()) + " cells: must be " +
                                 std::to_string(rows.front().size()) + ", as in the header");
    }
    return rows;
}

Row* rowOf(std::vector<Row>& rows, const std::string& subject) {
    const auto found = std::ranges::find_if(rows, [&](const Row& r) { return r[0] == subject; });
    return found == rows.end() ? nullptr : &*found;
}

std::string* cell(std::vector<Row>& rows, Row& row, const std::string& column) {
    const auto found = std::ranges::find(rows.front(), column);
    if (found == rows.front().end()) return nullptr;
    return &row[static_cast<std::size_t>(found - rows.front().begin())];
}

std::optional<double> ageFrom(const std::string& text, const fs::path& file) {
    if (text == kUnknown) return {};
    double age = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), age);
    if (error == std::errc() && end == text.data() + text.size() && kAge.holds(age)) return age;
    throw std::runtime_error(file.string() + ": column age: " + quotedText(text) + ": " +
                             kAge.text() + ", or n/a");
}

void require(const std::string& field, const std::string& text) {
    if (isPlainText(text)) return;
    throw std::invalid_argument("participant: " + field + ": " + quotedText(text) +
                                ": must be a text of one line");
}

}  // namespace

std::optional<ParticipantDetails> readParticipant(const fs::path& dataFolder,
                                                  const std::string& participant) {
    const fs::path file = dataFolder / "participants.tsv";
    if (!fs::exists(file)) return {};
    std::vector<Row> rows = readRows(file);
    Row* row = rowOf(rows, "sub-" + participant);
    if (row == nullptr) return {};
    const auto text = [&](const char* column) {
        const std::string* found = cell(rows, *row, column);
        return found == nullptr || *found == kUnknown ? std::string() : *found;
    };
    const std::string* age = cell(rows, *row, "age");
    return ParticipantDetails{.age = age == nullptr ? std::nullopt : ageFrom(*age, file),
                              .gender = text("gender"),
                              .expertise = text("expertise")};
}

std::optional<std::string> participantCell(const fs::path& dataFolder,
                                           const std::string& participant,
                                           const std::string& column) {
    const fs::path file = dataFolder / "participants.tsv";
    if (!fs::exists(file)) return {};
    std::vector<Row> rows = readRows(file);
    Row* row = rowOf(rows, "sub-" + participant);
    const std::string* found = row == nullptr ? nullptr : cell(rows, *row, column);
    return found == nullptr ? std::nullopt : std::optional(*found);
}

std::vector<std::string> participantColumns(const fs::path& dataFolder) {
    const fs::path file = dataFolder / "participants.tsv";
    if (!fs::exists(file)) return {};
    Row head = readRows(file).front();
    head.erase(head.begin());
    return head;
}

void writeParticipant(const fs::path& dataFolder, const std::string& participant,
                      const ParticipantDetails& details) {
    require("gender", details.gender);
    require("expertise", details.expertise);
    if (details.age && !kAge.holds(*details.age)) {
        throw std::invalid_argument("participant: age: " + exactText(*details.age) + ": " +
                                    kAge.text());
    }
    registerParticipant(dataFolder, participant);
    const fs::path file = dataFolder / "participants.tsv";
    std::vector<Row> rows = readRows(file);
    const auto set = [&](const std::string& column, const std::string& value) {
        Row* row = rowOf(rows, "sub-" + participant);
        if (cell(rows, *row, column) == nullptr) {
            for (Row& r : rows) r.push_back(&r == &rows.front() ? column : std::string(kUnknown));
        }
        *cell(rows, *row, column) = value.empty() ? kUnknown : value;
    };
    set("age", details.age ? exactText(*details.age) : "");
    set("gender", details.gender);
    set("expertise", details.expertise);
    std::string text;
    for (const Row& row : rows) {
        for (std::size_t i = 0; i < row.size(); ++i) text += (i == 0 ? "" : "\t") + row[i];
        text += "\n";
    }
    writeWholeFile(file, text);
}

}  // namespace records
