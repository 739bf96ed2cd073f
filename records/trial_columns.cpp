// SPDX-License-Identifier: MIT
#include "records/trial_columns.h"

#include <charconv>
#include <limits>
#include <type_traits>

#include "records/number_rule.h"
#include "records/quoted_text.h"

namespace records {

namespace {

const std::string kFine;

// One read and one write per kind of cell; which member and which rule are template arguments, so
// that the list below is a table of plain function pointers.

template <typename T>
struct Unwrapped {
    using Type = T;
    static constexpr bool isOptional = false;
};
template <typename T>
struct Unwrapped<std::optional<T>> {
    using Type = T;
    static constexpr bool isOptional = true;
};
template <auto Member>
using MemberType = std::remove_reference_t<decltype(std::declval<Trial&>().*Member)>;
template <auto Member>
using ValueType = typename Unwrapped<MemberType<Member>>::Type;
template <auto Member>
inline constexpr bool kMayBeUnknown = Unwrapped<MemberType<Member>>::isOptional;

template <auto Member>
std::string orUnknown(const std::string& rule) {
    return kMayBeUnknown<Member> ? rule + ", or n/a" : rule;
}

// True when the cell says "unknown" and may.
template <auto Member>
bool readUnknown(std::string_view cell, Trial& trial) {
    if constexpr (kMayBeUnknown<Member>) {
        if (cell != kUnknownCell) return false;
        (trial.*Member).reset();
        return true;
    }
    return false;
}

template <auto Member>
const ValueType<Member>* known(const Trial& trial) {
    if constexpr (kMayBeUnknown<Member>)
        return (trial.*Member) ? &*(trial.*Member) : nullptr;
    else
        return &(trial.*Member);
}

template <typename Number>
bool parseNumber(std::string_view cell, Number& value) {
    const char* end = cell.data() + cell.size();
    const auto result = std::from_chars(cell.data(), end, value);
    return result.ec == std::errc() && result.ptr == end;
}

constexpr NumberRule kTrialNumberRule = between(1, std::numeric_limits<int>::max());
constexpr NumberRule kWholeRule =
    between(std::numeric_limits<int>::min(), std::numeric_limits<int>::max());
constexpr NumberRule kQuarterRule = between(0, 3);
constexpr NumberRule kSeedRule = between(0, std::numeric_limits<int>::max());
constexpr NumberRule kAngleRule = between(-360, 360);

template <auto Member, const NumberRule& Rule>
std::string readNumber(std::string_view cell, Trial& trial) {
    if (readUnknown<Member>(cell, trial)) return kFine;
    constexpr bool isWhole = std::is_integral_v<ValueType<Member>>;
    ValueType<Member> value{};
    if (!parseNumber(cell, value) || !Rule.holds(static_cast<double>(value)))
        return orUnknown<Member>(Rule.text(isWhole ? "whole number" : "number"));
    trial.*Member = value;
    return kFine;
}

template <auto Member>
void writeNumber(const Trial& trial, std::string& row) {
    const auto* value = known<Member>(trial);
    if (value == nullptr) {
        row += kUnknownCell;
    } else if constexpr (std::is_integral_v<ValueType<Member>>) {
        row += std::to_string(*value);
    } else {
        row += exactText(*value);
    }
}

template <auto Member>
std::string readFlag(std::string_view cell, Trial& trial) {
    if (readUnknown<Member>(cell, trial)) return kFine;
    if (cell != "0" && cell != "1") return orUnknown<Member>("must be 0 or 1");
    trial.*Member = cell == "1";
    return kFine;
}

template <auto Member>
void writeFlag(const Trial& trial, std::string& row) {
    const bool* value = known<Member>(trial);
    row += value == nullptr ? kUnknownCell : std::string_view(*value ? "1" : "0");
}

template <auto Member>
std::string readText(std::string_view cell, Trial& trial) {
    if (readUnknown<Member>(cell, trial)) return kFine;
    if (cell.empty() || cell == kUnknownCell)
        return orUnknown<Member>("must be a text that is not empty");
    if (std::string rule = brokenTextRule(cell); !rule.empty()) return rule;
    trial.*Member = std::string(cell);
    return kFine;
}

template <auto Member>
void writeText(const Trial& trial, std::string& row) {
    const std::string* value = known<Member>(trial);
    row += value == nullptr ? kUnknownCell : std::string_view(*value);
}

template <auto Member, const auto& Words>
std::string readWord(std::string_view cell, Trial& trial) {
    if (readUnknown<Member>(cell, trial)) return kFine;
    std::string known;
    for (const auto& [word, value] : Words) {
        if (word == cell) {
            trial.*Member = value;
            return kFine;
        }
        known += (known.empty() ? "" : ", ") + std::string(word);
    }
    return orUnknown<Member>("must be one of " + known);
}

template <auto Member>
void writeWord(const Trial& trial, std::string& row) {
    const auto* value = known<Member>(trial);
    row += value == nullptr ? kUnknownCell : toText(*value);
}

#define STAIRWELL_NUMBER(member, rule) readNumber<&Trial::member, rule>, writeNumber<&Trial::member>
#define STAIRWELL_FLAG(member) readFlag<&Trial::member>, writeFlag<&Trial::member>
#define STAIRWELL_TEXT(member) readText<&Trial::member>, writeText<&Trial::member>
#define STAIRWELL_WORD(member, words) readWord<&Trial::member, words>, writeWord<&Trial::member>

std::string readSide(std::string_view cell, Trial& trial) {
    if (cell != kUnknownCell && cell != "left" && cell != "right")
        return "must be one of left, right, or n/a";
    return readText<&Trial::side>(cell, trial);
}

constexpr bool kRequired = true, kOptional = false;

// clang-format off
const TrialColumn kColumns[] = {
    {"trial", kRequired, "Number of the trial in the session, from 1", "", {}, STAIRWELL_NUMBER(number, kTrialNumberRule)},
    {"trial_type", kRequired, "What was shown", "",
     {{"artifact", "a filtered stair-step edge"}, {"reference", "the filtered artifact-free edge (catch trial)"}},
     STAIRWELL_WORD(type, kTrialTypeWords)},
    {"condition", kRequired, "Name of the condition in the design", "", {}, STAIRWELL_TEXT(condition)},
    {"pattern", kRequired, "Silhouette", "",
     {{"stair", "stairs along 45 degrees"}, {"step", "one step in a nearly axis-parallel edge"},
      {"line", "rasterised line at angle_deg"}, {"frame", "rendered frame"}},
     STAIRWELL_WORD(pattern, kPatternWords)},
    {"angle_deg", kRequired, "Angle of the true silhouette to the pixel axis", "deg", {}, STAIRWELL_NUMBER(angleDeg, kAngleRule)},
    {"artifact_px", kRequired, "Artifact size a: edge length of one shadow-map texel on screen", "px", {}, STAIRWELL_NUMBER(artifactPx, kPositive)},
    {"lit_level", kRequired, "Brightness of the lit side as a share of full white (after encoding)", "", {}, STAIRWELL_NUMBER(litLevel, kShare)},
    {"kernel", kRequired, "Filter kernel", "", {}, STAIRWELL_TEXT(kernel)},
    {"task", kRequired, "Task of the observer", "",
     {{"2afc", "two panels side by side: which one has the artifact?"}, {"yes_no", "one panel: is there an artifact?"}},
     STAIRWELL_WORD(task, kTaskWords)},
    {"proposed_radius_px", kRequired, "Filter radius that the staircase proposed, before display limits", "px", {}, STAIRWELL_NUMBER(proposedRadiusPx, kPositive)},
    {"filter_radius_px", kRequired, "Filter radius r that was shown", "px", {}, STAIRWELL_NUMBER(filterRadiusPx, kFinite)},
    {"response", kRequired, "Answer of the observer", "",
     {{"left", "2afc: the left panel"}, {"right", "2afc: the right panel"}, {"seen", "yes_no: an artifact"}, {"not_seen", "yes_no: none, or undecided"}, {"n/a", "none: disturbed before an answer"}},
     STAIRWELL_WORD(response, kResponseWords)},
    {"correct", kRequired, "Whether the answer was right (yes_no: seen on artifact, not_seen on reference)", "", {{"0", "wrong"}, {"1", "right"}}, STAIRWELL_FLAG(correct)},
    {"response_time_s", kRequired, "Time from the buffer swap that showed the stimulus to the answer", "s", {}, STAIRWELL_NUMBER(responseTimeS, kNotNegative)},
    {"status", kOptional, "Only ok rows enter a fit", "",
     {{"ok", "a valid trial"}, {"undone", "taken back by the observer"}, {"repeated", "disturbed and shown again"}, {"too_fast", "answered faster than anyone can see"}},
     STAIRWELL_WORD(status, kTrialStatusWords)},
    {"staircase", kOptional, "Name of the staircase that proposed the radius and learns from the answer; n/a on catch trials", "", {}, STAIRWELL_TEXT(staircase)},
    {"encoding", kOptional, "What the filter averaged", "", {{"srgb", "light; the display code is sRGB-encoded"}, {"code", "code values"}}, STAIRWELL_WORD(encoding, kEncodingWords)},
    {"side", kOptional, "Side of the artifact", "", {{"left", "left panel"}, {"right", "right panel"}}, readSide, writeText<&Trial::side>},
    {"orientation_quarter", kOptional, "Rotation of the stimulus in quarter turns", "", {}, STAIRWELL_NUMBER(orientationQuarter, kQuarterRule)},
    {"mirror", kOptional, "Whether the stimulus was mirrored", "", {{"0", "no"}, {"1", "yes"}}, STAIRWELL_FLAG(mirror)},
    {"shift_px", kOptional, "Roving of the stimulus position", "px", {}, STAIRWELL_NUMBER(shiftPx, kWholeRule)},
    {"tilt_deg", kOptional, "Tilt of the artifact-free panel", "deg", {}, STAIRWELL_NUMBER(tiltDeg, kAngleRule)},
    {"onset_s", kOptional, "Stimulus onset since the start of the session", "s", {}, STAIRWELL_NUMBER(onsetS, kFinite)},
    {"threshold_mean", kOptional, "Staircase: posterior mean of the threshold x0 = log10(a/r) after this trial", "log10", {}, STAIRWELL_NUMBER(thresholdMean, kFinite)},
    {"threshold_sd", kOptional, "Staircase: posterior standard deviation of x0", "log10", {}, STAIRWELL_NUMBER(thresholdSd, kNotNegative)},
    {"noise_levels", kOptional, "Standard deviation of the noise added to the image, in 8-bit codes; n/a or 0: none", "", {}, STAIRWELL_NUMBER(noiseLevels, kNotNegative)},
    {"dither", kOptional, "Whether codes were rounded at random instead of to the nearest; n/a: no", "", {{"0", "no"}, {"1", "yes"}}, STAIRWELL_FLAG(dither)},
    {"image_seed", kOptional, "Seed of the image's turned taps, noise and dither; n/a: it has none", "", {}, STAIRWELL_NUMBER(imageSeed, kSeedRule)},
    {"frame", kOptional, "File of the rendered frame with the artifact, in the design's folder", "", {}, STAIRWELL_TEXT(frame)},
    {"click_x_px", kOptional, "Where the observer saw the artifact: distance from the image's left edge", "px", {}, STAIRWELL_NUMBER(clickXPx, kNotNegative)},
    {"click_y_px", kOptional, "Where the observer saw the artifact: distance from the image's upper edge", "px", {}, STAIRWELL_NUMBER(clickYPx, kNotNegative)},
    {"click_distance_px", kOptional, "Distance of the click from the nearest riser of the artifact; n/a where none is shown", "px", {}, STAIRWELL_NUMBER(clickDistancePx, kNotNegative)},
};
// clang-format on

#undef STAIRWELL_NUMBER
#undef STAIRWELL_FLAG
#undef STAIRWELL_TEXT
#undef STAIRWELL_WORD

}  // namespace

std::span<const TrialColumn> trialColumns() {
    return kColumns;
}

std::string brokenTextRule(std::string_view cell) {
    return isPlainText(cell) ? kFine : "must be UTF-8 text without control characters";
}

// What must hold of the answer alone.
static std::optional<BrokenRule> brokenAnswerRule(const Trial& trial) {
    const bool isArtifact = trial.type == TrialType::artifact;
    if (!trial.response) {
        if (trial.status == TrialStatus::ok)
            return BrokenRule{"response", "must be an answer where the status is ok"};
        if (trial.correct) return BrokenRule{"correct", "must be 0 without a response"};
        return std::nullopt;
    }
    const bool isSideAnswer = trial.response == Response::left || trial.response == Response::right;
    if (isSideAnswer != (trial.task == Task::twoAfc))
        return BrokenRule{"response", trial.task == Task::twoAfc
                                          ? "must be left or right in the task 2afc"
                                          : "must be seen or not_seen in the task yes_no"};
    if (trial.task == Task::yesNo &&
        trial.correct != ((trial.response == Response::seen) == isArtifact))
        return BrokenRule{"correct",
                          "must be 1 for seen on artifact or not_seen on reference, 0 otherwise"};
    if (trial.task == Task::twoAfc && isArtifact && trial.side &&
        trial.correct != (toText(*trial.response) == *trial.side))
        return BrokenRule{"correct", "must be 1 where response is the side of the artifact"};
    return std::nullopt;
}

std::optional<BrokenRule> brokenRule(const Trial& trial) {
    if (auto broken = brokenAnswerRule(trial)) return broken;
    if (trial.type == TrialType::artifact && !kPositive.holds(trial.filterRadiusPx))
        return BrokenRule{"filter_radius_px", kPositive.text() + " on an artifact trial"};
    if (trial.clickXPx.has_value() != trial.clickYPx.has_value())
        return BrokenRule{"click_y_px", "must be there exactly where click_x_px is"};
    if (trial.pattern == Pattern::line && !trial.angleDeg)
        return BrokenRule{"angle_deg", "must be a number for the pattern line"};
    return std::nullopt;
}

}  // namespace records
