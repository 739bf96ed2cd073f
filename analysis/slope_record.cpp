// SPDX-License-Identifier: MIT
#include "analysis/slope_record.h"

#include <algorithm>
#include <cmath>

#include "analysis/number_text.h"
#include "analysis/slope_model.h"

namespace analysis {
namespace {

std::string countText(int count, const std::string& one) {
    return std::to_string(count) + " " + one + (count == 1 ? "" : "s");
}

std::string ratioText(const RatioTest& test) {
    return "likelihood ratio " + fixedText(test.statistic, 1) + " on " +
           countText(test.degreesOfFreedom, "degree") + " of freedom, " + pValueText(test.pValue);
}

// The psychometric slope that goes with the headline: that of its pattern.
double betaOfWorst(const SlopeAnalysis& analysis) {
    const Study& study = analysis.study;
    const RandomObserverFit& fit =
        analysis.slope.lawRejected ? *analysis.slope.sizeFit : analysis.slope.law;
    const Model model = slopeModel(study, perGroupDesign(study), analysis.options.criterion);
    for (std::size_t k = 0; k < study.conditions.size(); ++k) {
        if (study.groups[study.conditions[k].group].name == analysis.slope.worstGroup) {
            return fit.parameters.beta[static_cast<std::size_t>(model.betaIndex[k])];
        }
    }
    return fit.parameters.beta.front();
}

std::string lawFinding(const SlopeAnalysis& analysis) {
    const SlopeResult& slope = analysis.slope;
    if (!slope.kappa || !slope.kappaTest) return "";
    const std::string found = "Law r = c a: the size exponent kappa is " + plainText(*slope.kappa) +
                              " where the law has 1 (" + ratioText(*slope.kappaTest) + "). ";
    if (!slope.lawRejected) return found + "The data agree with the law.";
    return found + "The law is rejected: " +
           (slope.kappa->value < 1
                ? "small artifacts need more blur for their size than large ones"
                : "large artifacts need more blur for their size than small ones") +
           ". c is therefore given as the maximum over the sizes that were measured, which is at a "
           "= " +
           shortText(slope.worstArtifactPx.value_or(0)) + " px; beyond them it is not known.";
}

std::string groupFinding(const SlopeAnalysis& analysis) {
    if (!analysis.equalGroupsTest) return "";
    const RatioTest& test = *analysis.equalGroupsTest;
    const std::string found = "Groups: " + ratioText(test) + " that all groups have one slope. ";
    if (test.pValue >= 0.05) {
        return found + "They do not differ demonstrably; the worst one, " +
               analysis.slope.worstGroup + ", stands for all.";
    }
    return found + "They differ: only " + analysis.slope.worstGroup +
           " needs the headline's c, the others less.";
}

std::string observerFinding(const SlopeAnalysis& analysis) {
    const RandomObserverFit& law = analysis.slope.law;
    if (law.observers < 2) return "";
    const std::string c90 =
        slopeText(analysis.slope.headline.value90, analysis.slope.headline.ci95For90);
    if (law.tauAtZero) {
        return "Observers: no difference between them was found beyond chance. For one observer in "
               "ten c is above " +
               c90 + ".";
    }
    return "Observers: their slopes scatter by a factor of " +
           fixedText(std::pow(10.0, law.parameters.tau), 2) + " (sd " +
           fixedText(law.parameters.tau, 3) + " log10 between observers, " +
           fixedText(law.parameters.omega, 3) +
           " between an observer's conditions). One in ten needs c above " + c90 + ".";
}

std::string contrastFinding(const SlopeAnalysis& analysis) {
    if (!analysis.contrastExponent) return "";
    const LinearEstimate& e = *analysis.contrastExponent;
    return "Contrast: c(C) = c C^e with e = " + plainText(e) + ": at half the light c is " +
           fixedText(std::pow(0.5, e.value), 2) + " times as large.";
}

std::string screeningFinding(const SlopeAnalysis& analysis) {
    std::vector<std::string> excluded;
    for (const ScreenedObserver& row : analysis.screening) {
        if (row.excluded) excluded.push_back(row.id + " (" + row.reason + ")");
    }
    if (excluded.empty()) {
        return analysis.options.screening.apply ? "Screening: every observer passed."
                                                : "Screening: switched off.";
    }
    std::string text = "Screening: left out " + excluded.front();
    for (std::size_t i = 1; i < excluded.size(); ++i) text += ", " + excluded[i];
    if (analysis.everyone) {
        const SlopeResult& all = *analysis.everyone;
        text += ". With everyone c would be " + slopeText(all.headline.value, all.headline.ci95) +
                " (" + all.worstGroup + ")";
    }
    return text + ".";
}

}  // namespace

records::Slope slopeRecord(const SlopeAnalysis& analysis, const records::RunContext& context) {
    const SlopeResult& slope = analysis.slope;
    const Study& study = analysis.study;
    records::Slope record{
        .c = slopeEstimate(slope.headline.value, slope.headline.ci95),
        .worstGroup = slope.worstGroup,
        .cOverall = slopeEstimate(analysis.overall.value, analysis.overall.ci95()),
        .c90 = slopeEstimate(slope.headline.value90, slope.headline.ci95For90),
        .criterion = analysis.options.criterion,
        .percentCorrect = analysis.percentAtThreshold,
        .task = study.task,
        .kernel = study.kernel,
        .encoding = study.encoding,
        .beta = betaOfWorst(analysis),
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

std::vector<std::string> findings(const SlopeAnalysis& analysis) {
    std::vector<std::string> sentences = {lawFinding(analysis), groupFinding(analysis),
                                          observerFinding(analysis), contrastFinding(analysis),
                                          screeningFinding(analysis)};
    std::erase(sentences, "");
    for (const std::string& absent : analysis.absent)
        sentences.push_back("Not available: " + absent + ".");
    return sentences;
}

std::string methodParagraph(const SlopeAnalysis& analysis) {
    const Study& study = analysis.study;
    const RandomObserverFit& law = analysis.slope.law;
    const bool yesNo = study.task == records::Task::yesNo;
    std::string text = countText(static_cast<int>(study.observers.size()), "observer") + ", " +
                       countText(trialCount(study), "trial") + " in " +
                       countText(static_cast<int>(study.conditions.size()), "condition") + " of " +
                       countText(static_cast<int>(study.groups.size()), "group") +
                       " (pattern or angle x lit level). ";
    text +=
        "All trials were fitted at once by maximum marginal likelihood: detection follows a "
        "Weibull function of log10(c a / r) with one steepness per pattern and a shared lapse "
        "rate";
    text += yesNo
                ? "; false alarms at each observer's rate on reference trials, (FA + .5)/(n + 1). "
                : ", guessing at .5. ";
    text +=
        "log10 c varies normally between observers and between an observer's conditions; both "
        "were integrated out by adaptive Gauss-Hermite quadrature, their variances estimated by "
        "restricted maximum likelihood. Weak priors: steepness log-normal around 3.5 (ln sd .5), "
        "lapse rate Beta(1, 20) on [.001, .15]. ";
    text +=
        law.observers >= 2
            ? "Intervals: Student's t with Satterthwaite's degrees of freedom on the Hessian of "
              "the marginal likelihood. The headline is the largest slope, corrected for the "
              "median error of a maximum; its interval holds wherever the groups lie (parametric "
              "bootstrap of the joint distribution, " +
                  std::to_string(kBootstrapDraws) + " draws, seed " +
                  std::to_string(analysis.options.seed) + "). "
            : "No interval: one observer. ";
    if (analysis.slope.lawRejected) {
        text += "The test of kappa = 1 rejects r = c a (" +
                pValueText(analysis.slope.kappaTest->pValue) +
                "), so that c is the maximum over the measured sizes, at a = " +
                shortText(*analysis.slope.worstArtifactPx) + " px. ";
    }
    if (!law.converged) text += "The fit did not converge: " + law.message + ". ";
    if (law.lapseAtBound) {
        text += "The lapse rate ended on its bound, " + fixedText(law.parameters.lapse, 3) + ". ";
    }
    return text + screeningFinding(analysis);
}

}  // namespace analysis
