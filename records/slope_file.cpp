// SPDX-License-Identifier: MIT
#include "records/slope_file.h"

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "records/json_document.h"
#include "records/json_fields.h"
#include "records/whole_file.h"

namespace records {

namespace {

using nlohmann::json;
using nlohmann::ordered_json;

constexpr char kSchemaName[] = "stairwell slope";
constexpr int kMinor = 0;
constexpr NumberRule kPercent = between(0, 100);

template <typename T>
ordered_json orNull(const std::optional<T>& value) {
    return value ? ordered_json(*value) : ordered_json(nullptr);
}

ordered_json toJson(const Estimate& estimate) {
    ordered_json ci95 = nullptr;
    if (estimate.ci95) ci95 = ordered_json::array({estimate.ci95->low, estimate.ci95->high});
    return {{"estimate", estimate.estimate}, {"ci95", ci95}};
}

ordered_json toJson(const SlopeGroup& group) {
    return {{"name", group.name},
            {"pattern", toText(group.pattern)},
            {"angle_deg", orNull(group.angleDeg)},
            {"lit_level", group.litLevel},
            {"c", toJson(group.c)},
            {"trials", group.trials}};
}

ordered_json toJson(const Slope& slope) {
    ordered_json groups = ordered_json::array();
    for (const SlopeGroup& group : slope.groups) groups.push_back(toJson(group));
    return {{"schema", schemaJson(kSchemaName, kSlopeFileMajor, kMinor)},
            {"context", ordered_json(slope.context)},
            {"c", toJson(slope.c)},
            {"worst_group", slope.worstGroup},
            {"c_overall", toJson(slope.cOverall)},
            {"c_90th_percentile_observer", toJson(slope.c90)},
            {"criterion", slope.criterion},
            {"percent_correct", slope.percentCorrect},
            {"task", toText(slope.task)},
            {"kernel", slope.kernel},
            {"encoding",
             slope.encoding ? ordered_json(toText(*slope.encoding)) : ordered_json(nullptr)},
            {"psychometric_slope", slope.beta},
            {"observer_sd_log10", slope.observerSd},
            {"observer_condition_sd_log10", slope.observerConditionSd},
            {"kappa", toJson(slope.kappa)},
            {"kappa_p_value", orNull(slope.kappaPValue)},
            {"contrast_exponent",
             slope.contrastExponent ? toJson(*slope.contrastExponent) : ordered_json(nullptr)},
            {"groups", groups},
            {"observers", slope.observers},
            {"trials", slope.trials},
            {"px_per_deg", orNull(slope.pxPerDeg)},
            {"method", slope.method}};
}

Estimate estimateFrom(const JsonFields& fields, const NumberRule& rule) {
    Estimate result{.estimate = fields.number("estimate", rule), .ci95 = {}};
    if (!fields.has("ci95")) return result;
    const std::vector<double> ends = fields.numbers("ci95", rule);
    if (ends.size() != 2 || ends[0] > ends[1])
        fields.fail("ci95", "must be [low, high] with low <= high");
    result.ci95 = Interval{.low = ends[0], .high = ends[1]};
    return result;
}

SlopeGroup groupFrom(const JsonFields& fields) {
    return {.name = fields.text("name"),
            .pattern = fields.word("pattern", kPatternWords),
            .angleDeg = fields.optionalNumber("angle_deg"),
            .litLevel = fields.number("lit_level", kShare),
            .c = estimateFrom(fields.object("c"), kPositive),
            .trials = fields.integer("trials", 0)};
}

void requireWorstGroup(const JsonFields& fields, const Slope& slope) {
    const auto isWorst = [&](const SlopeGroup& group) { return group.name == slope.worstGroup; };
    if (!slope.groups.empty() && std::none_of(slope.groups.begin(), slope.groups.end(), isWorst))
        fields.fail("worst_group", "must be the name of one of the groups");
}

Slope slopeFrom(const json& value, const std::string& file) {
    const JsonFields fields(value, file);
    checkSchema(fields, kSchemaName, kSlopeFileMajor);
    Slope slope;
    slope.context = runContextFromJson(fields.any("context"), file);
    slope.c = estimateFrom(fields.object("c"), kPositive);
    slope.worstGroup = fields.text("worst_group");
    slope.cOverall = estimateFrom(fields.object("c_overall"), kPositive);
    slope.c90 = estimateFrom(fields.object("c_90th_percentile_observer"), kPositive);
    slope.criterion = fields.number("criterion", kInsideShare);
    slope.percentCorrect = fields.number("percent_correct", kPercent);
    slope.task = fields.word("task", kTaskWords);
    slope.kernel = fields.text("kernel");
    fields.any("encoding");  // null, not absent, where it is unknown
    slope.encoding = fields.optionalWord("encoding", kEncodingWords);
    slope.beta = fields.number("psychometric_slope", kPositive);
    slope.observerSd = fields.number("observer_sd_log10", kNotNegative);
    slope.observerConditionSd = fields.number("observer_condition_sd_log10", kNotNegative);
    slope.kappa = estimateFrom(fields.object("kappa"), kFinite);
    slope.kappaPValue = fields.optionalNumber("kappa_p_value", kShare);
    if (const auto exponent = fields.optionalObject("contrast_exponent"))
        slope.contrastExponent = estimateFrom(*exponent, kFinite);
    for (const JsonFields& group : fields.objects("groups"))
        slope.groups.push_back(groupFrom(group));
    requireWorstGroup(fields, slope);
    slope.observers = fields.integer("observers", 1);
    slope.trials = fields.integer("trials", 1);
    slope.pxPerDeg = fields.optionalNumber("px_per_deg", kPositive);
    slope.method = fields.text("method");
    return slope;
}

std::string formatted(const char* format, double value) {
    char text[64];
    std::snprintf(text, sizeof text, format, value);
    return text;
}

// ".6465", ".1": a share without its leading zero.
std::string shareText(double share) {
    const std::string text = formatted("%.4g", share);
    return text.starts_with("0.") ? text.substr(1) : text;
}

std::string intervalText(const std::optional<Interval>& interval) {
    if (!interval) return "(no interval)";
    return formatted("[%.2f, ", interval->low) + formatted("%.2f]", interval->high);
}

}  // namespace

std::string describeValue(const Slope& slope) {
    return formatted("c = %.2f ", slope.c.estimate) + intervalText(slope.c.ci95);
}

std::string describeTerms(const Slope& slope) {
    std::string text = "r = c a; F* = " + shareText(slope.criterion);
    text += formatted(", %.3g", slope.percentCorrect);
    text += slope.task == Task::twoAfc ? " % correct in 2AFC; " : " % seen in yes/no; ";
    text += slope.kernel + "; ";
    text += slope.encoding ? toText(*slope.encoding) : "encoding unknown";
    return text + formatted("; beta %.3g", slope.beta) + "; worst group " + slope.worstGroup;
}

std::string describe(const Slope& slope) {
    return describeValue(slope) + " (" + describeTerms(slope) + ")";
}

void writeSlope(const std::filesystem::path& file, const Slope& slope) {
    const ordered_json written = toJson(slope);
    try {
        slopeFrom(json(written), file.string());
    } catch (const std::runtime_error& error) {
        throw std::invalid_argument(error.what());
    }
    writeJson(file, written);
}

Slope parseSlope(std::string_view text, const std::string& file) {
    return slopeFrom(parseJson(text, file), file);
}

Slope readSlope(const std::filesystem::path& file) {
    return parseSlope(readWholeFile(file), file.string());
}

}  // namespace records
