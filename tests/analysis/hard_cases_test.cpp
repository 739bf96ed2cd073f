// SPDX-License-Identifier: MIT
// Tables that ought to break a fit: each gives a result with its flag or a located sentence. What
// is decided by the answers alone (all right, all wrong, separation, one radius, one trial) is in
// slope_analysis_test.cpp, what is decided by the columns in study_test.cpp; here are the files.
#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>

#include "analysis/slope_analysis.h"
#include "records/whole_file.h"
#include "tests/analysis/simulated_study.h"
#include "tests/records/scratch_folder.h"

namespace {

namespace fs = std::filesystem;
using namespace analysis;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

// One small study on disk, in which a row of the first table is changed.
class HardCase {
  public:
    explicit HardCase(const tests::StudyPlan& plan = {
                          .observers = 3, .sizes = {10}, .trials = 12}) {
        std::mt19937_64 rng(701);
        tests::writeTables(tests::simulateTables(plan, rng), folder_.path());
        first_ = folder_ / "sub-001_task-hideartifact_beh.tsv";
    }

    // Column by name, row from 1.
    void set(const std::string& column, std::size_t row, const std::string& value) const {
        std::vector<std::vector<std::string>> rows = cells();
        std::size_t at = 0;
        while (rows[0].at(at) != column) ++at;
        rows.at(row).at(at) = value;
        std::string text;
        for (const auto& line : rows) {
            for (std::size_t i = 0; i < line.size(); ++i) text += (i > 0 ? "\t" : "") + line[i];
            text += "\n";
        }
        records::writeWholeFile(first_, text);
    }

    std::string sentence() const {
        try {
            const fs::path paths[] = {folder_.path()};
            analyseSlope(loadStudy(paths));
        } catch (const std::runtime_error& error) {
            return error.what();
        }
        return "(no error)";
    }

    const fs::path& first() const { return first_; }
    const tests::ScratchFolder& folder() const { return folder_; }

  private:
    std::vector<std::vector<std::string>> cells() const {
        std::vector<std::vector<std::string>> rows(1, std::vector<std::string>(1));
        for (const char character : records::readWholeFile(first_)) {
            if (character == '\n') {
                rows.emplace_back(1);
            } else if (character == '\t') {
                rows.back().emplace_back();
            } else {
                rows.back().back() += character;
            }
        }
        rows.pop_back();
        return rows;
    }

