// SPDX-License-Identifier: MIT
#include "resolution_controller/texel_budget.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <limits>
#include <random>
#include <vector>

namespace {

namespace rc = resolution_controller;

rc::BudgetLight lightOf(std::int32_t need, std::int32_t lowest = 64,
                        rc::LevelRatio ratio = rc::LevelRatio::sqrtTwo) {
    return {.need = need,
            .lowest = lowest,
            .wanted = std::clamp(rc::levelAtLeast(need, ratio).value_or(8192), lowest, 8192),
            .levelRatio = ratio};
}

rc::BudgetUse share(std::vector<rc::BudgetLight>& lights, std::int64_t budget) {
    std::vector<std::uint32_t> scratch(lights.size());
    return rc::shareBudget(lights, budget, scratch);
}

std::uint64_t costOf(const std::vector<rc::BudgetLight>& lights) {
    std::uint64_t sum = 0;
    for (const auto& l : lights) sum += std::uint64_t(l.costPerTexel) * l.size * l.size;
    return sum;
}

double worstOf(const std::vector<rc::BudgetLight>& lights) {
    double worst = 0;
    for (const auto& l : lights) worst = std::max(worst, double(l.need) / l.size);
    return worst;
}

/// Every combination of levels.
double bestByTryingAll(std::vector<rc::BudgetLight> lights, std::uint64_t budget,
                       std::size_t i = 0) {
    if (i == lights.size()) {
        return costOf(lights) <= budget ? worstOf(lights) : std::numeric_limits<double>::infinity();
    }
    double best = std::numeric_limits<double>::infinity();
    for (const std::int32_t level : rc::kLevels) {
        if (level < lights[i].lowest || level > lights[i].wanted) continue;
        lights[i].size = level;
        best = std::min(best, bestByTryingAll(lights, budget, i + 1));
    }
    return best;
}

TEST(TexelBudget, IsTheLeastWorstArtifactOfAllAllotments) {
    std::mt19937_64 rng(1);
    for (int round = 0; round < 400; ++round) {
        std::vector<rc::BudgetLight> lights;
        for (int i = 0; i < 4; ++i) {
            lights.push_back(lightOf(std::int32_t(rng() % 3000), 64 << (rng() % 3)));
            lights.back().costPerTexel = 1 + std::int32_t(rng() % 4);
        }
        const auto budget = std::int64_t(rng() % 12'000'000);
        const double best = bestByTryingAll(lights, std::uint64_t(budget));
        const rc::BudgetUse use = share(lights, budget);
        ASSERT_EQ(use.used, costOf(lights));
        ASSERT_EQ(use.feasible, best < std::numeric_limits<double>::infinity());
        if (!use.feasible) continue;
        ASSERT_LE(use.used, std::uint64_t(budget));
        ASSERT_DOUBLE_EQ(worstOf(lights), best);
    }
}

TEST(TexelBudget, LeavesNoLevelThatStillFits) {
    std::mt19937_64 rng(2);
    for (int round = 0; round < 500; ++round) {
        const auto ratio = round % 2 ? rc::LevelRatio::two : rc::LevelRatio::sqrtTwo;
        std::vector<rc::BudgetLight> lights;
        for (int i = 0; i < 12; ++i)
            lights.push_back(lightOf(std::int32_t(rng() % 9000), 64, ratio));
        const auto budget = std::int64_t(1'000'000 + rng() % 60'000'000);
        const rc::BudgetUse use = share(lights, budget);
        ASSERT_TRUE(use.feasible);
        for (const auto& l : lights) {
            ASSERT_GE(l.size, l.lowest);
            ASSERT_LE(l.size, l.wanted) << "never above need";
            ASSERT_EQ(rc::levelAtLeast(l.size, ratio), l.size);
            if (l.size == l.wanted) continue;
            const std::int64_t next = *rc::levelAtLeast(l.size + 1, ratio);
            EXPECT_GT(next * next - std::int64_t(l.size) * l.size, budget - std::int64_t(use.used));
        }
    }
}

TEST(TexelBudget, GivesEverythingWhereEverythingFits) {
    std::vector<rc::BudgetLight> lights{lightOf(1000), lightOf(100), lightOf(5000)};
    const std::int64_t all = 1024 * 1024 + 128 * 128 + 5800 * 5800;
    EXPECT_EQ(share(lights, all).used, std::uint64_t(all));
    EXPECT_LT(share(lights, all - 1).used, std::uint64_t(all));
}

TEST(TexelBudget, TiesGoToTheFirst) {
    std::vector<rc::BudgetLight> lights(4, lightOf(1000));
    share(lights, 2 * 1024 * 1024 + 2 * 728 * 728);
    EXPECT_EQ(lights[0].size, 1024);
    EXPECT_EQ(lights[1].size, 1024);
    EXPECT_EQ(lights[2].size, 728);
    EXPECT_EQ(lights[3].size, 728);
}

TEST(TexelBudget, DoesNotDependOnTheOrderOfUnequalLights) {
    std::mt19937_64 rng(3);
    for (int round = 0; round < 200; ++round) {
        std::vector<rc::BudgetLight> lights;
        for (int i = 0; i < 8; ++i)
            lights.push_back(lightOf(100 + 997 * i + std::int32_t(rng() % 900)));
        auto reversed = lights;
        std::reverse(reversed.begin(), reversed.end());
        const auto budget = std::int64_t(rng() % 50'000'000);
        share(lights, budget);
        share(reversed, budget);
        EXPECT_DOUBLE_EQ(worstOf(lights), worstOf(reversed));
    }
}

TEST(TexelBudget, InfeasibleBudgetsGiveTheSmallestSizesAndSaySo) {
    for (const std::int64_t budget :
         {std::int64_t{0}, std::int64_t{-1}, std::int64_t{2 * 64 * 64 - 1},
          std::numeric_limits<std::int64_t>::min()}) {
        std::vector<rc::BudgetLight> lights{lightOf(1000), lightOf(100)};
        const rc::BudgetUse use = share(lights, budget);
        EXPECT_FALSE(use.feasible);
        EXPECT_EQ(lights[0].size, 64);
        EXPECT_EQ(lights[1].size, 64);
    }
    std::vector<rc::BudgetLight> lights{lightOf(1000), lightOf(100)};
    EXPECT_TRUE(share(lights, 2 * 64 * 64).feasible);
}

TEST(TexelBudget, NoLightsCostNothing) {
    std::vector<rc::BudgetLight> none;
    EXPECT_TRUE(share(none, 0).feasible);
    EXPECT_EQ(share(none, -3).used, 0u);
}

TEST(TexelBudget, TheMostAndDearestLightsDoNotOverflow) {
    std::vector<rc::BudgetLight> lights(
        rc::kMostLights, {.need = 65536, .lowest = 16, .wanted = 32768, .costPerTexel = 65536});
    const rc::BudgetUse use = share(lights, std::numeric_limits<std::int64_t>::max());
    EXPECT_EQ(use.used, std::uint64_t{1} << 58);
    EXPECT_TRUE(use.feasible);
    EXPECT_TRUE(share(lights, std::int64_t{1} << 57).feasible);
}

}  // namespace
