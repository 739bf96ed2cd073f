// SPDX-License-Identifier: MIT
#include "study_app/trial_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <set>
#include <vector>

#include "tests/study_app/test_designs.h"

namespace {

using records::Task;
using study_app::Design;
using study_app::TrialSlot;

std::vector<std::size_t> staircaseTrials(const std::vector<TrialSlot>& order) {
    std::vector<std::size_t> result;
    for (const TrialSlot& slot : order) {
        if (!slot.isCatch) result.push_back(slot.condition);
    }
    return result;
}

TEST(TrialOrder, GivesEveryConditionItsTrialsInBlocks) {
    for (const Task task : {Task::twoAfc, Task::yesNo}) {
        const Design design = tests::variedDesign(task);
        const std::size_t count = study_app::conditions(design).size();
        const auto order = study_app::trialOrder(design, 7);
        EXPECT_EQ(order.size(), static_cast<std::size_t>(study_app::totalTrials(design)));
        const auto trials = staircaseTrials(order);
        ASSERT_EQ(trials.size(), count * 6);
        for (std::size_t block = 0; block < 6; ++block) {
            const auto begin = trials.begin() + static_cast<std::ptrdiff_t>(block * count);
            const std::set<std::size_t> inBlock(begin, begin + static_cast<std::ptrdiff_t>(count));
            EXPECT_EQ(inBlock.size(), count) << "block " << block;
        }
    }
}

TEST(TrialOrder, HoldsTheCatchShareToWithinOneTrial) {
    Design design = tests::variedDesign(Task::yesNo);
    for (const double share : {0.0, 0.01, 0.1, 1.0 / 3, 0.5}) {
        design.catchShare = share;
        const auto order = study_app::trialOrder(design, 1);
        double catches = 0;
        for (const TrialSlot& slot : order) catches += slot.isCatch;
        EXPECT_NEAR(catches, share * static_cast<double>(order.size()), 1) << share;
    }
}

TEST(TrialOrder, SpreadsCatchTrialsOverTheSession) {
    Design design = tests::variedDesign(Task::yesNo);
    design.catchShare = 0.1;
    const auto order = study_app::trialOrder(design, 3);
    const auto catches = static_cast<std::size_t>(study_app::catchTrials(design));
    std::vector<int> inStretch(catches);
    for (std::size_t k = 0; k < order.size(); ++k) {
        if (!order[k].isCatch) continue;
        std::size_t stretch = k * catches / order.size();  // may be off by one at its end
        while ((stretch + 1) * order.size() / catches <= k) ++stretch;
        ++inStretch[stretch];
    }
    for (const int count : inStretch) EXPECT_EQ(count, 1);
}

TEST(TrialOrder, TakesObviousCatchTrialsIn2afcAndAllConditionsInYesNo) {
    for (const Task task : {Task::twoAfc, Task::yesNo}) {
        Design design = tests::variedDesign(task);
        design.catchShare = 0.5;
        const auto conditions = study_app::conditions(design);
        std::map<std::size_t, int> times;
        for (const TrialSlot& slot : study_app::trialOrder(design, 5)) {
            if (slot.isCatch) ++times[slot.condition];
        }
        const std::size_t expected =
            task == Task::twoAfc ? conditions.size() / 2 : conditions.size();
        EXPECT_EQ(times.size(), expected);
        for (const auto& [condition, count] : times) {
            if (task == Task::twoAfc) {
                EXPECT_EQ(conditions[condition].artifactPx, 8);
            }
        }
        // In turn: no condition is two ahead of another.
        int least = 1000, most = 0;
        for (const auto& [condition, count] : times) {
            least = std::min(least, count);
            most = std::max(most, count);
        }
        EXPECT_LE(most - least, 1);
    }
}

TEST(TrialOrder, FollowsFromTheSeedAlone) {
    const Design design = tests::variedDesign(Task::twoAfc);
    EXPECT_EQ(study_app::trialOrder(design, 9), study_app::trialOrder(design, 9));
    std::set<std::vector<std::size_t>> orders;
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
        orders.insert(staircaseTrials(study_app::trialOrder(design, seed)));
    }
    EXPECT_EQ(orders.size(), 100u);  // 32! orders of the first block alone
}

// Chi-squared over first conditions of 3,200 seeds, 31 degrees of freedom: beyond 70.7 once in
// 10,000 samples of fair draws (seeds fixed, so it passes always or never).
TEST(TrialOrder, StartsWithEveryConditionEquallyOften) {
    Design design = tests::variedDesign(Task::twoAfc);
    design.catchShare = 0;
    std::vector<int> first(study_app::conditions(design).size());
    ASSERT_EQ(first.size(), 32u);
    for (std::uint64_t seed = 0; seed < 3200; ++seed) {
        ++first[study_app::trialOrder(design, seed).front().condition];
    }
    double chiSquared = 0;
    for (const int count : first) chiSquared += (count - 100.0) * (count - 100.0) / 100;
    EXPECT_LT(chiSquared, 70.7);
}

}  // namespace
