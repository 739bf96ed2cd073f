// SPDX-License-Identifier: MIT
// The trial table: one row per trial of one observer, tab-separated, in the BIDS behavioural layout
// <data>/sub-<id>/beh/sub-<id>[_ses-<id>]_task-hideartifact_beh.tsv (K. Gorgolewski et al., "The
// brain imaging data structure", Scientific Data 2016), so that R and Python tools read it. `n/a`
// stands for unknown.
//
// A reader takes the columns in any order, extra columns (kept as text), misses of the optional
// ones, a byte-order mark and Windows line ends. Anything else that is wrong - a missing required
// column, a column named twice, a row with too few or too many cells, text in a number, a NaN or
// infinite number, a non-positive radius or size, a response that does not belong to the task, a
// `correct` that contradicts the response, trial numbers of `ok` rows that do not rise - is a
// std::runtime_error whose sentence names file, line, column, the value found and the rule. A torn
// last line (no line end) is dropped with a notice.
//
// One exception: on a reference trial any finite radius is taken, with a notice where it is not
// positive. Public tables hold such rows (a staircase in px that ran below zero); a filter leaves
// an artifact-free straight edge straight at any radius, and only the answer counts there. Take
// log10 of the radius on artifact trials only.
//
// The cells are UTF-8 without quotes or escapes: a tab, a line end or another control character
// cannot stand in a cell, and the writers refuse it. Row i (from 0) of a table that was read stands
// on line i + 2 of its file.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace records {

/// reference: the artifact-free stimulus (catch trial)
enum class TrialType { artifact, reference };
enum class Pattern { stair, step, line, frame };
enum class Task { twoAfc, yesNo };  ///< written "2afc", "yes_no"
enum class Response { left, right, seen, notSeen };
enum class TrialStatus { ok, undone, repeated, tooFast };  ///< only `ok` rows enter a fit
enum class Encoding { srgb, code };  ///< filtered in light, or in code values (METHODS section 2)

/// The words of the file format, each with the value it stands for.
inline constexpr std::pair<std::string_view, TrialType> kTrialTypeWords[] = {
    {"artifact", TrialType::artifact}, {"reference", TrialType::reference}};
inline constexpr std::pair<std::string_view, Pattern> kPatternWords[] = {{"stair", Pattern::stair},
                                                                         {"step", Pattern::step},
                                                                         {"line", Pattern::line},
                                                                         {"frame", Pattern::frame}};
inline constexpr std::pair<std::string_view, Task> kTaskWords[] = {{"2afc", Task::twoAfc},
                                                                   {"yes_no", Task::yesNo}};
inline constexpr std::pair<std::string_view, Response> kResponseWords[] = {
    {"left", Response::left},
    {"right", Response::right},
    {"seen", Response::seen},
    {"not_seen", Response::notSeen}};
inline constexpr std::pair<std::string_view, TrialStatus> kTrialStatusWords[] = {
    {"ok", TrialStatus::ok},
    {"undone", TrialStatus::undone},
    {"repeated", TrialStatus::repeated},
    {"too_fast", TrialStatus::tooFast}};
inline constexpr std::pair<std::string_view, Encoding> kEncodingWords[] = {
    {"srgb", Encoding::srgb}, {"code", Encoding::code}};

std::string_view toText(TrialType value);
std::string_view toText(Pattern value);
std::string_view toText(Task value);
std::string_view toText(Response value);
std::string_view toText(TrialStatus value);
std::string_view toText(Encoding value);
/// Nothing for an unknown word.
std::optional<TrialType> trialTypeFromText(std::string_view text);
std::optional<Pattern> patternFromText(std::string_view text);
std::optional<Task> taskFromText(std::string_view text);
std::optional<Response> responseFromText(std::string_view text);
std::optional<TrialStatus> trialStatusFromText(std::string_view text);
std::optional<Encoding> encodingFromText(std::string_view text);

