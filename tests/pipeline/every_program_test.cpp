// SPDX-License-Identifier: MIT
// The conventions that hold for each program: --help, --version, exit codes, one located sentence.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "tests/run_command.h"

namespace {

using testing::HasSubstr;
using testing::StartsWith;

class EveryProgram : public testing::TestWithParam<std::string> {};

int lines(const std::string& text) {
    return static_cast<int>(std::count(text.begin(), text.end(), '\n'));
}

TEST_P(EveryProgram, HelpsAndSucceeds) {
    const tests::CommandResult result = tests::runProgram(GetParam(), {"--help"});
    EXPECT_EQ(result.exitCode, 0);
    EXPECT_THAT(result.out, HasSubstr("--version"));
    EXPECT_EQ(result.err, "");
}

TEST_P(EveryProgram, SaysItsVersion) {
    const tests::CommandResult result = tests::runProgram(GetParam(), {"--version"});
    EXPECT_EQ(result.exitCode, 0);
    EXPECT_THAT(result.out, HasSubstr(GetParam()));
    EXPECT_EQ(lines(result.out), 1);
}

TEST_P(EveryProgram, CallsAnUnknownOptionBadUsageInOneSentence) {
    const tests::CommandResult result = tests::runProgram(GetParam(), {"--no-such-option"});
    EXPECT_EQ(result.exitCode, 2);
    EXPECT_THAT(result.err, StartsWith(GetParam() + ": "));
    EXPECT_THAT(result.err, HasSubstr("--no-such-option"));
    EXPECT_EQ(lines(result.err), 1);
    EXPECT_EQ(result.out, "");
}

INSTANTIATE_TEST_SUITE_P(Programs, EveryProgram,
                         testing::Values("study_app", "fit_slope", "reference_filter",
                                         "shadow_demo", "shadow_bench"),
                         [](const auto& parameter) { return parameter.param; });

}  // namespace
