// SPDX-License-Identifier: MIT
#include "analysis/slope_record.h"

#include "analysis/findings.h"
#include "analysis/number_text.h"
#include "analysis/slope_model.h"

namespace analysis {
namespace {

// The psychometric slope that goes with the headline: that of its pattern.
double betaOfWorst(const SlopeResult& slope) {
    const RandomObserverFit& fit = slope.lawRejected ? *slope.sizeFit : slope.law;
    return fit.parameters.beta[slope.betaIndex];
}

}  // namespace

records::Slope slopeRecord(const SlopeAnalysis& analysis, const records::RunContext& context) {
    const SlopeResult& slope = analysis.slope;
    const Study& study = analysis.study;
    const Group& worst = study.groups[slope.worstIndex];
    records::Slope record{
        .c = slopeEstimate(slope.headline.value, slope.headline.ci95),
        .worstGroup = slope.worstGroup,
        .cOverall = slopeEstimate(analysis.overall.value, analysis.overall.ci95()),
        .c90 = slopeEstimate(slope.headline.value90, slope.headline.ci95For90),
        .criterion = analysis.options.criterion,
        .percentCorrect = analysis.percentAtThreshold,
        .task = study.task,
        .kernel = worst.kernel,
        .encoding = worst.encoding,
        .beta = betaOfWorst(slope),
        .observerSd = slope.law.parameters.tau,
        .observerConditionSd = slope.law.parameters.omega,
        .kappa = {.estimate = 1, .ci95 = {}},
        .kappaPValue = {},
        .contrastExponent = {},
        .groups = {},
        .observers = static_cast<int>(study.observers.size()),
        .trials = trialCount(study),
        .pxPerDeg = study.pxPerDeg,
        .method = methodParagraph(analysis),
        .context = context};
    if (slope.kappa) record.kappa = {slope.kappa->value, slope.kappa->ci95()};
    if (slope.kappaTest) record.kappaPValue = slope.kappaTest->pValue;
    if (analysis.contrastExponent) {
        record.contrastExponent =
            records::Estimate{analysis.contrastExponent->value, analysis.contrastExponent->ci95()};
    }
    for (std::size_t g = 0; g < study.groups.size(); ++g) {
        const Group& group = study.groups[g];
        const GroupResult& result = analysis.groups[g];
        record.groups.push_back({.name = group.name,
                                 .pattern = group.pattern,
                                 .angleDeg = group.angleDeg,
                                 .litLevel = group.litLevel,
                                 .c = slopeEstimate(result.c.value, result.c.ci95()),
                                 .trials = result.trials});
    }
    return record;
}

}  // namespace analysis
