// SPDX-License-Identifier: MIT
#include "records/trial_table.h"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <system_error>

#include "records/quoted_text.h"
#include "records/trial_columns.h"
#include "records/whole_file.h"

namespace records {

namespace {

constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";

// One cell's place in errors and its destination: a column of ours, or the next extra one.
struct ColumnReader {
    std::string name;
    const TrialColumn* known = nullptr;
};

void splitCells(std::string_view line, std::vector<std::string_view>& cells) {
    cells.clear();
    for (std::size_t start = 0;;) {
        const std::size_t tab = line.find('\t', start);
        cells.push_back(line.substr(start, tab - start));
        if (tab == std::string_view::npos) return;
        start = tab + 1;
    }
}

std::string_view withoutReturn(std::string_view line) {
    if (line.ends_with('\r')) line.remove_suffix(1);
    return line;
}

// Walks through the lines of one table; knows where it is for the sentence of an error.
class TableParser {
  public:
    TableParser(std::string_view text, const std::filesystem::path& file) : text_(text) {
        table_.file = file;
        if (text_.starts_with(kByteOrderMark)) text_.remove_prefix(kByteOrderMark.size());
    }

    TrialTable parse() {
        if (text_.empty()) fail("is empty: a trial table starts with a line of column names");
        readHeader();
        while (nextLine()) readRow();
        if (oddRadii_ > 0) noteOddRadii();
        return std::move(table_);
    }

  private:
    // False at the end, or at a torn line, which goes into the notices.
    bool nextLine() {
        if (text_.empty()) return false;
        ++line_;
        const std::size_t end = text_.find('\n');
        if (end == std::string_view::npos) {
            if (line_ == 1) fail(quotedText(text_) + ": the line of column names has no line end");
            table_.notices.push_back(
                place() + ": torn line dropped, it has no line end: " + quotedText(text_) +
                " (if the row is whole, end it with a new line)");
            return false;
        }
        current_ = withoutReturn(text_.substr(0, end));
        text_.remove_prefix(end + 1);
        return true;
    }

    void readHeader() {
        nextLine();
        splitCells(current_, cells_);
        for (const std::string_view name : cells_) addColumn(name);
        for (const TrialColumn& column : trialColumns())
            if (column.required && !hasColumn(column.name))
                fail("column " + std::string(column.name) + ": is missing");
    }

    void addColumn(std::string_view name) {
        if (name.empty() || !isPlainText(name))
            fail("column name " + quotedText(name) + ": must be a text");
        if (hasColumn(name)) fail("column " + std::string(name) + ": stands twice");
        const auto all = trialColumns();
        const auto found = std::find_if(
            all.begin(), all.end(), [&](const TrialColumn& column) { return column.name == name; });
        columns_.push_back({std::string(name), found == all.end() ? nullptr : &*found});
        if (found == all.end()) table_.extraColumns.emplace_back(name);
    }

    bool hasColumn(std::string_view name) const {
        return std::any_of(columns_.begin(), columns_.end(),
                           [&](const ColumnReader& column) { return column.name == name; });
    }

    void readRow() {
        splitCells(current_, cells_);
        if (cells_.size() != columns_.size())
            fail(quotedText(current_) + ": has " + std::to_string(cells_.size()) +
                 " cells: must have " + std::to_string(columns_.size()) + ", one per column");
        Trial trial;
        for (std::size_t i = 0; i < cells_.size(); ++i) readCell(columns_[i], cells_[i], trial);
        if (const auto broken = brokenRule(trial))
            failCell(broken->column, cellOf(broken->column), broken->rule);
        if (trial.status == TrialStatus::ok) requireRisingNumber(trial.number);
        if (trial.filterRadiusPx <= 0 && oddRadii_++ == 0) firstOddRadius_ = line_;
        table_.trials.push_back(std::move(trial));
    }

    void readCell(const ColumnReader& column, std::string_view cell, Trial& trial) {
        const std::string rule =
            column.known != nullptr ? column.known->read(cell, trial) : brokenTextRule(cell);
        if (!rule.empty()) failCell(column.name, cell, rule);
        if (column.known == nullptr) trial.extra.emplace_back(cell);
    }

    // Interleaved rows of two sessions, or a row pasted twice, would count a trial twice.
    void requireRisingNumber(int number) {
        if (number <= lastOk_)
            failCell("trial", std::to_string(number),
                     "must be greater than " + std::to_string(lastOk_) +
                         ", the ok trial before it (line " + std::to_string(lastOkLine_) + ")");
        lastOk_ = number;
        lastOkLine_ = line_;
    }

