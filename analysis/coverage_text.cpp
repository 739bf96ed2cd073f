// SPDX-License-Identifier: MIT
#include <cmath>

#include "analysis/coverage.h"
#include "analysis/number_text.h"

namespace analysis {

TextTable coverageTable(const Coverage& coverage) {
    TextTable table{
        .name = "coverage",
        .caption =
            "Errors are log10(estimate / truth), .01 of which is 2.3 % of c, each with its "
            "Monte-Carlo standard error; kappa, tau and omega in their own units. Coverage "
            "is of the 95 % intervals; half a width is that of the median interval.",
        .head = {"estimator", "truth", "bias", "+-", "median error", "+-", "sd", "+-", "coverage %",
                 "+-", "half width", "studies"},
        .rows = {}};
    for (const EstimatorCoverage& row : coverage.estimators) {
        if (row.studies == 0) continue;
        const bool has = row.intervals > 0;
        table.rows.push_back(
            {row.name, fixedText(row.isSlope ? std::pow(10.0, row.truth) : row.truth, 3),
             fixedText(row.bias, 4), fixedText(row.biasError(), 4), fixedText(row.median, 4),
             fixedText(row.medianError(), 4), fixedText(row.sd, 4), fixedText(row.sdError(), 4),
             has ? fixedText(100 * row.coverage(), 1) : "n/a",
             has ? fixedText(100 * row.coverageError(), 1) : "n/a",
             has ? fixedText(row.halfWidth, 4) : "n/a", std::to_string(row.studies)});
    }
    return table;
}

std::vector<std::string> coverageFindings(const Coverage& coverage) {
    const CoveragePlan& plan = coverage.plan;
    std::vector<std::string> lines = {
        std::to_string(plan.studies) + " studies of design " + plan.design.name + ": " +
        std::to_string(plan.observers) + " observers x " +
        std::to_string(study_app::conditions(plan.design).size()) + " conditions x " +
        std::to_string(plan.design.trialsPerCondition) + " trials, " +
        std::to_string(study_app::catchTrials(plan.design)) + " catch trials each; " +
        toText(plan.population) + "; seed " + std::to_string(plan.seed) +
        "; fitted at F* = " + shortText(plan.criterion) + "."};
    if (plan.guessing > 0) {
        lines.push_back(std::to_string(plan.guessing) + " of the " +
                        std::to_string(plan.observers) + " observers press at random.");
    }
    if (coverage.lawRejected) {
        lines.push_back("The test of r = c a (kappa = 1) rejects it in " +
                        fixedText(100 * *coverage.lawRejected, 1) + " % of the studies; kappa is " +
                        shortText(plan.population.kappa) + " in the simulation.");
    }
    if (coverage.guessing) {
        const GuessingEffect& effect = *coverage.guessing;
        const auto percent = [](double log10) {
            return fixedText(100 * (std::pow(10.0, log10) - 1), 1);
        };
        lines.push_back("Guessing observers move the headline by " +
                        percent(effect.screenedMedian) + " +- " + percent(effect.screenedError) +
                        " % after screening (median over " + std::to_string(effect.studies) +
                        " studies, against the same studies with the " +
                        "guessers attentive), by " + percent(effect.unscreenedMedian) + " +- " +
                        percent(effect.unscreenedError) + " % without. Screening excludes " +
                        fixedText(100 * effect.guessersExcluded, 1) + " % of the guessers and " +
                        fixedText(100 * effect.attentiveExcluded, 1) + " % of the others.");
        if (effect.incomplete > 0) {
            lines.push_back("In " + std::to_string(effect.incomplete) +
                            " of them the study with attentive observers alone or that with "
                            "nobody left out gave no slope, and is missing in this; the first: " +
                            effect.firstError);
        }
    }
    if (coverage.withoutSlope > 0) {
        lines.push_back(
            std::to_string(coverage.withoutSlope) +
            " studies gave no slope and are left out, the first: " + coverage.firstError);
    }
    if (coverage.notConverged > 0) {
        lines.push_back(std::to_string(coverage.notConverged) +
                        " fits did not converge; their estimates are in the table.");
    }
    return lines;
}

}  // namespace analysis
