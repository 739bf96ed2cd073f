// SPDX-License-Identifier: MIT
#include "resolution_controller/levels.h"

#include <gmock/gmock.h>

#include <bit>
#include <cmath>

namespace {

namespace rc = resolution_controller;

TEST(Levels, AreMultiplesOfEightAtLeastSqrtTwoApart) {
    for (std::size_t i = 0; i < rc::kLevels.size(); ++i) {
        const double ideal = 16 * std::exp2(double(i) / 2);
        EXPECT_EQ(rc::kLevels[i] % 8, 0);
        EXPECT_GE(rc::kLevels[i], ideal - 1e-9);
        EXPECT_LT(rc::kLevels[i], ideal + 8);
    }
}

TEST(Levels, NeedRoundsUpAndLimitsRoundDown) {
    for (const auto ratio : {rc::LevelRatio::sqrtTwo, rc::LevelRatio::two}) {
        for (std::int32_t texels = 16; texels <= 32768; texels += texels < 3000 ? 1 : 97) {
            const auto up = rc::levelAtLeast(texels, ratio), down = rc::levelAtMost(texels, ratio);
            ASSERT_TRUE(up && down);
            EXPECT_GE(*up, texels);
            EXPECT_LE(*down, texels);
            EXPECT_EQ(rc::levelAtLeast(*up, ratio), up);
            EXPECT_EQ(rc::levelAtMost(*down, ratio), down);
            // Nothing lies between.
            EXPECT_TRUE(*up == *down || *rc::levelAtLeast(*down + 1, ratio) == *up);
            if (ratio == rc::LevelRatio::two) {
                EXPECT_TRUE(std::has_single_bit(unsigned(*up)));
                EXPECT_TRUE(std::has_single_bit(unsigned(*down)));
            }
        }
    }
}

TEST(Levels, EndWhereTheyEnd) {
    for (const auto ratio : {rc::LevelRatio::sqrtTwo, rc::LevelRatio::two}) {
        EXPECT_EQ(rc::levelAtLeast(-5, ratio), rc::kSmallestLevel);
        EXPECT_EQ(rc::levelAtLeast(32769, ratio), std::nullopt);
        EXPECT_EQ(rc::levelAtMost(15, ratio), std::nullopt);
        EXPECT_EQ(rc::levelAtMost(-1, ratio), std::nullopt);
        EXPECT_EQ(rc::levelAtMost(1'000'000'000'000, ratio), rc::kLargestLevel);
    }
}

static_assert(rc::levelAtLeast(1025, rc::LevelRatio::sqrtTwo) == 1456);
static_assert(rc::levelAtLeast(1025, rc::LevelRatio::two) == 2048);
static_assert(rc::levelAtMost(2047, rc::LevelRatio::sqrtTwo) == 1456);

}  // namespace
