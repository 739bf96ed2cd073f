// SPDX-License-Identifier: MIT
// The report as its reader gets it: figures, tables, sentences, checksums.
#include "analysis/slope_report.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <regex>
#include <set>
#include <sstream>

#include "analysis/figures.h"
#include "analysis/findings.h"
#include "analysis/observer_slopes.h"
#include "analysis/published_slope.h"
#include "analysis/result_tables.h"
#include "analysis/slope_record.h"
#include "records/file_checksum.h"
#include "records/html_page.h"
#include "records/whole_file.h"
#include "tests/analysis/simulated_study.h"
#include "tests/records/scratch_folder.h"

namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;
using tests::StudyPlan;

// A report of a study that was written to disk and read again.
class Report {
  public:
    explicit Report(const StudyPlan& plan, const analysis::AnalysisOptions& options = {},
                    const std::string& renamed = "", double pxPerDeg = 0) {
        std::mt19937_64 rng(7);
        std::vector<records::TrialTable> tables = tests::simulateTables(plan, rng);
        if (!renamed.empty()) tables.front().file = renamed;
        tests::writeTables(tables, folder_ / "data");
        std::vector<fs::path> files;
        for (const records::TrialTable& table : tables) {
            files.push_back(folder_ / "data" / table.file.filename());
        }
        analysis::Study study = analysis::loadStudy(files);
        if (pxPerDeg > 0) study.pxPerDeg = pxPerDeg;
        result_ = analysis::analyseSlope(study, options);
        context_ = records::currentRunContext("fit_slope", {"fit_slope", "my data", "--out", "x"});
        analysis::writeReport(out(), result_, analysis::slopeRecord(result_, context_),
                              analysis::referenceSizes(study));
        page_ = records::readWholeFile(out() / "report.html");
    }
    fs::path out() const { return folder_ / "out"; }
    fs::path data() const { return folder_ / "data"; }
    const std::string& page() const { return page_; }
    const analysis::SlopeAnalysis& result() const { return result_; }
    std::string file(const std::string& name) const { return records::readWholeFile(out() / name); }

  private:
    tests::ScratchFolder folder_;
    records::RunContext context_;
    analysis::SlopeAnalysis result_;
    std::string page_;
};

StudyPlan smallPlan() {
    return {.observers = 4,
            .groups = tests::fourGroups(0.4, 0.38, 0.54, 0.5),
            .sizes = {10, 20},
            .trials = 16};
}

// The first tag that does not match; empty where every element is closed in its turn.
std::string firstUnbalanced(const std::string& html) {
    std::vector<std::string> open;
    const std::set<std::string> empty = {"meta", "img", "br"};
    for (std::size_t at = html.find('<'); at != std::string::npos; at = html.find('<', at + 1)) {
        if (html.compare(at, 2, "<!") == 0) continue;
        const std::size_t end = html.find('>', at);
        if (end == std::string::npos) return html.substr(at, 40);
        const bool closes = html[at + 1] == '/';
        const std::size_t start = at + (closes ? 2 : 1);
        const std::string name = html.substr(start, html.find_first_of(" \t\n/>", start) - start);
        if (!closes && html[end - 1] != '/' && !empty.contains(name)) open.push_back(name);
        if (closes) {
            if (open.empty() || open.back() != name) return html.substr(at, 40);
            open.pop_back();
        }
        at = end;
    }
    return open.empty() ? "" : open.back();
}

std::vector<fs::path> filesWith(const fs::path& folder, const std::string& extension) {
    std::vector<fs::path> found;
    for (const auto& entry : fs::directory_iterator(folder)) {
        if (entry.path().extension() == extension) found.push_back(entry.path());
    }
    std::sort(found.begin(), found.end());
    return found;
}

