// SPDX-License-Identifier: MIT
#include "analysis/slope_analysis.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>
#include <stdexcept>

#include "analysis/distributions.h"
#include "analysis/slope_model.h"

namespace analysis {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

VectorXd unitVector(Index size, Index at) {
    VectorXd unit = VectorXd::Zero(size);
    unit[at] = 1;
    return unit;
}

std::string joined(const std::vector<std::string>& sentences) {
    std::string text;
    for (const std::string& sentence : sentences) text += (text.empty() ? "" : "; ") + sentence;
    return text;
}

void lap(StageTimes* times, const char* stage) {
    if (times) times->lap(stage);
}

Study screened(const Study& study, SlopeAnalysis& result) {
    result.screening = screen(study, result.options.screening);
    Study kept = withoutExcluded(study, result.screening);
    if (kept.observers.empty()) {
        std::vector<std::string> reasons;
        for (const ScreenedObserver& row : result.screening) {
            reasons.push_back("participant " + row.id + ": " + row.reason);
        }
        throw std::runtime_error(study.files.front().string() +
                                 ": no observer passes the screening: " + joined(reasons));
    }
    return kept;
}

// Groups without a threshold. One that lies below every radius shown cannot be the worst and is
// left out; one that lies above might be, so that there is no headline.
Study withThresholds(const Study& study, double criterion, std::vector<std::string>& notices,
                     std::vector<std::string>& groupFlags) {
    const std::vector<GroupCheck> checks = checkGroups(study, criterion);
    std::vector<bool> keep(study.conditions.size());
    bool any = false;
    for (std::size_t g = 0; g < checks.size(); ++g) {
        const std::string where = study.files.front().parent_path().string() + ": ";
        if (checks[g].state == GroupState::aboveShown) {
            throw std::runtime_error(where + checks[g].sentence +
                                     ", so that the largest slope is not known");
        }
        const bool estimable = checks[g].state == GroupState::estimable;
        if (estimable) {
            groupFlags.push_back(checks[g].oneRadius ? "one radius only: rests on the prior of beta"
                                                     : "");
        } else {
            notices.push_back(checks[g].sentence + ": group left out");
        }
        any = any || estimable;
        for (std::size_t k = 0; k < keep.size(); ++k) {
            if (study.conditions[k].group == g) keep[k] = estimable;
        }
    }
    if (!any) {
        throw std::runtime_error(study.files.front().parent_path().string() +
                                 ": no slope can be fitted: " + checks.front().sentence);
    }
    return subset(study, std::vector<bool>(study.observers.size(), true), keep);
}

// A fit that others can start from.
struct Fitted {
    MatrixXd design;
    RandomObserverFit fit;
};

RandomObserverFit fit(const Study& study, MatrixXd design, double criterion, FitOptions options,
                      const VectorXd& perCondition, const ModelParameters* curve) {
    const Model model = slopeModel(study, std::move(design), criterion);
    Start start = startOf(model, perCondition);
    options.estimateTau = options.estimateTau && start.estimateTau;
    options.estimateOmega = options.estimateOmega && start.estimateOmega;
    if (curve) {
        start.parameters.beta = curve->beta;
        // Off the bounds, where the likelihood is level in its coordinates.
        start.parameters.lapse = std::clamp(curve->lapse, 0.005, 0.145);
        if (options.estimateTau) start.parameters.tau = std::max(0.01, curve->tau);
        if (options.estimateOmega) start.parameters.omega = std::max(0.01, curve->omega);
    }
    return fitRandomObservers(model, start.parameters, options);
}

// From the pooled answers of each group.
RandomObserverFit fitFresh(const Study& study, const MatrixXd& design, double criterion) {
    const std::vector<GroupCheck> checks = checkGroups(study, criterion);
    VectorXd perCondition(design.rows());
    for (std::size_t k = 0; k < study.conditions.size(); ++k) {
        perCondition[static_cast<Index>(k)] = checks[study.conditions[k].group].log10c;
    }
    return fit(study, design, criterion, {}, perCondition, nullptr);
}

// From another fit of the same study: a few steps.
RandomObserverFit fitFrom(const Fitted& from, const Study& study, const MatrixXd& design,
                          double criterion, FitOptions options = {}) {
    options.inverseHessian = from.fit.inverseHessian;
    return fit(study, design, criterion, options, from.design * from.fit.parameters.fixed,
               &from.fit.parameters);
}

RatioTest ratioTest(const RandomObserverFit& narrow, const RandomObserverFit& wide,
                    int degreesOfFreedom) {
    const double statistic = std::max(0.0, 2 * (wide.logLikelihood - narrow.logLikelihood));
    return {statistic, degreesOfFreedom, chiSquaredSurvival(statistic, degreesOfFreedom)};
}

const FitOptions kForRatio{.form = LikelihoodForm::plain, .covariance = false};

void noteConvergence(const RandomObserverFit& fit, const std::string& what,
                     std::vector<std::string>& notices) {
    if (fit.converged && fit.message.empty()) return;
    std::ostringstream text;
    text << what << ": " << fit;
    if (fit.converged) text << "; " << fit.message;
    notices.push_back(text.str());
}

void testTheLaw(const Study& study, double criterion, const MatrixXd& design, const Fitted& law,
                const RandomObserverFit& narrow, SlopeResult& result,
                std::vector<std::string>& notices) {
    const Fitted wide{design, fitFrom(law, study, design, criterion, kForRatio)};
    result.sizeFit = fitFrom(wide, study, design, criterion);
    noteConvergence(*result.sizeFit, "fit of kappa", notices);
    if (result.sizeFit->converged) {
        result.kappa =
            linearEstimate(*result.sizeFit, unitVector(design.cols(), design.cols() - 1));
        result.kappa->value += 1;
    }
    if (!narrow.converged || !wide.fit.converged) {
        noteConvergence(narrow, "test of kappa = 1 left out", notices);
        noteConvergence(wide.fit, "test of kappa = 1 left out", notices);
        return;
    }
    result.kappaTest = ratioTest(narrow, wide.fit, 1);
    result.lawRejected = result.kappaTest->pValue < kLawLevel && result.sizeFit->converged;
}

// What the headline is the largest of: the groups' slopes, or where the law was rejected those at
// the measured sizes. log10 c at size a = log10 c at a0 + (kappa - 1) log10(a/a0), a condition's
// row of the design.
MatrixXd headlineTargets(const Study& study, const SlopeResult& result) {
    const auto n = static_cast<Index>(study.groups.size());
    return result.lawRejected ? *sizeExponentDesign(study) : MatrixXd::Identity(n, n);
}

const RandomObserverFit& headlineFit(const SlopeResult& result) {
    return result.lawRejected ? *result.sizeFit : result.law;
}

void chooseHeadline(const Study& study, std::uint64_t seed, SlopeResult& result) {
    result.headline = worstGroup(headlineFit(result), headlineTargets(study, result), seed);
    auto group = static_cast<std::size_t>(result.headline.index);
    if (result.lawRejected) {
        const Condition& worst = study.conditions[group];
        group = worst.group;
        result.worstArtifactPx = worst.artifactPx;
    }
    result.worstGroup = study.groups[group].name;
    result.worstIndex = group;
    const std::vector<records::Pattern> patterns = betaPatterns(study);
    result.betaIndex = static_cast<std::size_t>(
        std::find(patterns.begin(), patterns.end(), study.groups[group].pattern) -
        patterns.begin());
}

// A search that did not end may stand anywhere: not further than a factor of 10 from what the
// pooled answers say, or there is no slope.
void refuseStrayFit(const Study& study, double criterion, const RandomObserverFit& law) {
    if (law.converged) return;
    const std::vector<GroupCheck> checks = checkGroups(study, criterion);
    for (std::size_t g = 0; g < checks.size(); ++g) {
        const double off = law.parameters.fixed[static_cast<Index>(g)] - checks[g].log10c;
        if (std::abs(off) < 1) continue;  // NaN is not
        std::ostringstream why;
        why << law;
        throw std::runtime_error(study.files.front().parent_path().string() +
                                 ": no slope can be fitted: " + why.str());
    }
}

// `plain` is filled where the test of the law needed it.
SlopeResult slopeOf(const Study& study, const AnalysisOptions& options,
                    std::vector<std::string>& notices, std::optional<RandomObserverFit>& plain,
                    StageTimes* times) {
    SlopeResult result;
    for (const Group& group : study.groups) result.groupNames.push_back(group.name);
    const MatrixXd perGroup = perGroupDesign(study);
    result.law = fitFresh(study, perGroup, options.criterion);
    refuseStrayFit(study, options.criterion, result.law);
    noteConvergence(result.law, "fit of the law", notices);
    lap(times, "fit of the law");
    if (const auto design = sizeExponentDesign(study)) {
        const Fitted law{perGroup, result.law};
        plain = fitFrom(law, study, perGroup, options.criterion, kForRatio);
        testTheLaw(study, options.criterion, *design, law, *plain, result, notices);
        lap(times, "test of the law");
    }
    chooseHeadline(study, options.seed, result);
    lap(times, "headline and its interval");
    return result;
}

std::pair<int, int> countsOf(const Study& study, std::size_t group,
                             std::optional<std::size_t> condition) {
    int observers = 0, trials = 0;
    for (const Observer& observer : study.observers) {
        int own = 0;
        for (const Cell& cell : observer.cells) {
            const bool counts = condition ? cell.condition == *condition
                                          : study.conditions[cell.condition].group == group;
            own += counts ? static_cast<int>(cell.trials.size()) : 0;
        }
        observers += own > 0 ? 1 : 0;
        trials += own;
    }
    return {observers, trials};
}

// A slope of its own per condition, for those that have a threshold.
void fitConditions(SlopeAnalysis& result) {
    const std::vector<GroupCheck> checks = checkConditions(result.study, result.options.criterion);
    std::vector<bool> keep;
    for (const GroupCheck& check : checks) keep.push_back(check.state == GroupState::estimable);
    const Study estimable =
        subset(result.study, std::vector<bool>(result.study.observers.size(), true), keep);
    RandomObserverFit own;
    if (!estimable.conditions.empty()) {
        const VectorXd all = perGroupDesign(result.study) * result.slope.law.parameters.fixed;
        VectorXd perCondition(static_cast<Index>(estimable.conditions.size()));
        Index next = 0;
        for (std::size_t k = 0; k < keep.size(); ++k) {
            if (keep[k]) perCondition[next++] = all[static_cast<Index>(k)];
        }
        // A pattern that lost all its conditions has lost its beta as well.
        const bool sameCurve = next == all.size();
        own = fit(estimable, perConditionDesign(estimable), result.options.criterion, {},
                  perCondition, sameCurve ? &result.slope.law.parameters : nullptr);
        noteConvergence(own, "fit of the single conditions", result.notices);
    }
    Index column = 0;
    for (std::size_t k = 0; k < checks.size(); ++k) {
        ConditionResult row;
        std::tie(row.observers, row.trials) = countsOf(result.study, 0, k);
        row.flag = keep[k] ? (checks[k].oneRadius ? "one radius only" : "") : checks[k].sentence;
        if (keep[k] && own.converged) {
            row.c = linearEstimate(own, unitVector(own.parameters.fixed.size(), column));
        }
        column += keep[k] ? 1 : 0;
        result.conditions.push_back(std::move(row));
    }
}

void describeGroups(SlopeAnalysis& result, const std::vector<std::string>& flags) {
    const auto n = static_cast<Index>(result.study.groups.size());
    for (Index g = 0; g < n; ++g) {
        const auto group = static_cast<std::size_t>(g);
        GroupResult row{.c = linearEstimate(result.slope.law, unitVector(n, g)),
                        .flag = flags[group],
                        .twoStage = twoStage(result.study, result.thresholds, group),
                        .lines = lineFits(result.study, result.thresholds, group)};
        std::tie(row.observers, row.trials) = countsOf(result.study, group, std::nullopt);
        result.groups.push_back(std::move(row));
    }
    result.overall =
        linearEstimate(result.slope.law, VectorXd::Constant(n, 1.0 / static_cast<double>(n)));
}

// The same with everyone, where screening excluded somebody.
void includeEveryone(const Study& all, SlopeAnalysis& result) {
    const bool excluded = std::any_of(result.screening.begin(), result.screening.end(),
                                      [](const ScreenedObserver& row) { return row.excluded; });
    if (!excluded) return;
    std::vector<std::string> notices, flags;
    std::optional<RandomObserverFit> plain;
    try {
        const Study everyone = withThresholds(all, result.options.criterion, notices, flags);
        result.everyone = slopeOf(everyone, result.options, notices, plain, nullptr);
    } catch (const std::runtime_error& error) {
        notices.push_back(error.what());
    }
    for (const std::string& notice : notices) {
        result.notices.push_back("with everyone: " + notice);
    }
}

// A level's mean over the groups that differ in nothing but the factor and have every level.
std::vector<FactorTest::Level> levelsOf(const Study& study, const RandomObserverFit& law,
                                        std::size_t factor,
                                        const std::vector<std::size_t>& merged) {
    std::map<std::string, VectorXd> weights;
    const auto n = static_cast<Index>(study.groups.size());
    for (const Group& group : study.groups) weights[group.levels[factor]] = VectorXd::Zero(n);
    for (std::size_t g = 0; g < study.groups.size(); ++g) {
        const auto alike = std::count(merged.begin(), merged.end(), merged[g]);
        if (static_cast<std::size_t>(alike) != weights.size()) continue;
        weights[study.groups[g].levels[factor]][static_cast<Index>(g)] = 1;
    }
    std::vector<FactorTest::Level> levels;
    for (const auto& [name, weight] : weights) {
        if (weight.sum() == 0) return {};
        levels.push_back({name, linearEstimate(law, weight / weight.sum())});
    }
    return levels;
}

void testFactors(const Fitted& law, const RandomObserverFit& plain, SlopeAnalysis& result) {
    const Study& study = result.study;
    for (std::size_t f = 0; f < study.factors.size(); ++f) {
        const std::vector<std::size_t> merged = groupsWithout(study, f);
        const std::size_t count = *std::max_element(merged.begin(), merged.end()) + 1;
        if (count == study.groups.size()) {
            result.absent.push_back("test of " + study.factors[f] +
                                    ": no pattern and light was shown at two of its levels");
            continue;
        }
        const RandomObserverFit equal =
            fitFrom(law, study, mergedDesign(study, merged), result.options.criterion, kForRatio);
        if (!equal.converged || !plain.converged) {
            noteConvergence(equal, "test of " + study.factors[f] + " left out", result.notices);
            continue;
        }
        result.factorTests.push_back(
            {study.factors[f],
             ratioTest(equal, plain, static_cast<int>(study.groups.size() - count)),
             levelsOf(study, law.fit, f, merged)});
    }
}

void checkTheModel(SlopeAnalysis& result) {
    const Study& study = result.study;
    const double criterion = result.options.criterion;
    // Where the law bends, sizes that it does not fit are no sign of a wrong curve.
    const RandomObserverFit& fit = headlineFit(result.slope);
    const Model model = slopeModel(
        study, result.slope.lawRejected ? *sizeExponentDesign(study) : perGroupDesign(study),
        criterion);
    if (fit.converged) {
        result.secondHalf = secondHalfShift(study, model, fit);
        result.fitCheck = checkFit(study, model, fit);
    }
    std::string why;
    result.staircases = compareStaircases(study, result.thresholds, criterion, why);
    if (!result.staircases) {
        result.absent.push_back("comparison with the staircases' own thresholds: " + why);
    }
}

void compare(const Study& all, std::optional<RandomObserverFit> plain, SlopeAnalysis& result,
             StageTimes* times) {
    const Study& study = result.study;
    const double criterion = result.options.criterion;
    const Fitted law{perGroupDesign(study), result.slope.law};
    if (study.groups.size() >= 2) {
        if (!plain) plain = fitFrom(law, study, law.design, criterion, kForRatio);
        const RandomObserverFit equal =
            fitFrom(law, study, oneSlopeDesign(study), criterion, kForRatio);
        if (equal.converged && plain->converged) {
            result.equalGroupsTest =
                ratioTest(equal, *plain, static_cast<int>(study.groups.size()) - 1);
        }
    }
    if (plain) testFactors(law, *plain, result);
    if (const auto design = contrastDesign(study)) {
        const RandomObserverFit contrast = fitFrom(law, study, *design, criterion);
        noteConvergence(contrast, "fit of the contrast exponent", result.notices);
        result.contrastExponent =
            linearEstimate(contrast, unitVector(design->cols(), design->cols() - 1));
    } else {
        result.absent.push_back("contrast exponent: no pattern was shown at two lit levels");
    }
    lap(times, "tests");
    fitConditions(result);
    lap(times, "conditions");
    result.pooled =
        fitPooled(slopeModel(study, perGroupDesign(study), criterion), result.slope.law.parameters);
    lap(times, "pooled fit");
    includeEveryone(all, result);
    lap(times, "with everyone");
    checkTheModel(result);
    lap(times, "checks of the model");
    const SlopeResult& slope = result.slope;
    result.betas = betaAnalysis(study, slope.law);
    if (headlineFit(slope).converged) {
        result.audience =
            audienceCurve(headlineFit(slope), slope.headline, slope.betaIndex, criterion);
    }
    if (result.options.bootstrap > 0) {
        const MatrixXd design = slope.lawRejected ? *sizeExponentDesign(study) : law.design;
        result.bootstrap = bootstrapObservers(
            slopeModel(study, design, criterion), headlineFit(slope), headlineTargets(study, slope),
            slope.headline, result.options.bootstrap, result.options.seed, result.options.threads,
            result.options.bootstrapDone);
        lap(times, "bootstrap");
    }
}

void nameAbsences(SlopeAnalysis& result) {
    const RandomObserverFit& law = result.slope.law;
    if (law.observers < 2 && result.study.observers.size() >= 2) {
        result.absent.push_back(
            "every interval of c: no two observers share a group, so that the spread between "
            "observers cannot be told from that between groups");
    } else if (law.observers < 2) {
        result.absent.push_back(
            "every interval of c: one observer says nothing about how observers differ");
    } else if (law.covariance.size() == 0) {
        result.absent.push_back("every interval of c: " + law.message);
    }
    if (!result.slope.kappa) {
        result.absent.push_back("exponent kappa and its test: no group has two artifact sizes");
    }
    if (law.parameters.omega == 0 && !law.omegaAtZero) {
        result.absent.push_back(
            "spread of observer x condition: no more cells than observers and slopes; it counts as "
            "spread between observers");
    }
}

double percentAtThreshold(const Study& study, const RandomObserverFit& law, double criterion) {
    double sum = 0;
    for (const Observer& observer : study.observers) {
        const double gamma = guessingRate(observer, study.task);
        sum += quest::responseProbability(criterion,
                                          quest::ResponseModel{gamma, law.parameters.lapse, gamma});
    }
    return 100 * sum / static_cast<double>(study.observers.size());
}

}  // namespace

