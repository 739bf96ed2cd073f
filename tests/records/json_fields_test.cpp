// SPDX-License-Identifier: MIT
#include "records/json_fields.h"

#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <utility>

#include "records/json_document.h"
#include "tests/records/scratch_folder.h"

namespace {

using namespace records;
using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;
using tests::errorOf;

std::string parseError(const std::string& text) {
    return errorOf<std::runtime_error>([&] { parseJson(text, "d.json"); });
}

TEST(ParseJson, LocatesSyntaxErrorsByLineAndColumn) {
    EXPECT_THAT(parseError("{\n  \"a\": 1,\n  \"b\": nan\n}"),
                StartsWith("d.json: line 3, column 9: syntax error"));
    EXPECT_THAT(parseError(""), StartsWith("d.json: line 1, column 1: syntax error"));
    EXPECT_THAT(parseError("{\"a\": 1,}"), StartsWith("d.json: line 1, column 9: syntax error"));
    EXPECT_THAT(parseError("{\"a\": 1} x"), StartsWith("d.json: line 1, column 10"));
    EXPECT_THAT(parseError("{\"a\": \"\xff\"}"), StartsWith("d.json: line 1, column 8"));
    EXPECT_THAT(parseError("{\"a\": 1"), HasSubstr("line 1, column 8"));
}

TEST(ParseJson, RefusesKeysThatStandTwice) {
    EXPECT_EQ(parseError(R"({"a": 1, "b": {"a": 2}, "c": [{"a": 1}, {"a": 2}]})"), "(no error)");
    EXPECT_EQ(parseError(R"({"a": {"b": 1, "c": {}, "b": 2}})"),
              "d.json: field \"b\": stands twice in one object");
}

TEST(ParseJson, RefusesNumbersBeyondDoubleAndDeepNesting) {
    EXPECT_THAT(parseError(R"({"a": 1e999})"), HasSubstr("d.json: number overflow"));
    EXPECT_EQ(parseError(std::string(64, '[') + std::string(64, ']')), "(no error)");
    EXPECT_EQ(parseError(std::string(100000, '[')), "d.json: nested deeper than 64");
}

TEST(WriteJson, RefusesNumbersThatJsonCannotHold) {
    const tests::ScratchFolder folder;
    const auto file = folder / "a.json";
    const auto write = [&] { writeJson(file, {{"a", {{"b", {1.0, std::nan("")}}}}}); };
    EXPECT_THAT(errorOf<std::invalid_argument>(write),
                HasSubstr("a.json: field a.b[1]: nan: must be a finite number"));
    EXPECT_FALSE(std::filesystem::exists(file));
}

TEST(WriteJson, ReplacesBytesThatAreNoUtf8) {
    const tests::ScratchFolder folder;
    writeJson(folder / "a.json", {{"path", "caf\xe9"}});
    EXPECT_EQ(readJson(folder / "a.json")["path"], "caf\xef\xbf\xbd");
}

enum class Fruit { apple, pear };
constexpr std::pair<std::string_view, Fruit> kFruits[] = {{"apple", Fruit::apple},
                                                          {"pear", Fruit::pear}};

class JsonFieldsTest : public testing::Test {
  protected:
    const json json_ = parseJson(R"({
        "number": 2.5, "negative": -1, "whole": 7, "big": 18446744073709551615, "flag": true,
        "text": "words", "empty": "", "none": null, "fruit": "pear",
        "numbers": [1, 2.5], "mixed": [1, "x"], "texts": ["a", ""],
        "object": {"inner": {"x": 0}}, "objects": [{"y": 1}, {"y": "z"}], "notObjects": [{}, 3]
    })",
                                 "d.json");
    const JsonFields fields_{json_, "d.json"};

    template <typename Get>
    std::string failure(Get get) {
        return errorOf<std::runtime_error>([&] { (void)get(fields_); });
    }
};

TEST_F(JsonFieldsTest, GivesTheValues) {
    EXPECT_EQ(fields_.number("number"), 2.5);
    EXPECT_EQ(fields_.number("whole", kPositive), 7);
    EXPECT_EQ(fields_.integer("negative"), -1);
    EXPECT_EQ(fields_.unsignedInteger("big"), 18446744073709551615u);
    EXPECT_TRUE(fields_.boolean("flag"));
    EXPECT_EQ(fields_.text("text"), "words");
    EXPECT_EQ(fields_.word("fruit", kFruits), Fruit::pear);
    EXPECT_THAT(fields_.numbers("numbers"), ElementsAre(1, 2.5));
    EXPECT_THAT(fields_.texts("texts"), ElementsAre("a", ""));
    EXPECT_EQ(fields_.object("object").object("inner").number("x"), 0);
    EXPECT_EQ(fields_.objects("objects")[0].number("y"), 1);
}

TEST_F(JsonFieldsTest, OptionalFieldsMayBeAbsentOrNullButNotWrong) {
    EXPECT_EQ(fields_.optionalNumber("absent"), std::nullopt);
    EXPECT_EQ(fields_.optionalNumber("none"), std::nullopt);
    EXPECT_EQ(fields_.optionalNumber("number"), 2.5);
    EXPECT_EQ(fields_.optionalInteger("whole"), 7);
    EXPECT_EQ(fields_.optionalBoolean("absent"), std::nullopt);
    EXPECT_EQ(fields_.optionalText("text"), "words");
    EXPECT_EQ(fields_.optionalWord("absent", kFruits), std::nullopt);
    EXPECT_EQ(fields_.optionalWord("fruit", kFruits), Fruit::pear);
    EXPECT_FALSE(fields_.optionalObject("none"));
    EXPECT_THAT(failure([](auto& f) { return f.optionalNumber("text"); }),
                HasSubstr("d.json: field text: \"words\": must be a finite number"));
}

