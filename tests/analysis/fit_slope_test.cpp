// SPDX-License-Identifier: MIT
// The program as its user meets it.
#include <gmock/gmock.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "records/html_page.h"
#include "records/slope_file.h"
#include "records/whole_file.h"
#include "tests/analysis/simulated_study.h"
#include "tests/records/scratch_folder.h"
#include "tests/run_command.h"

namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using tests::CommandResult;
using tests::runProgram;

// A small study on disk.
void writeStudy(const fs::path& folder) {
    tests::StudyPlan plan{.observers = 5,
                          .groups = tests::fourGroups(0.4, 0.38, 0.54, 0.5),
                          .sizes = {10, 20},
                          .trials = 20};
    std::mt19937_64 rng(95);
    tests::writeTables(tests::simulateTables(plan, rng), folder);
}

std::string withoutContext(const fs::path& file) {
    std::string text = records::readWholeFile(file);
    const std::size_t start = text.find("\"context\""), end = text.find("\"c\"");
    return text.erase(start, end - start);
}

TEST(FitSlope, WritesSlopeReportFiguresAndTables) {
    const tests::ScratchFolder folder;
    writeStudy(folder / "data");
    const CommandResult run =
        runProgram("fit_slope", {(folder / "data").string(), "--out", (folder / "out").string()});
    ASSERT_EQ(run.exitCode, 0) << run.err;
    const records::Slope slope = records::readSlope(folder / "out" / "slope.json");
    EXPECT_THAT(run.out, testing::StartsWith(records::describe(slope)));
    EXPECT_EQ(slope.groups.size(), 4u);
    EXPECT_EQ(slope.trials, 5 * 8 * 20);
    EXPECT_TRUE(slope.c.ci95 && slope.cOverall.ci95 && slope.c90.ci95 && slope.kappaPValue);
    EXPECT_LT(slope.c.ci95->low, slope.c.estimate);
    EXPECT_GT(slope.c90.estimate, slope.c.estimate);
    for (const char* name :
         {"groups.tsv", "conditions.tsv", "thresholds.tsv", "estimators.tsv", "screening.tsv"}) {
        EXPECT_TRUE(fs::exists(folder / "out" / name)) << name;
    }
    const std::string page = records::readWholeFile(folder / "out" / "report.html");
    EXPECT_THAT(page, HasSubstr(records::htmlEscaped(records::describeTerms(slope))));
    EXPECT_THAT(page, HasSubstr("<svg"));
}

TEST(FitSlope, GivesTheSameFilesEveryTime) {
    const tests::ScratchFolder folder;
    writeStudy(folder / "data");
    for (const char* out : {"a", "b"}) {
        ASSERT_EQ(
            runProgram("fit_slope", {(folder / "data").string(), "--out", (folder / out).string()})
                .exitCode,
            0);
    }
    for (const auto& entry : fs::recursive_directory_iterator(folder / "a")) {
        if (entry.is_directory()) continue;
        const fs::path name = fs::relative(entry.path(), folder / "a");
        if (name == "slope.json" || name == "report.html") continue;  // they hold date and command
        EXPECT_EQ(records::readWholeFile(entry.path()), records::readWholeFile(folder / "b" / name))
            << name;
    }
    EXPECT_EQ(withoutContext(folder / "a" / "slope.json"),
              withoutContext(folder / "b" / "slope.json"));
}

TEST(FitSlope, ReadsTheHumanTablesAsTheyAre) {
    const char* data = std::getenv("STAIRWELL_HUMAN_DATA");
    if (!data || !fs::exists(data)) {
        // Human data may not lie in the project; CI names the folder, so there nothing is skipped.
        GTEST_SKIP() << "STAIRWELL_HUMAN_DATA names no folder of human tables";
    }
    const tests::ScratchFolder folder;
    const CommandResult run = runProgram("fit_slope", {data, "--out", folder.path().string()});
    ASSERT_EQ(run.exitCode, 0) << run.err;
    const records::Slope slope = records::readSlope(folder / "slope.json");
    // What its README says of it: nine angles, four sizes at one, noise left out, one careless
    // observer of twelve with 14 false alarms in 77.
    EXPECT_EQ(slope.groups.size(), 9u);
    EXPECT_EQ(slope.observers, 11);
    EXPECT_EQ(slope.task, records::Task::yesNo);
    EXPECT_FALSE(slope.encoding);
    EXPECT_THAT(run.out, HasSubstr("14 false alarms in 77 reference trials"));
    EXPECT_THAT(run.err, HasSubstr("image noise was added"));
    for (const records::SlopeGroup& group : slope.groups) {
        EXPECT_TRUE(group.c.ci95) << group.name;
    }
    // METHODS section 5: c falls with size there, which a law with kappa = 1 does not allow.
    ASSERT_TRUE(slope.kappaPValue && slope.kappa.ci95);
    EXPECT_LT(*slope.kappaPValue, 0.05);
    EXPECT_LT(slope.kappa.ci95->high, 1);
    // Known of it: observers differ by .04 to .22 log10.
    EXPECT_GT(slope.observerSd, 0.04);
    EXPECT_LT(slope.observerSd, 0.22);
}

