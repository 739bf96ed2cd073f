// SPDX-License-Identifier: MIT
#include "program/progress.h"

#include <gtest/gtest.h>

#include <thread>
#include <vector>

namespace {

using program::Progress;
using program::progressLine;

TEST(Progress, TellsTheTimeLeftAtThePaceSoFar) {
    EXPECT_EQ(progressLine("fitting", 50, 200, 10), "fitting: 50 of 200 (25 %), 30 s left");
    EXPECT_EQ(progressLine("fitting", 1, 100, 10), "fitting: 1 of 100 (1 %), 16 min 30 s left");
    EXPECT_EQ(progressLine("fitting", 1, 1000, 10), "fitting: 1 of 1000 (0 %), 2 h 46 min left");
}

TEST(Progress, ClaimsNoTimeWhereNoneCanBeKnown) {
    EXPECT_EQ(progressLine("x", 0, 10, 5), "x: 0 of 10 (0 %)");
    EXPECT_EQ(progressLine("x", 10, 10, 5), "x: 10 of 10 (100 %)");
    EXPECT_EQ(progressLine("x", 12, 10, 5), "x: 12 of 10 (120 %)");
    EXPECT_EQ(progressLine("x", 3, 0, 5), "x: 3 of 0");
}

TEST(Progress, KeepsQuietOverShortWork) {
    testing::internal::CaptureStderr();
    {
        Progress progress("x", 1000);
        std::vector<std::thread> workers;
        for (int i = 0; i < 4; ++i)
            workers.emplace_back([&] {
                for (int k = 0; k < 250; ++k) progress.advance();
            });
        for (std::thread& worker : workers) worker.join();
    }
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

}  // namespace