TEST_F(JsonFieldsTest, NamesFileFieldValueAndRule) {
    EXPECT_EQ(failure([](auto& f) { return f.number("absent"); }),
              "d.json: field absent: is missing");
    EXPECT_EQ(failure([](auto& f) { return f.number("negative", kPositive); }),
              "d.json: field negative: -1: must be a number greater than 0");
    EXPECT_EQ(failure([](auto& f) { return f.number("number", kShare); }),
              "d.json: field number: 2.5: must be a number from 0 to 1");
    EXPECT_EQ(failure([](auto& f) { return f.number("number", kInsideShare); }),
              "d.json: field number: 2.5: must be a number greater than 0 and less than 1");
    EXPECT_EQ(failure([](auto& f) { return f.number("negative", atLeast(3)); }),
              "d.json: field negative: -1: must be a number of at least 3");
    EXPECT_EQ(failure([](auto& f) { return f.number("none"); }),
              "d.json: field none: null: must be a finite number");
    EXPECT_EQ(failure([](auto& f) { return f.integer("number", 0, 9); }),
              "d.json: field number: 2.5: must be a whole number from 0 to 9");
    EXPECT_THAT(failure([](auto& f) { return f.integer("big"); }), HasSubstr("must be a whole"));
    EXPECT_THAT(failure([](auto& f) { return f.unsignedInteger("negative"); }),
                HasSubstr("d.json: field negative: -1: must be a whole number from 0 to 2^64 - 1"));
    EXPECT_EQ(failure([](auto& f) { return f.boolean("whole"); }),
              "d.json: field whole: 7: must be true or false");
    EXPECT_EQ(failure([](auto& f) { return f.text("empty"); }),
              "d.json: field empty: \"\": must be a text that is not empty");
    EXPECT_EQ(failure([](auto& f) { return f.word("text", kFruits); }),
              "d.json: field text: \"words\": must be one of apple, pear");
    EXPECT_EQ(failure([](auto& f) { return f.numbers("mixed"); }),
              "d.json: field mixed[1]: \"x\": must be a finite number");
    EXPECT_EQ(failure([](auto& f) { return f.texts("mixed"); }),
              "d.json: field mixed[0]: 1: must be a text");
    EXPECT_EQ(failure([](auto& f) { return f.numbers("object"); }),
              "d.json: field object: an object: must be an array of numbers");
    EXPECT_EQ(failure([](auto& f) { return f.object("numbers"); }),
              "d.json: field numbers: an array: must be an object");
    EXPECT_EQ(failure([](auto& f) { return f.objects("notObjects"); }),
              "d.json: field notObjects[1]: 3: must be an object");
    EXPECT_EQ(
        failure([](auto& f) { return f.object("object").object("inner").number("x", kPositive); }),
        "d.json: field object.inner.x: 0: must be a number greater than 0");
    EXPECT_EQ(failure([](auto& f) { return f.objects("objects")[1].number("y"); }),
              "d.json: field objects[1].y: \"z\": must be a finite number");
    EXPECT_EQ(errorOf<std::runtime_error>([] { JsonFields(json::array(), "d.json"); }),
              "d.json: an array: must be an object");
}

TEST_F(JsonFieldsTest, RefusesFieldsThatNoOneAskedFor) {
    const json small = {{"beta", 3.5}, {"bta", 2}};
    const JsonFields fields(small, "d.json", "quest");
    fields.number("beta");
    fields.optionalNumber("delta");
    EXPECT_EQ(errorOf<std::runtime_error>([&] { fields.noOtherFields(); }),
              "d.json: field quest.bta: is unknown; the fields here are beta, delta");
    fields.has("bta");
    EXPECT_NO_THROW(fields.noOtherFields());
}

TEST(Schema, RefusesAnotherKindOfFileAndAnotherMajor) {
    const auto check = [](const json& schema) {
        const json file = {{"schema", schema}};
        return errorOf<std::runtime_error>(
            [&] { checkSchema(JsonFields(file, "d.json"), "stairwell slope", 1); });
    };
    EXPECT_EQ(check(json(schemaJson("stairwell slope", 1, 0))), "(no error)");
    EXPECT_EQ(check(json(schemaJson("stairwell slope", 1, 7))), "(no error)") << "only adds fields";
    EXPECT_EQ(check(json(schemaJson("stairwell slope", 2, 0))),
              "d.json: field schema.major: 2: this program reads major version 1");
    EXPECT_EQ(check(json(schemaJson("stairwell session", 1, 0))),
              "d.json: field schema.name: \"stairwell session\": must be \"stairwell slope\"");
    EXPECT_THAT(check(json{{"name", "stairwell slope"}}), HasSubstr("schema.major: is missing"));
    EXPECT_THAT(check(3), HasSubstr("field schema: 3: must be an object"));
}

}  // namespace