    tests::ScratchFolder folder_;
    fs::path first_;
};

TEST(HardCases, RadiiThatAreNoRadiiAreLocated) {
    for (const char* value : {"nan", "0", "-3", "inf", "1e999", "wide"}) {
        const HardCase study;
        study.set("filter_radius_px", 5, value);
        EXPECT_THAT(study.sentence(), AllOf(HasSubstr("sub-001_task-hideartifact_beh.tsv: line 6"),
                                            HasSubstr("filter_radius_px")))
            << value;
    }
}

TEST(HardCases, ARadiusFarOffTheOthersChangesLittle) {
    const HardCase study;
    const fs::path paths[] = {study.folder().path()};
    const double before = analyseSlope(loadStudy(paths)).slope.headline.value;
    study.set("filter_radius_px", 5, "1e300");
    const SlopeAnalysis result = analyseSlope(loadStudy(paths));
    // One of 36 trials, right or wrong: a lapse at most.
    EXPECT_NEAR(result.slope.headline.value, before, 0.3);
}

TEST(HardCases, ARadiusThatNoDisplayShowsIsLeftOutWithANotice) {
    for (const char* value : {"1e-300", "1e-90", "1e300"}) {
        const HardCase study;
        study.set("filter_radius_px", 5, value);
        const fs::path paths[] = {study.folder().path()};
        EXPECT_THAT(loadStudy(paths).notices, Contains(HasSubstr("r/a beyond 1e4"))) << value;
    }
}

TEST(HardCases, TrialNumbersThatStandTwiceAreLocated) {
    const HardCase study;
    study.set("trial", 5, "4");
    EXPECT_THAT(study.sentence(),
                AllOf(HasSubstr("sub-001_task-hideartifact_beh.tsv: line 6"), HasSubstr("trial")));
}

TEST(HardCases, TwoTablesOfOneObserverAreLocated) {
    const HardCase study;
    fs::create_directory(study.folder() / "again");
    fs::copy_file(study.first(), study.folder() / "again" / study.first().filename());
    EXPECT_THAT(study.sentence(), AllOf(HasSubstr("participant 001 is also in"),
                                        HasSubstr("two observers must not share an id")));
}

TEST(HardCases, LitLevelZeroIsLeftOutWithANotice) {
    const HardCase study;
    study.set("lit_level", 5, "0");
    const fs::path paths[] = {study.folder().path()};
    const SlopeAnalysis result = analyseSlope(loadStudy(paths));
    EXPECT_THAT(result.notices,
                testing::Contains(HasSubstr("1 trial left out: lit level 0 shows no edge")));
    EXPECT_EQ(result.study.groups.size(), 1u);
}

TEST(HardCases, AFalseAlarmRateAboveTheCriterionIsExcludedOrFitted) {
    const HardCase study(
        {.observers = 3, .sizes = {10}, .trials = 40, .yesNo = true, .falseAlarms = 0.8});
    EXPECT_THAT(study.sentence(), HasSubstr("no observer passes the screening"));
    const fs::path paths[] = {study.folder().path()};
    AnalysisOptions everyone;
    everyone.screening.apply = false;
    const SlopeAnalysis result = analyseSlope(loadStudy(paths), everyone);
    for (const ScreenedObserver& row : result.screening) EXPECT_NE(row.reason, "");
    EXPECT_TRUE(std::isfinite(result.slope.headline.value));
    // Detection is what is left above the guesses: at r = c a "seen" in .8 + .2 F* or so.
    EXPECT_GT(result.percentAtThreshold, 80);
}

TEST(HardCases, AnObserverWhoAlwaysPressesLeftHasNoThresholdAndStopsNobody) {
    tests::StudyPlan plan{.observers = 6, .sizes = {10, 20}, .trials = 30, .catchTrials = 20};
    std::mt19937_64 rng(702);
    auto tables = tests::simulateTables(plan, rng);
    for (std::size_t t = 0; t < tables[0].trials.size(); ++t) {
        records::Trial& trial = tables[0].trials[t];
        trial.side = t % 2 == 0 ? "left" : "right";  // the sides of the artifact are random
        trial.response = records::Response::left;
        trial.correct = t % 2 == 0;
    }
    const SlopeAnalysis result = analyseSlope(studyOf(tables));
    EXPECT_TRUE(result.screening[0].excluded) << "half of his catch trials fail";
    EXPECT_EQ(result.study.observers.size(), 5u);
    ASSERT_TRUE(result.slope.headline.ci95);
}

TEST(HardCases, GiveTheSameBitsWhateverTheNumberOfThreads) {
    const Study study =
        tests::simulateStudy({.observers = 4, .sizes = {10, 20}, .trials = 40}, 703);
    const SlopeAnalysis one = analyseSlope(study, {.bootstrap = 20, .threads = 1});
    const SlopeAnalysis four = analyseSlope(study, {.bootstrap = 20, .threads = 4});
    EXPECT_EQ(one.slope.headline.value, four.slope.headline.value);
    EXPECT_EQ(one.slope.headline.ci95->low, four.slope.headline.ci95->low);
    ASSERT_TRUE(one.fitCheck.dispersion);
    EXPECT_EQ(one.fitCheck.dispersion->pearson, four.fitCheck.dispersion->pearson);
    EXPECT_EQ(one.bootstrap->headline->high, four.bootstrap->headline->high);
}

// A shaky observer's few answers may curve a condition's likelihood upwards where its search
// begins.
TEST(HardCases, AFewAnswersOfOneObserverHaveALikelihood) {
    const tests::StudyPlan plan{.observers = 1,
                                .groups = {{}, {.pattern = records::Pattern::step}},
                                .sizes = {10, 20},
                                .trials = 15,
                                .lapse = 0.1};
    for (std::uint64_t seed = 1; seed <= 20; ++seed)
        for (const std::string& notice : analyseSlope(tests::simulateStudy(plan, seed)).notices)
            EXPECT_THAT(notice, Not(HasSubstr("nan"))) << "seed " << seed;
}

}  // namespace
