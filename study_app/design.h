// SPDX-License-Identifier: MIT
// What a study shows: the conditions, the staircases that place their trials, and the limits of the
// display. A design says nothing about who sits in front of it, nor about the seed.
//
//   const study_app::Design design = study_app::readDesign("paper16.json");  // design_file.h
//   for (const study_app::Condition& c : study_app::conditions(design)) ...
//
// Conditions are every combination of artifact size, pattern, lit level, kernel and noise. Each has
// its own staircase with the same parameters, since strength x = log10(a / r) is relative to the
// size. The paper's designs and the readings behind them: Kreuzer, "Using Perception-Based
// Filtering to Hide Shadow Artifacts", sections 4.2 and 4.3. docs/design-files.md describes the
// file.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "quest/observer_screening.h"
#include "quest/quest.h"
#include "records/frame_manifest.h"
#include "records/trial_table.h"
#include "study_app/presentation.h"

namespace study_app {

/// Which way the silhouette runs. `any` leaves it to the quarter turns of the roving; the other two
/// make the direction a condition, and roving then turns by halves only.
enum class Orientation { any, horizontal, vertical };

/// One silhouette. Stair is the 45 degree pattern, step the single step across the window, line a
/// silhouette of a given angle sampled at texel centres.
struct Silhouette {
    records::Pattern pattern = records::Pattern::stair;  ///< stair, step or line
    std::optional<double> angleDeg = {};                 ///< of a line alone, (0, 45)
    Orientation orientation = Orientation::any;          ///< of step and line
    bool operator==(const Silhouette&) const = default;
};

/// What the display can show, screen px. A proposed radius is rounded to a multiple of `step` and
/// then held within min and max; the staircase is updated with the result.
struct RadiusLimits {
    double min = 1;      ///< multiple of step, > 0
    double max = 300;    ///< multiple of step, at most the window; files default to half the window
    double step = 0.25;  ///< 0.25, 0.5 or 1
    bool operator==(const RadiusLimits&) const = default;
};

/// Share of a staircase's trials that the display cannot show as proposed above which its threshold
/// is a bound, not a measurement.
inline constexpr double kLimitShare = 0.3;

/// Random variation between trials, so that tilt or place cannot give the answer away. What is off
/// stays at zero.
struct Roving {
    bool shift = true;        ///< whole pixels, uniform within +-a/2
    bool quarterTurn = true;  ///< 0..3 quarter turns (0 or 2, 1 or 3 where a direction is set)
    bool mirror = true;
    bool tilt = true;  ///< step in 2AFC: the straight panel's tilt, uniform in +-atan(a / window)
    bool operator==(const Roving&) const = default;
};

/// The false-alarm rate that staircases assume in yes/no where a design gives none: careful
/// observers have 1 to 6 %. Presets keep their criterion there.
inline constexpr double kYesNoGamma = 0.05;

/// Rendered frames in the place of edges (frame_design.h).
struct FrameSet {
    std::filesystem::path folder;           ///< in which the pictures lie
    std::vector<records::FramePair> pairs;  ///< of its manifest
    /// SHA-256 by the pictures' names, so that a session goes on with the pictures that it began
    /// with; empty: not known.
    std::map<std::string, std::string> sha256 = {};
    bool operator==(const FrameSet&) const = default;
};

struct Design {
    std::string name;
    std::string description;
    records::Task task = records::Task::twoAfc;
    records::Encoding encoding = records::Encoding::srgb;
    int windowPx = 600;           ///< edge of the square stimulus, screen px
    std::vector<int> artifactPx;  ///< a, whole screen px (risers lie on pixel edges), < window / 2
    std::vector<Silhouette> patterns;
    std::vector<double> litLevels{1.0};  ///< share of full white, (0, 1]
    /// disc, box, gaussian, or turned taps: poisson16, poisson16-still (stimulus/tap_kernel.h)
    std::vector<std::string> kernels{"disc"};
    std::vector<double> noiseLevels{0};  ///< sd of image noise, 8-bit codes, [0, 64]
    bool dither = false;                 ///< codes rounded at random
    bool localise = false;               ///< yes/no: after "seen" a click on the artifact
    int trialsPerCondition = 40;         ///< catch trials not counted
    double catchShare = 0.1;  ///< of all trials, [0, .5]; what a catch trial is: session.h
    double guessRatio = 3;    ///< first guess of the threshold radius, as a multiple of a
    quest::QuestParameters staircase = quest::kDefaultParameters;  ///< priorMean: see guessRatio
    RadiusLimits radius;
    Roving roving;
    Presentation presentation;
    quest::ScreeningLimits screening;  ///< who is left out of the fit
    /// Then the rest that describes an edge is empty or at its default, and windowPx is the edge of
    /// the frames.
    std::optional<FrameSet> frames = {};
    /// Names of conditions that are shown alone, as where a session runs flagged ones again; empty:
    /// all of them. Whatever else is the same measures the same, so a fit takes both together.
    std::vector<std::string> onlyConditions = {};

    bool operator==(const Design&) const = default;
};

/// Empty when usable; else "<field>: <value>: <rule>" with the field's name in the file.
std::string validate(const Design& design);

/// The staircase's parameters with the prior centred on the guess.
quest::QuestParameters staircaseParameters(const Design& design);

struct Condition {
    std::string name;  ///< unique in the design: "step-a10-lit0.5", "line22.5-a8-lit1"
    Silhouette silhouette;
    double angleDeg = 45;  ///< of the true silhouette: stair 45, step atan(a / window), line its
                           ///< own; of frames without meaning
    int artifactPx = 0;    ///< 0: of frames, where it varies
    double litLevel = 1;
    std::string kernel;
    double noiseLevels = 0;
    std::vector<records::FramePair> frames = {};  ///< by rising r / a; of edges empty
};

/// Patterns outermost, then sizes, lit levels, kernels, noise. Kernel and noise are part of the
/// name where the design has several. Of these the ones in onlyConditions.
std::vector<Condition> conditions(const Design& design);

/// The strongest and the weakest x = log10(a / r) that the display, or the list of frames, can show
/// in a condition.
struct StrengthRange {
    double weakest = 0, strongest = 0;
};
StrengthRange strengthRange(const Design& design, const Condition& condition);

int catchTrials(
    const Design& design);  ///< so that their share of all trials is catchShare, rounded
int totalTrials(const Design& design);  ///< with catch trials

/// Minutes that a session takes, rounded up: trials with an answer after kTypicalAnswerS, and the
/// least breaks.
int expectedMinutes(const Design& design);

}  // namespace study_app
