// SPDX-License-Identifier: MIT
#include "records/slope_file.h"

#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <random>
#include <stdexcept>

#include "tests/records/random_records.h"
#include "tests/records/scratch_folder.h"

namespace {

using namespace records;
using nlohmann::json;
using testing::HasSubstr;
using testing::StartsWith;
using tests::errorOf;

Slope exampleSlope() {
    Slope slope;
    slope.c = {.estimate = 3.41, .ci95 = Interval{.low = 3.2, .high = 3.63}};
    slope.worstGroup = "step, lit 1";
    slope.cOverall = {.estimate = 2.9, .ci95 = {}};
    slope.c90 = {.estimate = 4.5, .ci95 = {}};
    slope.criterion = 0.64646464;
    slope.percentCorrect = 82;
    slope.kernel = "disc";
    slope.beta = 3.5;
    slope.kappa = {.estimate = 1, .ci95 = {}};
    slope.groups = {{.name = "step, lit 1",
                     .pattern = Pattern::step,
                     .angleDeg = {},
                     .litLevel = 1,
                     .c = slope.c,
                     .trials = 640}};
    slope.observers = 10;
    slope.trials = 6400;
    slope.method = "simulated";
    slope.context = currentRunContext("fit_slope", {"fit_slope", "data"});
    return slope;
}

TEST(SlopeFile, EverySlopeThatCanBeWrittenReadsBackExactly) {
    const tests::ScratchFolder folder;
    std::mt19937_64 random(2);
    for (int round = 0; round < 100; ++round) {
        const Slope slope = tests::randomSlope(random);
        writeSlope(folder / "slope.json", slope);
        ASSERT_EQ(readSlope(folder / "slope.json"), slope);
    }
}

TEST(SlopeFile, SaysWhatTheNumberMeansInOneSentence) {
    Slope slope = exampleSlope();
    EXPECT_EQ(describe(slope),
              "c = 3.41 [3.20, 3.63] (r = c a; F* = .6465, 82 % correct in 2AFC; disc; srgb; "
              "beta 3.5; worst group step, lit 1)");
    slope.c.ci95.reset();
    slope.task = Task::yesNo;
    slope.encoding = Encoding::code;
    EXPECT_EQ(describe(slope),
              "c = 3.41 (no interval) (r = c a; F* = .6465, 82 % seen in yes/no; disc; code; "
              "beta 3.5; worst group step, lit 1)");
    EXPECT_EQ(describe(slope), describeValue(slope) + " (" + describeTerms(slope) + ")");
    slope.encoding.reset();
    EXPECT_THAT(describeTerms(slope), HasSubstr("; disc; encoding unknown; beta 3.5"));
}

TEST(SlopeFile, RefusesToWriteWhatItWouldNotRead) {
    const tests::ScratchFolder folder;
    const auto refusal = [&](const std::function<void(Slope&)>& spoil) {
        Slope slope = exampleSlope();
        spoil(slope);
        return errorOf<std::invalid_argument>([&] { writeSlope(folder / "slope.json", slope); });
    };
    EXPECT_THAT(refusal([](Slope& s) { s.c.estimate = std::nan(""); }),
                HasSubstr("slope.json: field c.estimate"));
    EXPECT_THAT(refusal([](Slope& s) { s.beta = HUGE_VAL; }), HasSubstr("psychometric_slope"));
    EXPECT_THAT(refusal([](Slope& s) { s.worstGroup = "none"; }),
                HasSubstr("worst_group: \"none\": must be the name of one of the groups"));
    EXPECT_FALSE(std::filesystem::exists(folder / "slope.json"));
    EXPECT_EQ(refusal([](Slope&) {}), "(no error)");
}

// The file as JSON, spoilt in one place, and the sentence that follows.
TEST(SlopeFile, NamesFileFieldValueAndRule) {
    const tests::ScratchFolder folder;
    writeSlope(folder / "slope.json", exampleSlope());
    const json good = json::parse(tests::readBytes(folder / "slope.json"));
    const auto failure = [&](const char* pointer, const json& value) {
        json bad = good;
        bad[json::json_pointer(pointer)] = value;
        return errorOf<std::runtime_error>([&] { parseSlope(bad.dump(), "s.json"); });
    };
    EXPECT_EQ(failure("/c/estimate", 0),
              "s.json: field c.estimate: 0: must be a number greater than 0");
    EXPECT_EQ(failure("/c/estimate", "3"),
              "s.json: field c.estimate: \"3\": must be a number greater than 0");
    EXPECT_EQ(failure("/c/estimate", nullptr),
              "s.json: field c.estimate: null: must be a number greater than 0");
    EXPECT_EQ(failure("/c/ci95", {4, 3}),
              "s.json: field c.ci95: an array: must be [low, high] with low <= high");
    EXPECT_EQ(failure("/c/ci95", {3}),
              "s.json: field c.ci95: an array: must be [low, high] with low <= high");
    EXPECT_EQ(failure("/c/ci95", {-1, 3}),
              "s.json: field c.ci95[0]: -1: must be a number greater than 0");
    EXPECT_EQ(failure("/criterion", 1),
              "s.json: field criterion: 1: must be a number greater than 0 and less than 1");
    EXPECT_THAT(failure("/task", "3afc"), HasSubstr("field task: \"3afc\": must be one of 2afc"));
    EXPECT_THAT(failure("/groups/0/c/estimate", -2), HasSubstr("field groups[0].c.estimate: -2"));
    EXPECT_THAT(failure("/observers", 0), HasSubstr("field observers: 0"));
    EXPECT_THAT(failure("/kappa_p_value", 1.5), HasSubstr("field kappa_p_value: 1.5"));
    EXPECT_THAT(failure("/schema/major", 2), HasSubstr("this program reads major version 1"));
    EXPECT_THAT(failure("/context/command", "x"), HasSubstr("field context.command"));
    EXPECT_EQ(failure("/a_field_of_a_later_minor", 1), "(no error)");
}

TEST(SlopeFile, NamesEveryMissingField) {
    const tests::ScratchFolder folder;
    writeSlope(folder / "slope.json", exampleSlope());
    const json good = json::parse(tests::readBytes(folder / "slope.json"));
    const std::set<std::string> mayBeAbsent = {"kappa_p_value", "contrast_exponent", "px_per_deg"};
    for (const auto& [key, value] : good.items()) {
        json bad = good;
        bad.erase(key);
        const std::string error =
            errorOf<std::runtime_error>([&] { parseSlope(bad.dump(), "s.json"); });
        EXPECT_EQ(error, mayBeAbsent.contains(key) ? "(no error)"
                                                   : "s.json: field " + key + ": is missing");
    }
}

TEST(SlopeFile, MissingFileIsALocatedError) {
    EXPECT_THAT(errorOf<std::runtime_error>([] { readSlope("none/slope.json"); }),
                StartsWith("none/slope.json: cannot be read: No such file"));
}

}  // namespace
