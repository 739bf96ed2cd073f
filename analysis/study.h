// SPDX-License-Identifier: MIT
// The trials of a study, as the fit sees them: observers x conditions, with everything that does
// not enter a fit left out and said so.
//
//     const analysis::Study study = analysis::loadStudy({"data"});
//     for (const std::string& notice : study.notices) std::cerr << notice << '\n';
//
// A group is a pattern (of lines: an angle; of frames: a scene at a radius) at a lit level: the
// unit that has a slope c of its own. The conditions of a group are its artifact sizes. Frames hold
// the radius and vary the size: their trials are brought to the geometric mean of the sizes shown,
// each at its own r / a.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "records/trial_table.h"

namespace analysis {

struct Group {
    std::string name;  ///< "stair, lit 1", "line 22.5 deg, lit 1"
    records::Pattern pattern = records::Pattern::stair;
    std::optional<double> angleDeg;  ///< where all its trials have the same one, as lines do
    double litLevel = 1;
    std::string kind = {};                 ///< the name without the levels
    std::vector<std::string> levels = {};  ///< of Study::factors: "box", "expert"
    std::string kernel = {};
    std::optional<records::Encoding> encoding = {};  ///< absent where no table says it
};

struct Condition {
    std::size_t group = 0;  ///< index into Study::groups
    double artifactPx = 0;
    std::optional<double> angleDeg;  ///< of the true silhouette, where its trials have the same one
};

struct StudyTrial {
    double radiusPx = 0;  ///< shown
    std::optional<double> proposedPx;
    bool yes = false;         ///< 2AFC: correct; yes/no: seen
    bool catchTrial = false;  ///< 2AFC: not placed by a staircase although others are
};

struct Cell {
    std::size_t condition = 0;       ///< index into Study::conditions
    std::vector<StudyTrial> trials;  ///< at least one, in file order
    /// By the staircases that placed them: minus the last posterior mean of x0 in the table, at the
    /// staircases' own criterion (Study::staircases); mean over them where there are several.
    std::optional<double> staircaseLog10c = {};
};

struct Observer {
    std::string id;
    std::vector<Cell> cells;                 ///< at least one, by condition
    int references = 0;                      ///< yes/no: artifact-free trials
    int falseAlarms = 0;                     ///< of them answered "seen"
    int catchTrials = 0, catchFailures = 0;  ///< 2AFC
};

/// What the staircases assumed.
struct StaircaseTerms {
    double criterion = 0;  ///< F* of the threshold that they looked for
    double beta = 0;
    bool operator==(const StaircaseTerms&) const = default;
};

/// Who is left out, as the design fixed it before anybody had answered; screening.h has the rules.
struct ScreeningLimits {
    double falseAlarmRate = 0.10, catchFailureShare = 0.20;
    bool operator==(const ScreeningLimits&) const = default;
};

struct Study {
    std::vector<Group> groups;          ///< by pattern, angle, falling lit level
    std::vector<Condition> conditions;  ///< by group, artifact size
    std::vector<Observer> observers;    ///< by id
    std::vector<std::string> factors;   ///< by which groups are divided beyond pattern and light
    records::Task task = records::Task::twoAfc;
    std::string kernel;  ///< of all groups; "box, disc" where they are divided by it
    std::optional<records::Encoding> encoding;  ///< absent where no table says it or groups differ
    std::optional<double> pxPerDeg;             ///< mean over sessions, where every sidecar has it
    std::optional<StaircaseTerms> staircases;   ///< where every sidecar says the same
    std::optional<ScreeningLimits> screening;  ///< of the design, where every sidecar says the same
    std::vector<std::filesystem::path> files;
    std::vector<std::string> notices;  ///< what was left out, and why
};

/// Every table named, or found below a folder named. Sessions of one participant are joined. `by`
/// names further factors that divide the groups (factors.h). Throws std::runtime_error, located: no
/// table, a malformed table (records/trial_table.h), two tables of one session, tables that differ
/// in task, or in kernel, encoding or (as their sidecars say) design without being divided by it,
/// nothing left to fit; std::invalid_argument for a factor that cannot be.
Study loadStudy(std::span<const std::filesystem::path> paths, std::span<const std::string> by = {});

/// The same of tables already read, in which factors are columns; sidecars are not looked for.
Study studyOf(std::span<const records::TrialTable> tables, std::span<const std::string> by = {});

/// P(yes) without detection: .5 in 2AFC; yes/no: the false-alarm rate, shrunk ((FA + .5)/(n + 1)).
double guessingRate(const Observer& observer, records::Task task);

int trialCount(const Study& study);
int trialCount(const Study& study, std::size_t group);
/// Geometric mean of the distinct artifact sizes, px: where c and the size exponent are least
/// entangled.
double referenceArtifactPx(const Study& study);
std::string conditionName(const Study& study, std::size_t condition);  ///< "stair, lit 1, a 10"

/// The study with only those observers and conditions for which `observer[i]`, `condition[k]` is
/// true; groups, conditions and observers that lose all their trials go too.
Study subset(const Study& study, const std::vector<bool>& observer,
             const std::vector<bool>& condition);

}  // namespace analysis
