// SPDX-License-Identifier: MIT
#include "records/whole_file.h"

#include <gmock/gmock.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <random>
#include <stdexcept>
#include <string>

#include "records/quoted_text.h"
#include "tests/records/scratch_folder.h"

namespace {

using namespace records;
using testing::HasSubstr;
using tests::errorOf;
using tests::readBytes;
using tests::ScratchFolder;
using tests::writeBytes;

std::ptrdiff_t filesIn(const std::filesystem::path& folder) {
    return std::distance(std::filesystem::directory_iterator(folder),
                         std::filesystem::directory_iterator());
}

TEST(WholeFile, ReadsBackWhatWasWritten) {
    const ScratchFolder folder;
    const std::string bytes[] = {"", "a", std::string("\0\r\n\xff", 4), std::string(200000, 'x')};
    for (const std::string& content : bytes) {
        writeWholeFile(folder / "new/deep/file", content);
        EXPECT_EQ(readWholeFile(folder / "new/deep/file"), content);
    }
    EXPECT_EQ(filesIn(folder / "new/deep"), 1);
}

TEST(WholeFile, AFullDiskLeavesTheOldContentAndNoTemporaryFile) {
    const ScratchFolder folder;
    writeBytes(folder / "file", "old");
    EXPECT_EQ(tests::runWithFullDisk(
                  100, [&] { writeWholeFile(folder / "file", std::string(5000, 'n')); }),
              99);
    EXPECT_EQ(readBytes(folder / "file"), "old");
    EXPECT_EQ(filesIn(folder.path()), 1);
}

// A reader at any moment, and a kill at any moment, find one of the two contents.
TEST(WholeFile, IsNeverSeenInPart) {
    const ScratchFolder folder;
    const auto file = folder / "file";
    const std::string a(100000, 'a'), b(30000, 'b');
    writeWholeFile(file, a);
    std::mt19937_64 random(5);
    for (int life = 0; life < 20; ++life) {
        const pid_t child = ::fork();
        if (child == 0)
            for (;;) writeWholeFile(file, b), writeWholeFile(file, a);
        for (int i = 0; i < 20; ++i) {
            const std::string seen = readWholeFile(file);
            ASSERT_TRUE(seen == a || seen == b);
        }
        ::usleep(static_cast<useconds_t>(random() % 3000));
        ::kill(child, SIGKILL);
        ::waitpid(child, nullptr, 0);
        const std::string left = readWholeFile(file);
        ASSERT_TRUE(left == a || left == b);
    }
}

TEST(WholeFile, NamesTheFileAndTheReason) {
    const ScratchFolder folder;
    writeBytes(folder / "file", "");
    const auto writing = [](const std::filesystem::path& file) {
        return errorOf<std::runtime_error>([&] { writeWholeFile(file, "x"); });
    };
    EXPECT_THAT(writing(folder.path()), HasSubstr("cannot be written: Is a directory"));
    EXPECT_THAT(writing(folder / "file/x"), HasSubstr("file: cannot be created as a folder"));
    EXPECT_THAT(writing("/dev/full"), HasSubstr("/dev/full: cannot be written: No space left"));
    EXPECT_THAT(writing("/proc/none/x"), HasSubstr("/proc/none"));
    EXPECT_THAT(errorOf<std::runtime_error>([&] { readWholeFile(folder / "none"); }),
                HasSubstr("none: cannot be read: No such file or directory"));
    EXPECT_NO_THROW(writeWholeFile("/dev/null", "x"));
}

TEST(WholeFile, IfMissingLetsOneOfManyWrite) {
    const ScratchFolder folder;
    for (int i = 0; i < 8; ++i)
        if (::fork() == 0)
            ::_exit(writeWholeFileIfMissing(folder / "file", std::to_string(i)) ? 1 : 0);
    int wrote = 0;
    for (int i = 0, status; i < 8; ++i) ::wait(&status), wrote += WEXITSTATUS(status);
    EXPECT_EQ(wrote, 1);
    EXPECT_EQ(filesIn(folder.path()), 1);
    const std::string content = readBytes(folder / "file");
    EXPECT_FALSE(writeWholeFileIfMissing(folder / "file", "late"));
    EXPECT_EQ(readBytes(folder / "file"), content);
}

TEST(QuotedText, ShowsAnyBytesOnOneLine) {
    EXPECT_EQ(quotedText("é 1"), "\"é 1\"");
    EXPECT_EQ(quotedText("a\tb\n\x1b[31m"), "\"a\\x09b\\x0a\\x1b[31m\"");
    EXPECT_EQ(quotedText("\xff\xc3"), "\"\\xff\\xc3\"");
    EXPECT_LT(quotedText(std::string(1000, 'x')).size(), 80u);
    EXPECT_TRUE(isPlainText("日本🙂é"));
    EXPECT_FALSE(isPlainText("\xed\xa0\x80")) << "a surrogate";
    EXPECT_FALSE(isPlainText("\xc0\xaf")) << "overlong";
    EXPECT_FALSE(isPlainText("\xf4\x90\x80\x80")) << "beyond Unicode";
    EXPECT_FALSE(isPlainText("a\x7f"));
}

}  // namespace
