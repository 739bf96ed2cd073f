// SPDX-License-Identifier: MIT
// The published schema and the reader say the same. A validator of JSON Schema that is not ours
// (Python's jsonschema) reads the schema.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <random>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "records/json_document.h"
#include "study_app/design_file.h"
#include "tests/project_folders.h"
#include "tests/study_app/bad_designs.h"
#include "tests/study_app/frame_folder.h"
#include "tests/study_app/mutated_designs.h"
#include "tests/study_app/test_designs.h"
#include "tests/temporary_folder.h"

namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using tests::patched;

const fs::path kSource = tests::sourceFolder();

/// "ok" or the first problem of each.
std::vector<std::string> bySchema(const std::string& schema, const std::vector<json>& designs) {
    const tests::TemporaryFolder folder;
    std::string command = "python3 '" + (kSource / "tests/study_app/validate_schema.py").string() +
                          "' '" + (kSource / "docs" / schema).string() + "'";
    for (std::size_t i = 0; i < designs.size(); ++i) {
        const fs::path file = folder.path() / std::to_string(i);
        std::ofstream(file) << designs[i].dump();
        command += " '" + file.string() + "'";
    }
    const std::unique_ptr<FILE, int (*)(FILE*)> out(popen(command.c_str(), "r"), &pclose);
    std::string text;
    char part[4096];
    while (out && std::fgets(part, sizeof part, out.get()) != nullptr) text += part;
    std::istringstream lines(text);
    std::vector<std::string> answers;
    for (std::string line; std::getline(lines, line);) answers.push_back(line);
    if (answers.size() != designs.size())
        throw std::runtime_error(
            "python3 with the module jsonschema (Debian: python3-jsonschema) "
            "did not answer");
    return answers;
}

TEST(DesignSchema, AcceptsWhatTheReaderAcceptsAndWrites) {
    std::vector<json> designs{tests::smallDesign()};
    for (const study_app::ShippedDesign& shipped : study_app::shippedDesigns()) {
        designs.push_back(records::readJson(shipped.file));
        designs.push_back(study_app::normalisedJson(study_app::readDesign(shipped.file)));
    }
    for (const records::Task task : {records::Task::twoAfc, records::Task::yesNo})
        designs.push_back(study_app::normalisedJson(tests::variedDesign(task)));
    const tests::TemporaryFolder folder;
    tests::writeFrameFolder(folder.path() / "frames", {1, 2, 4, 8});
    json frames = patched("/frames", "frames");
    frames.erase("artifact_px");
    frames.erase("patterns");
    designs.push_back(frames);
    designs.push_back(
        study_app::normalisedJson(study_app::designFromJson(frames, "frames.json", folder.path())));
    designs.push_back(patched("/roving", false));
    for (const std::string& answer : bySchema("design.schema.json", designs))
        EXPECT_EQ(answer, "ok");
    const json manifest = records::readJson(folder.path() / "frames" / records::kManifestName);
    EXPECT_EQ(bySchema("frames.schema.json", {manifest}).front(), "ok");
}

// What a schema cannot say: rules that hold two values, or two spellings of one, against each
// other.
const std::set<std::string> kAcrossFields{"CriterionAboveCurve",
                                          "CriterionBelowCurve",
                                          "GuessAboveMax",
                                          "GuessBelowMin",
                                          "LineFlatterThanTheStep",
                                          "LineWithoutAStep",
                                          "MaxBeyondWindow",
                                          "MaxOffTheGrid",
                                          "MinAboveMax",
                                          "MinIsMax",
                                          "MinOffTheGrid",
                                          "OnlyUnknownCondition",
                                          "PatternTwice",
                                          "PracticeCannotBeMet",
                                          "RangeTooNarrow",
                                          "SizeOfHalfTheWindow",
                                          "TimeLimitBelowTooFast",
                                          "TrialsInAll"};

TEST(DesignSchema, RefusesWhatTheReaderRefusesButRulesAcrossFields) {
    std::vector<json> designs;
    for (const tests::BadDesign& bad : tests::badDesigns()) designs.push_back(bad.design);
    const std::vector<std::string> answers = bySchema("design.schema.json", designs);
    std::set<std::string> accepted;
    for (std::size_t i = 0; i < designs.size(); ++i) {
        if (answers[i] == "ok") accepted.insert(tests::badDesigns()[i].claim);
    }
    EXPECT_EQ(accepted, kAcrossFields);
}

