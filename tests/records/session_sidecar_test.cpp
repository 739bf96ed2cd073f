// SPDX-License-Identifier: MIT
#include "records/session_sidecar.h"

#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <random>
#include <sstream>
#include <stdexcept>

#include "tests/records/random_records.h"
#include "tests/records/scratch_folder.h"

namespace {

using namespace records;
using nlohmann::json;
using testing::HasSubstr;
using testing::UnorderedElementsAreArray;
using tests::errorOf;
using tests::readBytes;
using tests::ScratchFolder;
using tests::writeBytes;

TEST(Sidecar, EverySidecarThatCanBeWrittenReadsBackExactly) {
    const ScratchFolder folder;
    std::mt19937_64 random(3);
    for (int round = 0; round < 50; ++round) {
        const SessionSidecar sidecar = tests::randomSidecar(random);
        writeSidecar(folder / "a.json", sidecar);
        ASSERT_EQ(readSidecar(folder / "a.json"), sidecar);
    }
}

TEST(Sidecar, HoldsReadingsOfAPhotometerThatRiseFromBlackToWhite) {
    const ScratchFolder folder;
    std::mt19937_64 random(3);
    SessionSidecar sidecar = tests::randomSidecar(random);
    sidecar.luminance = {.black = 0, .grey = 21.5, .white = 98};
    writeSidecar(folder / "a.json", sidecar);
    EXPECT_EQ(readSidecar(folder / "a.json").luminance, sidecar.luminance);
    sidecar.luminance.grey = 98;
    EXPECT_THAT(errorOf<std::invalid_argument>([&] { writeSidecar(folder / "b.json", sidecar); }),
                HasSubstr("b.json: field stairwell.luminance_cd_m2: 98.0: must be greater than "
                          "luminance_grey_cd_m2, 98"));
    // Before there were three, white stood alone.
    json old = json::parse(readBytes(folder / "a.json"));
    for (const char* field : {"luminance_black_cd_m2", "luminance_grey_cd_m2"})
        old["stairwell"].erase(field);
    EXPECT_EQ(parseSidecar(old.dump(), "old.json").luminance, (ScreenLuminance{.white = 98}));
}

TEST(Sidecar, DescribesEveryColumnOfTheTable) {
    const ScratchFolder folder;
    std::mt19937_64 random(3);
    writeSidecar(folder / "a.json", tests::randomSidecar(random));
    const json file = json::parse(readBytes(folder / "a.json"));
    std::istringstream header(trialTableHeader());
    for (std::string column; std::getline(header, column, '\t');)
        EXPECT_FALSE(file.at(column).at("Description").get<std::string>().empty()) << column;
    EXPECT_EQ(file["filter_radius_px"]["Units"], "px");
    EXPECT_TRUE(file["task"]["Levels"].contains("2afc"));
    // The levels are the words of the format, no more and no less.
    std::vector<std::string> statuses;
    for (const auto& [word, value] : kTrialStatusWords) statuses.emplace_back(word);
    std::vector<std::string> levels;
    for (const auto& [word, meaning] : file["status"]["Levels"].items()) levels.push_back(word);
    EXPECT_THAT(levels, UnorderedElementsAreArray(statuses));
}

TEST(Sidecar, LiesBesideItsTable) {
    EXPECT_EQ(sidecarPath("d/sub-1_task-hideartifact_beh.tsv"),
              "d/sub-1_task-hideartifact_beh.json");
}

TEST(Sidecar, NamesFileFieldValueAndRule) {
    const ScratchFolder folder;
    std::mt19937_64 random(4);
    const SessionSidecar sidecar = tests::randomSidecar(random);
    writeSidecar(folder / "a.json", sidecar);
    const json good = json::parse(readBytes(folder / "a.json"));
    const auto failure = [&](const char* pointer, const json& value) {
        json bad = good;
        bad[json::json_pointer(pointer)] = value;
        return errorOf<std::runtime_error>([&] { parseSidecar(bad.dump(), "s.json"); });
    };
    EXPECT_EQ(failure("/stairwell/criterion", -1),
              "s.json: field stairwell.criterion: -1: must be a number greater than 0 and less "
              "than 1");
    EXPECT_THAT(failure("/stairwell/design", 3),
                HasSubstr("stairwell.design: 3: must be an object"));
    EXPECT_THAT(failure("/stairwell/schema/major", 9), HasSubstr("stairwell.schema.major: 9"));
    EXPECT_THAT(failure("/stairwell/context/date", 9), HasSubstr("stairwell.context.date: 9"));
    EXPECT_THAT(failure("/stairwell/display_width_px", 0), HasSubstr("display_width_px: 0"));
    EXPECT_THAT(failure("/stairwell", nullptr), HasSubstr("field stairwell: null"));
    EXPECT_THAT(failure("/stairwell/luminance_cd_m2", 0),
                HasSubstr("luminance_cd_m2: 0: must be a number greater than 0"));
    EXPECT_THAT(failure("/stairwell/luminance_black_cd_m2", -0.1),
                HasSubstr("luminance_black_cd_m2: -0.1: must be"));
    SessionSidecar bad = sidecar;
    bad.beta = std::nan("");
    EXPECT_THAT(errorOf<std::invalid_argument>([&] { writeSidecar(folder / "b.json", bad); }),
                HasSubstr("b.json: field stairwell.psychometric_slope"));
}

TEST(Participants, AreAddedOnceAndNeverChanged) {
    const ScratchFolder folder;
    const auto data = folder / "new/data";
    registerParticipant(data, "07");
    registerParticipant(data, "08");
    registerParticipant(data, "07");
    EXPECT_EQ(readBytes(data / "participants.tsv"), "participant_id\nsub-07\nsub-08\n");
    const json description = json::parse(readBytes(data / "dataset_description.json"));
    EXPECT_TRUE(description.contains("Name"));
    EXPECT_TRUE(description.contains("BIDSVersion"));
}

TEST(Participants, KeepTheColumnsAndRowsThatAreThere) {
    const ScratchFolder folder;
    const auto file = folder / "participants.tsv";
    const std::string mine = "participant_id\tage\tsex\r\nsub-1\t33\tf\r\nsub-12\t20\tm";
    writeBytes(file, mine);
    writeBytes(folder / "dataset_description.json", "{\"Name\": \"mine\"}");
    registerParticipant(folder.path(), "1");
    EXPECT_EQ(readBytes(file), mine);
    registerParticipant(folder.path(), "2");
    EXPECT_EQ(readBytes(file), mine + "\nsub-2\tn/a\tn/a\n");
    EXPECT_EQ(readBytes(folder / "dataset_description.json"), "{\"Name\": \"mine\"}");
}

TEST(Participants, MayBeRegisteredByManyProgramsAtOnce) {
    const ScratchFolder folder;
    constexpr int kPrograms = 12;
    for (int i = 0; i < kPrograms; ++i)
        if (::fork() == 0) {
            registerParticipant(folder / "data", std::to_string(i));
            registerParticipant(folder / "data", "all");
            ::_exit(0);
        }
    for (int i = 0, status; i < kPrograms; ++i) {
        ::wait(&status);
        EXPECT_EQ(status, 0);
    }
    const std::string text = readBytes(folder / "data/participants.tsv");
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1 + kPrograms + 1);
    for (const auto& entry : std::filesystem::directory_iterator(folder / "data"))
        EXPECT_NE(entry.path().extension(), ".tmp");
}

TEST(Participants, RefuseAForeignTableAndBadIds) {
    const ScratchFolder folder;
    writeBytes(folder / "participants.tsv", "name\nsub-1\n");
    EXPECT_THAT(errorOf<std::runtime_error>([&] { registerParticipant(folder.path(), "1"); }),
                HasSubstr("participants.tsv: line 1: column 1: \"name\": must be participant_id"));
    EXPECT_THROW(registerParticipant(folder.path(), "a\tb"), std::invalid_argument);
    EXPECT_THROW(registerParticipant(folder.path(), ""), std::invalid_argument);
}

TEST(Participants, AFullDiskLeavesTheTableAsItWas) {
    const ScratchFolder folder;
    registerParticipant(folder.path(), "1");
    const std::string before = readBytes(folder / "participants.tsv");
    const int exitCode =
        tests::runWithFullDisk(before.size() + 3, [&] { registerParticipant(folder.path(), "2"); });
    EXPECT_EQ(exitCode, 99);
    EXPECT_EQ(readBytes(folder / "participants.tsv"), before);
}

}  // namespace
