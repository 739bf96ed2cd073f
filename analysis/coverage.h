// SPDX-License-Identifier: MIT
// What a study of a given design would find: studies are simulated with the sessions of study_app
// itself and fitted, and every estimate is held against the truth that was simulated. For planning
// (how wide will the interval be with 8 observers?) and for judging the estimators.
//
//     analysis::CoveragePlan plan{.design = study_app::readDesign(file), .observers = 8};
//     const analysis::Coverage coverage = analysis::simulateCoverage(plan);
//     std::cout << analysis::alignedText(analysis::coverageTable(coverage));
//
// Study i of a plan is the same whatever the number of threads. A library of its own beside
// `analysis`: trial tables go from study_app to the fit, so that this direction of linking is that
// of the data, and the fit itself still knows nothing of sessions.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "analysis/text_table.h"
#include "records/trial_table.h"
#include "study_app/design.h"
#include "study_app/simulated_population.h"

namespace analysis {

struct CoveragePlan {
    study_app::Design design;
    study_app::SimulatedPopulation population = {};
    int observers = 10;                         ///< [1, 9999]
    int guessing = 0;                           ///< the last so many of them press at random
    int studies = 100;                          ///< >= 2
    std::uint64_t seed = 1;                     ///< of all that is random
    double criterion = quest::kPaperCriterion;  ///< F* of the fit, (0, 1)
    int threads = 0;                            ///< 0: one for each processor
};

/// One estimator over the studies. Errors are estimate - truth, in log10 units of c (a factor of
/// 1.023 per .01) but for kappa, tau and omega, which are in their own units.
struct EstimatorCoverage {
    std::string name;
    double truth = 0;             ///< log10 c; kappa, tau, omega themselves
    bool isSlope = true;          ///< truth is log10 c
    int studies = 0;              ///< that gave an estimate
    double bias = 0, median = 0;  ///< of the error
    double sd = 0;                ///< of the estimate between studies
    int intervals = 0;            ///< studies that gave an interval
    int covered = 0;              ///< of them with the truth inside
    double halfWidth = 0;         ///< median of half the interval's width

    double biasError() const;      ///< Monte-Carlo standard errors
    double medianError() const;    ///< 1.2533 sd / sqrt(n), that of a normal's median
    double sdError() const;        ///< sd / sqrt(2 (n - 1))
    double coverage() const;       ///< covered / intervals
    double coverageError() const;  ///< binomial, at least that of one miss
};

/// What guessing observers do to the headline: the same studies with and without them, where the
/// guessers were attentive as well.
struct GuessingEffect {
    int studies = 0;
    int incomplete = 0;                                ///< of them without one of the two shifts
    std::string firstError = {};                       ///< of these
    double screenedMedian = 0, screenedError = 0;      ///< of log10 c, excluded by the rules
    double unscreenedMedian = 0, unscreenedError = 0;  ///< of log10 c, nobody excluded
    double guessersExcluded = 0;                       ///< share
    double attentiveExcluded = 0;                      ///< share
};

struct Coverage {
    CoveragePlan plan;
    std::vector<EstimatorCoverage> estimators;
    int withoutSlope = 0;               ///< studies whose analysis was an error
    std::string firstError = {};        ///< of them
    int notConverged = 0;               ///< studies whose fit did not
    std::optional<double> lawRejected;  ///< share of the studies with a test of kappa = 1
    double fitSeconds = 0;              ///< median for one study
    std::optional<GuessingEffect> guessing;
};

/// Throws std::invalid_argument for a plan outside its ranges and what studyOf throws for a design
/// that no one slope stands for (several kernels). `done` is called after each study, from several
/// threads.
Coverage simulateCoverage(const CoveragePlan& plan, const std::function<void()>& done = {});

/// One simulated study as tables, with `guessing` guessers among them.
std::vector<records::TrialTable> simulatedTables(const CoveragePlan& plan, std::uint64_t studySeed,
                                                 int guessing);

/// One row per estimator with Monte-Carlo errors.
TextTable coverageTable(const Coverage& coverage);
/// What was simulated, and what the table leaves out, in sentences.
std::vector<std::string> coverageFindings(const Coverage& coverage);

}  // namespace analysis
