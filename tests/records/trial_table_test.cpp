// SPDX-License-Identifier: MIT
#include "records/trial_table.h"

#include <gmock/gmock.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/records/random_records.h"
#include "tests/records/scratch_folder.h"

namespace {

using namespace records;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;
using tests::errorOf;

constexpr char kFile[] = "data/sub-07_ses-b2_task-hideartifact_beh.tsv";

// A table as columns and rows of cells, for tests to spoil.
struct Cells {
    std::vector<std::string> columns;
    std::vector<std::vector<std::string>> rows;

    void set(std::size_t row, const std::string& column, const std::string& cell) {
        rows[row][at(column)] = cell;
    }
    void dropColumn(const std::string& column) {
        const auto i = static_cast<std::ptrdiff_t>(at(column));
        columns.erase(columns.begin() + i);
        for (auto& row : rows) row.erase(row.begin() + i);
    }
    std::size_t at(const std::string& column) const {
        const auto found = std::find(columns.begin(), columns.end(), column);
        return static_cast<std::size_t>(found - columns.begin());
    }
    std::string text(const std::string& lineEnd = "\n") const {
        std::string result = joined(columns) + lineEnd;
        for (const auto& row : rows) result += joined(row) + lineEnd;
        return result;
    }
    static std::string joined(const std::vector<std::string>& cells) {
        std::string line;
        for (std::size_t i = 0; i < cells.size(); ++i) line += (i == 0 ? "" : "\t") + cells[i];
        return line;
    }
};

// Three plain rows with the required columns only: two 2AFC trials and a yes/no catch trial.
Cells plainTable() {
    return {{"trial", "trial_type", "condition", "pattern", "angle_deg", "artifact_px", "lit_level",
             "kernel", "task", "proposed_radius_px", "filter_radius_px", "response", "correct",
             "response_time_s"},
            {{"1", "artifact", "stair-a10", "stair", "45", "10", "1", "disc", "2afc", "34.5", "34",
              "left", "1", "0.8"},
             {"2", "artifact", "step-a10", "step", "0.95", "10", "0.5", "disc", "2afc", "n/a",
              "30.25", "right", "0", "1.25"},
             {"5", "reference", "step-a10", "step", "n/a", "10", "0.5", "disc", "yes_no", "n/a",
              "30.25", "not_seen", "1", "n/a"}}};
}

TrialTable parsed(const Cells& cells) {
    return parseTrialTable(cells.text(), kFile);
}
std::string parseError(const std::string& text) {
    return errorOf<std::runtime_error>([&] { parseTrialTable(text, kFile); });
}

TEST(TrialTable, EveryTableThatCanBeWrittenReadsBackExactly) {
    std::mt19937_64 random(1);
    const std::vector<std::string> extras[] = {{}, {"mood"}, {"größe", "x y"}};
    for (int round = 0; round < 300; ++round) {
        const auto& extraColumns = extras[round % 3];
        const auto trials = tests::randomTrials(random, round % 20, extraColumns.size());
        const TrialTable table = parseTrialTable(tests::tableText(trials, extraColumns), kFile);
        ASSERT_EQ(table.trials, trials);
        ASSERT_EQ(table.extraColumns, extraColumns);
        ASSERT_THAT(table.notices, IsEmpty());
    }
}

TEST(TrialTable, ReadsWhatEachCellSays) {
    const TrialTable table = parsed(plainTable());
    EXPECT_EQ(table.participant, "07");
    EXPECT_EQ(table.session, "b2");
    ASSERT_EQ(table.trials.size(), 3u);
    const Trial& second = table.trials[1];
    EXPECT_EQ(second.number, 2);
    EXPECT_EQ(second.type, TrialType::artifact);
    EXPECT_EQ(second.condition, "step-a10");
    EXPECT_EQ(second.pattern, Pattern::step);
    EXPECT_EQ(second.angleDeg, 0.95);
    EXPECT_EQ(second.artifactPx, 10);
    EXPECT_EQ(second.litLevel, 0.5);
    EXPECT_EQ(second.kernel, "disc");
    EXPECT_EQ(second.task, Task::twoAfc);
    EXPECT_EQ(second.proposedRadiusPx, std::nullopt);
    EXPECT_EQ(second.filterRadiusPx, 30.25);
    EXPECT_EQ(second.response, Response::right);
    EXPECT_FALSE(second.correct);
    EXPECT_EQ(second.responseTimeS, 1.25);
    EXPECT_EQ(second.status, TrialStatus::ok);
}

TEST(TrialTable, TakesTheColumnsInAnyOrder) {
    Cells cells = plainTable();
    const TrialTable expected = parsed(cells);
    std::reverse(cells.columns.begin(), cells.columns.end());
    for (auto& row : cells.rows) std::reverse(row.begin(), row.end());
    EXPECT_EQ(parsed(cells).trials, expected.trials);
}

TEST(TrialTable, KeepsExtraColumnsAsText) {
    Cells cells = plainTable();
    cells.columns.insert(cells.columns.begin(), "mood");
    for (auto& row : cells.rows) row.insert(row.begin(), "20");
    cells.columns.push_back("remark");
    for (auto& row : cells.rows) row.push_back("");
    const TrialTable table = parsed(cells);
    EXPECT_THAT(table.extraColumns, ElementsAre("mood", "remark"));
    EXPECT_THAT(table.trials[2].extra, ElementsAre("20", ""));
}

TEST(TrialTable, TakesWindowsLineEndsAndAByteOrderMark) {
    const Cells cells = plainTable();
    EXPECT_EQ(parseTrialTable("\xef\xbb\xbf" + cells.text("\r\n"), kFile).trials,
              parsed(cells).trials);
}

TEST(TrialTable, HeaderWithoutRowsIsATableWithoutTrials) {
    Cells cells = plainTable();
    cells.rows.clear();
    EXPECT_THAT(parsed(cells).trials, IsEmpty());
}

TEST(TrialTable, TornLastLineIsDroppedWithANotice) {
    const std::string text = plainTable().text();
    const TrialTable table = parseTrialTable(text + "6\tartifact\tst", kFile);
    EXPECT_EQ(table.trials, parsed(plainTable()).trials);
    ASSERT_EQ(table.notices.size(), 1u);
    EXPECT_THAT(table.notices[0], StartsWith(std::string(kFile) + ": line 5: torn line dropped"));
    EXPECT_THAT(table.notices[0], HasSubstr("artifact"));
    // A whole row without its line end cannot be told from a torn one ("34" may have been "34.5").
    EXPECT_EQ(parseTrialTable(text.substr(0, text.size() - 1), kFile).trials.size(), 2u);
}

TEST(TrialTable, TakesTheParticipantFromTheFileName) {
    const std::string text = plainTable().text();
    const auto participantOf = [&](const char* file) {
        return parseTrialTable(text, file).participant;
    };
    EXPECT_EQ(participantOf("x/sub-01_task-hideartifact_beh.tsv"), "01");
    EXPECT_EQ(participantOf("sub-Zoë_beh.tsv"), "Zoë");
    EXPECT_EQ(participantOf("my observer.tsv"), "my observer");
    EXPECT_EQ(participantOf("sub-_beh.tsv"), "sub-_beh");
    EXPECT_EQ(parseTrialTable(text, "sub-01_beh.tsv").session, std::nullopt);
}

struct BadCell {
    std::string column, cell, rule;
};

// Every rule of a cell, with the sentence that it gives: file, line, column, value and rule.
TEST(TrialTable, NamesFileLineColumnValueAndRuleOfEveryBadCell) {
    const std::string finite = "must be a number greater than 0";
    const BadCell kBad[] = {
        {"trial", "0", "must be a whole number from 1 to 2147483647"},
        {"trial", "1.5", "must be a whole number"},
        {"trial", "99999999999", "must be a whole number"},
        {"trial", "", "must be a whole number"},
        {"trial", "1", "must be greater than 1, the ok trial before it (line 2)"},
        {"trial_type", "catch", "must be one of artifact, reference"},
        {"condition", "", "must be a text that is not empty"},
        {"condition", "n/a", "must be a text that is not empty"},
        {"condition", "a\x01", "must be UTF-8 text without control characters"},
        {"condition", "\xff", "must be UTF-8 text"},
        {"pattern", "Stair", "must be one of stair, step, line, frame"},
        {"pattern", "line", "must be a number for the pattern line"},
        {"angle_deg", "400", "must be a number from -360 to 360, or n/a"},
        {"artifact_px", "0", finite},
        {"artifact_px", "-3", finite},
        {"artifact_px", "nan", finite},
        {"artifact_px", "inf", finite},
        {"artifact_px", "1e999", finite},
        {"artifact_px", "n/a", finite},
        {"artifact_px", "ten", finite},
        {"artifact_px", "10px", finite},
        {"artifact_px", "1,5", finite},
        {"artifact_px", " 10", finite},
        {"lit_level", "1.01", "must be a number from 0 to 1"},
        {"lit_level", "-0.1", "must be a number from 0 to 1"},
        {"kernel", "", "must be a text"},
        {"task", "3afc", "must be one of 2afc, yes_no"},
        {"proposed_radius_px", "0", finite + ", or n/a"},
        {"proposed_radius_px", "", finite + ", or n/a"},
        {"filter_radius_px", "0", finite},
        {"filter_radius_px", "-4", finite + " on an artifact trial"},
        {"filter_radius_px", "NaN", "must be a finite number"},
        {"filter_radius_px", "n/a", "must be a finite number"},
        {"response", "up", "must be one of left, right, seen, not_seen"},
        {"response", "seen", "must be left or right in the task 2afc"},
        {"task", "yes_no", "must be seen or not_seen in the task yes_no"},
        {"correct", "2", "must be 0 or 1"},
        {"correct", "true", "must be 0 or 1"},
        {"correct", "n/a", "must be 0 or 1"},
        {"response_time_s", "-0.1", "must be a number of at least 0, or n/a"},
        {"status", "good", "must be one of ok, undone, repeated, too_fast"},
        {"encoding", "rgb", "must be one of srgb, code, or n/a"},
        {"side", "up", "must be one of left, right, or n/a"},
        {"side", "right", "must be 1 where response is the side of the artifact"},
        {"orientation_quarter", "4", "must be a whole number from 0 to 3, or n/a"},
        {"mirror", "-1", "must be 0 or 1, or n/a"},
        {"shift_px", "0.5", "must be a whole number"},
        {"threshold_sd", "-1", "must be a number of at least 0, or n/a"},
        {"response", "n/a", "must be an answer where the status is ok"},
        {"noise_levels", "loud", "must be a number of at least 0, or n/a"},
        {"image_seed", "2147483648", "must be a whole number from 0 to 2147483647, or n/a"},
        {"dither", "2", "must be 0 or 1, or n/a"},
        {"click_x_px", "-1", "must be a number of at least 0, or n/a"},
        {"staircase", "", "must be a text that is not empty, or n/a"},
    };
    for (const BadCell& bad : kBad) {
        Cells cells = plainTable();
        if (cells.at(bad.column) == cells.columns.size()) {
            cells.columns.push_back(bad.column);
            for (auto& row : cells.rows) row.push_back(bad.column == "status" ? "ok" : "n/a");
        }
        cells.set(1, "response", "left");
        cells.set(1, "correct", "1");
        cells.set(1, "angle_deg", bad.cell == "line" ? "n/a" : "1");
        cells.set(1, bad.column, bad.cell);
        const std::string error = parseError(cells.text());
        EXPECT_THAT(error, StartsWith(std::string(kFile) + ": line 3: column ")) << bad.column;
        EXPECT_THAT(error, HasSubstr(bad.rule)) << bad.column << " " << bad.cell;
    }
}

TEST(TrialTable, YesNoCorrectFollowsFromTheAnswer) {
    Cells cells = plainTable();
    cells.set(2, "correct", "0");
    EXPECT_THAT(parseError(cells.text()),
                HasSubstr("line 4: column correct: \"0\": must be 1 for seen on artifact or "
                          "not_seen on reference"));
}

TEST(TrialTable, NamesEveryMissingRequiredColumn) {
    for (const std::string& column : plainTable().columns) {
        Cells cells = plainTable();
        cells.dropColumn(column);
        EXPECT_EQ(parseError(cells.text()),
                  std::string(kFile) + ": line 1: column " + column + ": is missing");
    }
}

TEST(TrialTable, RefusesAMalformedHeader) {
    const std::string rows = "\n1\t2\n";
    EXPECT_THAT(parseError(""), HasSubstr("is empty"));
    EXPECT_THAT(parseError("\xef\xbb\xbf"), HasSubstr("is empty"));
    EXPECT_THAT(parseError("trial\ttrial_type"), HasSubstr("line 1"));
    EXPECT_THAT(parseError("trial\ttrial" + rows), HasSubstr("column trial: stands twice"));
    EXPECT_THAT(parseError("x\tx" + rows), HasSubstr("column x: stands twice"));
    EXPECT_THAT(parseError("trial\t" + rows), HasSubstr("column name \"\": must be a text"));
    EXPECT_THAT(parseError("\n"), HasSubstr("line 1: column name \"\""));
    EXPECT_THAT(parseError(std::string("\x7f"
                                       "ELF\0\x01\n",
                                       7)),
                HasSubstr("\\x7fELF\\x00\\x01"));
}

TEST(TrialTable, RefusesRowsWithTooFewOrTooManyCells) {
    const std::string text = plainTable().text();
    EXPECT_THAT(parseError(text + "6\tartifact\n"),
                HasSubstr("line 5: \"6\\x09artifact\": has 2 cells: must have 14"));
    EXPECT_THAT(parseError(text + "\n"), HasSubstr("line 5: \"\": has 1 cells"));
    Cells cells = plainTable();
    cells.rows[0].push_back("more");
    EXPECT_THAT(parseError(cells.text()), HasSubstr("line 2"));
    EXPECT_THAT(parseError(cells.text()), HasSubstr("has 15 cells: must have 14"));
}

TEST(TrialTable, OnlyOkRowsNeedRisingNumbers) {
    Cells cells = plainTable();
    cells.columns.push_back("status");
    for (auto& row : cells.rows) row.push_back("ok");
    cells.rows.insert(cells.rows.begin() + 1, cells.rows[0]);
    cells.set(1, "status", "undone");
    EXPECT_EQ(parsed(cells).trials.size(), 4u);
    cells.set(1, "status", "ok");
    EXPECT_THAT(parseError(cells.text()),
                HasSubstr("line 3: column trial: \"1\": must be greater"));
}

TEST(TrialTable, ReferenceTrialsMayHaveAnyFiniteRadiusWithANotice) {
    Cells cells = plainTable();
    cells.set(2, "filter_radius_px", "-1.46361");
    const TrialTable table = parsed(cells);
    EXPECT_EQ(table.trials[2].filterRadiusPx, -1.46361);
    ASSERT_EQ(table.notices.size(), 1u);
    EXPECT_THAT(table.notices[0],
                HasSubstr("line 4: column filter_radius_px: not greater than 0 on 1 reference"));
    cells.set(2, "filter_radius_px", "nan");
    EXPECT_THAT(parseError(cells.text()), HasSubstr("line 4: column filter_radius_px: \"nan\""));
}

TEST(TrialTable, WritersRefuseWhatAReaderWouldNotGiveBack) {
    const Trial good = parsed(plainTable()).trials[0];
    const auto refusal = [&](const std::function<void(Trial&)>& spoil) {
        Trial trial = good;
        spoil(trial);
        return errorOf<std::invalid_argument>([&] { trialTableRow(trial); });
    };
    EXPECT_EQ(refusal([](Trial&) {}), "(no error)");
    EXPECT_THAT(refusal([](Trial& t) { t.condition = "a\tb"; }),
                HasSubstr("trial 1: column condition: \"a\\x09b\": must be UTF-8 text"));
    EXPECT_THAT(refusal([](Trial& t) { t.kernel = "a\nb"; }), HasSubstr("column kernel"));
    EXPECT_THAT(refusal([](Trial& t) { t.staircase = "a\rb"; }), HasSubstr("column staircase"));
    EXPECT_THAT(refusal([](Trial& t) { t.staircase = "n/a"; }), HasSubstr("n/a"));
    EXPECT_THAT(refusal([](Trial& t) { t.extra = {"ok", "a\tb"}; }), HasSubstr("extra"));
    EXPECT_THAT(refusal([](Trial& t) { t.filterRadiusPx = std::nan(""); }),
                HasSubstr("trial 1: column filter_radius_px: \"nan\": must be a finite number"));
    EXPECT_THAT(refusal([](Trial& t) { t.onsetS = HUGE_VAL; }), HasSubstr("column onset_s"));
    EXPECT_THAT(refusal([](Trial& t) { t.side = "top"; }), HasSubstr("column side"));
    EXPECT_THAT(refusal([](Trial& t) { t.response = Response::seen; }), HasSubstr("response"));
    EXPECT_THAT(refusal([](Trial& t) { t.number = 0; }), HasSubstr("column trial"));
    EXPECT_THAT(errorOf<std::invalid_argument>([] { trialTableHeader({"a\tb"}); }),
                HasSubstr("column name"));
}

TEST(TrialTable, FindsTablesInABidsTreeAndAFlatFolder) {
    const tests::ScratchFolder folder;
    std::filesystem::create_directories(folder / "sub-b/beh");
    std::filesystem::create_directories(folder / ".git");
    std::filesystem::create_directories(folder / "sub-x_task-hideartifact_beh.tsv.d");
    const auto inTree = folder / "sub-b/beh/sub-b_ses-1_task-hideartifact_beh.tsv";
    const auto flat = folder / "sub-a_task-hideartifact_beh.tsv";
    for (const auto& file :
         {inTree, flat, folder / "participants.tsv", folder / "sub-a_task-rest_beh.tsv",
          folder / ".sub-a_task-hideartifact_beh.tsv", folder / "sub-a_task-hideartifact_beh.json",
          folder / ".git/sub-c_task-hideartifact_beh.tsv"})
        tests::writeBytes(file, "x");
    EXPECT_THAT(findTrialTables(folder.path()), ElementsAre(flat, inTree));
    EXPECT_THAT(findTrialTables(folder / "participants.tsv"),
                ElementsAre(folder / "participants.tsv"));
}

TEST(TrialTable, MissingOrEmptyFoldersAreErrors) {
    const tests::ScratchFolder folder;
    EXPECT_THAT(errorOf<std::runtime_error>([&] { findTrialTables(folder / "none"); }),
                HasSubstr("none: cannot be read: "));
    EXPECT_THAT(errorOf<std::runtime_error>([&] { findTrialTables(folder.path()); }),
                HasSubstr("holds no trial table"));
    EXPECT_THAT(errorOf<std::runtime_error>([&] { readTrialTable(folder.path()); }),
                HasSubstr("cannot be read: Is a directory"));
    EXPECT_THAT(errorOf<std::runtime_error>([&] { readTrialTable(folder / "none.tsv"); }),
                HasSubstr("none.tsv: cannot be read: No such file"));
}

TEST(TrialTable, PathsFollowBidsAndRefuseOtherIds) {
    EXPECT_EQ(trialTablePath("d", "07", std::nullopt),
              "d/sub-07/beh/sub-07_task-hideartifact_beh.tsv");
    EXPECT_EQ(trialTablePath("d", "07", "b"),
              "d/sub-07/beh/sub-07_ses-b_task-hideartifact_beh.tsv");
    for (const char* id : {"", "a b", "a/b", "..", "a_b", "a-b", "é", "a\n"}) {
        EXPECT_THROW(trialTablePath("d", id, std::nullopt), std::invalid_argument) << id;
        EXPECT_THROW(trialTablePath("d", "a", id), std::invalid_argument) << id;
    }
}

template <typename Words, typename FromText>
void expectWordsRoundTrip(const Words& words, FromText fromText) {
    for (const auto& [word, value] : words) {
        EXPECT_EQ(toText(value), word);
        EXPECT_EQ(fromText(word), value);
    }
    EXPECT_EQ(fromText("n/a"), std::nullopt);
    EXPECT_EQ(fromText(""), std::nullopt);
}

TEST(TrialTable, EveryWordMeansOneValue) {
    expectWordsRoundTrip(kTrialTypeWords, trialTypeFromText);
    expectWordsRoundTrip(kPatternWords, patternFromText);
    expectWordsRoundTrip(kTaskWords, taskFromText);
    expectWordsRoundTrip(kResponseWords, responseFromText);
    expectWordsRoundTrip(kTrialStatusWords, trialStatusFromText);
    expectWordsRoundTrip(kEncodingWords, encodingFromText);
}

TEST(TrialTable, ReadsTheHumanTablesAsTheyAre) {
    const char* folder = std::getenv("STAIRWELL_HUMAN_DATA");
    // Human data may not lie in the project; CI names the folder, so there nothing is skipped.
    if (folder == nullptr) GTEST_SKIP() << "STAIRWELL_HUMAN_DATA names no folder of human tables";
    const auto files = findTrialTables(folder);
    EXPECT_EQ(files.size(), 12u);
    for (const auto& file : files) {
        const TrialTable table = readTrialTable(file);
        EXPECT_LE(table.notices.size(), 1u);
        for (const auto& notice : table.notices) EXPECT_THAT(notice, HasSubstr("filter_radius_px"));
        EXPECT_THAT(table.extraColumns, IsEmpty());
        const auto lines = tests::readBytes(file);
        EXPECT_EQ(static_cast<std::ptrdiff_t>(table.trials.size()) + 1,
                  std::count(lines.begin(), lines.end(), '\n'));
        for (const Trial& trial : table.trials) {
            EXPECT_EQ(trial.task, Task::yesNo);
            EXPECT_EQ(trial.proposedRadiusPx, std::nullopt);
            EXPECT_TRUE(trial.noiseLevels.has_value());
        }
    }
}

}  // namespace