TEST(SlopeReport, IsOneWellFormedFileThatNeedsNoOther) {
    const Report report(smallPlan());
    EXPECT_EQ(firstUnbalanced(report.page()), "");
    EXPECT_EQ(firstUnbalanced("<p><b></p></b>"), "</p></b>");
    // Names of namespaces are no references.
    const std::string page =
        std::regex_replace(report.page(), std::regex("xmlns(:xlink)?=\"[^\"]*\""), "");
    for (const char* reference : {"http:", "https:", "<link", "<script", "@import", "src=\"file",
                                  "src=\"figures", "url(http", "url(file"}) {
        EXPECT_THAT(page, Not(HasSubstr(reference)));
    }
}

TEST(SlopeReport, ShowsEveryFigureAndGivesItAsSvgAndPdfWithItsScript) {
    const Report report(smallPlan());
    const fs::path figures = report.out() / "figures";
    const std::vector<fs::path> scripts = filesWith(figures, ".gp");
    std::vector<std::string> names;
    for (const fs::path& script : scripts) names.push_back(script.stem().string());
    EXPECT_THAT(names, testing::ElementsAre("audience", "iso_contours", "psychometric_functions",
                                            "reference_size", "residuals", "slope_against_light",
                                            "slopes_by_group", "slopes_by_observer", "staircases",
                                            "threshold_against_size"));
    for (const std::string& name : names) {
        const std::string svg = records::readWholeFile(figures / (name + ".svg"));
        const std::string pdf = records::readWholeFile(figures / (name + ".pdf"));
        EXPECT_THAT(svg, testing::ContainsRegex("<(path|polygon|circle|use)")) << name;
        EXPECT_THAT(svg, testing::EndsWith("</svg>\n\n")) << name;
        EXPECT_THAT(svg, HasSubstr("prefers-color-scheme: dark")) << name;
        EXPECT_THAT(svg, Not(HasSubstr("<title>$"))) << name;  // shown under the mouse
        EXPECT_THAT(pdf, testing::StartsWith("%PDF")) << name;
        EXPECT_THAT(pdf, HasSubstr("%%EOF")) << name;
        EXPECT_THAT(pdf, Not(HasSubstr("CreationDate"))) << name;
        EXPECT_GT(pdf.size(), 4000u) << name;  // an empty page has 1 kB
    }
    const std::regex shown("<svg");
    EXPECT_EQ(static_cast<std::size_t>(std::distance(
                  std::sregex_iterator(report.page().begin(), report.page().end(), shown),
                  std::sregex_iterator())),
              names.size());
    EXPECT_THAT(report.page(), HasSubstr("Figure 10. "));
    EXPECT_THAT(report.page(), Not(HasSubstr("Figure 11. ")));
}

TEST(SlopeReport, NamesTheDataByTheirChecksums) {
    const Report report(smallPlan());
    std::istringstream lines(report.file("data.sha256"));
    int count = 0;
    for (std::string line; std::getline(lines, line); ++count) {
        ASSERT_GT(line.size(), 66u);
        EXPECT_EQ(line.substr(0, 64), records::sha256(records::readWholeFile(line.substr(66))));
        EXPECT_THAT(report.page(), HasSubstr(records::htmlEscaped(line)));
    }
    EXPECT_EQ(count, 4);
}

TEST(SlopeReport, GivesTheCommandAsItCanBeTypedAgain) {
    EXPECT_THAT(Report(smallPlan()).page(), HasSubstr("fit_slope &#39;my data&#39; --out x"));
}

TEST(SlopeReport, ShowsMarkupInNamesAsText) {
    const Report report(smallPlan(), {}, "a<b>&'c_{d}.tsv");
    EXPECT_EQ(firstUnbalanced(report.page()), "");
    EXPECT_THAT(report.page(), Not(HasSubstr("<b>")));
    EXPECT_THAT(report.page(), HasSubstr("a&lt;b&gt;&amp;&#39;c_{d}"));
    // gnuplot's own markup as well: the name is one piece of text.
    EXPECT_THAT(report.file("figures/slopes_by_observer.svg"), HasSubstr("a&lt;b>&amp;'c_{d}"));
}