    void noteOddRadii() {
        table_.notices.push_back(
            table_.file.string() + ": line " + std::to_string(firstOddRadius_) +
            ": column filter_radius_px: not greater than 0 on " + std::to_string(oddRadii_) +
            " reference trials from here on; kept, since only the answer "
            "counts on them");
    }

    std::string_view cellOf(std::string_view column) const {
        for (std::size_t i = 0; i < columns_.size(); ++i)
            if (columns_[i].name == column) return cells_[i];
        return kUnknownCell;
    }

    std::string place() const {
        return table_.file.string() + (line_ > 0 ? ": line " + std::to_string(line_) : "");
    }
    [[noreturn]] void fail(const std::string& sentence) const {
        throw std::runtime_error(place() + ": " + sentence);
    }
    [[noreturn]] void failCell(std::string_view column, std::string_view cell,
                               const std::string& rule) const {
        fail("column " + std::string(column) + ": " + quotedText(cell) + ": " + rule);
    }

    std::string_view text_;     // what is still to be read
    std::string_view current_;  // the line at line_
    std::size_t line_ = 0;
    std::vector<std::string_view> cells_;
    std::vector<ColumnReader> columns_;
    int lastOk_ = 0;
    std::size_t lastOkLine_ = 0;
    std::size_t oddRadii_ = 0;  // rows with a radius that is not positive (reference trials)
    std::size_t firstOddRadius_ = 0;
    TrialTable table_;
};

// The <id> of "<key>-<id>" between underscores in a BIDS file name.
std::optional<std::string> entityOf(const std::string& stem, const std::string& key) {
    for (std::size_t start = 0; start < stem.size();) {
        const std::size_t end = std::min(stem.find('_', start), stem.size());
        const std::string part = stem.substr(start, end - start);
        if (part.starts_with(key + "-") && part.size() > key.size() + 1)
            return part.substr(key.size() + 1);
        start = end + 1;
    }
    return std::nullopt;
}

}  // namespace

TrialTable parseTrialTable(std::string_view text, const std::filesystem::path& file) {
    TrialTable table = TableParser(text, file).parse();
    const std::string stem = file.stem().string();
    table.participant = entityOf(stem, "sub").value_or(stem);
    table.session = entityOf(stem, "ses");
    return table;
}

TrialTable readTrialTable(const std::filesystem::path& file) {
    return parseTrialTable(readWholeFile(file), file);
}

std::string trialTableHeader(const std::vector<std::string>& extraColumns) {
    std::string header;
    const auto add = [&](std::string_view name) {
        if (!header.empty()) header += '\t';
        header += name;
    };
    for (const TrialColumn& column : trialColumns()) add(column.name);
    for (const std::string& name : extraColumns) {
        if (name.empty() || !isPlainText(name))
            throw std::invalid_argument("column name " + quotedText(name) + ": must be a text");
        add(name);
    }
    return header;
}

std::string trialTableRow(const Trial& trial) {
    std::string row, cell;
    Trial readBack;
    const auto fail = [&](std::string_view column, const std::string& rule) {
        throw std::invalid_argument("trial " + std::to_string(trial.number) + ": column " +
                                    std::string(column) + ": " + quotedText(cell) + ": " + rule);
    };
    for (const TrialColumn& column : trialColumns()) {
        cell.clear();
        column.write(trial, cell);
        if (const std::string rule = column.read(cell, readBack); !rule.empty())
            fail(column.name, rule);
        if (!row.empty()) row += '\t';
        row += cell;
    }
    for (const std::string& extra : trial.extra) {
        cell = extra;
        if (const std::string rule = brokenTextRule(cell); !rule.empty()) fail("(extra)", rule);
        row += '\t' + extra;
    }
    readBack.extra = trial.extra;
    if (const auto broken = brokenRule(trial)) {
        for (const TrialColumn& column : trialColumns())
            if (column.name == broken->column) cell.clear(), column.write(trial, cell);
        fail(broken->column, broken->rule);
    }
    // What is left is an optional text that spells the word for unknown.
    if (readBack != trial)
        throw std::invalid_argument("trial " + std::to_string(trial.number) +
                                    ": a text is \"n/a\", which would read back as unknown");
    return row;
}

}  // namespace records