SlopeAnalysis analyseSlope(const Study& study, const AnalysisOptions& options, StageTimes* times) {
    if (!(options.criterion > 0 && options.criterion < 1)) {
        throw std::invalid_argument("criterion " + std::to_string(options.criterion) +
                                    ": must be a probability between 0 and 1");
    }
    SlopeAnalysis result;
    result.options = options;
    result.notices = study.notices;
    std::vector<std::string> flags;
    result.study =
        withThresholds(screened(study, result), options.criterion, result.notices, flags);
    lap(times, "screening");
    std::optional<RandomObserverFit> plain;
    result.slope = slopeOf(result.study, options, result.notices, plain, times);

    const RandomObserverFit& law = result.slope.law;
    const Model model = slopeModel(result.study, perGroupDesign(result.study), options.criterion);
    result.thresholds = cellThresholds(result.study, model, law.parameters);
    result.twoStage = twoStage(result.study, result.thresholds);
    result.lines = lineFits(result.study, result.thresholds);
    describeGroups(result, flags);
    result.percentAtThreshold = percentAtThreshold(result.study, law, options.criterion);
    nameAbsences(result);
    lap(times, "two-stage thresholds");
    if (options.comparisons) compare(study, std::move(plain), result, times);
    return result;
}

}  // namespace analysis
