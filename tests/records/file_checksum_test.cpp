// SPDX-License-Identifier: MIT
#include "records/file_checksum.h"

#include <gmock/gmock.h>

#include <stdexcept>

#include "tests/records/scratch_folder.h"

namespace {

// The examples of FIPS 180-4 that NIST publishes, and a million times "a".
TEST(Sha256, AgreesWithTheStandardsExamples) {
    EXPECT_EQ(records::sha256("abc"),
              "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    EXPECT_EQ(records::sha256(""),
              "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
    EXPECT_EQ(records::sha256(std::string(1000000, 'a')),
              "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST(ChecksumLines, AreWhatSha256sumChecks) {
    const tests::ScratchFolder folder;
    tests::writeBytes(folder / "a.tsv", "abc");
    tests::writeBytes(folder / "b.tsv", std::string("a\0b", 3));
    const std::filesystem::path files[] = {folder / "a.tsv", folder / "b.tsv"};
    const std::string lines = records::checksumLines(files);
    EXPECT_THAT(lines,
                testing::StartsWith(records::sha256("abc") + "  " + files[0].string() + "\n"));
    EXPECT_THAT(lines, testing::EndsWith("  " + files[1].string() + "\n"));
    EXPECT_EQ(lines.find(records::sha256(std::string("a\0b", 3))), files[0].string().size() + 67);
}

TEST(ChecksumLines, NameTheFileThatCannotBeRead) {
    const std::filesystem::path files[] = {"nowhere.tsv"};
    EXPECT_THROW(
        {
            try {
                records::checksumLines(files);
            } catch (const std::runtime_error& error) {
                EXPECT_THAT(error.what(), testing::HasSubstr("nowhere.tsv"));
                throw;
            }
        },
        std::runtime_error);
}

}  // namespace
