// SPDX-License-Identifier: MIT
#include "records/trial_journal.h"

#include <gmock/gmock.h>
#include <signal.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/records/random_records.h"
#include "tests/records/scratch_folder.h"

namespace {

int syncCalls = 0;
bool syncFails = false;

}  // namespace

// Stands in for the C library's in this test program: counts, and fails like a dying disk when told
// to.
extern "C" int fdatasync(int descriptor) {
    ++syncCalls;
    if (syncFails) return errno = EIO, -1;
    return static_cast<int>(::syscall(SYS_fdatasync, descriptor));
}

namespace {

using namespace records;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;
using tests::errorOf;
using tests::readBytes;
using tests::ScratchFolder;
using tests::writeBytes;

constexpr char kName[] = "sub-07/beh/sub-07_task-hideartifact_beh.tsv";

std::vector<Trial> someTrials(int count) {
    std::mt19937_64 random(7);
    auto trials = tests::randomTrials(random, count);
    for (Trial& trial : trials) {
        trial.status = TrialStatus::ok;
        if (trial.response) continue;  // an ok trial has one; these are wrong
        const bool artifact = trial.type == TrialType::artifact;
        trial.response = trial.task == Task::twoAfc ? Response::left
                         : artifact                 ? Response::notSeen
                                                    : Response::seen;
    }
    return trials;
}

TEST(TrialJournal, WhatIsAppendedIsReadBack) {
    const ScratchFolder folder;
    const auto file = folder / kName;
    const auto trials = someTrials(20);
    for (std::size_t i = 0; i < trials.size(); ++i) {
        TrialJournal journal(file);
        EXPECT_THAT(journal.existing().trials, SizeIs(i));
        EXPECT_EQ(journal.existing().participant, "07");
        journal.append(trials[i]);
        EXPECT_EQ(readTrialTable(file).trials.back(), trials[i]) << "on disk before it returns";
    }
    EXPECT_EQ(readTrialTable(file).trials, trials);
    EXPECT_EQ(readBytes(file), tests::tableText(trials));
}

TEST(TrialJournal, GoesOnAfterATableWasCutAtAnyByte) {
    const ScratchFolder folder;
    const auto file = folder / "t_beh.tsv";
    const auto trials = someTrials(4);
    const std::string whole = tests::tableText(trials);
    const std::size_t headerBytes = trialTableHeader().size() + 1;
    for (std::size_t cut = 0; cut <= whole.size(); ++cut) {
        writeBytes(file, whole.substr(0, cut));
        std::size_t rows = 0;
        for (std::size_t i = headerBytes; i < cut; ++i) rows += whole[i] == '\n';
        if (cut >= headerBytes) {
            ASSERT_THAT(readTrialTable(file).trials, SizeIs(rows)) << cut;
            ASSERT_EQ(readTrialTable(file).notices.empty(), whole[cut - 1] == '\n') << cut;
        } else {
            ASSERT_THROW(readTrialTable(file), std::runtime_error) << cut;
        }
        TrialJournal journal(file, {}, SyncRows::atClose);
        ASSERT_THAT(journal.existing().trials, SizeIs(rows)) << cut;
        for (std::size_t i = rows; i < trials.size(); ++i) journal.append(trials[i]);
        ASSERT_EQ(readBytes(file), whole) << cut;
    }
}

TEST(TrialJournal, CarriesExtraColumns) {
    const ScratchFolder folder;
    std::mt19937_64 random(3);
    const Trial trial = tests::randomTrial(random, 1, 2);
    const auto file = folder / "t.tsv";
    TrialJournal(file, {"noise", "taps"}).append(trial);
    EXPECT_EQ(TrialJournal(file, {"noise", "taps"}).existing().trials.at(0), trial);
    TrialJournal journal(file, {"noise", "taps"});
    EXPECT_THAT(errorOf<std::invalid_argument>([&] { journal.append(someTrials(3)[2]); }),
                HasSubstr("0 extra cells: must be 2"));
}

TEST(TrialJournal, RefusesASecondWriter) {
    const ScratchFolder folder;
    const auto file = folder / "t.tsv";
    TrialJournal first(file);
    const auto open = [&] { TrialJournal second(file); };
    EXPECT_THAT(errorOf<std::runtime_error>(open), HasSubstr("t.tsv: is open in another program"));
    const pid_t child = ::fork();
    if (child == 0) {
        const bool refused = errorOf<std::runtime_error>(open) != "(no error)";
        ::_exit(refused ? 0 : 1);
    }
    int status = -1;
    ::waitpid(child, &status, 0);
    EXPECT_EQ(status, 0) << "another process got in";
    first.append(someTrials(1)[0]);
}

TEST(TrialJournal, KnowsTheLastNumberOfTheTableItGoesOnWith) {
    const ScratchFolder folder;
    const auto trials = someTrials(2);
    TrialJournal(folder / "t.tsv").append(trials[0]);
    TrialJournal journal(folder / "t.tsv");
    EXPECT_THROW(journal.append(trials[0]), std::invalid_argument);
    journal.append(trials[1]);
}

TEST(TrialJournal, LetsTheNextOneInOnceItIsClosed) {
    const ScratchFolder folder;
    { TrialJournal first(folder / "t.tsv"); }
    EXPECT_NO_THROW(TrialJournal(folder / "t.tsv"));
}

TEST(TrialJournal, LeavesFilesThatAreNoTableOfItsOwnAsTheyAre) {
    const ScratchFolder folder;
    const auto file = folder / "t.tsv";
    std::string reordered = tests::tableText(someTrials(2));
    reordered.replace(0, reordered.find('\n'), [&] {
        std::string header = trialTableHeader();
        return header.substr(header.find('\t') + 1) + "\ttrial";
    }());
    const std::string foreign[] = {"x", "some notes\n", std::string("\0\0", 2), reordered,
                                   tests::tableText(someTrials(2), {"more"})};
    for (const std::string& bytes : foreign) {
        writeBytes(file, bytes);
        EXPECT_THROW(TrialJournal{file}, std::runtime_error) << bytes;
        EXPECT_EQ(readBytes(file), bytes);
    }
    writeBytes(file, trialTableHeader({"more"}) + "\n");
    EXPECT_THAT(errorOf<std::runtime_error>([&] { TrialJournal{file}; }),
                HasSubstr("exactly the columns"));
}

TEST(TrialJournal, RefusesRowsThatWouldNotReadBack) {
    const ScratchFolder folder;
    const auto file = folder / "t.tsv";
    TrialJournal journal(file);
    const auto trials = someTrials(2);
    journal.append(trials[1]);
    EXPECT_THAT(errorOf<std::invalid_argument>([&] { journal.append(trials[1]); }),
                HasSubstr("must be greater than"));
    EXPECT_THROW(journal.append(trials[0]), std::invalid_argument);
    Trial torn = someTrials(4)[3];
    torn.condition = "a\nb";
    EXPECT_THROW(journal.append(torn), std::invalid_argument);
    Trial undone = trials[0];
    undone.status = TrialStatus::undone;
    journal.append(undone);
    EXPECT_EQ(readTrialTable(file).trials, (std::vector<Trial>{trials[1], undone}));
}

TEST(TrialJournal, FullDiskCutsTheTornRowOffAndGoesOnOnceThereIsRoom) {
    const ScratchFolder folder;
    const auto file = folder / "t.tsv";
    const auto trials = someTrials(40);
    const std::size_t room = tests::tableText({trials.begin(), trials.begin() + 17}).size() + 50;
    const int exitCode = tests::runWithFullDisk(room, [&] {
        TrialJournal journal(file);
        std::size_t written = 0;
        std::string error;
        while (error.empty()) try {
                journal.append(trials[written]);
                ++written;
            } catch (const std::runtime_error& full) {
                error = full.what();
            }
        if (written != 17 ||
            error.find("t.tsv: row cannot be written: File too large") == std::string::npos)
            throw std::runtime_error("after " + std::to_string(written) + ": " + error);
        const std::vector<Trial> expected(trials.begin(), trials.begin() + 17);
        if (readTrialTable(file).trials != expected || !readTrialTable(file).notices.empty())
            throw std::runtime_error("the file was not cut back");
        tests::freeTheDisk();
        for (; written < trials.size(); ++written) journal.append(trials[written]);
    });
    EXPECT_EQ(exitCode, 0);
    EXPECT_EQ(readTrialTable(file).trials, trials);
}

TEST(TrialJournal, SyncsEveryRowBeforeItReturns) {
    const ScratchFolder folder;
    TrialJournal journal(folder / "t.tsv");
    for (const Trial& trial : someTrials(5)) {
        syncCalls = 0;
        journal.append(trial);
        EXPECT_EQ(syncCalls, 1);
    }
}

TEST(TrialJournal, SyncsOnceAtTheCloseWhereThatIsAskedFor) {
    const ScratchFolder folder;
    {
        TrialJournal journal(folder / "t.tsv", {}, SyncRows::atClose);
        syncCalls = 0;
        for (const Trial& trial : someTrials(5)) journal.append(trial);
        EXPECT_EQ(syncCalls, 0);
        EXPECT_THAT(readTrialTable(folder / "t.tsv").trials, SizeIs(5)) << "a kill loses nothing";
    }
    EXPECT_EQ(syncCalls, 1);
}

TEST(TrialJournal, TakesNoMoreRowsAfterTheDiskFailedToSync) {
    const ScratchFolder folder;
    const auto trials = someTrials(3);
    TrialJournal journal(folder / "t.tsv");
    journal.append(trials[0]);
    syncFails = true;
    EXPECT_THAT(errorOf<std::runtime_error>([&] { journal.append(trials[1]); }),
                HasSubstr("t.tsv: rows cannot be brought to the disk: Input/output error"));
    syncFails = false;
    EXPECT_THAT(errorOf<std::runtime_error>([&] { journal.append(trials[2]); }),
                HasSubstr("t.tsv: takes no more rows after the disk failed"));
    EXPECT_THAT(readTrialTable(folder / "t.tsv").notices, IsEmpty()) << "complete rows only";
}

TEST(TrialJournal, LeavesNoEmptyTableWhereTheDiskIsFullAtTheStart) {
    const ScratchFolder folder;
    const int exitCode =
        tests::runWithFullDisk(20, [&] { TrialJournal journal(folder / "t.tsv"); });
    EXPECT_EQ(exitCode, 99);
    EXPECT_FALSE(std::filesystem::exists(folder / "t.tsv"));
}

TEST(TrialJournal, NoticesThatTheFileWasTakenAwayOrChanged) {
    const ScratchFolder folder;
    const auto file = folder / "t.tsv";
    const auto trials = someTrials(3);
    TrialJournal journal(file);
    journal.append(trials[0]);
    const auto appendNext = [&] { journal.append(trials[1]); };
    std::filesystem::rename(file, folder / "moved.tsv");
    EXPECT_THAT(errorOf<std::runtime_error>(appendNext), HasSubstr("was deleted or replaced"));
    std::filesystem::rename(folder / "moved.tsv", file);
    const std::string before = readBytes(file);
    writeBytes(file, before + "a remark\n");
    EXPECT_THAT(errorOf<std::runtime_error>(appendNext), HasSubstr("another program changed it"));
    writeBytes(file, before);
    EXPECT_NO_THROW(appendNext());
}

TEST(TrialJournal, NamesTheFileWhereItCannotBeWritten) {
    const ScratchFolder folder;
    writeBytes(folder / "file", "");
    const auto failure = [](const std::filesystem::path& file) {
        return errorOf<std::runtime_error>([&] { TrialJournal journal(file); });
    };
    EXPECT_THAT(failure(folder / "file/t.tsv"), HasSubstr("cannot be created as a folder"));
    EXPECT_THAT(failure(folder.path()), HasSubstr("cannot be written: Is a directory"));
    EXPECT_THAT(failure("/dev/null"), HasSubstr("/dev/null: is no regular file"));
}

// One life of a session: opens the journal, appends what is missing and tells each row's number
// through the pipe once it is acknowledged, until it is killed.
[[noreturn]] void appendUntilKilled(const std::filesystem::path& file,
                                    const std::vector<Trial>& trials, int pipe) {
    TrialJournal journal(file);
    for (std::size_t i = journal.existing().trials.size(); i < trials.size(); ++i) {
        journal.append(trials[i]);
        const int count = static_cast<int>(i) + 1;
        if (::write(pipe, &count, sizeof count) != sizeof count) ::_exit(1);
    }
    ::_exit(0);
}

TEST(TrialJournal, KilledAtAnyMomentLosesNoAcknowledgedRow) {
    const ScratchFolder folder;
    const auto file = folder / "t.tsv";
    const auto trials = someTrials(20000);
    std::mt19937_64 random(11);
    int acknowledged = 0;
    for (int life = 0; life < 100; ++life) {
        int ends[2];
        ASSERT_EQ(::pipe(ends), 0);
        const pid_t child = ::fork();
        if (child == 0) appendUntilKilled(file, trials, ends[1]);
        ::close(ends[1]);
        ::usleep(static_cast<useconds_t>(random() % 15000));
        ::kill(child, SIGKILL);
        ::waitpid(child, nullptr, 0);
        for (int count; ::read(ends[0], &count, sizeof count) == sizeof count;)
            acknowledged = count;
        ::close(ends[0]);
        if (!std::filesystem::exists(file)) continue;  // killed before it was created
        TrialJournal resumed(file);
        const auto& rows = resumed.existing().trials;
        ASSERT_GE(static_cast<int>(rows.size()), acknowledged) << "life " << life;
        ASSERT_TRUE(std::equal(rows.begin(), rows.end(), trials.begin())) << "life " << life;
    }
    EXPECT_GT(acknowledged, 100) << "the kills left no time to write: the test tested nothing";
}

}  // namespace
