// SPDX-License-Identifier: MIT
#include "study_app/presentation.h"

#include <nlohmann/json.hpp>
#include <utility>

#include "records/json_document.h"
#include "records/json_fields.h"
#include "records/quoted_text.h"

namespace study_app {
namespace {

using records::JsonFields;

constexpr std::pair<std::string_view, Between> kBetweenWords[] = {{"blank", Between::blank},
                                                                  {"mask", Between::mask}};
constexpr records::NumberRule kSeconds = records::between(0, 60);
constexpr records::NumberRule kTimeLimit{.low = 0, .high = 3600, .lowIncluded = false};

template <typename T>
void set(T& field, const std::optional<T>& value) {
    if (value) field = *value;
}

void readRule(const JsonFields& fields, const std::string& key, PracticeRule& rule) {
    const auto object = fields.optionalObject(key);
    if (!object) return;
    set(rule.correct, object->optionalInteger("correct", 0, 100));
    set(rule.ofLast, object->optionalInteger("of_last", 1, 100));
    set(rule.atMost, object->optionalInteger("at_most", 1, 1000));
    object->noOtherFields();
}

std::string brokenRule(const std::string& field, const PracticeRule& rule) {
    if (rule.correct > rule.ofLast) {
        return field + ".correct: " + std::to_string(rule.correct) +
               ": must be at most of_last, which is " + std::to_string(rule.ofLast);
    }
    if (rule.atMost < rule.ofLast && rule.correct > 0) {
        return field + ".at_most: " + std::to_string(rule.atMost) +
               ": must be at least of_last, which is " + std::to_string(rule.ofLast);
    }
    return {};
}

std::string broken(const std::string& field, double value, const records::NumberRule& rule) {
    return rule.holds(value) ? "" : field + ": " + records::exactText(value) + ": " + rule.text();
}

}  // namespace

std::string validate(const Presentation& p) {
    for (const std::string& found :
         {broken("blank_s", p.blankS, kSeconds), broken("fixation_s", p.fixationS, kSeconds),
          broken("feedback_s", p.feedbackS, kSeconds),
          broken("too_fast_s", p.tooFastS, records::between(0, 2)),
          p.timeLimitS ? broken("time_limit_s", *p.timeLimitS, kTimeLimit) : std::string(),
          broken("background_code", p.backgroundCode, records::between(0, 255)),
          broken("break_every_trials", p.breakEveryTrials, records::atLeast(0)),
          broken("break_minimum_s", p.breakMinimumS, records::between(0, 3600)),
          brokenRule("practice", p.practice), brokenRule("resumed_practice", p.resumedPractice)}) {
        if (!found.empty()) return found;
    }
    if (p.timeLimitS && *p.timeLimitS <= p.tooFastS) {
        return "time_limit_s: " + records::exactText(*p.timeLimitS) +
               ": must be greater than too_fast_s, which is " + records::exactText(p.tooFastS);
    }
    return {};
}

Presentation presentationFromJson(const nlohmann::json& json, const std::string& file,
                                  const std::string& path) {
    const JsonFields fields(json, file, path);
    records::requireNoNull(json, file, path);
    Presentation p;
    set(p.blankS, fields.optionalNumber("blank_s", kSeconds));
    set(p.fixationS, fields.optionalNumber("fixation_s", kSeconds));
    set(p.between, fields.optionalWord("between", kBetweenWords));
    p.timeLimitS = fields.optionalNumber("time_limit_s", kTimeLimit);
    set(p.tooFastS, fields.optionalNumber("too_fast_s", records::between(0, 2)));
    set(p.feedback, fields.optionalBoolean("feedback"));
    set(p.feedbackS, fields.optionalNumber("feedback_s", kSeconds));
    set(p.backgroundCode, fields.optionalInteger("background_code", 0, 255));
    set(p.breakEveryTrials, fields.optionalInteger("break_every_trials", 0));
    set(p.breakMinimumS, fields.optionalNumber("break_minimum_s", records::between(0, 3600)));
    readRule(fields, "practice", p.practice);
    readRule(fields, "resumed_practice", p.resumedPractice);
    fields.noOtherFields();
    if (const std::string problem = validate(p); !problem.empty()) {
        throw std::runtime_error(file + ": field " + (path.empty() ? "" : path + ".") + problem);
    }
    return p;
}

nlohmann::ordered_json presentationJson(const Presentation& p) {
    const auto rule = [](const PracticeRule& r) {
        return nlohmann::ordered_json{
            {"correct", r.correct}, {"of_last", r.ofLast}, {"at_most", r.atMost}};
    };
    nlohmann::ordered_json json{{"blank_s", p.blankS},
                                {"fixation_s", p.fixationS},
                                {"between", p.between == Between::mask ? "mask" : "blank"},
                                {"too_fast_s", p.tooFastS},
                                {"feedback", p.feedback},
                                {"feedback_s", p.feedbackS},
                                {"background_code", p.backgroundCode},
                                {"break_every_trials", p.breakEveryTrials},
                                {"break_minimum_s", p.breakMinimumS},
                                {"practice", rule(p.practice)},
                                {"resumed_practice", rule(p.resumedPractice)}};
    if (p.timeLimitS) json["time_limit_s"] = *p.timeLimitS;
    return json;
}

Presentation readPresentation(const std::filesystem::path& file) {
    return presentationFromJson(records::readJson(file), file.string());
}

}  // namespace study_app
