// SPDX-License-Identifier: MIT
#include "resolution_controller/slope.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "resolution_controller/portable_power.h"

namespace {

namespace rc = resolution_controller;
using testing::HasSubstr;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

TEST(Slope, DefaultIsThePublishedOne) {
    const rc::Slope slope;
    EXPECT_EQ(rc::validate(slope), "");
    EXPECT_EQ(slope.c, 3.47);
    EXPECT_EQ(rc::describe(slope),
              "c = 3.47 (detected with probability 0.6465 at r = c a; 2AFC, filtered in code "
              "values, beta 3.5)");
}

TEST(Slope, HidingFromMoreObserversAsksForALargerC) {
    const rc::Slope slope;
    const rc::Slope hidden = rc::atCriterion(slope, 0.10);
    EXPECT_NEAR(hidden.c / slope.c, 1.92, 0.005);
    EXPECT_EQ(hidden.criterion, 0.10);
    EXPECT_NEAR(rc::atCriterion(hidden, slope.criterion).c, slope.c, 1e-12);
    double last = std::numeric_limits<double>::infinity();
    for (double f = 0.01; f < 1; f += 0.01) {
        const double c = rc::atCriterion(slope, f).c;
        EXPECT_LT(c, last);
        last = c;
    }
}

TEST(Slope, RefusesWhatIsNoSlope) {
    EXPECT_EQ(rc::validate(rc::Slope{.c = -1}), "slope.c is -1: must be finite and greater than 0");
    for (const double c : {0.0, kNan, std::numeric_limits<double>::infinity()}) {
        EXPECT_THAT(rc::validate(rc::Slope{.c = c}), HasSubstr("slope.c is"));
    }
    for (const double f : {0.0, 1.0, -0.5, kNan}) {
        EXPECT_THAT(rc::validate(rc::Slope{.criterion = f}), HasSubstr("slope.criterion is"));
        EXPECT_THROW(rc::atCriterion({}, f), std::invalid_argument);
    }
    for (const double beta : {0.0, -3.5, kNan}) {
        EXPECT_THAT(rc::validate(rc::Slope{.beta = beta}), HasSubstr("slope.beta is"));
        EXPECT_THROW(rc::atCriterion({.beta = beta}, 0.1), std::invalid_argument);
    }
}

TEST(Slope, RefusesWhatIsNoSlopeInItsFurtherFields) {
    EXPECT_THAT(rc::validate(rc::Slope{.c90 = -1}), HasSubstr("slope.c90 is -1"));
    EXPECT_THAT(rc::validate(rc::Slope{.c90 = kNan}), HasSubstr("slope.c90 is nan"));
    EXPECT_EQ(rc::validate(rc::Slope{.c90 = 4}), "");
    for (const double e : {kNan, 4.1, -5.0}) {
        EXPECT_THAT(rc::validate(rc::Slope{.contrastExponent = e}),
                    HasSubstr("slope.contrastExponent is"));
    }
    EXPECT_THAT(rc::validate(rc::Slope{.major = 2}), HasSubstr("slope.major is 2: must be 1"));
    EXPECT_THAT(rc::validate(rc::Slope{.task = rc::Task(9)}), HasSubstr("slope.task is 9"));
    EXPECT_THAT(rc::validate(rc::Slope{.encoding = rc::Encoding(9)}),
                HasSubstr("slope.encoding is 9"));
    EXPECT_THAT(rc::validate(rc::Slope{.kernel = rc::Kernel(9)}), HasSubstr("slope.kernel is 9"));
}

TEST(Slope, CriterionMovesTheNinetiethObserverAlike) {
    const rc::Slope hidden = rc::atCriterion({.c90 = 4.5}, 0.1);
    EXPECT_NEAR(hidden.c90 / 4.5, hidden.c / 3.47, 1e-12);
}

// Tolerance: a few units in the last place of a double.
TEST(PortablePower, IsThePower) {
    for (double x = 1e-6; x < 1e6; x *= 1.37) {
        EXPECT_NEAR(rc::portableLog2(x), std::log2(x), 1e-14);
        for (const double y : {-4.0, -0.3, 0.0, 0.5, 1.0, 2.7, 4.0}) {
            EXPECT_NEAR(rc::portablePower(x, y) / std::pow(x, y), 1, 2e-14) << x << "^" << y;
        }
    }
    EXPECT_EQ(rc::portableLog2(1), 0);
    EXPECT_EQ(rc::portableExp2(10), 1024);
}
// Settled at compile time, so no C library has a say in it.
static_assert(rc::portablePower(0.25, 0.5) == 0.5);

TEST(Slope, ContrastFactorFollowsTheExponentDownToTheLeastContrast) {
    EXPECT_NEAR(rc::contrastFactor(0.5, 0.2), std::pow(0.5, 0.2), 1e-14);
    EXPECT_EQ(rc::contrastFactor(0, 0.2), rc::contrastFactor(0.02, 0.2));
    EXPECT_EQ(rc::contrastFactor(1, 3), 1);
    EXPECT_EQ(rc::contrastFactor(0.3, 0), 1);
    EXPECT_GT(rc::contrastFactor(0.3, -1), 3);
    for (const double bad : {kNan, -0.1, 1.5, std::numeric_limits<double>::infinity()}) {
        EXPECT_EQ(rc::contrastFactor(bad, 0.5), 1) << bad;
        EXPECT_TRUE(std::isfinite(rc::contrastFactor(0.5, bad))) << bad;
    }
}

}  // namespace
