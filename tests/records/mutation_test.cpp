// SPDX-License-Identifier: MIT
// Files that were damaged at random: each gives the content or a located error, never a crash, and
// what a reader accepts can be written and read again. Run under the sanitizers this is a small
// fuzzer with a fixed seed.
#include <gmock/gmock.h>

#include <functional>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "records/session_sidecar.h"
#include "records/slope_file.h"
#include "records/trial_table.h"
#include "tests/records/random_records.h"
#include "tests/records/scratch_folder.h"

namespace {

using namespace records;

std::string damaged(std::mt19937_64& random, std::string bytes) {
    static const std::string kTokens[] = {"\t",
                                          "\n",
                                          "\r\n",
                                          "n/a",
                                          "nan",
                                          "inf",
                                          "-1",
                                          "0",
                                          "1e999",
                                          "1e-999",
                                          "{",
                                          "}",
                                          "[",
                                          "]",
                                          "\"",
                                          ",",
                                          ":",
                                          "null",
                                          "\xff",
                                          "\xef\xbb\xbf",
                                          std::string(1, '\0'),
                                          "9999999999999999999",
                                          "-0",
                                          "0x10",
                                          "+1",
                                          "\\u0000",
                                          "\\ud800",
                                          "ok",
                                          "left",
                                          "line"};
    for (std::uint64_t count = 1 + random() % 3; count > 0; --count) {
        const std::size_t at = bytes.empty() ? 0 : random() % bytes.size();
        const std::size_t length = std::min<std::size_t>(random() % 12, bytes.size() - at);
        const std::string& token = kTokens[random() % std::size(kTokens)];
        switch (random() % 6) {
            case 0:
                bytes.insert(at, token);
                break;
            case 1:
                bytes.replace(at, length, token);
                break;
            case 2:
                bytes.erase(at, length);
                break;
            case 3:
                bytes.insert(at, bytes.substr(at, random() % 300));
                break;
            case 4:
                bytes.resize(at);
                break;
            default:
                if (!bytes.empty()) bytes[at] = static_cast<char>(random());
                break;
        }
    }
    return bytes;
}

// How many of the damaged files were accepted; every other one gave an error that begins with the
// file.
int acceptedOf(int rounds, std::uint64_t seed, const std::vector<std::string>& files,
               const std::function<void(const std::string&)>& read) {
    std::mt19937_64 random(seed);
    int accepted = 0;
    for (int round = 0; round < rounds; ++round) {
        const std::string bytes = damaged(random, files[random() % files.size()]);
        try {
            read(bytes);
            ++accepted;
        } catch (const std::runtime_error& error) {
            EXPECT_THAT(error.what(), testing::StartsWith("file: "));
        }
    }
    return accepted;
}

TEST(DamagedFiles, TablesGiveTrialsOrALocatedError) {
    std::mt19937_64 random(21);
    std::vector<std::string> files;
    for (int i = 0; i < 10; ++i)
        files.push_back(tests::tableText(tests::randomTrials(random, 5, 1), {"extra"}));
    const int accepted = acceptedOf(30000, 22, files, [](const std::string& bytes) {
        const TrialTable table = parseTrialTable(bytes, "file");
        const std::string rewritten = tests::tableText(table.trials, table.extraColumns);
        EXPECT_EQ(parseTrialTable(rewritten, "file").trials, table.trials);
    });
    EXPECT_GT(accepted, 1000) << "too few to say anything about what is accepted";
}

TEST(DamagedFiles, SlopesGiveASlopeOrALocatedError) {
    const tests::ScratchFolder folder;
    std::mt19937_64 random(23);
    std::vector<std::string> files;
    for (int i = 0; i < 10; ++i) {
        writeSlope(folder / "s.json", tests::randomSlope(random));
        files.push_back(tests::readBytes(folder / "s.json"));
    }
    int described = 0;
    const int accepted = acceptedOf(6000, 24, files, [&](const std::string& bytes) {
        described += describe(parseSlope(bytes, "file")).starts_with("c = ");
    });
    EXPECT_GT(accepted, 100);
    EXPECT_EQ(described, accepted);
}

TEST(DamagedFiles, SidecarsGiveASidecarOrALocatedError) {
    const tests::ScratchFolder folder;
    std::mt19937_64 random(25);
    writeSidecar(folder / "s.json", tests::randomSidecar(random));
    const std::vector<std::string> files = {tests::readBytes(folder / "s.json")};
    EXPECT_GT(
        acceptedOf(3000, 26, files, [](const std::string& bytes) { parseSidecar(bytes, "file"); }),
        100);
}

}  // namespace
