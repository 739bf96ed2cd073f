// SPDX-License-Identifier: MIT
#include "analysis/coverage.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <random>
#include <stdexcept>

#include "analysis/distributions.h"
#include "analysis/number_text.h"
#include "analysis/parallel.h"
#include "analysis/slope_analysis.h"
#include "analysis/slope_model.h"
#include "study_app/session.h"
#include "study_app/simulated_study.h"

namespace analysis {
namespace {

constexpr double kGuesserLapse = 0.999999;  // a lapse of 1 is no observer at all

void require(bool holds, const std::string& what, const std::string& rule) {
    if (!holds) throw std::invalid_argument(what + ": must be " + rule);
}

void validate(const CoveragePlan& plan) {
    require(plan.observers >= 1 && plan.observers <= 9999,
            "observers: " + std::to_string(plan.observers), "from 1 to 9999");
    require(plan.guessing >= 0 && plan.guessing < plan.observers,
            "guessing: " + std::to_string(plan.guessing), "from 0 to less than all observers");
    require(plan.studies >= 2, "studies: " + std::to_string(plan.studies), "at least 2");
    require(plan.criterion > 0 && plan.criterion < 1, "criterion: " + shortText(plan.criterion),
            "a probability between 0 and 1");
    const std::string problem = study_app::validate(plan.design);
    if (!problem.empty()) throw std::invalid_argument("design: " + problem);
}

std::uint64_t seedOfStudy(std::uint64_t seed, std::size_t index) {
    std::seed_seq sequence{seed & 0xFFFFFFFFU, seed >> 32, static_cast<std::uint64_t>(index)};
    return std::mt19937_64(sequence)();
}

// What the mean observer has, at the criterion of the fit.
struct Truth {
    std::vector<study_app::Condition> conditions;
    std::vector<double> log10c;  // of the conditions
    double worst = 0;            // where kappa bends the law, over the measured sizes

    explicit Truth(const CoveragePlan& plan) : conditions(study_app::conditions(plan.design)) {
        study_app::SimulatedPopulation mean = plan.population;
        mean.observerSd = mean.conditionSd = 0;
        const auto observer = study_app::drawParticipant(mean, plan.design, 0);
        const double factor =
            quest::slopeFactor(mean.criterion, plan.criterion, plan.population.beta);
        for (std::size_t k = 0; k < conditions.size(); ++k) {
            log10c.push_back(std::log10(factor * study_app::trueSlope(observer, k)));
        }
        worst = *std::max_element(log10c.begin(), log10c.end());
    }

    // Mean over its sizes: c at their geometric mean.
    double ofGroup(const Group& group) const {
        double sum = 0;
        int count = 0;
        for (std::size_t k = 0; k < conditions.size(); ++k) {
            const study_app::Silhouette& shape = conditions[k].silhouette;
            const bool line = shape.pattern == records::Pattern::line;
            if (shape.pattern != group.pattern || conditions[k].litLevel != group.litLevel ||
                (line && shape.angleDeg != group.angleDeg)) {
                continue;
            }
            sum += log10c[k];
            ++count;
        }
        return sum / count;
    }