TEST(SlopeReport, GivesDegreesWhereTheScreensHaveThemAndOnlyThere) {
    const Report with(smallPlan(), {}, "", 40);
    EXPECT_THAT(with.page(), HasSubstr("radius (deg)"));
    EXPECT_THAT(with.page(), HasSubstr("40.0 px per degree of visual angle"));
    EXPECT_THAT(with.file("figures/threshold_against_size.svg"), HasSubstr("degrees"));
    EXPECT_THAT(with.file("conditions.tsv"), HasSubstr("\t0.25\t"));  // 10 px
    const Report without(smallPlan());
    EXPECT_THAT(without.page(), Not(HasSubstr("radius (deg)")));
    EXPECT_THAT(without.page(), HasSubstr("sizes are in px alone"));
    EXPECT_THAT(without.file("figures/threshold_against_size.svg"), Not(HasSubstr("degrees")));
}

TEST(SlopeReport, ReadsWellFromOneObserverAndOneCondition) {
    const Report report({.observers = 1, .groups = {{}}, .sizes = {10}, .trials = 40});
    EXPECT_EQ(firstUnbalanced(report.page()), "");
    EXPECT_THAT(report.page(), HasSubstr("One observer: c is this person&#39;s"));
    EXPECT_THAT(report.page(), HasSubstr("(no interval)"));
    EXPECT_THAT(report.page(), HasSubstr("No interval: one observer."));
    EXPECT_THAT(report.page(), Not(HasSubstr("nan")));
    EXPECT_THAT(report.page(), Not(HasSubstr("90th-percentile observer.")));
    EXPECT_FALSE(fs::exists(report.out() / "figures/slopes_by_observer.svg"));
    EXPECT_FALSE(fs::exists(report.out() / "figures/audience.svg"));
}

TEST(Warnings, TellWhereTheLapseRateEndedOnItsUpperBoundNotOnItsFloor) {
    analysis::AnalysisOptions options;
    options.comparisons = false;
    analysis::SlopeAnalysis result = analysis::analyseSlope(
        tests::simulateStudy({.observers = 4, .groups = {{}}, .sizes = {10, 20}}, 8), options);
    result.slope.law.lapseAtBound = true;
    result.slope.law.parameters.lapse = analysis::kLapseFloor;
    EXPECT_THAT(warnings(result), testing::ElementsAre(HasSubstr("No catch trials")));
    result.options.screening.apply = false;  // then nobody expects any
    EXPECT_THAT(warnings(result), testing::IsEmpty());
    result.slope.law.parameters.lapse = analysis::kLapseLimit;
    EXPECT_THAT(warnings(result), testing::ElementsAre(HasSubstr("upper bound, 15 %")));
    result.groups.front().flag = "one radius only";
    EXPECT_THAT(warnings(result).back(), HasSubstr("stair, lit 1 (one radius only)"));
}

TEST(SlopeReport, HasATableOfEveryObserver) {
    const Report report(smallPlan());
    const std::string table = report.file("observers.tsv");
    EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 5);
}

TEST(SlopeReport, HasEveryNumberWithAndWithoutTheExcludedAndOnlyWhereThereAreSome) {
    StudyPlan plan = smallPlan();
    plan.catchTrials = 20;
    EXPECT_FALSE(fs::exists(Report(plan).out() / "with_everyone.tsv"));
    plan.guessing = 1;
    const Report report(plan);
    ASSERT_TRUE(report.result().everyone);
    EXPECT_THAT(report.page(), HasSubstr("What leaving observers out changes"));
    const std::string table = report.file("with_everyone.tsv");
    for (const char* row : {"headline\t", "90th-percentile observer\t", "group stair, lit 0.5\t",
                            "exponent kappa\t", "lapse rate\t"}) {
        EXPECT_THAT(table, HasSubstr(row));
    }
    EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 1 + 2 + 4 + 1 + 3);
}

