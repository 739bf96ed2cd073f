// SPDX-License-Identifier: MIT
#include "study_app/design_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/study_app/test_designs.h"

namespace {

using study_app::checkDesign;
using study_app::Design;
using study_app::DesignCheck;
using study_app::SimulatedPopulation;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

Design oneCondition(int trials) {
    Design d;
    d.name = "one";
    d.artifactPx = {10};
    d.patterns = {{.pattern = records::Pattern::step}};
    d.trialsPerCondition = trials;
    d.catchShare = 0;
    return d;
}

// A deviation of 200 sessions is known to 5 %; five of them, wrong once in a million. The bound is
// Cramer and Rao's at the paper's curve, sqrt(0.0562 / n) log10; a good staircase comes near it.
TEST(DesignCheck, ThresholdsSpreadAsTheirTrialsAllow) {
    for (const int trials : {20, 40, 80}) {
        const DesignCheck check = checkDesign(oneCondition(trials), {}, 5);
        const double bound = std::sqrt(0.0562 / trials);
        EXPECT_GT(check.conditions[0].errorSd, 0.75 * bound) << trials;
        EXPECT_LT(check.conditions[0].errorSd, 1.25 * 1.3 * bound) << trials;
    }
}

TEST(DesignCheck, SlopesSpreadAsObserversDo) {
    const SimulatedPopulation alike{.observerSd = 0, .conditionSd = 0};
    const SimulatedPopulation differing{.observerSd = 0.3, .conditionSd = 0};
    const DesignCheck one = checkDesign(oneCondition(80), alike, 5);
    const DesignCheck many = checkDesign(oneCondition(80), differing, 5);
    EXPECT_LT(one.groups[0].spreadSd, 0.06);
    EXPECT_NEAR(many.groups[0].spreadSd, 0.3, 5 * 0.3 / std::sqrt(400.0));
    EXPECT_NEAR(one.groups[0].c, 3.47, 0.2);
    EXPECT_EQ(one.groups[0].name, "step-lit1");
}

TEST(DesignCheck, WarnsWhereTheDisplayCannotShowWhatIsAskedFor) {
    Design narrow = oneCondition(20);
    EXPECT_LT(checkDesign(narrow, {}, 5).beyondLimits, 0.1);
    narrow.radius.max = 30;
    const DesignCheck check = checkDesign(narrow, {.observerSd = 0, .conditionSd = 0}, 5);
    EXPECT_GT(check.conditions[0].beyondLimits, study_app::kLimitShare);
    EXPECT_DOUBLE_EQ(check.conditions[0].mostC, 3);
    EXPECT_DOUBLE_EQ(check.conditions[0].leastC, 0.1);
    EXPECT_THAT(checkText(check, narrow, 10),
                AllOf(HasSubstr("warning: step-a10-lit1: "), HasSubstr("cannot be shown")));
    EXPECT_THAT(checkText(checkDesign(oneCondition(20), {}, 5), oneCondition(20), 10),
                Not(HasSubstr("warning")));
}

TEST(DesignCheck, SaysWhatADisplaySubtends) {
    const std::string text = visibleRangeText(oneCondition(20), 60);
    EXPECT_THAT(text,
                AllOf(HasSubstr("a pixel is 1.00 arc minutes"), HasSubstr("10.0 degrees wide"),
                      HasSubstr("Steps of 10 px are 10.0 arc minutes")));
}

}  // namespace
