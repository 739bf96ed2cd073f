// SPDX-License-Identifier: MIT
// Measured rows that outlive a kill: a tab-separated file to which whole lines are appended and
// synced, after lines of context that begin with #. A torn last line is dropped by the reader.
//
//   TsvJournal journal(folder / "times.tsv", {"scene", "frame_ms"}, contextText);
//   journal.add({"yard", "12.5"});
//   for (const TsvRow& row : readTsv(folder / "times.tsv").rows()) row.number("frame_ms");
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "records/file_descriptor.h"

namespace demo {

class TsvTable;

/// A row of a table, which must outlive it.
class TsvRow {
  public:
    TsvRow(const TsvTable& table, std::size_t row) : table_(table), row_(row) {}
    /// Throw std::runtime_error that names file, row, column and what was found there.
    const std::string& text(const std::string& column) const;
    double number(const std::string& column) const;  ///< n/a is NaN
    int whole(const std::string& column) const;
    std::vector<int> wholes(const std::string& column) const;  ///< with commas between

  private:
    const TsvTable& table_;
    std::size_t row_;
};

class TsvTable {
  public:
    TsvTable(std::string name, std::vector<std::string> columns)
        : name_(std::move(name)), columns_(std::move(columns)) {}

    std::vector<TsvRow> rows() const;
    std::size_t size() const { return cells_.size(); }
    const std::vector<std::string>& columns() const { return columns_; }
    const std::string& context() const { return context_; }

    /// Throws std::invalid_argument for a row of another length.
    void add(std::vector<std::string> row);
    /// Rows of another table with the same columns. Throws std::invalid_argument where they differ.
    void append(const TsvTable& other);
    void setContext(const std::string& lines) { context_ = lines; }
    std::string toText() const;  ///< context, column names, rows

  private:
    friend class TsvRow;
    std::string name_;
    std::vector<std::string> columns_;
    std::vector<std::vector<std::string>> cells_;
    std::string context_;  // without the # of each line
};

/// Throws std::runtime_error that names the file and line for a row of a wrong length that is not
/// the last one, and where the file cannot be read.
TsvTable readTsv(const std::filesystem::path& file);

/// Appends to a file, which begins with context and column names where it is new.
class TsvJournal {
  public:
    /// Throws std::runtime_error where the file cannot be written or has other columns. What a
    /// killed program left torn is cut off.
    TsvJournal(std::filesystem::path file, std::vector<std::string> columns,
               const std::string& context);

    /// On disk before it returns.
    void add(const std::vector<std::string>& row);
    const TsvTable& table() const { return table_; }  ///< what is in the file, this run's rows too

  private:
    std::filesystem::path file_;
    TsvTable table_;
    records::FileDescriptor descriptor_;
};

std::string tsvNumber(double value);  ///< six digits; n/a for what is not finite

}  // namespace demo
