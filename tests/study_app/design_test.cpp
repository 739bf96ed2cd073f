// SPDX-License-Identifier: MIT
#include "study_app/design.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "quest/random.h"
#include "records/json_document.h"
#include "study_app/design_file.h"
#include "study_app/random_stream.h"
#include "study_app/session.h"
#include "study_app/trial_stimulus.h"
#include "tests/study_app/bad_designs.h"
#include "tests/study_app/mutated_designs.h"
#include "tests/study_app/test_designs.h"

namespace {

using nlohmann::json;
using study_app::Design;
using testing::AllOf;
using testing::HasSubstr;
using tests::BadDesign;
using tests::badDesigns;
using tests::patched;
using tests::smallDesign;
using tests::without;

std::string errorOf(const json& design) {
    try {
        study_app::designFromJson(design, "small.json");
    } catch (const std::runtime_error& error) {
        return error.what();
    }
    return "no error";
}

TEST(Design, RefusesContradictionsWithFieldValueAndRule) {
    for (const BadDesign& bad : badDesigns()) {
        const std::string error = errorOf(bad.design);
        EXPECT_THAT(error, HasSubstr("small.json")) << bad.claim;
        for (const std::string& part : bad.parts) EXPECT_THAT(error, HasSubstr(part)) << bad.claim;
    }
}

// Run under the sanitizers this is a small fuzzer with a fixed seed.
TEST(Design, MutatedAtRandomGivesALocatedErrorOrASessionThatShowsImages) {
    std::mt19937_64 random(31);
    int accepted = 0;
    for (int round = 0; round < 4000; ++round) {
        const json changed =
            tests::mutated(random, round % 2 == 0 ? tests::fullDesign() : smallDesign());
        Design design;
        try {
            design = study_app::designFromJson(changed, "small.json");
        } catch (const std::runtime_error& error) {
            ASSERT_THAT(error.what(), testing::StartsWith("small.json: ")) << changed.dump();
            continue;
        }
        ++accepted;
        const json normalised = study_app::normalisedJson(design);
        ASSERT_EQ(study_app::designFromJson(normalised, "again"), design) << changed.dump();
        if (study_app::totalTrials(design) > 500 || design.windowPx > 200) continue;
        const study_app::Session session(design, 1);
        ASSERT_NO_THROW(study_app::trialImages(session.next(), design)) << changed.dump();
    }
    EXPECT_GT(accepted, 150) << "too few to say anything about what is accepted";
}

TEST(Design, TakesTheSmallestFile) {
    EXPECT_EQ(errorOf(smallDesign()), "no error");
}

TEST(Design, ConstructedInCodeIsHeldToTheSameRules) {
    Design design = tests::variedDesign(records::Task::twoAfc);
    EXPECT_EQ(study_app::validate(design), "");
    design.catchShare = std::nan("");
    EXPECT_THAT(study_app::validate(design), HasSubstr("catch_share: nan"));
    design = tests::variedDesign(records::Task::twoAfc);
    design.patterns[0].pattern = records::Pattern::frame;
    EXPECT_THAT(study_app::validate(design), HasSubstr("patterns[0]"));
}

TEST(Design, LocatesABrokenFile) {
    EXPECT_THROW(study_app::readDesign("/nowhere/design.json"), std::runtime_error);
    try {
        study_app::designFromJson(records::parseJson("{\n  \"name\": }", "broken.json"),
                                  "broken.json");
        FAIL() << "no error";
    } catch (const std::runtime_error& error) {
        EXPECT_THAT(error.what(), AllOf(HasSubstr("broken.json"), HasSubstr("line 2")));
    }
}

TEST(ShippedDesigns, ReadAndAreNamedAsTheirFiles) {
    for (const char* name : {"paper16", "paper24", "quick"}) {
        EXPECT_EQ(tests::shippedDesign(name).name, name);
    }
}

TEST(ShippedDesigns, PaperHasItsSixteenConditions) {
    const Design design = tests::shippedDesign("paper16");
    EXPECT_EQ(study_app::conditions(design).size(), 16u);
    EXPECT_EQ(study_app::totalTrials(design), 640);
    EXPECT_EQ(design.encoding, records::Encoding::code);
    const quest::QuestParameters q = study_app::staircaseParameters(design);
    EXPECT_EQ(q, [] {
        quest::QuestParameters paper = quest::kPaperParameters;
        paper.priorMean = -std::log10(3.0);
        return paper;
    }());
    EXPECT_EQ(q.pThreshold, 0.82);
    EXPECT_NEAR(quest::criterion(q), quest::kPaperCriterion, 1e-15);  // rounding of one division
}

TEST(ShippedDesigns, Paper24AddsTheStepInTheSecondDirection) {
    std::set<std::string> names;
    int vertical = 0, horizontal = 0;
    for (const study_app::Condition& c : study_app::conditions(tests::shippedDesign("paper24"))) {
        names.insert(c.name);
        vertical += c.silhouette.orientation == study_app::Orientation::vertical;
        horizontal += c.silhouette.orientation == study_app::Orientation::horizontal;
    }
    EXPECT_EQ(names.size(), 24u);
    EXPECT_EQ(vertical, 8);
    EXPECT_EQ(horizontal, 8);
}

TEST(ShippedDesigns, AreFoundBesideTheProgramsByName) {
    std::vector<std::string> names;
    for (const study_app::ShippedDesign& d : study_app::shippedDesigns()) names.push_back(d.name);
    EXPECT_THAT(names, testing::ElementsAre("paper16", "paper24", "quick"));
    EXPECT_EQ(study_app::readDesign(study_app::findDesign("quick")), tests::shippedDesign("quick"));
}

TEST(ShippedDesigns, AreLookedForWhereTheEnvironmentSays) {
    setenv("STAIRWELL_DATA", "/nowhere", 1);
    try {
        study_app::findDesign("quick");
        FAIL() << "no error";
    } catch (const std::runtime_error& error) {
        EXPECT_THAT(error.what(), HasSubstr("/nowhere/designs/quick.json"));
    }
    EXPECT_THROW(study_app::shippedDesigns(), std::runtime_error);
    unsetenv("STAIRWELL_DATA");
}

TEST(Design, FillsInDefaults) {
    const Design d = study_app::designFromJson(smallDesign(), "small.json");
    EXPECT_EQ(d.task, records::Task::twoAfc);
    EXPECT_EQ(d.encoding, records::Encoding::srgb);
    EXPECT_EQ(d.windowPx, 600);
    EXPECT_EQ(d.kernels, std::vector<std::string>{"disc"});
    EXPECT_EQ(d.radius, (study_app::RadiusLimits{.min = 1, .max = 300, .step = 0.25}));
    EXPECT_EQ(d.staircase, quest::kDefaultParameters);
}

TEST(Design, PresetKeepsItsCriterionInYesNo) {
    for (const char* preset : {"default", "paper"}) {
        json j = patched("/quest", preset);
        j["task"] = "yes_no";
        const quest::QuestParameters q =
            study_app::staircaseParameters(study_app::designFromJson(j, "yes_no.json"));
        EXPECT_EQ(q.gamma, study_app::kYesNoGamma);
        EXPECT_NEAR(quest::criterion(q), quest::kPaperCriterion, 1e-14);  // rounding there and back
        // Where trials carry information in yes/no.
        EXPECT_GT(q.pThreshold, 0.6);
        EXPECT_LT(q.pThreshold, 0.8);
    }
}

TEST(Design, GivenFieldsOverrideThePreset) {
    const Design d = study_app::designFromJson(
        patched("/quest", {{"preset", "paper"}, {"prior_sd", 0.7}, {"guess_ratio", 2}}), "x");
    EXPECT_EQ(d.staircase.priorSd, 0.7);
    EXPECT_EQ(d.staircase.pThreshold, 0.82);
    EXPECT_EQ(study_app::staircaseParameters(d).priorMean, -std::log10(2.0));
}

TEST(Design, ConditionsAreTheFullCrossingWithTrueAngles) {
    const Design d = tests::variedDesign(records::Task::twoAfc);
    const auto conditions = study_app::conditions(d);
    EXPECT_EQ(conditions.size(), 2u * 4 * 2 * 2);
    std::set<std::string> names;
    for (const study_app::Condition& c : conditions) {
        names.insert(c.name);
        if (c.silhouette.pattern == records::Pattern::stair) {
            EXPECT_EQ(c.angleDeg, 45);
        }
        if (c.silhouette.pattern == records::Pattern::line) {
            EXPECT_EQ(c.angleDeg, 22.5);
        }
        if (c.silhouette.pattern == records::Pattern::step) {
            EXPECT_NEAR(std::tan(c.angleDeg * M_PI / 180), c.artifactPx / 600.0, 1e-15);
        }
    }
    EXPECT_EQ(names.size(), conditions.size());
    EXPECT_TRUE(names.contains("step-vertical-a8-lit0.25-poisson4"));
    EXPECT_TRUE(names.contains("line22.5-a3-lit1-disc"));
}

TEST(Design, ExamplesOfTheDocumentationRead) {
    std::ifstream in(tests::shippedDesignFile("quick").parent_path() /
                     "../../docs/design-files.md");
    std::string line, block;
    int examples = 0;
    for (bool inside = false; std::getline(in, line);) {
        if (!line.starts_with("```")) {
            if (inside) block += line + "\n";
            continue;
        }
        inside = line == "```json";
        if (!inside && !block.empty()) {
            const auto example = records::parseJson(block, "design-files.md");
            EXPECT_NO_THROW(study_app::designFromJson(example, "design-files.md")) << block;
            ++examples;
            block.clear();
        }
    }
    EXPECT_EQ(examples, 2);
}

// Designs drawn at random within the rules: what the writer writes, the reader reads as the same.
Design randomDesign(std::uint64_t seed) {
    std::mt19937_64 rng = study_app::engineAt(seed, study_app::Purpose::order, 0);
    const auto flip = [&] { return quest::uniformBelow(rng, 2) == 0; };
    Design d = tests::variedDesign(flip() ? records::Task::twoAfc : records::Task::yesNo);
    d.description = flip() ? "a \"text\" with \xc3\xa4" : "";
    d.encoding = flip() ? records::Encoding::srgb : records::Encoding::code;
    d.litLevels = {1 - quest::uniform01(rng)};
    d.patterns[3].angleDeg = 1 + 43 * quest::uniform01(rng);
    d.patterns[1].orientation =
        flip() ? study_app::Orientation::horizontal : study_app::Orientation::any;
    d.catchShare = 0.5 * quest::uniform01(rng);
    d.guessRatio = 1 + 4 * quest::uniform01(rng);
    d.staircase.priorSd = 0.1 + quest::uniform01(rng);
    d.staircase.beta = 1 + 5 * quest::uniform01(rng);
    if (flip()) d.staircase.range = 5 + quest::uniform01(rng);
    d.radius = {.min = 0.5, .max = 250.5, .step = flip() ? 0.25 : 0.5};
    d.kernels = flip() ? std::vector<std::string>{"poisson16-still"}
                       : std::vector<std::string>{"disc", "poisson9"};
    d.noiseLevels = flip() ? std::vector<double>{0, 2.5} : std::vector<double>{0};
    d.dither = flip();
    d.presentation = {.blankS = quest::uniform01(rng),
                      .between = flip() ? study_app::Between::mask : study_app::Between::blank,
                      .feedback = flip(),
                      .breakEveryTrials = static_cast<int>(quest::uniformBelow(rng, 100)),
                      .practice = {.correct = 1, .ofLast = 2, .atMost = 3}};
    if (flip()) d.presentation.timeLimitS = 1 + quest::uniform01(rng);
    d.roving = {.shift = flip(), .quarterTurn = flip(), .mirror = flip(), .tilt = flip()};
    return d;
}

TEST(Design, NormalisedFormReadsBackAsTheSameDesign) {
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        const Design design = randomDesign(seed);
        ASSERT_EQ(study_app::validate(design), "") << seed;
        const json written = json::parse(study_app::normalisedJson(design).dump());
        const Design read = study_app::designFromJson(written, "written.json");
        ASSERT_EQ(read, design) << seed;
        ASSERT_EQ(study_app::designDifference(written, json(study_app::normalisedJson(read))), "");
    }
}

TEST(Design, DifferenceNamesTheFieldAndBothValues) {
    const Design design = tests::variedDesign(records::Task::twoAfc);
    Design other = design;
    other.description = "the text is free to change";
    const auto difference = [&] {
        return study_app::designDifference(json(study_app::normalisedJson(design)),
                                           json(study_app::normalisedJson(other)));
    };
    EXPECT_EQ(difference(), "");
    other.staircase.beta = 4;
    EXPECT_EQ(difference(), "quest.beta is 3.5 there and 4.0 here");
    other = design;
    other.litLevels.push_back(0.5);
    EXPECT_EQ(difference(), "lit_levels.2 is absent there and 0.5 here");
    other = design;
    other.litLevels.pop_back();
    EXPECT_EQ(difference(), "lit_levels.1 is 0.25 there and absent here");
}

}  // namespace