// 3.47 was found at F* = .6465. In a curve of beta 3.5 it is (ln(1 - .6465) / ln(1 - .1))^(1/3.5)
// times that where one trial in ten is detected.
TEST(SlopeReport, PutsThePublishedSlopeBesideAtTheCriterionOfTheFit) {
    EXPECT_EQ(analysis::publishedText(quest::kPaperCriterion), "3.47");
    EXPECT_EQ(analysis::publishedText(0.6465), "3.47");
    EXPECT_NEAR(analysis::publishedAt(0.1), 3.47 * std::pow(1.03977 / 0.105361, 1 / 3.5), 1e-4);
    analysis::AnalysisOptions hidden;
    hidden.criterion = 0.1;
    const Report report(smallPlan(), hidden);
    EXPECT_THAT(report.page(), HasSubstr("Its worst case was c = 6.67 (3.47 at F* = 0.6465)"));
    EXPECT_THAT(report.file("figures/slopes_by_group.gp"), HasSubstr("set arrow 1 from 6.6"));
    EXPECT_THAT(report.file("figures/threshold_against_size.gp"), HasSubstr("c = 6.67"));
}

// The headline and the slopes of the groups come from two fits there, and may lie in any order.
TEST(SlopeReport, SaysWhereHeadlineAndGroupsComeFromDifferentFits) {
    StudyPlan plan{.observers = 8, .groups = tests::fourGroups(0.44, 0.44, 0.6, 0.6), .kappa = 0.7};
    const Report bent(plan);
    ASSERT_TRUE(bent.result().slope.lawRejected);
    EXPECT_THAT(bent.page(),
                HasSubstr("comes from a second fit, in which c changes with the size"));
    EXPECT_THAT(bent.page(), HasSubstr("The headline is not among them"));
    EXPECT_THAT(Report(smallPlan()).page(), Not(HasSubstr("second fit")));
}

// The paragraph says what was done and nothing else.
TEST(MethodParagraph, FollowsTheOptions) {
    const analysis::Study study = tests::simulateStudy(smallPlan(), 3);
    const std::string all = methodParagraph(analysis::analyseSlope(study));
    EXPECT_THAT(all, HasSubstr("F* = 0.6465"));
    EXPECT_THAT(all, HasSubstr("kappa = 1"));
    EXPECT_THAT(all, HasSubstr("pooled maximum likelihood"));
    EXPECT_THAT(all, HasSubstr("guessing at .5"));
    EXPECT_THAT(all, HasSubstr("Nobody could be screened: there are no catch trials"));
    EXPECT_THAT(all, Not(HasSubstr("a bootstrap over observers")));

    analysis::AnalysisOptions options;
    options.criterion = 0.1;
    options.screening.apply = false;
    options.comparisons = false;
    const std::string few = methodParagraph(analysis::analyseSlope(study, options));
    EXPECT_THAT(few, HasSubstr("F* = 0.1000"));
    EXPECT_THAT(few, HasSubstr("Screening: Switched off."));
    EXPECT_THAT(few, Not(HasSubstr("pooled maximum likelihood")));
    EXPECT_THAT(few, Not(HasSubstr("second half")));

    options = {};
    options.bootstrap = 40;
    EXPECT_THAT(methodParagraph(analysis::analyseSlope(study, options)),
                HasSubstr("a bootstrap over observers (40 draws)"));
}

TEST(MethodParagraph, ClaimsNoTestAndNoMaximumThatThereWasNot) {
    const std::string text = methodParagraph(analysis::analyseSlope(
        tests::simulateStudy({.observers = 5, .groups = {{}}, .sizes = {10}}, 4)));
    EXPECT_THAT(text, Not(HasSubstr("kappa")));
    EXPECT_THAT(text, Not(HasSubstr("median error of a maximum")));
    EXPECT_THAT(text, HasSubstr("1 condition of 1 group"));
    const std::string yesNo = methodParagraph(analysis::analyseSlope(
        tests::simulateStudy({.observers = 5, .groups = {{}}, .sizes = {10}, .yesNo = true}, 4)));
    EXPECT_THAT(yesNo, HasSubstr("false alarms at each observer's rate"));
    EXPECT_THAT(yesNo, Not(HasSubstr("guessing at .5")));
}