struct Trial {
    int number = 0;  ///< column `trial`, >= 1
    TrialType type = TrialType::artifact;
    std::string condition;  ///< name of the condition, unique within a design
    Pattern pattern = Pattern::stair;
    std::optional<double> angleDeg;  ///< of the true silhouette; stair 45, step atan(a/L)
    double artifactPx = 0;           ///< a, screen px, > 0
    double litLevel = 1;             ///< share of full white, in [0, 1]
    std::string kernel;              ///< "disc", "box", "gaussian", "poisson16"; frames: technique
    Task task = Task::twoAfc;
    std::optional<double> proposedRadiusPx;  ///< by the staircase, before display limits
    double filterRadiusPx = 0;         ///< r that was shown, screen px; > 0 on artifact trials
    std::optional<Response> response;  ///< none on a trial that was disturbed before an answer
    bool correct = false;  ///< 2AFC: the side was right; yes/no: seen on artifact, not_seen on
                           ///< reference; without a response false
    std::optional<double> responseTimeS;  ///< seconds from the swap that showed the stimulus

    // Written by study_app, optional for a reader:
    TrialStatus status = TrialStatus::ok;
    std::optional<std::string> staircase;  ///< name of the staircase that learns from the trial;
                                           ///< none on catch trials (study_app/session.h)
    std::optional<Encoding> encoding;
    std::optional<std::string> side;        ///< side of the artifact, "left" or "right"
    std::optional<int> orientationQuarter;  ///< quarter turns, 0..3
    std::optional<bool> mirror;             ///< written 0 or 1
    std::optional<int> shiftPx;             ///< whole-pixel roving of the position
    std::optional<double> tiltDeg;          ///< tilt of the straight panel (step in 2AFC)
    std::optional<double> onsetS;           ///< stimulus onset, seconds since the session's start
    std::optional<double> thresholdMean;    ///< posterior mean of x0 = log10(a/r) after this trial
    std::optional<double> thresholdSd;      ///< posterior sd of x0, log10 units
    std::optional<double> noiseLevels;      ///< sd of the noise added to the image, 8-bit codes
    std::optional<bool> dither;             ///< codes rounded at random; written 0 or 1
    std::optional<int> imageSeed;           ///< of turned taps, noise and dither: redraws them
    std::optional<std::string> frame;       ///< file name of the rendered frame with the artifact
    std::optional<double> clickXPx, clickYPx;  ///< on the image, from its left and upper edge
    std::optional<double> clickDistancePx;     ///< from there to the nearest riser of the artifact

    std::vector<std::string> extra;  ///< cells of TrialTable::extraColumns, as text

    bool operator==(const Trial&) const = default;
};

struct TrialTable {
    std::string participant;  ///< the <id> of sub-<id> in the file name, or the name without .tsv
    std::optional<std::string> session;  ///< the <id> of ses-<id>, where there is one
    std::filesystem::path file;
    std::vector<std::string> extraColumns;
    std::vector<Trial> trials;         ///< in file order, every status
    std::vector<std::string> notices;  ///< located sentences: torn line dropped, ...
};

/// Reads one table. Throws as described above.
TrialTable readTrialTable(const std::filesystem::path& file);

/// The same on text that came from `file`.
TrialTable parseTrialTable(std::string_view text, const std::filesystem::path& file);

/// Every table below `folder` (the BIDS tree or a flat folder: files named
/// *task-hideartifact*_beh.tsv), or the one file named (whatever its name), sorted by path. Hidden
/// folders and links to folders are not entered. Throws when the path does not exist or holds no
/// table.
std::vector<std::filesystem::path> findTrialTables(const std::filesystem::path& fileOrFolder);

/// `<data>/sub-<id>/beh/sub-<id>[_ses-<id>]_task-hideartifact_beh.tsv`. Ids: letters and digits
/// only (BIDS); throws otherwise.
std::filesystem::path trialTablePath(const std::filesystem::path& dataFolder,
                                     const std::string& participant,
                                     const std::optional<std::string>& session);

/// The header line and one row, without line end, as the journal writes them. Numbers are written
/// so that reading them gives the same bits. A trial that a reader would refuse or read back as
/// another one (a NaN, a tab in a text, the text "n/a") is a std::invalid_argument that names
/// trial, column, value and rule.
std::string trialTableHeader(const std::vector<std::string>& extraColumns = {});
std::string trialTableRow(const Trial& trial);

}  // namespace records
