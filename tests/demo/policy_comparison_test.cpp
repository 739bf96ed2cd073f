// SPDX-License-Identifier: MIT
// Policies over a made-up sweep whose answer is known: the time of a size is its edge in ms, its
// ripple falls with it, and one of two scenes needs twice the size of the other.
#include "demo/policy_comparison.h"

#include <gmock/gmock.h>

#include "demo/automatic_against_fixed.h"
#include "demo/policy_summary.h"
#include "demo/speed_error_front.h"
#include "demo/sweep_difference.h"
#include "demo/sweep_policy_report.h"
#include "demo/sweep_report.h"
#include "demo/tsv_journal.h"
#include "records/whole_file.h"
#include "tests/temporary_folder.h"

namespace {

using testing::HasSubstr;
using testing::Not;

const std::vector<int> kSizes = {128, 256, 512, 1024, 2048};

struct MadeUp {
    double slower = 1;     ///< factor of all times
    double worse = 0;      ///< added to all errors
    int reference = 2048;  ///< of all errors
    bool skipLargest = false;
    bool broken = false;  ///< NaN in place of the errors at 1024
};

/// Needed sizes: 256 in "small", 1024 in "large"; there a ripple of 25.5/255 = .1 is left.
void writeSweep(const std::filesystem::path& folder, const MadeUp& sweep) {
    demo::TsvJournal times(folder / "sweep_times.tsv", demo::kSweepTimeColumns, "made up");
    demo::TsvJournal errors(folder / "sweep_errors.tsv", demo::kSweepErrorColumns, "made up");
    demo::TsvJournal policies(folder / "sweep_policies.tsv", demo::kSweepPolicyColumns, "made up");
    for (const auto& [scene, need] : {std::pair{"small", 256}, std::pair{"large", 1024}}) {
        for (const int size : kSizes) {
            const bool skipped = sweep.skipLargest && size == kSizes.back();
            for (int round = 0; round < 3; ++round)
                times.add({scene, "0", "pcf_disc", std::to_string(size), std::to_string(round),
                           skipped ? "skipped: predicted 9999 ms a frame" : "ok",
                           skipped ? "n/a" : demo::tsvNumber(sweep.slower * size), "1", "n/a", "1",
                           "1", "1", "4"});
            if (skipped) continue;
            std::vector<std::string> row = {scene, "0", "pcf_disc", std::to_string(size),
                                            std::to_string(sweep.reference)};
            row.resize(demo::kSweepErrorColumns.size() - 1, "0.01");
            row[7] =
                sweep.broken && size == 1024 ? "n/a" : demo::tsvNumber(sweep.worse + 10.0 / size);
            const int level = std::min(255, 26 * need / size);
            std::string counts;
            for (int i = 0; i < level; ++i) counts += "0,";
            row.push_back(counts + "100");
            errors.add(row);
        }
        for (const demo::SizingPolicy& policy : demo::sizingPolicies()) {
            // Ours follows the need; all others take one size everywhere.
            std::string sizes;
            for (int step = -demo::kPolicySteps; step <= demo::kPolicySteps; ++step) {
                int at = 512;
                if (policy.ours)
                    at = step < 0 ? need / 2 : step == 0 ? need : 2 * need;
                else if (step > 0)
                    at = 1024;
                sizes += (sizes.empty() ? "" : ",") + std::to_string(at);
            }
            policies.add({scene, "0", "pcf_disc", std::string(policy.name), sizes});
        }
    }
}

std::vector<demo::DirectRow> drawnDirectly() {
    // In the made-up sweep a size takes its edge in ms.
    return {{.scene = "small",
             .technique = "pcf_disc",
             .policy = "auto",
             .parameter = "3.47",
             .frameMs = 256,
             .rmse = 0.01,
             .ripples = {0, 19, 0, 1}},
            {.scene = "large",
             .technique = "pcf_disc",
             .policy = "auto",
             .parameter = "3.47",
             .frameMs = 1024,
             .rmse = 0.02,
             .ripples = {20}},
            {.scene = "large",
             .technique = "pcf_disc",
             .policy = "paper",
             .parameter = "3.47",
             .frameMs = 1,
             .rmse = 0.5,
             .ripples = {}}};
}

class PolicyComparisonOf : public testing::Test {
  protected:
    demo::SweepTable sweep(const MadeUp& madeUp) {
        const auto at = folder_.path() / std::to_string(count_++);
        writeSweep(at, madeUp);
        last_ = at;
        return demo::readSweep(at);
    }
    tests::TemporaryFolder folder_;
    std::filesystem::path last_;
    int count_ = 0;
};

TEST_F(PolicyComparisonOf, IsTheRatioOfTimesAtEqualRipple) {
    const auto all = demo::comparePolicies(sweep({}));
    ASSERT_EQ(all.size(), 1U);
    ASSERT_TRUE(all[0].ours.has_value());
    EXPECT_EQ(all[0].ours->smallest, 256);
    EXPECT_EQ(all[0].ours->largest, 1024);
    EXPECT_EQ(all[0].ours->step, 0);
    EXPECT_NEAR(all[0].ours->rippleP95, 26.5 / 255, 1e-9);
    EXPECT_NEAR(all[0].ours->geometricMeanMs, 512, 1e-6);  // of 256 and 1024
    for (const auto& entry : all[0].entries) {
        ASSERT_TRUE(entry.result.has_value()) << entry.policy->name;
        EXPECT_NEAR(entry.timesOurs, entry.policy->ours ? 1 : 2, 1e-6) << entry.policy->name;
    }
}

// Of one scene with few contour pixels the others make up for any ripple; each for itself does not.
TEST_F(PolicyComparisonOf, ASceneCannotHideAmongTheOthers) {
    demo::SweepTable table = sweep({});
    for (demo::SweepCell& cell : table.cells)
        if (cell.scene == "large") cell.ripples.back() = 1;
    const demo::SizingPolicy& fixed = demo::findSizingPolicy("fixed");
    const auto of = [&](demo::RippleOver over) {
        return *demo::calibrated(table, fixed, "pcf_disc", over);
    };
    EXPECT_EQ(of(demo::RippleOver::eachScene).largest, 1024);
    EXPECT_EQ(of(demo::RippleOver::allTogether).largest, 512);
    EXPECT_NEAR(of(demo::RippleOver::allTogether).rippleP95, 52.5 / 255, 1e-9);
    EXPECT_NEAR(of(demo::RippleOver::allTogether).rippleP95Together, 13.5 / 255, 1e-9);
}

TEST_F(PolicyComparisonOf, ACheatThatTakesTheTruthsSizeIsCaughtByItsCost) {
    const demo::SweepTable table = sweep({});
    // The largest size everywhere: no ripple at all, and dear.
    const demo::PolicyResult ours =
        *demo::calibrated(table, demo::automaticPolicy(), "pcf_disc", demo::RippleOver::eachScene);
    EXPECT_LT(table.find("small", 0, "pcf_disc", 2048)->ripples.size(), ours.rippleP95 * 255);
    EXPECT_GT(table.find("small", 0, "pcf_disc", 2048)->frameMs.median, 2 * ours.geometricMeanMs);
    const auto all = demo::speedAndErrors(table, "");
    for (const auto& point : all) EXPECT_NE(point.resolution, 2048) << "the reference is no choice";
}

TEST_F(PolicyComparisonOf, ABoundOutOfReachGivesWayToTheLeastRippleOfOursAndSaysSo) {
    const demo::SweepTable table = sweep({});
    const auto all = demo::comparePolicies(table, demo::RippleOver::eachScene, 0.001);
    // Twice the need, the finest that ours takes: half the ripple.
    EXPECT_NEAR(all[0].bound, 13.5 / 255, 1e-9);
    ASSERT_TRUE(all[0].ours.has_value());
    EXPECT_EQ(all[0].ours->largest, 2048);
    for (const auto& entry : all[0].entries) {
        EXPECT_EQ(entry.result.has_value(), entry.policy->ours) << entry.policy->name;
        if (entry.policy->ours) continue;
        // The others take 1024 at most, which leaves the large scene as it was.
        ASSERT_TRUE(entry.nearest.has_value());
        EXPECT_NEAR(entry.nearest->rippleP95, 26.5 / 255, 1e-9);
        EXPECT_TRUE(std::isnan(entry.timesOurs));
    }
    const std::string page =
        records::readWholeFile(demo::writeSweepReport(last_, table, std::nullopt));
    EXPECT_THAT(page, Not(HasSubstr("<td>nearest</td>")));  // to .13, which they all keep to
}

TEST_F(PolicyComparisonOf, WhatWasNotMeasuredIsNamed) {
    const demo::SweepTable table = sweep({.skipLargest = true});
    const demo::PolicyResult result =
        demo::evaluate(table, demo::automaticPolicy(), "pcf_disc", demo::kPolicySteps);
    EXPECT_FALSE(result.complete());
    EXPECT_THAT(result.missing, HasSubstr("large frame 0 at 2048: skipped"));
}

TEST_F(PolicyComparisonOf, ErrorsAgainstACoarseReferenceDoNotCount) {
    const demo::SweepTable table = sweep({.reference = 512});
    EXPECT_FALSE(
        demo::calibrated(table, demo::automaticPolicy(), "pcf_disc", demo::RippleOver::eachScene)
            .has_value());
    EXPECT_THAT(demo::evaluate(table, demo::automaticPolicy(), "pcf_disc", 0).missing,
                HasSubstr("its reference is 512 alone"));
    EXPECT_TRUE(demo::speedAndErrors(table, "").empty());
    EXPECT_TRUE(demo::calibrated(sweep({.reference = 1024}), demo::automaticPolicy(), "pcf_disc",
                                 demo::RippleOver::eachScene)
                    .has_value());
}

TEST_F(PolicyComparisonOf, TheFrontHasWhatNothingBeats) {
    const demo::SweepTable table = sweep({});
    auto all = demo::speedAndErrors(table, "small");
    ASSERT_EQ(all.size(), kSizes.size() - 1);
    for (const auto& point : all) EXPECT_FALSE(point.dominated);
    EXPECT_EQ(demo::recommended(all, {.mostError = 0.02})->resolution, 512);
    EXPECT_EQ(demo::recommended(all, {.mostMs = 300})->resolution, 256);
    EXPECT_EQ(demo::recommended(all, {.mostError = 0.001}), nullptr);
}

TEST_F(PolicyComparisonOf, ComparedSweepsDifferBeyondNoiseAlone) {
    const demo::SweepTable before = sweep({});
    EXPECT_TRUE(demo::slowerOrWorse(before, sweep({})).empty());
    EXPECT_TRUE(demo::slowerOrWorse(before, sweep({.slower = 0.5})).empty());
    const auto slower = demo::slowerOrWorse(before, sweep({.slower = 1.3}));
    EXPECT_EQ(slower.size(), 2 * kSizes.size());
    EXPECT_EQ(slower.at(0).what, "slower");
    const auto worse = demo::slowerOrWorse(before, sweep({.worse = 0.02}));
    EXPECT_EQ(worse.size(), 2 * kSizes.size());
    EXPECT_EQ(worse.at(0).what, "worse");
    const auto missing = demo::slowerOrWorse(before, sweep({.skipLargest = true}));
    EXPECT_EQ(missing.size(), 2U);
    EXPECT_EQ(missing.at(0).what, "missing");
}

TEST_F(PolicyComparisonOf, ABrokenTechniqueIsTheFirstThingInTheReport) {
    EXPECT_TRUE(demo::brokenTechniques(sweep({})).empty());
    EXPECT_THAT(demo::brokenTechniques(sweep({.worse = 0.2})),
                testing::ElementsAre(HasSubstr("does not converge")));
    const demo::SweepTable broken = sweep({.broken = true});
    ASSERT_EQ(demo::brokenTechniques(broken).size(), 1U);
    const auto file = demo::writeSweepReport(last_, broken, std::nullopt);
    const std::string page = records::readWholeFile(file);
    EXPECT_THAT(page, HasSubstr("<p class=\"failure\""));
    EXPECT_LT(page.find("<p class=\"failure\""), page.find("the speed"));
    const std::string sound =
        records::readWholeFile(demo::writeSweepReport(last_, sweep({}), std::nullopt));
    EXPECT_EQ(sound.find("<p class=\"failure\""), std::string::npos);
    EXPECT_THAT(page, HasSubstr("<svg"));
    EXPECT_TRUE(std::filesystem::exists(last_ / "policies.tsv"));
    EXPECT_TRUE(std::filesystem::exists(last_ / "front.tsv"));
}

TEST_F(PolicyComparisonOf, TheAutomaticSizeIsHeldAgainstAFixedOneSceneByScene) {
    const demo::SweepTable table = sweep({});
    std::vector<demo::DirectRow> direct = drawnDirectly();
    auto all = demo::automaticAgainstFixed(direct, table, {512, 2048});
    ASSERT_EQ(all.size(), 2U);
    EXPECT_EQ(all[0].fixed, 512);
    EXPECT_THAT(all[0].times, testing::ElementsAre(2, 0.5));
    EXPECT_NEAR(all[0].geometricMean, 1, 1e-12);
    EXPECT_NEAR(all[1].geometricMean, 4, 1e-12);  // of 8 and 2
    EXPECT_EQ(all[1].worstRmse, 0.02);
    EXPECT_NEAR(all[1].rippleP95, 1.5 / 255, 1e-12);
    EXPECT_NEAR(all[1].rippleMost, 4.0 / 255, 1e-12);

    // A map finer than the reference is not wrong by what the two differ in.
    direct[0].reference = direct[1].reference = 2048;
    direct[1].resolution = 4096;
    all = demo::automaticAgainstFixed(direct, table, {2048});
    EXPECT_EQ(all[0].finerFrames, 1);
    EXPECT_EQ(all[0].worstRmse, 0.01);
    EXPECT_THAT(demo::sweepHeadline(direct, demo::comparePolicies(table), table).meaning,
                HasSubstr("1 frames took maps finer"));

    direct.erase(direct.begin());
    all = demo::automaticAgainstFixed(direct, table, {2048});
    EXPECT_TRUE(std::isnan(all[0].times[0])) << "not drawn there";
    EXPECT_TRUE(std::isnan(all[0].geometricMean));
    EXPECT_EQ(all[0].times[1], 2);
}

TEST_F(PolicyComparisonOf, OneLineForEachTechniqueSaysWhereWeLose) {
    auto all = demo::comparePolicies(sweep({}));
    const demo::PolicySummary won = demo::summarised(all).at(0);
    EXPECT_EQ(won.technique, "pcf_disc");
    EXPECT_NEAR(won.overFixed, 2, 1e-6);
    EXPECT_NEAR(won.overEngines, 2, 1e-6);
    EXPECT_NEAR(won.overPublished, 2, 1e-6);
    EXPECT_NEAR(won.overBest, 2, 1e-6);
    EXPECT_EQ(won.smallest, 256);
    EXPECT_EQ(won.largest, 1024);
    for (auto& entry : all[0].entries) {
        if (entry.policy->name == "distance") entry.timesOurs = 0.8;
        if (entry.policy->name == "coverage") entry.timesOurs = 0.9;
        if (entry.policy->name == "paper") entry.timesOurs = NAN;    // cannot keep to the bound
        if (entry.policy->name == "bounded") entry.timesOurs = 0.5;  // ours too
    }
    const demo::PolicySummary lost = demo::summarised(all).at(0);
    EXPECT_EQ(lost.best, "distance");
    EXPECT_EQ(lost.overBest, 0.8);
    EXPECT_EQ(lost.overEngines, 0.8);
    EXPECT_TRUE(std::isnan(lost.overPublished));
    EXPECT_EQ(demo::verdict(lost.overBest), "slower");
    EXPECT_EQ(demo::verdict(1.004), "as fast");
    EXPECT_EQ(demo::verdict(1.2), "faster");
    EXPECT_EQ(demo::verdict(NAN), "n/a");
}

TEST_F(PolicyComparisonOf, TheReportBeginsWithOneHeadlineAndOneLineForEachTechnique) {
    const demo::SweepTable table = sweep({});
    const auto all = demo::comparePolicies(table);
    const auto drawn = demo::sweepHeadline(drawnDirectly(), all, table);
    EXPECT_EQ(drawn.number, "4.0x and 2.0x the speed");
    EXPECT_THAT(drawn.meaning, HasSubstr("of a fixed map of 2048 and 1024"));
    EXPECT_THAT(drawn.meaning, HasSubstr("2 scenes and pcf_disc;"));
    EXPECT_THAT(drawn.meaning, HasSubstr("0.020 RMSE"));
    EXPECT_EQ(demo::sweepHeadline({}, all, table).number, "2.00x the speed");
    EXPECT_THAT(demo::sweepHeadline({}, all, table).meaning, HasSubstr("best fixed size"));

    const std::string page =
        records::readWholeFile(demo::writeSweepReport(last_, table, std::nullopt));
    const std::string headline = "class=\"headline\"";
    EXPECT_NE(page.find(headline), std::string::npos);
    EXPECT_EQ(page.find(headline), page.rfind(headline));
    EXPECT_LT(page.find(headline), page.find("techniques.tsv"));
    EXPECT_LT(page.find("techniques.tsv"), page.find("policies.tsv"));
    EXPECT_THAT(records::readWholeFile(last_ / "summary.md"),
                HasSubstr("| pcf_disc | 2.00 | fixed | faster |"));
    EXPECT_THAT(records::readWholeFile(last_ / "policies.tsv"),
                HasSubstr("pcf_disc\tpercentile\t1.000\t256 to 1024\t"));
}

TEST_F(PolicyComparisonOf, TheStabilityTableStandsInTheReport) {
    const auto file = folder_.path() / "errors.md";
    records::writeWholeFile(file,
                            "# Title\n\nWorst of `all`\nmaps.\n\n| technique | worst |\n"
                            "|---|---|\n| vsm | a < b |\n| esm |  |\n");
    const demo::SweepTable table = sweep({});
    const std::string page = records::readWholeFile(demo::writeSweepReport(last_, table, file));
    EXPECT_THAT(page, HasSubstr("<p>Worst of all maps.</p>"));
    EXPECT_THAT(page, HasSubstr("<td>vsm</td><td>a &lt; b</td>"));
    EXPECT_THAT(page, Not(HasSubstr("|---|")));
    EXPECT_THROW(demo::writeSweepReport(last_, table, folder_.path() / "none.md"),
                 std::runtime_error);
}

TEST_F(PolicyComparisonOf, AFolderWithoutASweepIsAnError) {
    EXPECT_THROW(demo::readSweep(folder_.path() / "nothing"), std::runtime_error);
}

demo::FrameFacts factsWithoutDemand() {
    demo::FrameFacts facts;
    facts.coveredPx = 90000;
    facts.mapExtentM = 8;
    facts.distanceM = 10;
    facts.casterRadiusPx = 200;
    facts.screenEdgePx = 640;
    return facts;
}

TEST(SizingPolicy, TakesLevelsWithinTheLimits) {
    demo::FrameFacts facts = factsWithoutDemand();
    facts.demand = [](const resolution_controller::DemandRule& rule) {
        resolution_controller::DemandHistogram histogram;
        for (int i = 0; i < 100; ++i) histogram.add(rule.c * 100);
        return histogram;
    };
    const std::vector<int> levels = {128, 184, 256, 368, 512, 728, 1024, 2048, 4096};
    const auto size = [&](const char* policy, double parameter) {
        return demo::chosenSize(demo::findSizingPolicy(policy), facts, parameter, levels);
    };
    EXPECT_EQ(size("fixed", 300), 368);
    EXPECT_EQ(size("coverage", 2), 1024);  // 600, a power of two
    EXPECT_EQ(size("texels_per_pixel", 1), 512);
    EXPECT_EQ(size("distance", 1000), 1024);
    EXPECT_EQ(size("paper", 3.47), 368);  // 347
    EXPECT_EQ(size("percentile", 3.47), 368);
    EXPECT_EQ(size("fixed", 1), 128);
    EXPECT_EQ(size("fixed", 1e9), 4096);
    EXPECT_EQ(size("fixed", 1400), 2048);  // 1456 is not among the sizes
    for (const demo::SizingPolicy& policy : demo::sizingPolicies()) {
        int last = 0;
        for (int step = -demo::kPolicySteps; step <= demo::kPolicySteps; ++step) {
            const int now = demo::chosenSize(policy, facts,
                                             demo::policyParameter(policy.standard, step), levels);
            EXPECT_GE(now, last) << policy.name << ": a larger parameter takes a smaller map";
            last = now;
        }
    }
    EXPECT_THROW(demo::findSizingPolicy("nope"), std::invalid_argument);
}

TEST(SizingPolicy, ManyParametersTakeTheSizesOfEachAndAreAskedWhereThoseChangeAlone) {
    int asked = 0;
    demo::FrameFacts facts = factsWithoutDemand();
    facts.demand = [&](const resolution_controller::DemandRule& rule) {
        ++asked;
        resolution_controller::DemandHistogram histogram;
        for (int i = 1; i < 100; ++i)
            histogram.add(std::min(rule.c * 3 * static_cast<float>(i), rule.pixelBound * 700));
        return histogram;
    };
    const std::vector<int> levels = {128, 184, 256, 368, 512, 728, 1024, 2048, 4096};
    for (const demo::SizingPolicy& policy : demo::sizingPolicies()) {
        std::vector<double> parameters;
        std::vector<int> oneByOne;
        for (int step = -demo::kPolicySteps; step <= demo::kPolicySteps; ++step) {
            parameters.push_back(demo::policyParameter(policy.standard, step));
            oneByOne.push_back(demo::chosenSize(policy, facts, parameters.back(), levels));
        }
        asked = 0;
        EXPECT_EQ(demo::chosenSizes(policy, facts, parameters, levels), oneByOne) << policy.name;
        EXPECT_LE(asked, 45) << policy.name << ": of 81; 8 changes, each found in 6 halvings";
    }
    const demo::SizingPolicy& fixed = demo::findSizingPolicy("fixed");
    EXPECT_TRUE(demo::chosenSizes(fixed, facts, {}, levels).empty());
    EXPECT_EQ(demo::chosenSizes(fixed, facts, std::vector<double>{300}, levels),
              std::vector<int>{368});
}

}  // namespace