TEST(Figures, DrawManyPatternsAsThoseWithTheLargestSlopesAndSaySo) {
    StudyPlan plan{.observers = 2, .groups = {}, .sizes = {10}, .trials = 12};
    for (int i = 0; i < 9; ++i) {
        plan.groups.push_back({records::Pattern::stair, 1 - 0.1 * i, 0.3 + 0.02 * i});
    }
    analysis::AnalysisOptions options;
    options.comparisons = false;
    const analysis::SlopeAnalysis result =
        analysis::analyseSlope(tests::simulateStudy(plan, 5), options);
    const analysis::Figure figure = analysis::thresholdAgainstSize(result);
    EXPECT_THAT(figure.caption, HasSubstr("the 7 groups with the largest c"));
    std::size_t least = 0;
    for (std::size_t g = 0; g < result.groups.size(); ++g) {
        if (result.groups[g].c.value < result.groups[least].c.value) least = g;
    }
    std::string title = "'";  // as the key has it: "'lit 0.9: c = ..."
    title.append(result.study.groups[least].name.substr(7)).append(":");
    EXPECT_THAT(figure.plot, Not(HasSubstr(title)));
}

TEST(Figures, ChooseEvenlyAndKeepBothEnds) {
    EXPECT_THAT(analysis::evenlySpaced(3, 6), testing::ElementsAre(0, 1, 2));
    EXPECT_THAT(analysis::evenlySpaced(200, 6), testing::ElementsAre(0, 39, 79, 119, 159, 199));
    EXPECT_THAT(analysis::evenlySpaced(9, 1), testing::ElementsAre(4));
    EXPECT_THAT(analysis::evenlySpaced(0, 4), testing::IsEmpty());
}

TEST(Figures, PutTicsWhereTheyDoNotTouch) {
    const double sizes[] = {5, 5.1, 10, 30};
    EXPECT_EQ(analysis::ticsAt(sizes, 0, 32, false), "('5' 5, '10' 10, '30' 30)");
    EXPECT_EQ(analysis::logTics(1, 100),
              "('1' 1, '2' 2, '5' 5, '10' 10, '20' 20, '50' 50, '100' 100)");
}

// Of the simulated spread, tau = .1: the sd of 40 observers is within 3 / sqrt(80) of it, a third,
// in all but three studies of a thousand; the errors of single observers (.03) add 5 %.
TEST(ObserverSlopes, ScatterAsTheSimulatedObserversDo) {
    const analysis::SlopeAnalysis result = analysis::analyseSlope(
        tests::simulateStudy({.observers = 40, .groups = {{}}, .sizes = {5, 10, 20, 30}}, 12));
    const std::vector<analysis::ObserverSlope> slopes = analysis::observerSlopes(result);
    ASSERT_EQ(slopes.size(), 40u);
    double squares = 0;
    for (const analysis::ObserverSlope& slope : slopes) {
        ASSERT_TRUE(slope.own);
        EXPECT_EQ(slope.cells, 4);
        // The same observer told twice, from the trials alone and drawn to the mean: closer than
        // the error of the one.
        EXPECT_NEAR(slope.shrunken, *slope.own, 3 * slope.standardError);
        squares += *slope.own * *slope.own / 40;
    }
    EXPECT_NEAR(std::sqrt(squares), 0.1, 0.038);
    const std::vector<std::size_t> order = analysis::observersByRisingSlope(slopes);
    for (std::size_t i = 1; i < order.size(); ++i) {
        EXPECT_LE(slopes[order[i - 1]].shrunken, slopes[order[i]].shrunken);
    }
}

}  // namespace
