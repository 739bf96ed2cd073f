// SPDX-License-Identifier: MIT
#include "analysis/findings.h"

#include <algorithm>
#include <cmath>

#include "analysis/number_text.h"
#include "analysis/published_slope.h"

namespace analysis {
namespace {

constexpr double kLevel = 0.05;          // of the tests that only sentences hang on
constexpr std::size_t kNamesListed = 6;  // of observers in one sentence
// Chosen by eye: what agrees with the law and with half as much again says nothing of the law.
constexpr double kTellingChange = 0.5;
constexpr double kMisfit = 1.5;  // X^2 over its degrees of freedom: intervals a fifth too short
constexpr int kTellingTrials = 3000;  // half of what finds three misfits in four (docs/analysis.md)
constexpr double kNearGuessing = 0.65;  // P(correct) in 2AFC

std::string countText(int count, const std::string& one) {
    return std::to_string(count) + " " + one + (count == 1 ? "" : "s");
}

std::string ratioText(const RatioTest& test) {
    return "likelihood ratio " + fixedText(test.statistic, 1) + " on " +
           countText(test.degreesOfFreedom, "degree") + " of freedom, " + pValueText(test.pValue);
}

std::string percentText(double share) {
    return fixedText(100 * share, 0) + " %";
}

std::string listed(const std::vector<std::string>& names, const std::string& elsewhere) {
    std::string text;
    for (std::size_t i = 0; i < std::min(names.size(), kNamesListed); ++i) {
        text += (i > 0 ? ", " : "") + names[i];
    }
    if (names.size() > kNamesListed) {
        text += " and " + std::to_string(names.size() - kNamesListed) + " more (" + elsewhere + ")";
    }
    return text;
}

std::pair<double, double> sizeRange(const Study& study) {
    const auto [least, most] =
        std::minmax_element(study.conditions.begin(), study.conditions.end(),
                            [](const Condition& one, const Condition& other) {
                                return one.artifactPx < other.artifactPx;
                            });
    return {least->artifactPx, most->artifactPx};
}

// A test that does not reject proves nothing; what its interval still allows does.
std::string lawAccepted(const SlopeAnalysis& analysis) {
    const auto [least, most] = sizeRange(analysis.study);
    const std::string range = shortText(least) + " to " + shortText(most) + " px";
    const auto ci95 = analysis.slope.kappa->ci95();
    const double off = ci95 ? std::max(std::abs(ci95->low - 1), std::abs(ci95->high - 1)) : 0;
    const double allowed = std::pow(most / least, off) - 1;
    std::string text = allowed > kTellingChange
                           ? "The data cannot tell whether the law holds from " + range
                           : "The data agree with the law: one c serves every size from " + range;
    if (ci95) {
        text += ". What kappa's interval still allows changes c by up to " + percentText(allowed) +
                " over that range";
    }
    return text + ".";
}

std::string lawFinding(const SlopeAnalysis& analysis) {
    const SlopeResult& slope = analysis.slope;
    if (!slope.kappa || !slope.kappaTest) return "";
    const std::string found = "The size exponent kappa is " + plainText(*slope.kappa) +
                              " where the law r = c a has 1 (" + ratioText(*slope.kappaTest) +
                              "). ";
    if (!slope.lawRejected) return found + lawAccepted(analysis);
    const auto [least, most] = sizeRange(analysis.study);
    return found + "The law is rejected: " +
           (slope.kappa->value < 1
                ? "small artifacts need more blur for their size than large ones"
                : "large artifacts need more blur for their size than small ones") +
           ". c is therefore the largest of the measured sizes, which is at a = " +
           shortText(slope.worstArtifactPx.value_or(0)) + " px: safe from " + shortText(least) +
           " to " + shortText(most) + " px, " +
           (slope.kappa->value < 1 ? "too small for smaller artifacts."
                                   : "too small for larger artifacts.");
}

// What a reader of the published study looks for first.
std::string publishedFinding(const SlopeAnalysis& analysis) {
    const double criterion = analysis.options.criterion;
    const WorstGroup& headline = analysis.slope.headline;
    const double off = std::log10(publishedAt(criterion));
    std::optional<records::Interval> ci95;
    if (headline.ci95) ci95 = {headline.ci95->low - off, headline.ci95->high - off};
    std::string text = "Its worst case was c = " + publishedText(criterion) +
                       ", given without an interval; c here is " +
                       slopeText(headline.value - off, ci95) + " times that.";
    if (!ci95) return text;
    if (ci95->low <= 0 && ci95->high >= 0) return text + " No difference is demonstrable.";
    return text + " They differ: observers, task, screen and filter may all have a part in it.";
}

std::string groupFinding(const SlopeAnalysis& analysis) {
    if (!analysis.equalGroupsTest) return "";
    const RatioTest& test = *analysis.equalGroupsTest;
    const std::string found = "That all groups have one slope: " + ratioText(test) + ". ";
    if (test.pValue >= kLevel) {
        return found + "They do not differ demonstrably. The headline is that of " +
               analysis.slope.worstGroup + ", the largest.";
    }
    std::size_t least = 0, most = 0;
    for (std::size_t g = 0; g < analysis.groups.size(); ++g) {
        if (analysis.groups[g].c.value < analysis.groups[least].c.value) least = g;
        if (analysis.groups[g].c.value > analysis.groups[most].c.value) most = g;
    }
    const auto cOf = [&](std::size_t g) {
        return fixedText(std::pow(10.0, analysis.groups[g].c.value), 2);
    };
    return found + "They differ, from c = " + cOf(least) + " (" +
           analysis.study.groups[least].name + ") to " + cOf(most) + " (" +
           analysis.study.groups[most].name + "). " +
           (analysis.slope.lawRejected
                ? "These take one c for all sizes of a group; the headline comes from a second "
                  "fit, in which c changes with the size, and "
                : "The headline ") +
           "is that of " + analysis.slope.worstGroup +
           (analysis.slope.lawRejected
                ? " at a = " + shortText(analysis.slope.worstArtifactPx.value_or(0)) + " px: it "
                : ", corrected for being the largest of noisy ones: it ") +
           "serves all of them at the criterion; where only the easier ones occur, their own c is "
           "enough.";
}

std::string factorFinding(const FactorTest& factor) {
    std::string text = "That c is the same at every level: " + ratioText(factor.test) + ". ";
    for (std::size_t i = 0; i < factor.levels.size(); ++i) {
        text += (i == 0 ? "Over the groups shown at every level c is " : ", ") +
                slopeText(factor.levels[i].c) + " at " + factor.levels[i].name;
    }
    if (!factor.levels.empty()) text += ". ";
    return text + (factor.test.pValue < kLevel
                       ? "They differ: take the c of the level that you have."
                       : "They do not differ demonstrably.");
}

std::string observerFinding(const SlopeAnalysis& analysis) {
    const RandomObserverFit& law = analysis.slope.law;
    if (law.observers < 2) return "";
    const std::string c90 =
        "c for the 90th-percentile observer is " +
        slopeText(analysis.slope.headline.value90, analysis.slope.headline.ci95For90) +
        ": with the headline's c, half of all observers see more than the criterion says; with "
        "this one, one in ten.";
    if (law.tauAtZero) {
        return "No difference between observers was found beyond chance, so that c for the "
               "90th-percentile observer is the headline's.";
    }
    std::string text = "Their slopes scatter by a factor of " +
                       fixedText(std::pow(10.0, law.parameters.tau), 2) + " (sd " +
                       fixedText(law.parameters.tau, 3) + " log10 between observers";
    if (law.parameters.omega > 0 || law.omegaAtZero) {
        text += ", " + fixedText(law.parameters.omega, 3) + " between an observer's conditions";
    }
    return text + "). " + c90;
}

std::string contrastFinding(const SlopeAnalysis& analysis) {
    if (!analysis.contrastExponent) return "";
    const LinearEstimate& e = *analysis.contrastExponent;
    const auto ci95 = e.ci95();
    const auto atHalf = [](double exponent) { return fixedText(std::pow(0.5, exponent), 2); };
    std::string text = "c(C) = c C^e over the lit level C, with e = " + plainText(e) +
                       ": at half the light c is " + atHalf(e.value);
    if (ci95) text += " [" + atHalf(ci95->high) + ", " + atHalf(ci95->low) + "]";
    text += " times as large.";
    if (!ci95) return text;
    if (ci95->low <= 0 && ci95->high >= 0) {
        return text + " No effect is demonstrable: use one c at every contrast.";
    }
    return text + (e.value > 0
                       ? " Less light needs less blur; c of full light is safe."
                       : " Less light needs more blur: c of full light is too small there.");
}

// log10 difference as a factor on c.
std::string factorText(double log10, const std::optional<records::Interval>& ci95) {
    return estimateText(std::pow(10.0, log10), powerOfTen(ci95));
}

std::string halvesFinding(const SlopeAnalysis& analysis) {
    if (!analysis.secondHalf) return "";
    const ObserverMean& shift = *analysis.secondHalf;
    const std::string found = "In the second half of their trials observers' c is " +
                              factorText(shift.value, shift.ci95) + " times that of the first half";
    if (!shift.pValue) return found + ".";
    const std::string tested = found + " (" + pValueText(*shift.pValue) + "). ";
    if (*shift.pValue >= kLevel) {
        return tested + "No practice or fatigue is demonstrable: c can be taken over all trials.";
    }
    return tested +
           (shift.value > 0
                ? "They may have learned to see the artifact: then c is a mean over the learning, "
                  "and too small for practised eyes."
                : "They may have tired: then c is a mean over it, and too small for fresh eyes.");
}

std::string dispersionFinding(const SlopeAnalysis& analysis) {
    if (!analysis.fitCheck.dispersion) return "";
    const Dispersion& spread = *analysis.fitCheck.dispersion;
    const std::string found = "Pearson's X^2 over its degrees of freedom is " +
                              fixedText(spread.ratio(), 2) + " where the model has 1 (" +
                              pValueText(spread.pValue) + "). ";
    if (spread.pValue >= kLevel) {
        return found + "That the answers scatter more than the model says is not demonstrable" +
               (trialCount(analysis.study) < kTellingTrials
                    ? "; with so few trials only a gross misfit would be."
                    : ".");
    }
    return found +
           "The answers scatter more than the model says: its intervals are too short, by a "
           "factor of about " +
           fixedText(std::sqrt(std::max(1.0, spread.ratio())), 1) +
           ". Look at the psychometric functions and the residuals for where.";
}

std::string staircaseFinding(const SlopeAnalysis& analysis) {
    if (!analysis.staircases) return "";
    const StaircaseComparison& staircases = *analysis.staircases;
    const ObserverMean& difference = staircases.difference;
    std::string text = "The staircases' own estimates, which assume beta " +
                       shortText(staircases.assumedBeta) + ", are " +
                       factorText(difference.value, difference.ci95) +
                       " times those refitted to the same trials";
    if (staircases.cells > 1) {
        text += " (scatter of a single one " + fixedText(staircases.scatter, 3) + " log10)";
    }
    text += ".";
    if (!difference.ci95) return text;
    const bool differ = difference.ci95->low > 0 || difference.ci95->high < 0;
    return text + (differ ? " A slope read off the staircases would be off by that factor; c here "
                            "is from the refit."
                          : " They agree on average.");
}

std::string betaFinding(const SlopeAnalysis& analysis) {
    std::string text;
    for (const BetaEstimate& beta : analysis.betas) {
        text += (text.empty() ? "" : "; ") + std::string(records::toText(beta.pattern)) + " " +
                estimateText(beta.beta, beta.ci95);
        if (beta.priorShare > 0.5) text += " (mostly the prior: too few trials to tell)";
    }
    if (text.empty()) return "";
    return "The psychometric slope beta is " + text +
           "; the published study took 3.5. It says what another criterion costs: the flatter the "
           "curve, the more radius it takes to hide what is left.";
}

std::string audienceFinding(const SlopeAnalysis& analysis) {
    return analysis.audience ? audienceSentence(*analysis.audience) : "";
}

std::string bootstrapFinding(const SlopeAnalysis& analysis) {
    if (!analysis.bootstrap) return "";
    const ObserverBootstrap& bootstrap = *analysis.bootstrap;
    std::string text = std::to_string(bootstrap.draws) + " times the observers were drawn anew";
    if (bootstrap.failed > 0) text += ", of which " + std::to_string(bootstrap.failed) + " failed";
    if (!bootstrap.headline) return text + ": too few draws came through for an interval.";
    const auto ci95 = powerOfTen(bootstrap.headline);
    return text + ": c lies in [" + fixedText(ci95->low, 2) + ", " + fixedText(ci95->high, 2) +
           "]. It assumes no distribution of observers, and is too short with few of them.";
}

// In yes/no an observer without reference trials is left out; in 2AFC catch trials may be missing.
bool couldBeScreened(const SlopeAnalysis& analysis) {
    return analysis.study.task == records::Task::yesNo ||
           std::any_of(analysis.screening.begin(), analysis.screening.end(),
                       [](const ScreenedObserver& row) { return row.catchTrials > 0; });
}

// Observers whose answers look like guesses; no rule leaves them out.
std::vector<std::string> nearGuessing(const SlopeAnalysis& analysis) {
    std::vector<std::string> found;
    if (analysis.study.task != records::Task::twoAfc) return found;
    for (const Observer& observer : analysis.study.observers) {
        int trials = 0, yes = 0;
        for (const Cell& cell : observer.cells) {
            trials += static_cast<int>(cell.trials.size());
            for (const StudyTrial& trial : cell.trials) yes += trial.yes ? 1 : 0;
        }
        if (yes < kNearGuessing * trials) {
            found.push_back(observer.id + " (" + percentText(static_cast<double>(yes) / trials) +
                            " right)");
        }
    }
    return found;
}

std::string screeningFinding(const SlopeAnalysis& analysis) {
    std::vector<std::string> excluded;
    for (const ScreenedObserver& row : analysis.screening) {
        if (row.excluded) excluded.push_back(row.id + " (" + row.reason + ")");
    }
    const ScreeningRules& rules = analysis.options.screening;
    if (!rules.apply) return "Switched off.";
    if (!couldBeScreened(analysis)) return "Nobody could be screened: there are no catch trials.";
    std::string text = analysis.study.task == records::Task::yesNo
                           ? "The rule leaves out whoever has a false-alarm rate whose lower 95 % "
                             "bound is above " +
                                 shortText(100 * rules.limits.falseAlarmRate) + " %"
                           : "The rule leaves out whoever fails more than " +
                                 shortText(100 * rules.limits.catchFailureShare) +
                                 " % of the catch trials";
    if (excluded.empty()) return text + ": nobody.";
    text += ": participant" + std::string(excluded.size() > 1 ? "s " : " ") +
            listed(excluded, "screening.tsv") + ".";
    if (analysis.everyone) {
        const SlopeResult& all = *analysis.everyone;
        text += " With everyone c would be " + slopeText(all.headline.value, all.headline.ci95) +
                " (" + all.worstGroup + ").";
    }
    return text;
}

std::string modelText(const SlopeAnalysis& analysis) {
    const ModelParameters& fitted = analysis.slope.law.parameters;
    const RandomObserverFit& law = analysis.slope.law;
    std::string text =
        "All trials were fitted at once by maximum marginal likelihood: detection follows a "
        "Weibull function of log10(c a / r) that passes through F* = " +
        fixedText(analysis.options.criterion, 4) +
        " at r = c a, with one steepness per pattern and a shared lapse rate";
    text += analysis.study.task == records::Task::yesNo
                ? "; false alarms at each observer's rate on reference trials, (FA + .5)/(n + 1). "
                : ", guessing at .5. ";
    const bool observers = fitted.tau > 0 || law.tauAtZero;
    const bool cells = fitted.omega > 0 || law.omegaAtZero;
    if (observers || cells) {
        text += "log10 c varies normally ";
        text += observers ? "between observers" : "";
        text += observers && cells ? " and " : "";
        text += cells ? "between an observer's conditions" : "";
        text +=
            "; these effects were integrated out by adaptive Gauss-Hermite quadrature, their "
            "variance estimated by restricted maximum likelihood. ";
    }
    return text +
           "Weak priors: steepness log-normal around 3.5 (ln sd .5), lapse rate Beta(1, 20) on "
           "[.001, .15]. ";
}

std::string intervalText(const SlopeAnalysis& analysis) {
    const RandomObserverFit& law = analysis.slope.law;
    if (law.observers < 2) {
        return analysis.study.observers.size() < 2
                   ? "No interval: one observer. "
                   : "No interval: no two observers share a group. ";
    }
    if (!analysis.slope.headline.ci95) return "No interval: " + law.message + ". ";
    std::string text =
        "Intervals: 95 %, Student's t with Satterthwaite's degrees of freedom on the Hessian of "
        "the marginal likelihood. ";
    const bool ofSeveral = analysis.study.groups.size() > 1 || analysis.slope.lawRejected;
    text += ofSeveral ? "The headline is the largest slope, corrected for the median error of a "
                        "maximum; its interval holds wherever the groups lie (parametric bootstrap "
                        "of the joint distribution, "
                      : "The interval for the 90th-percentile observer comes from a parametric "
                        "bootstrap (";
    return text + std::to_string(kBootstrapDraws) + " draws, seed " +
           std::to_string(analysis.options.seed) + "). ";
}

// What else was computed, each only where it was.
std::string comparisonText(const SlopeAnalysis& analysis) {
    std::vector<std::string> done;
    if (analysis.secondHalf) {
        done.push_back(
            "a shift of each observer's thresholds in the second half of the trials (t "
            "test over observers)");
    }
    if (analysis.fitCheck.dispersion) {
        done.push_back("Pearson's X^2 of answers forecast from the earlier ones");
    }
    if (analysis.staircases) done.push_back("the staircases' own posterior means");
    if (analysis.twoStage.log10c) done.push_back("two-stage means of single thresholds");
    if (analysis.lines.throughOrigin) done.push_back("least squares on the threshold radii");
    if (analysis.pooled && analysis.pooled->converged) done.push_back("pooled maximum likelihood");
    if (analysis.bootstrap) {
        done.push_back("a bootstrap over observers (" + std::to_string(analysis.bootstrap->draws) +
                       " draws)");
    }
    if (done.empty()) return "";
    std::string text = "For comparison: ";
    for (std::size_t i = 0; i < done.size(); ++i) text += (i > 0 ? ", " : "") + done[i];
    return text + ". ";
}

}  // namespace

std::vector<Finding> findings(const SlopeAnalysis& analysis) {
    std::vector<Finding> found = {{"Law r = c a", lawFinding(analysis)},
                                  {"Groups", groupFinding(analysis)},
                                  {"Published study", publishedFinding(analysis)},
                                  {"Observers", observerFinding(analysis)},
                                  {"Audience", audienceFinding(analysis)},
                                  {"Contrast", contrastFinding(analysis)},
                                  {"Steepness", betaFinding(analysis)},
                                  {"Practice", halvesFinding(analysis)},
                                  {"Scatter", dispersionFinding(analysis)},
                                  {"Staircases", staircaseFinding(analysis)},
                                  {"Bootstrap", bootstrapFinding(analysis)},
                                  {"Screening", screeningFinding(analysis)}};
    std::erase_if(found, [](const Finding& finding) { return finding.text.empty(); });
    for (const FactorTest& factor : analysis.factorTests) {
        found.push_back({"Factor " + factor.factor, factorFinding(factor)});
    }
    for (const std::string& absent : analysis.absent) {
        found.push_back({"Not available", absent + "."});
    }
    return found;
}

std::vector<std::string> warnings(const SlopeAnalysis& analysis) {
    const RandomObserverFit& law = analysis.slope.law;
    std::vector<std::string> sentences;
    if (!law.converged) {
        sentences.push_back("The fit did not converge (" + law.message +
                            "): its numbers are where it stopped.");
    }
    if (analysis.study.observers.size() == 1) {
        sentences.push_back(
            "One observer: c is this person's. No interval can be given for people in general.");
    }
    if (law.lapseAtBound && law.parameters.lapse > 0.5 * kLapseLimit) {
        sentences.push_back(
            "The lapse rate ended on its upper bound, " + percentText(law.parameters.lapse) +
            ": observers often missed what they could see, or the psychometric function does not "
            "fit. Look at the psychometric functions and at the screening before using c.");
    }
    if (analysis.slope.lawRejected) {
        sentences.push_back("The law r = c a is rejected (" +
                            pValueText(analysis.slope.kappaTest->pValue) +
                            "): c holds for the sizes that were measured, not beyond.");
    }
    if (analysis.fitCheck.dispersion && analysis.fitCheck.dispersion->pValue < kLevel &&
        analysis.fitCheck.dispersion->ratio() > kMisfit) {
        sentences.push_back(dispersionFinding(analysis));
    }
    if (analysis.options.screening.apply && !couldBeScreened(analysis)) {
        sentences.push_back(
            "No catch trials: nobody could be screened, and whoever guesses makes c too small.");
    }
    if (const auto guessing = nearGuessing(analysis); !guessing.empty()) {
        sentences.push_back("Answers that look like guesses: " + listed(guessing, "observers.tsv") +
                            ". No rule leaves them out; see what c is without them.");
    }
    std::vector<std::string> flagged;
    for (std::size_t g = 0; g < analysis.groups.size(); ++g) {
        if (analysis.groups[g].flag.empty()) continue;
        flagged.push_back(analysis.study.groups[g].name + " (" + analysis.groups[g].flag + ")");
    }
    if (!flagged.empty()) {
        sentences.push_back("Flagged: " + listed(flagged, "groups.tsv") + ".");
    }
    return sentences;
}

namespace {

std::string factorsText(const Study& study) {
    std::string text;
    for (const std::string& factor : study.factors) text += " x " + factor;
    return text;
}

}  // namespace

std::string methodParagraph(const SlopeAnalysis& analysis) {
    const Study& study = analysis.study;
    const SlopeResult& slope = analysis.slope;
    std::string text = countText(static_cast<int>(study.observers.size()), "observer") + ", " +
                       countText(trialCount(study), "trial") + " in " +
                       countText(static_cast<int>(study.conditions.size()), "condition") + " of " +
                       countText(static_cast<int>(study.groups.size()), "group") +
                       " (pattern or angle x lit level" + factorsText(study) + "). ";
    text += modelText(analysis) + intervalText(analysis);
    if (slope.kappaTest) {
        const std::string p = pValueText(slope.kappaTest->pValue);
        text +=
            "Designs are compared by the ratio of their likelihoods in the plain form; the test of "
            "kappa = 1 ";
        text += slope.lawRejected ? "rejects r = c a (" + p +
                                        "), so that c is the maximum over the measured sizes, at "
                                        "a = " +
                                        shortText(*slope.worstArtifactPx) + " px. "
                                  : "does not reject r = c a (" + p + "). ";
    }
    text += comparisonText(analysis);
    text += study.pxPerDeg ? "The screens showed " + fixedText(*study.pxPerDeg, 1) +
                                 " px per degree of visual angle (mean over sessions). "
                           : "How many px a degree had is not known for every session: sizes are "
                             "in px alone. ";
    if (!slope.law.converged) text += "The fit did not converge: " + slope.law.message + ". ";
    if (slope.law.lapseAtBound) {
        text +=
            "The lapse rate ended on its bound, " + fixedText(slope.law.parameters.lapse, 3) + ". ";
    }
    return text + "Screening: " + screeningFinding(analysis);
}

}  // namespace analysis