TEST(FitSlope, ExplainsBadUsageAndExitsWithTwo) {
    EXPECT_EQ(runProgram("fit_slope", {}).exitCode, 2);
    EXPECT_EQ(runProgram("fit_slope", {"somewhere"}).exitCode, 2);
    EXPECT_EQ(runProgram("fit_slope", {"somewhere", "--out", "x", "--frobnicate"}).exitCode, 2);
    EXPECT_EQ(runProgram("fit_slope", {"somewhere", "--out", "x", "--criterion", "half"}).exitCode,
              2);
    EXPECT_EQ(runProgram("fit_slope", {"--help"}).exitCode, 0);
}

TEST(FitSlope, NamesWhatIsWrongAndExitsWithOne) {
    const tests::ScratchFolder folder;
    const std::string out = (folder / "out").string();
    const auto failure = [&](std::vector<std::string> arguments) {
        const CommandResult run = runProgram("fit_slope", arguments);
        EXPECT_EQ(run.exitCode, 1) << run.err;
        EXPECT_THAT(run.err, testing::StartsWith("fit_slope: "));
        return run.err;
    };
    EXPECT_THAT(failure({(folder / "nowhere").string(), "--out", out}), HasSubstr("nowhere"));
    fs::create_directory(folder / "empty");
    EXPECT_THAT(failure({(folder / "empty").string(), "--out", out}), HasSubstr("empty"));
    writeStudy(folder / "data");
    const std::string data = (folder / "data").string();
    EXPECT_THAT(failure({data, "--out", out, "--criterion", "1.5"}),
                HasSubstr("--criterion: 1.5: must be a probability between 0 and 1"));
    EXPECT_THAT(failure({data, "--out", ""}), HasSubstr("--out: empty: must name a folder"));
    tests::writeBytes(folder / "file", "x");
    EXPECT_THAT(failure({data, "--out", (folder / "file").string()}), HasSubstr("file"));
    EXPECT_THAT(failure({data, "--out", "/proc/nothing"}), HasSubstr("/proc/nothing"));

    const fs::path table = folder / "data" / "sub-001_task-hideartifact_beh.tsv";
    const std::string good = records::readWholeFile(table);
    std::string bad = good;
    bad.replace(bad.find("\tdisc\t"), 6, "\tdisc\tx\t");
    tests::writeBytes(table, bad);
    EXPECT_THAT(failure({data, "--out", out}),
                HasSubstr("sub-001_task-hideartifact_beh.tsv: line 2"));
    EXPECT_FALSE(fs::exists(folder / "out" / "slope.json"));
    tests::writeBytes(table, good.substr(0, good.size() - 20));  // torn last line: a notice
    const CommandResult torn = runProgram("fit_slope", {data, "--out", out});
    EXPECT_EQ(torn.exitCode, 0) << torn.err;
    EXPECT_THAT(torn.err, HasSubstr("sub-001"));
}

TEST(FitSlope, SaysThatGnuplotIsMissing) {
    const tests::ScratchFolder folder;
    writeStudy(folder / "data");
    const std::string before = std::getenv("PATH");
    setenv("PATH", folder.path().c_str(), 1);
    const CommandResult run =
        runProgram("fit_slope", {(folder / "data").string(), "--out", (folder / "out").string()});
    setenv("PATH", before.c_str(), 1);
    EXPECT_EQ(run.exitCode, 1);
    EXPECT_THAT(run.err, HasSubstr("gnuplot, which draws the figures, cannot be started"));
    EXPECT_THAT(run.err, HasSubstr("install the package gnuplot-nox"));
}

}  // namespace
