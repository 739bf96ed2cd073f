// SPDX-License-Identifier: MIT
#include "demo/tsv_journal.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <sstream>
#include <stdexcept>

#include "demo/ripple_counts.h"
#include "records/whole_file.h"

namespace demo {
namespace {

std::vector<std::string> cellsOf(const std::string& line) {
    std::vector<std::string> cells;
    std::size_t begin = 0;
    for (std::size_t tab; (tab = line.find('\t', begin)) != std::string::npos; begin = tab + 1)
        cells.push_back(line.substr(begin, tab - begin));
    cells.push_back(line.substr(begin));
    return cells;
}

std::string lineOf(const std::vector<std::string>& cells) {
    std::string line;
    for (std::size_t i = 0; i < cells.size(); ++i) line += (i == 0 ? "" : "\t") + cells[i];
    return line + "\n";
}

std::string contextLines(const std::string& context) {
    std::string lines;
    std::istringstream in(context);
    for (std::string line; std::getline(in, line);)
        if (!line.empty()) lines += "# " + line + "\n";
    return lines;
}

}  // namespace

const std::string& TsvRow::text(const std::string& column) const {
    const auto found = std::find(table_.columns_.begin(), table_.columns_.end(), column);
    if (found == table_.columns_.end())
        throw std::runtime_error(table_.name_ + ": column \"" + column + "\" is missing");
    return table_.cells_[row_][static_cast<std::size_t>(found - table_.columns_.begin())];
}

double TsvRow::number(const std::string& column) const {
    const std::string& found = text(column);
    if (found == "n/a") return NAN;
    double value = 0;
    const auto [end, error] = std::from_chars(found.data(), found.data() + found.size(), value);
    if (error != std::errc() || end != found.data() + found.size())
        throw std::runtime_error(table_.name_ + ": row " + std::to_string(row_ + 1) + ", column " +
                                 column + " is \"" + found + "\", must be a number or n/a");
    return value;
}

int TsvRow::whole(const std::string& column) const {
    const double value = number(column);
    if (!(std::abs(value) <= 1e9 && value == std::floor(value)))
        throw std::runtime_error(table_.name_ + ": row " + std::to_string(row_ + 1) + ", column " +
                                 column + " is \"" + text(column) + "\", must be a whole number");
    return static_cast<int>(value);
}

std::vector<int> TsvRow::wholes(const std::string& column) const {
    const std::string& found = text(column);
    try {
        return wholeNumbers(found);
    } catch (const std::runtime_error& error) {
        throw std::runtime_error(table_.name_ + ": row " + std::to_string(row_ + 1) + ", column " +
                                 column + ": " + error.what());
    }
}

std::vector<TsvRow> TsvTable::rows() const {
    std::vector<TsvRow> all;
    for (std::size_t i = 0; i < cells_.size(); ++i) all.emplace_back(*this, i);
    return all;
}

void TsvTable::add(std::vector<std::string> row) {
    if (row.size() != columns_.size())
        throw std::invalid_argument(name_ + ": a row of " + std::to_string(row.size()) +
                                    " cells, must have " + std::to_string(columns_.size()));
    cells_.push_back(std::move(row));
}

void TsvTable::append(const TsvTable& other) {
    if (other.columns_ != columns_)
        throw std::invalid_argument(other.name_ + ": has other columns than " + name_);
    cells_.insert(cells_.end(), other.cells_.begin(), other.cells_.end());
}

std::string TsvTable::toText() const {
    std::string text = contextLines(context_) + lineOf(columns_);
    for (const auto& row : cells_) text += lineOf(row);
    return text;
}

TsvTable readTsv(const std::filesystem::path& file) {
    const std::string text = records::readWholeFile(file);
    TsvTable table(file.string(), {});
    std::string context;
    int number = 0;
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = text.find('\n', begin);
        if (end == std::string::npos) break;  // torn
        const std::string line = text.substr(begin, end - begin);
        begin = end + 1;
        ++number;
        if (line.starts_with("#")) {
            context += line.substr(line.starts_with("# ") ? 2 : 1) + "\n";
        } else if (table.columns().empty()) {
            table = TsvTable(file.string(), cellsOf(line));
        } else {
            std::vector<std::string> cells = cellsOf(line);
            if (cells.size() != table.columns().size())
                throw std::runtime_error(file.string() + ":" + std::to_string(number) + ": has " +
                                         std::to_string(cells.size()) + " cells, must have " +
                                         std::to_string(table.columns().size()));
            table.add(std::move(cells));
        }
    }
    if (table.columns().empty())
        throw std::runtime_error(file.string() + ": no line of column names");
    table.setContext(context);
    return table;
}

TsvJournal::TsvJournal(std::filesystem::path file, std::vector<std::string> columns,
                       const std::string& context)
    : file_(std::move(file)), table_(file_.string(), columns) {
    table_.setContext(context);
    const std::string begin = table_.toText();
    std::string bytes;
    if (std::filesystem::exists(file_)) bytes = records::readWholeFile(file_);
    const std::size_t whole = bytes.rfind('\n') == std::string::npos ? 0 : bytes.rfind('\n') + 1;
    // Killed while it wrote the first lines: nothing was measured.
    const bool isNew = bytes.find('\n' + lineOf(columns)) == std::string::npos &&
                       (whole == 0 || bytes.substr(bytes.rfind('\n', whole - 2) + 1)[0] == '#');
    if (!isNew) {
        table_ = readTsv(file_);
        if (table_.columns() != columns)
            throw std::runtime_error(file_.string() +
                                     ": has other columns than this program writes; name another "
                                     "folder or delete it");
    }
    records::createFolders(file_.parent_path());
    descriptor_ = records::openFile(file_, O_WRONLY | O_CREAT);
    if (!descriptor_.isOpen()) records::throwSystemError(file_, "cannot be opened", errno);
    if (!records::cutFile(descriptor_.get(), isNew ? 0 : whole) ||
        ::lseek(descriptor_.get(), 0, SEEK_END) < 0 ||
        (isNew && !records::writeAll(descriptor_.get(), begin)))
        records::throwSystemError(file_, "cannot be written", errno);
}

void TsvJournal::add(const std::vector<std::string>& row) {
    table_.add(row);
    if (!records::writeAll(descriptor_.get(), lineOf(row)) || !records::syncData(descriptor_.get()))
        records::throwSystemError(file_, "cannot be written", errno);
}

std::string tsvNumber(double value) {
    if (!std::isfinite(value)) return "n/a";
    char text[32];
    std::snprintf(text, sizeof text, "%.6g", value);
    return text;
}

}  // namespace demo