    double ofAll(const Study& study) const {
        double sum = 0;
        for (const Group& group : study.groups) sum += ofGroup(group);
        return sum / static_cast<double>(study.groups.size());
    }
};

// One estimate of one study.
struct Estimate {
    std::string name;
    double truth = 0;
    bool isSlope = true;
    std::optional<double> value;
    std::optional<records::Interval> ci95;
};

struct StudyOutcome {
    std::string error;  // empty, or why there is no slope
    bool converged = false;
    std::optional<bool> lawRejected;
    double seconds = 0;
    std::vector<Estimate> estimates;
    // With guessing observers:
    std::optional<double> screenedShift, unscreenedShift;
    std::string comparisonError;  // empty, or why one of them is missing
    int guessersExcluded = 0, attentiveExcluded = 0;
};

std::vector<Estimate> estimatesOf(const SlopeAnalysis& result, const CoveragePlan& plan,
                                  const Truth& truth) {
    const SlopeResult& slope = result.slope;
    const double all = truth.ofAll(result.study);
    std::vector<Estimate> rows = {
        {"headline: worst group", truth.worst, true, slope.headline.value, slope.headline.ci95},
        {"90th-percentile observer", truth.worst + kPercentile90 * plan.population.observerSd, true,
         slope.headline.value90, slope.headline.ci95For90},
        {"overall, one-stage", all, true, result.overall.value, result.overall.ci95()}};
    for (std::size_t g = 0; g < result.groups.size(); ++g) {
        const LinearEstimate& c = result.groups[g].c;
        rows.push_back({"group " + result.study.groups[g].name,
                        truth.ofGroup(result.study.groups[g]), true, c.value, c.ci95()});
    }
    rows.push_back({"two-stage mean", all, true, result.twoStage.log10c, result.twoStage.ci95});
    rows.push_back({"two-stage median", all, true, result.twoStage.medianLog10c, {}});
    const PooledFit pooled =
        fitPooled(slopeModel(result.study, perGroupDesign(result.study), plan.criterion),
                  slope.law.parameters);
    if (pooled.converged) {
        Estimate row{"pooled, trials independent", all, true, pooled.fixed.mean(), {}};
        if (pooled.covariance.size() > 0) {
            const auto n = pooled.fixed.size();
            const double half = normalQuantile(0.975) *
                                std::sqrt(pooled.covariance.topLeftCorner(n, n).sum()) /
                                static_cast<double>(n);
            row.ci95 = records::Interval{*row.value - half, *row.value + half};
        }
        rows.push_back(row);
    }
    const LineFits& lines = result.lines;
    if (lines.throughOrigin) {
        rows.push_back(
            {"line through the origin, px", all, true, std::log10(*lines.throughOrigin), {}});
    }
    if (lines.affine && lines.affine->slope > 0) {
        rows.push_back(
            {"affine line, its slope, px", all, true, std::log10(lines.affine->slope), {}});
    }
    if (lines.powerLaw) {
        rows.push_back({"power law at the mean size", all, true, lines.powerLaw->log10c, {}});
    }
    if (slope.kappa) {
        rows.push_back(
            {"kappa", plan.population.kappa, false, slope.kappa->value, slope.kappa->ci95()});
    }
    rows.push_back({"tau, sd between observers",
                    plan.population.observerSd,
                    false,
                    slope.law.parameters.tau,
                    {}});
    rows.push_back({"omega, observer x condition",
                    plan.population.conditionSd,
                    false,
                    slope.law.parameters.omega,
                    {}});
    return rows;
}

SlopeAnalysis analysed(const std::vector<records::TrialTable>& tables, const CoveragePlan& plan,
                       bool screening) {
    AnalysisOptions options;
    options.criterion = plan.criterion;
    options.screening.apply = screening;
    options.comparisons = false;
    return analyseSlope(studyOf(tables), options);
}

// The same study with its guessers attentive, and with nobody excluded.
void compareGuessing(const CoveragePlan& plan, std::uint64_t seed, const SlopeAnalysis& screened,
                     const std::vector<records::TrialTable>& tables, StudyOutcome& outcome) {
    const int attentives = plan.observers - plan.guessing;
    for (std::size_t i = 0; i < screened.screening.size(); ++i) {
        int& count =
            static_cast<int>(i) < attentives ? outcome.attentiveExcluded : outcome.guessersExcluded;
        count += screened.screening[i].excluded ? 1 : 0;
    }
    try {
        const double attentive =
            analysed(simulatedTables(plan, seed, 0), plan, true).slope.headline.value;
        outcome.screenedShift = screened.slope.headline.value - attentive;
        outcome.unscreenedShift = analysed(tables, plan, false).slope.headline.value - attentive;
    } catch (const std::runtime_error& error) {  // the study itself has its slope
        outcome.comparisonError = error.what();
    }
}

StudyOutcome fitOne(const CoveragePlan& plan, const Truth& truth, std::uint64_t seed) {
    StudyOutcome outcome;
    const auto tables = simulatedTables(plan, seed, plan.guessing);
    try {
        const auto start = std::chrono::steady_clock::now();
        const SlopeAnalysis result = analysed(tables, plan, true);
        outcome.seconds =
            std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        outcome.converged = result.slope.law.converged;
        if (result.slope.kappaTest) outcome.lawRejected = result.slope.lawRejected;
        outcome.estimates = estimatesOf(result, plan, truth);
        if (plan.guessing > 0) compareGuessing(plan, seed, result, tables, outcome);
    } catch (const std::runtime_error& error) {  // a study without a slope is a result
        outcome.error = error.what();
    }
    return outcome;
}

double mean(const std::vector<double>& values) {
    double sum = 0;
    for (const double v : values) sum += v;
    return sum / static_cast<double>(values.size());
}

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    const std::size_t half = values.size() / 2;
    return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

double standardDeviation(const std::vector<double>& values) {
    if (values.size() < 2) return 0;
    const double centre = mean(values);
    double squares = 0;
    for (const double v : values) squares += (v - centre) * (v - centre);
    return std::sqrt(squares / static_cast<double>(values.size() - 1));
}

// Of a median: that of a normal distribution's.
double errorOfMedian(double sd, std::size_t count) {
    return 1.2533 * sd / std::sqrt(static_cast<double>(count));
}

EstimatorCoverage summarise(const std::string& name, const std::vector<StudyOutcome>& outcomes) {
    EstimatorCoverage row;
    row.name = name;
    std::vector<double> errors, halfWidths;
    for (const StudyOutcome& outcome : outcomes) {
        const auto found = std::find_if(outcome.estimates.begin(), outcome.estimates.end(),
                                        [&](const Estimate& one) { return one.name == name; });
        if (found == outcome.estimates.end() || !found->value) continue;
        row.truth = found->truth;
        row.isSlope = found->isSlope;
        errors.push_back(*found->value - found->truth);
        if (!found->ci95) continue;
        ++row.intervals;
        const bool inside = found->ci95->low <= found->truth && found->truth <= found->ci95->high;
        row.covered += inside ? 1 : 0;
        halfWidths.push_back(0.5 * (found->ci95->high - found->ci95->low));
    }
    row.studies = static_cast<int>(errors.size());
    if (!errors.empty()) {
        row.bias = mean(errors);
        row.median = median(errors);
        row.sd = standardDeviation(errors);
    }
    if (!halfWidths.empty()) row.halfWidth = median(halfWidths);
    return row;
}

std::optional<GuessingEffect> guessingEffect(const CoveragePlan& plan,
                                             const std::vector<StudyOutcome>& outcomes) {
    GuessingEffect effect;
    std::vector<double> screened, unscreened;
    int guessers = 0, attentive = 0;
    for (const StudyOutcome& outcome : outcomes) {
        if (!outcome.error.empty()) continue;
        if (outcome.screenedShift) screened.push_back(*outcome.screenedShift);
        if (outcome.unscreenedShift) unscreened.push_back(*outcome.unscreenedShift);
        if (!outcome.comparisonError.empty() && effect.incomplete++ == 0) {
            effect.firstError = outcome.comparisonError;
        }
        ++effect.studies;
        guessers += outcome.guessersExcluded;
        attentive += outcome.attentiveExcluded;
    }
    if (plan.guessing == 0 || screened.empty() || unscreened.empty()) return std::nullopt;
    effect.screenedMedian = median(screened);
    effect.screenedError = errorOfMedian(standardDeviation(screened), screened.size());
    effect.unscreenedMedian = median(unscreened);
    effect.unscreenedError = errorOfMedian(standardDeviation(unscreened), unscreened.size());
    effect.guessersExcluded = static_cast<double>(guessers) / (effect.studies * plan.guessing);
    effect.attentiveExcluded =
        static_cast<double>(attentive) / (effect.studies * (plan.observers - plan.guessing));
    return effect;
}

Coverage summarise(const CoveragePlan& plan, const std::vector<StudyOutcome>& outcomes) {
    Coverage coverage;
    coverage.plan = plan;
    std::vector<std::string> names;  // in the order in which they come up
    std::vector<double> seconds;
    int tested = 0, rejected = 0;
    for (const StudyOutcome& outcome : outcomes) {
        if (!outcome.error.empty()) {
            if (coverage.withoutSlope++ == 0) coverage.firstError = outcome.error;
            continue;
        }
        coverage.notConverged += outcome.converged ? 0 : 1;
        tested += outcome.lawRejected ? 1 : 0;
        rejected += outcome.lawRejected.value_or(false) ? 1 : 0;
        seconds.push_back(outcome.seconds);
        for (const Estimate& one : outcome.estimates) {
            if (std::find(names.begin(), names.end(), one.name) == names.end()) {
                names.push_back(one.name);
            }
        }
    }
    for (const std::string& name : names) coverage.estimators.push_back(summarise(name, outcomes));
    if (tested > 0) coverage.lawRejected = static_cast<double>(rejected) / tested;
    if (!seconds.empty()) coverage.fitSeconds = median(seconds);
    coverage.guessing = guessingEffect(plan, outcomes);
    return coverage;
}

}  // namespace

double EstimatorCoverage::biasError() const {
    return sd / std::sqrt(static_cast<double>(studies));
}
double EstimatorCoverage::medianError() const {
    return errorOfMedian(sd, static_cast<std::size_t>(studies));
}
double EstimatorCoverage::sdError() const {
    return studies > 1 ? sd / std::sqrt(2.0 * (studies - 1)) : 0;
}
double EstimatorCoverage::coverage() const {
    return static_cast<double>(covered) / intervals;
}
double EstimatorCoverage::coverageError() const {
    const double missed = std::clamp(intervals - covered, 1, std::max(1, intervals - 1));
    const double share = missed / intervals;
    return std::sqrt(share * (1 - share) / intervals);
}

std::vector<records::TrialTable> simulatedTables(const CoveragePlan& plan, std::uint64_t studySeed,
                                                 int guessing) {
    std::vector<records::TrialTable> tables;
    const auto observers = static_cast<std::size_t>(plan.observers);
    for (std::size_t i = 0; i < observers; ++i) {
        const std::uint64_t seed = study_app::participantSeed(studySeed, i);
        study_app::SimulatedParticipant participant =
            study_app::drawParticipant(plan.population, plan.design, seed);
        if (i + static_cast<std::size_t>(guessing) >= observers) {
            participant.response.lapse = kGuesserLapse;
        }
        records::TrialTable table;
        table.participant = study_app::participantName(i, observers);
        table.file = "simulated participant " + table.participant;
        study_app::Session session(plan.design, seed);
        std::optional<records::Trial> last;
        while (!session.finished()) {
            last = session.answer(study_app::simulatedAnswer(participant, session, last));
            table.trials.push_back(*last);
        }
        tables.push_back(std::move(table));
    }
    return tables;
}

Coverage simulateCoverage(const CoveragePlan& plan, const std::function<void()>& done) {
    validate(plan);
    studyOf(simulatedTables(plan, seedOfStudy(plan.seed, 0), 0));  // one slope per design
    const Truth truth(plan);
    std::vector<StudyOutcome> outcomes(static_cast<std::size_t>(plan.studies));
    inParallel(outcomes.size(), plan.threads, [&](std::size_t i) {
        outcomes[i] = fitOne(plan, truth, seedOfStudy(plan.seed, i));
        if (done) done();
    });
    return summarise(plan, outcomes);
}

}  // namespace analysis
