// SPDX-License-Identifier: MIT
// How a session is shown to a person: the pace of a trial, breaks, practice. Nothing here changes a
// proposal: the same answers lead to the same staircases at any pace.
//
// Part of a design, in JSON its field `presentation`: the members below in snake_case, all of them
// optional; docs/design-files.md lists them. `study_app --presentation FILE` puts a file of the
// same fields in its place.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

namespace study_app {

/// Met as soon as `correct` of the last `ofLast` practice answers were right.
struct PracticeRule {
    int correct = 4, ofLast = 5;
    int atMost = 30;  ///< then the experimenter is asked for
    bool operator==(const PracticeRule&) const = default;
};

enum class Between { blank, mask };  ///< what stands in the place of the stimulus before a trial

struct Presentation {
    double blankS = 0.3;                 ///< after an answer, [0, 60]
    double fixationS = 0.5;              ///< fixation cross before the stimulus, [0, 60]
    Between between = Between::blank;    ///< mask: noise of single pixels
    std::optional<double> timeLimitS{};  ///< an answer later than this counts as none, (0, 3600]
    double tooFastS = 0.15;     ///< an earlier answer cannot be one to the stimulus, [0, 2]
    bool feedback = false;      ///< right or wrong, after each answer
    double feedbackS = 0.5;     ///< how long feedback stays, [0, 60]
    int backgroundCode = 64;    ///< grey around the stimulus, 0..255; chosen by eye
    int breakEveryTrials = 60;  ///< 0: no breaks
    double breakMinimumS = 15;  ///< [0, 3600]
    PracticeRule practice{};    ///< correct = 0: no practice
    PracticeRule resumedPractice{.correct = 2, .ofLast = 3, .atMost = 15};
    bool operator==(const Presentation&) const = default;
};

/// Empty when usable; else "<field>: <value>: <rule>".
std::string validate(const Presentation& presentation);

/// What a person takes to answer, s, before anything is known of the pace. Chosen by eye from the
/// human tables: a median answer takes about a second.
inline constexpr double kTypicalAnswerS = 1.2;

/// Throws std::runtime_error "<file>: field <field>: <value>: <rule>".
Presentation readPresentation(const std::filesystem::path& file);
/// The same from JSON that is already there; `path` is its place in the file, "" for the file's
/// own.
Presentation presentationFromJson(const nlohmann::json& json, const std::string& file,
                                  const std::string& path = "");
/// Every field, defaults filled in; without a time limit none. Reads back the same.
nlohmann::ordered_json presentationJson(const Presentation& presentation);

}  // namespace study_app
