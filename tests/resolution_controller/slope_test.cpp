// SPDX-License-Identifier: MIT
#include "resolution_controller/slope.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <stdexcept>

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

}  // namespace
