// SPDX-License-Identifier: MIT
// The program, as its user runs it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "tests/run_command.h"

namespace {

using testing::HasSubstr;
using testing::StartsWith;
using tests::CommandResult;

CommandResult run(const std::vector<std::string>& arguments) {
    return tests::runProgram("reference_filter", arguments);
}

std::vector<std::map<std::string, std::string>> rowsOf(const std::string& table) {
    std::vector<std::map<std::string, std::string>> rows;
    std::vector<std::string> head;
    std::istringstream lines(table);
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with("#")) continue;
        std::vector<std::string> cells;
        std::istringstream fields(line);
        for (std::string cell; std::getline(fields, cell, '\t');) cells.push_back(cell);
        if (head.empty()) {
            head = cells;
            continue;
        }
        std::map<std::string, std::string> row;
        EXPECT_EQ(cells.size(), head.size()) << line;
        for (std::size_t i = 0; i < std::min(cells.size(), head.size()); ++i)
            row[head[i]] = cells[i];
        rows.push_back(row);
    }
    return rows;
}

TEST(ReferenceFilter, PrintsThePublishedStudysConditions) {
    const CommandResult result = run({"--all", "--kernel", "box"});
    ASSERT_EQ(result.exitCode, 0) << result.err;
    EXPECT_THAT(result.out, StartsWith("# program   reference_filter "));
    EXPECT_THAT(result.out, HasSubstr("up to 600 px"));
    const auto rows = rowsOf(result.out);
    ASSERT_EQ(rows.size(), 16u);
    for (const auto& row : rows) {
        const double a = std::stod(row.at("artifact_px")), lit = std::stod(row.at("lit_level"));
        const double spacing = row.at("pattern") == "step" ? 600 : a;
        // The box's exact formula; the grid of radii and pixels beside the maximum cost up to 3/4
        // px.
        EXPECT_NEAR(std::stod(row.at("half_code_px")), std::sqrt(255 * lit * a * spacing / 16),
                    0.75);
        EXPECT_LE(std::stod(row.at("one_code_px")), std::stod(row.at("half_code_px")));
    }
}

TEST(ReferenceFilter, TakesListsAndScaleFreeSpacing) {
    const auto rows = rowsOf(
        run({"--pattern", "step,stair", "--artifact", "8", "10", "--spacing", "8a", "--identical"})
            .out);
    ASSERT_EQ(rows.size(), 4u);
    EXPECT_EQ(rows[0].at("riser_spacing_px"), "64");
    EXPECT_EQ(rows[1].at("riser_spacing_px"), "80");
    EXPECT_EQ(rows[2].at("riser_spacing_px"), "n/a");
    EXPECT_EQ(rows[0].at("identical_px"), "n/a");
    EXPECT_EQ(rows[0].at("encoding"), "code");
}

TEST(ReferenceFilter, SaysWhatIsNotReached) {
    const auto rows = rowsOf(run({"--artifact", "30", "--max-radius", "20"}).out);
    ASSERT_EQ(rows.size(), 1u);
    EXPECT_EQ(rows[0].at("half_code_px"), "n/a");
}

TEST(ReferenceFilter, TellsBadUsageFromBadValues) {
    const auto expect = [](int exitCode, const std::vector<std::string>& arguments,
                           const std::string& sentence) {
        const CommandResult result = run(arguments);
        EXPECT_EQ(result.exitCode, exitCode) << sentence;
        EXPECT_THAT(result.err, HasSubstr(sentence));
        EXPECT_EQ(result.out, "") << sentence;
    };
    expect(2, {"--kernel", "tent"}, "tent not in {disc,box,gaussian}");
    expect(2, {"--pattern", "frame"}, "frame not in {stair,step,line}");
    expect(2, {"--artifact", "wide"}, "--artifact");
    expect(2, {"--all", "--pattern", "step"}, "excludes");
    expect(1, {"--artifact", "0"}, "artifact size is 0 px: must be in (0, 65536]");
    expect(1, {"--artifact", "nan"}, "artifact size is nan px");
    expect(1, {"--lit-level", "1.5"}, "lit level is 1.5: must be in [0, 1]");
    expect(1, {"--window", "0"}, "window is 0 px");
    expect(1, {"--max-radius", "-3"}, "bound of the radius is -3 px");
    expect(1, {"--pattern", "line"}, "--pattern line: needs an --angle");
    expect(1, {"--pattern", "line", "--angle", "46"}, "angle of the line is 46 degrees");
    expect(1, {"--angle", "20"}, "--angle: only the pattern line");
    expect(1, {"--spacing", "8a"}, "--spacing: only the pattern step");
}

}  // namespace
