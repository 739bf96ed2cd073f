// SPDX-License-Identifier: MIT
#include "resolution_controller/audience.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>
#include <string>

namespace {

namespace rc = resolution_controller;
using testing::HasSubstr;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

constexpr std::uint32_t bit(rc::Warning warning) {
    return static_cast<std::uint32_t>(warning);
}

rc::Slope measured() {
    return {.c = 3, .encoding = rc::Encoding::srgb, .c90 = 3 * std::pow(10, 0.1 * 1.2815515655446)};
}

TEST(Audience, AsMeasuredChangesNothing) {
    const rc::AudienceSlope result = rc::slopeFor(measured(), rc::kAsMeasured);
    EXPECT_EQ(result.slope, measured());
    EXPECT_EQ(result.warnings, 0u);
    EXPECT_EQ(rc::describe(rc::kAsMeasured),
              "detected as often as in the study, for the mean observer");
}

// 2e-6: the rounding to 21 binary digits.
TEST(Audience, CriterionAndPopulationMultiply) {
    const rc::Slope slope = measured();
    const double hidden = rc::slopeFor(slope, rc::kHidden).slope.c;
    EXPECT_NEAR(hidden / rc::atCriterion(slope, 0.1).c, 1, 2e-6);
    const double forNinety = rc::slopeFor(slope, {.people = 0.9}).slope.c;
    EXPECT_NEAR(forNinety / slope.c90, 1, 2e-6);
    const rc::Slope both = rc::slopeFor(slope, rc::kHiddenForNineInTen).slope;
    EXPECT_NEAR(both.c / (hidden * forNinety / slope.c), 1, 4e-6);
    EXPECT_EQ(both.criterion, 0.1);
    EXPECT_EQ(rc::describe(rc::kHiddenForNineInTen),
              "detected in at most 10 % of looks, for 90 % of people");
}

// The observer sd put in, .1 log10, comes out at every share.
TEST(Audience, PeopleFollowALogNormalDistribution) {
    const struct {
        double share, z;
    } table[] = {{0.01, -2.326347874},
                 {0.25, -0.674489750},
                 {0.75, 0.674489750},
                 {0.95, 1.644853627},
                 {0.99, 2.326347874}};
    for (const auto& [share, z] : table) {
        const double c = rc::slopeFor(measured(), {.people = share}).slope.c;
        EXPECT_NEAR(c / (3 * std::pow(10, 0.1 * z)), 1, 2e-6) << share;
    }
}

TEST(Audience, WarnsWhereTheSlopeCannotSay) {
    rc::Slope slope = measured();
    slope.c90 = 0;
    const rc::AudienceSlope result = rc::slopeFor(slope, {.people = 0.9});
    EXPECT_EQ(result.warnings, bit(rc::Warning::populationUnknown));
    EXPECT_EQ(result.slope.c, slope.c);
    EXPECT_EQ(rc::slopeFor(slope, {}).warnings, 0u) << "the mean observer is known";
    slope.encoding = rc::Encoding::unknown;
    slope.kernel = rc::Kernel::unknown;
    EXPECT_EQ(rc::slopeFor(slope, {}).warnings,
              bit(rc::Warning::encodingUnknown) | bit(rc::Warning::kernelUnknown));
}

TEST(Audience, WarnsOfARendererThatFiltersOtherwise) {
    const rc::RendererTraits same{rc::Encoding::srgb, rc::Kernel::disc};
    EXPECT_EQ(rc::slopeFor(measured(), {}, same).warnings, 0u);
    EXPECT_EQ(rc::slopeFor(measured(), {}, {rc::Encoding::code, rc::Kernel::disc}).warnings,
              bit(rc::Warning::encodingDiffers));
    EXPECT_EQ(rc::slopeFor(measured(), {}, {rc::Encoding::srgb, rc::Kernel::sampled}).warnings,
              bit(rc::Warning::kernelDiffers));
    EXPECT_EQ(rc::slopeFor(rc::Slope{}, {}, same).warnings, bit(rc::Warning::encodingDiffers))
        << "the published slope was measured in code values";
}

TEST(Audience, EveryWarningHasItsOwnWords) {
    std::set<std::string> words;
    for (std::uint32_t b = 1; b <= rc::kAllWarnings; b *= 2) {
        words.insert(rc::text(rc::Warning(b)));
    }
    EXPECT_EQ(words.size(), 5u);
    EXPECT_EQ(words.count("unknown"), 0u);
    EXPECT_STREQ(rc::text(rc::Warning(3)), "unknown");
}

TEST(Audience, RefusesWhatIsNoAudience) {
    for (const double bad : {-0.1, 1.0, 2.0, kNan}) {
        EXPECT_THROW(rc::slopeFor({}, {.detection = bad}), std::invalid_argument) << bad;
    }
    for (const double bad : {0.0, 1.0, 0.001, kNan}) {
        EXPECT_THROW(rc::slopeFor({}, {.people = bad}), std::invalid_argument) << bad;
    }
    EXPECT_THROW(rc::slopeFor({.c = kNan}, {}), std::invalid_argument);
    // A slope that overflows for this audience says so instead of handing out infinity.
    EXPECT_THROW(rc::slopeFor({.beta = 1e-3}, rc::kHidden), std::invalid_argument);
}

}  // namespace
