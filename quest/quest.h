// SPDX-License-Identifier: MIT
// QUEST: a Bayesian staircase for one threshold. It proposes where to place the next trial and
// holds the posterior over the threshold x0.
//
// Source: A. B. Watson and D. G. Pelli, "QUEST: A Bayesian adaptive psychometric method",
// Perception & Psychophysics 33 (1983), in the form that the Psychophysics Toolbox computes;
// placement at a quantile after D. G. Pelli, "The ideal psychometric procedure" (1987); the
// posterior mean as estimate after P. E. King-Smith et al., Vision Research 34 (1994).
//
//     quest::Quest staircase(quest::kDefaultParameters);
//     const double r = shownRadius(quest::radiusAt(a, staircase.quantile()));  // limits, rounding
//     staircase.update(quest::strength(a, r), answeredYes ? 1 : 0);            // what was shown
//     const double c = quest::radiusAt(1.0, staircase.mean());                 // at criterion()
//
// The unit of every threshold is the strength x = log10(a / r), not the radius: visibility rises
// with x, and QUEST fed with r runs to the wrong end. Limits of the display live outside: show
// what can be shown, then update with what was shown.
//
// The same parameters and history give the same bits, so that a session is resumed by replay.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "quest/psychometric.h"

namespace quest {

struct QuestParameters {
    double priorMean = -0.47712125471966244;  ///< g, centre of the candidates: x of r = 3 a
    double priorSd = 0.35;                    ///< s > 0, log10 units; at least grain / 20
    double pThreshold = 0.82;  ///< P(yes) that defines the threshold; must lie inside the curve
    double beta = 3.5;         ///< slope of the curve, > 0
    double delta = 0.01;       ///< share of blind answers, [0, 1)
    double gamma = 0.5;        ///< P(yes) without detection, [0, 1]; above pThreshold: .5 is used
                               ///< instead, with a warning
    double grain = 0.01;       ///< h, distance of the candidates, > 0, log10 units
    /// Width of the candidates, > 0, log10 units; absent: 500 intervals of grain. Be generous: a
    /// threshold outside is held to be impossible.
    std::optional<double> range = {};

    bool operator==(const QuestParameters&) const = default;
};

/// At most this many intervals of grain in range.
inline constexpr double kMaxIntervals = 1e6;

/// Empty when usable; else a sentence that names field, value and rule.
std::string validate(const QuestParameters& parameters);

/// F*, the corrected detection probability at the threshold: states which c = 10^-x0 is meant.
double criterion(const QuestParameters& parameters);

/// P(yes) at which an observer of this gamma and delta (guessing with gamma) detects with F*.
double thresholdProbability(double criterion, double gamma, double delta);

/// The same prior and criterion for a yes/no task, where gamma is the false-alarm rate. With F* =
/// .6465 trials are then placed where P(seen) is about .65: keep it within .6 to .8, since a trial
/// at low P carries a quarter of the information. For a lower criterion convert the result
/// (slopeFactor), do not place by it.
QuestParameters forYesNo(QuestParameters parameters, double falseAlarmRate);

struct QuestPreset {
    std::string_view name;
    std::string_view description;
    QuestParameters parameters;
};

/// The published study's set (Kreuzer, section 4.3; 2AFC). "Threshold guess 3 % of the artifact
/// size, also used as standard deviation guess" is read as a guess of 3 a with sd 0.3.
inline constexpr QuestParameters kPaperParameters{
    .priorSd = 0.3, .pThreshold = 0.82, .beta = 3.5, .delta = 0.01, .gamma = 0.5};

/// The default of new designs (2AFC): the paper's criterion, with more room for lapses.
inline constexpr QuestParameters kDefaultParameters{
    .priorSd = 0.35,
    .pThreshold = 0.02 * 0.5 + 0.98 * (0.5 + 0.5 * kPaperCriterion),
    .beta = 3.5,
    .delta = 0.02,
    .gamma = 0.5};

inline constexpr std::array<QuestPreset, 2> kPresets{{
    {"default", "paper's criterion, lapses of 2 %, prior sd 0.35", kDefaultParameters},
    {"paper", "as published: pThreshold .82, delta .01, gamma .5, beta 3.5", kPaperParameters},
}};

/// Nothing for a name that is not in kPresets.
std::optional<QuestParameters> presetNamed(std::string_view name);

struct QuestTrial {
    double x = 0;      ///< strength as given to update(), also where it left the table
    int response = 0;  ///< 1 yes (correct, seen), 0 no
    bool operator==(const QuestTrial&) const = default;
};

/// Something the user should hear about; nothing is printed here.
struct QuestWarning {
    enum class Kind {
        gammaReplaced,      ///< gamma was above pThreshold: .5 is used
        outOfRange,         ///< x too far from the guess for the table: its nearest place is used
        impossibleResponse  ///< no candidate allows this answer (delta = 0): the posterior is kept
    };
    Kind kind = Kind::outOfRange;
    std::size_t trial = 0;     ///< from 1; 0: at construction
    double value = 0;          ///< gamma, or x
    double low = 0, high = 0;  ///< range that x left
};
std::string toSentence(const QuestWarning& warning);

class Quest {
  public:
    /// Throws std::invalid_argument with validate()'s sentence.
    explicit Quest(const QuestParameters& parameters);

    /// Takes the strength that was shown and the answer into the posterior. Throws
    /// std::invalid_argument, with nothing changed, for an x that is not finite or a response other
    /// than 0 and 1.
    void update(double x, int response);

    /// Where to place the next trial: the quantile of quantileOrder(), the most informative one.
    double quantile() const { return quantile(quantileOrder_); }
    /// Throws std::invalid_argument for an order outside [0, 1].
    double quantile(double order) const;

    /// The estimate of the threshold, and its uncertainty.
    double mean() const;
    double sd() const;

    double quantileOrder() const { return quantileOrder_; }
    const QuestParameters& parameters() const { return parameters_; }

    /// The posterior, summing to one, over candidate(0) .. candidate(pdf().size() - 1).
    std::span<const double> pdf() const { return pdf_; }
    double candidate(std::size_t index) const { return parameters_.priorMean + offset(index); }

    std::span<const QuestTrial> history() const { return history_; }
    std::span<const QuestWarning> warnings() const { return warnings_; }

  private:
    struct RunningSum {
        std::size_t index;   // a candidate,
        double before, sum;  // and the sums of the posterior up to the one before it and up to it
    };

    double offset(std::size_t index) const;
    void setPrior();
    void tabulateCurve();
    void warn(QuestWarning::Kind kind, double x);
    double sumWeights();
    void normalise(double sum);
    double meanOffset() const;
    RunningSum firstReaching(double target) const;

    QuestParameters parameters_;
    std::size_t intervals_;    // D
    std::vector<double> pdf_;  // D + 1
    // The posterior before it was normalised, padded with zeros, and its running sums at the end of
    // every block of candidates: what quantiles are read from.
    std::vector<double> weights_, blockEnd_;
    // P and 1 - P over the table of 2 D + 1 points, in falling order of x, so that an update is one
    // product of two contiguous arrays.
    std::vector<double> yes_, no_;
    double quantileOrder_ = 0.5;
    std::vector<QuestTrial> history_;
    std::vector<QuestWarning> warnings_;
};

}  // namespace quest
