// SPDX-License-Identifier: MIT
// From a study to everything that is reported of it: METHODS section 5 carried out in order.
//
//     const analysis::SlopeAnalysis result = analysis::analyseSlope(analysis::loadStudy(paths));
//     std::cout << records::describe(analysis::slopeRecord(result, context)) << '\n';
//
// The headline c is the worst group's under the law r = c a. Where the test of the law rejects it
// (p below kLawLevel), c is the maximum over the sizes that were measured instead.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "analysis/audience_curve.h"
#include "analysis/beta_analysis.h"
#include "analysis/lack_of_fit.h"
#include "analysis/line_fits.h"
#include "analysis/observer_bootstrap.h"
#include "analysis/pooled_fit.h"
#include "analysis/random_observer_fit.h"
#include "analysis/screening.h"
#include "analysis/stage_times.h"
#include "analysis/study.h"
#include "analysis/thresholds.h"
#include "analysis/worst_group.h"

namespace analysis {

inline constexpr double kLawLevel = 0.05;

struct AnalysisOptions {
    double criterion = quest::kPaperCriterion;  ///< F*, (0, 1)
    ScreeningRules screening = {};
    std::uint64_t seed = kBootstrapSeed;  ///< of the parametric bootstrap
    /// Off: headline, groups, overall and the test of the law alone, for simulations.
    bool comparisons = true;
    int bootstrap = 0;                         ///< draws of observers; 0: none
    int threads = 0;                           ///< as in parallel.h; no result depends on it
    std::function<void()> bootstrapDone = {};  ///< after each draw, from several threads
};

struct GroupResult {
    LinearEstimate c;  ///< log10 c, one-stage, r = c a
    int trials = 0, observers = 0;
    std::string flag = {};  ///< empty, or what its number rests on
    TwoStage twoStage;
    LineFits lines = {};
};

struct ConditionResult {
    std::optional<LinearEstimate> c;  ///< log10 c of this condition alone; absent where it has none
    int trials = 0, observers = 0;
    std::string flag;  ///< empty, or why there is no c
};

/// -2 ln of the likelihood ratio of two nested designs (plain form).
struct RatioTest {
    double statistic = 0;
    int degreesOfFreedom = 1;
    double pValue = 1;
};

/// Whether a factor of --by matters: one c for all its levels against one for each.
struct FactorTest {
    std::string factor;
    RatioTest test;
    struct Level {
        std::string name;
        LinearEstimate c;  ///< log10: mean over the groups that exist at every level
    };
    std::vector<Level> levels;  ///< empty where no group does
};

/// The slope of one set of observers: the fit, the test of the law, and the headline that follows.
struct SlopeResult {
    RandomObserverFit law;                     ///< r = c a, a slope per group
    std::vector<std::string> groupNames;       ///< of its slopes
    std::optional<RandomObserverFit> sizeFit;  ///< r = c a0 (a/a0)^kappa; absent with one size
    std::optional<LinearEstimate> kappa;       ///< the exponent, 1 under the law
    std::optional<RatioTest> kappaTest;
    bool lawRejected = false;
    WorstGroup headline;
    std::string worstGroup;                 ///< its name
    std::size_t worstIndex = 0;             ///< index into groups
    std::size_t betaIndex = 0;              ///< of its pattern, in betaPatterns(study)
    std::optional<double> worstArtifactPx;  ///< where the law was rejected: the size it belongs to
};

struct SlopeAnalysis {
    AnalysisOptions options;
    Study study;                              ///< what was fitted: screened, without flagged groups
    std::vector<ScreenedObserver> screening;  ///< everyone
    std::vector<std::string> notices;         ///< what was left out, what did not converge
    std::vector<std::string> absent;          ///< which intervals and tests cannot be had, and why

    SlopeResult slope;
    LinearEstimate overall;  ///< mean of the groups' log10 c
    std::vector<GroupResult> groups;
    std::vector<ConditionResult> conditions;
    std::vector<CellThreshold> thresholds;
    TwoStage twoStage;              ///< all groups
    LineFits lines;                 ///< all groups
    double percentAtThreshold = 0;  ///< P(yes) at r = c a with the fitted lapse and mean gamma

    // Comparisons:
    std::optional<RatioTest> equalGroupsTest;        ///< absent with one group
    std::vector<FactorTest> factorTests;             ///< one per factor with two levels and a fit
    std::optional<LinearEstimate> contrastExponent;  ///< e; absent with one lit level
    std::optional<PooledFit> pooled;
    std::optional<ObserverMean> secondHalf;  ///< shift of log10 c; absent with a trial per cell
    FitCheck fitCheck;                       ///< overdispersion, residuals
    std::optional<StaircaseComparison> staircases;
    std::vector<BetaEstimate> betas;             ///< per pattern
    std::optional<AudienceCurve> audience;       ///< of the worst group
    std::optional<ObserverBootstrap> bootstrap;  ///< where it was asked for
    /// With the observers that screening excluded; absent where it excluded nobody.
    std::optional<SlopeResult> everyone;
};

/// Throws std::invalid_argument for a criterion outside (0, 1); std::runtime_error, located, where
/// there is no slope: everyone excluded, a group whose threshold lies above every radius shown (it
/// might be the worst one), no group with a threshold, a fit that did not converge.
SlopeAnalysis analyseSlope(const Study& study, const AnalysisOptions& options = {},
                           StageTimes* times = nullptr);

}  // namespace analysis
