// SPDX-License-Identifier: MIT
#include "records/trial_journal.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <stdexcept>

#include "records/quoted_text.h"
#include "records/whole_file.h"

namespace records {

namespace {

bool isSameFile(int descriptor, const std::filesystem::path& file) {
    struct stat opened, named;
    return ::fstat(descriptor, &opened) == 0 && ::stat(file.c_str(), &named) == 0 &&
           opened.st_dev == named.st_dev && opened.st_ino == named.st_ino;
}

std::string_view firstLine(std::string_view text) {
    std::string_view line = text.substr(0, text.find('\n'));
    if (line.starts_with("\xef\xbb\xbf")) line.remove_prefix(3);
    if (line.ends_with('\r')) line.remove_suffix(1);
    return line;
}

}  // namespace

TrialJournal::TrialJournal(const std::filesystem::path& file,
                           const std::vector<std::string>& extraColumns, SyncRows sync)
    : file_(file), sync_(sync), extraColumns_(extraColumns.size()) {
    if (file_.has_parent_path()) createFolders(file_.parent_path());
    openLocked();
    readExisting(extraColumns);
    for (const Trial& trial : existing_.trials)
        if (trial.status == TrialStatus::ok) lastOk_ = trial.number;
}

TrialJournal::~TrialJournal() {
    if (!synced_) syncData(descriptor_.get());
}

// Opening and locking are two steps, and a file may be replaced in between: look again once it is
// ours.
void TrialJournal::openLocked() {
    do {
        descriptor_ = openFile(file_, O_RDWR | O_CREAT | O_APPEND);
        if (!descriptor_.isOpen()) throwSystemError(file_, "cannot be written", errno);
        struct stat status;
        if (::fstat(descriptor_.get(), &status) == 0 && !S_ISREG(status.st_mode))
            throw std::runtime_error(file_.string() + ": is no regular file");
        if (::flock(descriptor_.get(), LOCK_EX | LOCK_NB) != 0) {
            if (errno == EWOULDBLOCK)
                throw std::runtime_error(file_.string() +
                                         ": is open in another program: this session is running");
            throwSystemError(file_, "cannot be locked", errno);
        }
    } while (!isSameFile(descriptor_.get(), file_));
}

void TrialJournal::readExisting(const std::vector<std::string>& extraColumns) {
    const std::string header = trialTableHeader(extraColumns);
    const std::string text = readAll(descriptor_.get(), file_);
    const std::size_t complete = text.rfind('\n') + 1;  // npos + 1 is 0
    // A power cut may leave the first line torn; nothing was recorded then.
    if (complete == 0 && header.starts_with(text)) return startTable(header);
    existing_ = parseTrialTable(text, file_);
    if (firstLine(text) != header)
        throw std::runtime_error(file_.string() + ": line 1: " + quotedText(firstLine(text)) +
                                 ": a session goes on only in a table with exactly the columns " +
                                 quotedText(header) + ", in this order");
    if (complete < text.size() &&
        (!cutFile(descriptor_.get(), complete) || !syncFile(descriptor_.get())))
        throwSystemError(file_, "torn last line cannot be cut off", errno);
    bytes_ = complete;
}

void TrialJournal::startTable(const std::string& header) {
    if (!cutFile(descriptor_.get(), 0)) throwSystemError(file_, "cannot be written", errno);
    try {
        write(header + "\n");
        sync();
        syncFolder(file_.has_parent_path() ? file_.parent_path() : ".");
    } catch (const std::runtime_error&) {
        // An empty table would be in the way of everyone who reads the folder.
        ::unlink(file_.c_str());
        throw;
    }
    existing_ = parseTrialTable(header + "\n", file_);
}

void TrialJournal::append(const Trial& trial) {
    const std::string row = trialTableRow(trial);
    const std::string number = "trial " + std::to_string(trial.number);
    if (trial.extra.size() != extraColumns_)
        throw std::invalid_argument(number + ": " + std::to_string(trial.extra.size()) +
                                    " extra cells: must be " + std::to_string(extraColumns_));
    const bool isOk = trial.status == TrialStatus::ok;
    if (isOk && trial.number <= lastOk_)
        throw std::invalid_argument(number + ": must be greater than " + std::to_string(lastOk_) +
                                    ", the ok trial before it");
    requireUntouched();
    write(row + "\n");
    if (sync_ == SyncRows::everyRow) sync();
    if (isOk) lastOk_ = trial.number;
}

void TrialJournal::requireUntouched() const {
    if (broken_)
        throw std::runtime_error(file_.string() +
                                 ": takes no more rows after the disk failed; start again");
    struct stat status;
    if (::fstat(descriptor_.get(), &status) != 0)
        throwSystemError(file_, "cannot be written", errno);
    if (!isSameFile(descriptor_.get(), file_))
        throw std::runtime_error(file_.string() +
                                 ": was deleted or replaced while the session runs");
    if (static_cast<std::size_t>(status.st_size) != bytes_)
        throw std::runtime_error(file_.string() + ": has " + std::to_string(status.st_size) +
                                 " bytes: must have " + std::to_string(bytes_) +
                                 ": another program changed it while the session runs");
}

void TrialJournal::write(std::string_view line) {
    if (!writeAll(descriptor_.get(), line)) cutBack(errno);
    bytes_ += line.size();
    synced_ = false;
}

// Part of a row is worse than none: the file goes back to its last complete row.
void TrialJournal::cutBack(int error) {
    broken_ = !cutFile(descriptor_.get(), bytes_);
    throwSystemError(file_, "row cannot be written", error);
}

void TrialJournal::sync() {
    if (synced_) return;
    if (!syncData(descriptor_.get())) {
        // What reached the disk is unknown after a failed sync, and asking again may claim success.
        broken_ = true;
        throwSystemError(file_, "rows cannot be brought to the disk", errno);
    }
    synced_ = true;
}

}  // namespace records