TEST(DesignSchema, AcceptsWhateverTheReaderAccepts) {
    std::mt19937_64 random(37);
    std::vector<json> designs;
    while (designs.size() < 300) {
        const json changed =
            tests::mutated(random, random() % 2 == 0 ? tests::fullDesign() : tests::smallDesign());
        try {
            study_app::designFromJson(changed, "d.json");
            designs.push_back(changed);
        } catch (const std::runtime_error&) {
        }
    }
    const std::vector<std::string> answers = bySchema("design.schema.json", designs);
    for (std::size_t i = 0; i < designs.size(); ++i) {
        EXPECT_EQ(answers[i], "ok") << designs[i].dump();
    }
}

TEST(DesignSchema, RefusesBadManifests) {
    const json pair = {{"artifact", "a.png"}, {"converged", "c.png"}, {"artifact_px", 4},
                       {"radius_px", 20},     {"scene", "yard"},      {"technique", "pcf_disc"}};
    const auto manifest = [](const json& list) {
        return json{{"schema", {{"name", "stairwell frames"}, {"major", 1}, {"minor", 0}}},
                    {"frames", list}};
    };
    const auto with = [&](const char* field, const json& value) {
        json changed = pair;
        changed[field] = value;
        return manifest(json::array({changed}));
    };
    json incomplete = pair;
    incomplete.erase("scene");
    const auto answers =
        bySchema("frames.schema.json",
                 {manifest(json::array({pair})), manifest(json::array()),
                  manifest(json::array({pair, pair})), manifest(json::array({incomplete})),
                  with("artifact", "../a.png"), with("artifact", ".."), with("artifact_px", 0),
                  with("radius_px", "20"), with("scene", ""), with("size", 3), json::object()});
    EXPECT_EQ(answers.front(), "ok");
    for (std::size_t i = 1; i < answers.size(); ++i) EXPECT_NE(answers[i], "ok") << i;
}

/// The fields that the reader knows where `pointer` points, as its error for an unknown one lists
/// them.
std::set<std::string> readersFields(json design, const std::string& pointer) {
    design[json::json_pointer(pointer + "/zzz")] = 1;
    try {
        study_app::designFromJson(design, "d.json");
    } catch (const std::runtime_error& error) {
        const std::string text = error.what();
        const std::string start = "is unknown; the fields here are ";
        const std::size_t at = text.find(start);
        if (at == text.npos) throw;
        std::istringstream list(text.substr(at + start.size()));
        std::set<std::string> fields;
        for (std::string field; list >> field;) {
            if (field.ends_with(',')) field.pop_back();
            if (field != "zzz") fields.insert(field);
        }
        return fields;
    }
    return {};
}

std::set<std::string> schemasFields(const json& schema, const std::string& pointer) {
    std::set<std::string> fields;
    for (const auto& [name, rule] : schema.at(json::json_pointer(pointer + "/properties")).items())
        fields.insert(name);
    return fields;
}

TEST(DesignSchema, HasExactlyTheFieldsOfTheReader) {
    const json schema = records::readJson(kSource / "docs/design.schema.json");
    json design = tests::smallDesign();
    design["patterns"] = {{{"pattern", "step"}}};
    for (const char* object : {"quest", "radius_px", "roving", "presentation"})
        design[object] = json::object();
    design["presentation"] = {{"practice", json::object()}, {"resumed_practice", json::object()}};
    const std::vector<std::pair<std::string, std::string>> places{
        {"", ""},
        {"/patterns/0", "/$defs/pattern/oneOf/1"},
        {"/quest", "/properties/quest/oneOf/1"},
        {"/radius_px", "/properties/radius_px"},
        {"/roving", "/properties/roving/oneOf/1"},
        {"/presentation", "/$defs/presentation"},
        {"/presentation/practice", "/$defs/practice"},
        {"/presentation/resumed_practice", "/$defs/practice"}};
    for (const auto& [inDesign, inSchema] : places)
        EXPECT_EQ(readersFields(design, inDesign), schemasFields(schema, inSchema)) << inDesign;
}

}  // namespace
