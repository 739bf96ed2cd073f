// SPDX-License-Identifier: MIT
#include "study_app/design.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string_view>

#include "records/number_rule.h"
#include "records/quoted_text.h"
#include "stimulus/kernel.h"
#include "stimulus/silhouette.h"
#include "stimulus/stimulus_image.h"
#include "stimulus/tap_kernel.h"
#include "study_app/frame_design.h"

namespace study_app {
namespace {

using records::exactText;

constexpr std::array<double, 3> kRadiusSteps{0.25, 0.5, 1};

// Against slips of the keyboard: far beyond what a person can sit through.
constexpr int kMostTrials = 100000;

// A quarter of all codes: at more, most of the noise is cut off at black and white.
constexpr double kMostNoiseLevels = 64;

// Log10 units. A prior narrower than a step of the radii on a display learns nothing from answers;
// one wider than a hundredfold to either side knows nothing of displays.
constexpr records::NumberRule kPriorSd = records::between(0.02, 2);
// Candidates must lie closer than the posterior is wide after 80 trials, .04.
constexpr records::NumberRule kGrain = records::between(0.001, 0.04);
constexpr records::NumberRule kRange{.low = 0, .high = 20, .lowIncluded = false};
// From a curve that rises over all radii of a display to a jump. Published ones: 2 to 5.
constexpr records::NumberRule kBeta = records::between(0.5, 20);
// Of who answers half of the trials blindly nothing can be learned.
constexpr records::NumberRule kLapse = records::between(0, 0.5);

std::string problem(const std::string& field, const std::string& value, const std::string& rule) {
    return field + ": " + value + ": " + rule;
}

std::string problem(const std::string& field, double value, const std::string& rule) {
    return problem(field, exactText(value), rule);
}

std::string broken(const std::string& field, double value, const records::NumberRule& rule,
                   const std::string& kind = "number") {
    return rule.holds(value) ? "" : problem(field, value, rule.text(kind));
}

std::string indexed(const std::string& field, std::size_t i) {
    return field + "[" + std::to_string(i) + "]";
}

/// The first problem of a list of checks.
template <typename... Checks>
std::string firstOf(Checks... checks) {
    std::string found;
    ((found = checks(), found.empty()) && ...);
    return found;
}

template <typename List>
std::string duplicate(const std::string& field, const List& list) {
    for (std::size_t i = 1; i < list.size(); ++i) {
        const auto before = list.begin() + static_cast<std::ptrdiff_t>(i);
        const auto first = std::find(list.begin(), before, list[i]);
        if (first == before) continue;
        return problem(indexed(field, i),
                       "repeats " + indexed(field, static_cast<std::size_t>(first - list.begin())),
                       "a condition may stand in a design only once");
    }
    return {};
}

template <typename List>
std::string noConditions(const std::string& field, const List& list) {
    return list.empty() ? problem(field, "empty", "without an entry there are no conditions") : "";
}

double conditionCount(const Design& d) {
    if (!d.onlyConditions.empty()) return static_cast<double>(d.onlyConditions.size());
    if (d.frames) return static_cast<double>(frameConditions(d).size());
    return static_cast<double>(d.artifactPx.size() * d.patterns.size() * d.litLevels.size() *
                               d.kernels.size() * d.noiseLevels.size());
}

std::string checkWindow(const Design& d) {
    return broken("window_px", d.windowPx, records::between(16, stimulus::kMaxWindowPx),
                  "whole number");
}

std::string checkSizes(const Design& d) {
    if (auto found = noConditions("artifact_px", d.artifactPx); !found.empty()) return found;
    for (std::size_t i = 0; i < d.artifactPx.size(); ++i) {
        const int a = d.artifactPx[i];
        if (auto found = broken(indexed("artifact_px", i), a, records::atLeast(1), "whole number");
            !found.empty()) {
            return found;
        }
        if (2 * a >= d.windowPx) {
            return problem(
                indexed("artifact_px", i), a,
                "must be less than half of window_px, which is " + std::to_string(d.windowPx));
        }
    }
    return duplicate("artifact_px", d.artifactPx);
}

std::string checkPattern(const std::string& field, const Silhouette& s) {
    if (s.pattern == records::Pattern::frame) {
        return problem(field, "\"frame\"", "must be one of stair, step, line");
    }
    if (s.pattern == records::Pattern::line) {
        if (!s.angleDeg) return problem(field + ".angle_deg", "missing", "a line needs its angle");
        const records::NumberRule rule{
            .low = 0, .high = 45, .lowIncluded = false, .highIncluded = false};
        return broken(field + ".angle_deg", *s.angleDeg, rule);
    }
    if (s.angleDeg) {
        return problem(field + ".angle_deg", *s.angleDeg,
                       "only a line takes an angle; that of stair and step follows");
    }
    if (s.pattern == records::Pattern::stair && s.orientation != Orientation::any) {
        return problem(field + ".orientation",
                       s.orientation == Orientation::vertical ? "\"vertical\"" : "\"horizontal\"",
                       "a stair of 45 degrees has no such direction; step and line have");
    }
    return {};
}

/// A flatter line has no step in the window: its steps are a / tan(angle) apart, the first ones
/// half of that from the middle. Nothing could be seen there at any radius.
std::string checkSlant(const Design& d, const std::string& field, double angleDeg) {
    const int most = *std::ranges::max_element(d.artifactPx);
    const double least = std::atan2(most, d.windowPx) * 180 / std::numbers::pi;
    if (angleDeg > least) return {};
    return problem(field + ".angle_deg", angleDeg,
                   "shows no step of " + std::to_string(most) + " px in a window of " +
                       std::to_string(d.windowPx) + " px, must be greater than atan(a / window), " +
                       exactText(std::ceil(least * 1000) / 1000) +
                       " degrees (or take the pattern step)");
}

std::string checkPatterns(const Design& d) {
    if (auto found = noConditions("patterns", d.patterns); !found.empty()) return found;
    for (std::size_t i = 0; i < d.patterns.size(); ++i) {
        const std::string field = indexed("patterns", i);
        if (auto found = checkPattern(field, d.patterns[i]); !found.empty()) return found;
        if (!d.patterns[i].angleDeg) continue;
        if (auto found = checkSlant(d, field, *d.patterns[i].angleDeg); !found.empty()) {
            return found;
        }
    }
    return duplicate("patterns", d.patterns);
}

std::string checkLitLevels(const Design& d) {
    if (auto found = noConditions("lit_levels", d.litLevels); !found.empty()) return found;
    const records::NumberRule rule{.low = 0, .high = 1, .lowIncluded = false};
    for (std::size_t i = 0; i < d.litLevels.size(); ++i) {
        if (auto found = broken(indexed("lit_levels", i), d.litLevels[i], rule); !found.empty()) {
            return found;
        }
    }
    return duplicate("lit_levels", d.litLevels);
}

std::string checkKernels(const Design& d) {
    if (auto found = noConditions("kernels", d.kernels); !found.empty()) return found;
    for (std::size_t i = 0; i < d.kernels.size(); ++i) {
        if (!stimulus::kernelShapeFromText(d.kernels[i]) &&
            !stimulus::tapKernelFromText(d.kernels[i])) {
            return problem(indexed("kernels", i), records::quotedText(d.kernels[i]),
                           "must be one of disc, box, gaussian, poisson1 to poisson" +
                               std::to_string(stimulus::kMostTaps) + ", poisson1-still to poisson" +
                               std::to_string(stimulus::kMostTaps) + "-still");
        }
    }
    return duplicate("kernels", d.kernels);
}

std::string checkNoise(const Design& d) {
    if (auto found = noConditions("noise_levels", d.noiseLevels); !found.empty()) return found;
    for (std::size_t i = 0; i < d.noiseLevels.size(); ++i) {
        if (auto found = broken(indexed("noise_levels", i), d.noiseLevels[i],
                                records::between(0, kMostNoiseLevels));
            !found.empty()) {
            return found;
        }
    }
    return duplicate("noise_levels", d.noiseLevels);
}

std::string checkLocalise(const Design& d) {
    if (!d.localise || d.task == records::Task::yesNo) return {};
    return problem("localise", "true",
                   "belongs to the task yes_no: in 2afc the side is the answer");
}

std::string checkPresentation(const Design& d) {
    const std::string found = validate(d.presentation);
    return found.empty() ? "" : "presentation." + found;
}

std::string checkTrials(const Design& d) {
    if (auto found = broken("trials_per_condition", d.trialsPerCondition,
                            records::between(1, kMostTrials), "whole number");
        !found.empty()) {
        return found;
    }
    if (auto found = broken("screening.false_alarm_rate", d.screening.falseAlarmRate,
                            records::between(0, 1));
        !found.empty()) {
        return found;
    }
    if (auto found = broken("screening.catch_failure_share", d.screening.catchFailureShare,
                            records::between(0, 1));
        !found.empty()) {
        return found;
    }
    if (auto found = broken("catch_share", d.catchShare, records::between(0, 0.5));
        !found.empty()) {
        return found;
    }
    const double total = static_cast<double>(d.trialsPerCondition) * conditionCount(d);
    if (total <= kMostTrials) return {};
    return problem("trials_per_condition", d.trialsPerCondition,
                   "makes " + exactText(total) + " trials in all, must be at most " +
                       std::to_string(kMostTrials));
}

std::string checkRadius(const Design& d) {
    const auto& [min, max, step] = d.radius;
    if (std::find(kRadiusSteps.begin(), kRadiusSteps.end(), step) == kRadiusSteps.end()) {
        return problem("radius_px.step", step, "must be 0.25, 0.5 or 1");
    }
    const auto multiple = [step = step](const char* field, double value) {
        if (auto found = broken(field, value, records::kPositive); !found.empty()) return found;
        if (std::fmod(value, step) == 0) return std::string();
        return problem(field, value, "must be a multiple of radius_px.step, " + exactText(step));
    };
    if (auto found = multiple("radius_px.min", min); !found.empty()) return found;
    if (auto found = multiple("radius_px.max", max); !found.empty()) return found;
    if (min >= max) {
        return problem("radius_px.min", min,
                       "must be less than radius_px.max, which is " + exactText(max));
    }
    if (max > d.windowPx) {
        return problem("radius_px.max", max,
                       "must be at most window_px, which is " + std::to_string(d.windowPx));
    }
    return {};
}

std::string checkGuess(const Design& d) {
    if (auto found = broken("quest.guess_ratio", d.guessRatio, records::kPositive);
        !found.empty()) {
        return found;
    }
    for (const int a : d.artifactPx) {
        const double guess = d.guessRatio * a;
        if (guess >= d.radius.min && guess <= d.radius.max) continue;
        return problem("quest.guess_ratio", d.guessRatio,
                       "guesses a radius of " + exactText(guess) + " px at artifact_px " +
                           std::to_string(a) + ", outside radius_px, " + exactText(d.radius.min) +
                           " to " + exactText(d.radius.max));
    }
    return {};
}

std::string checkCurve(const Design& d) {
    const quest::QuestParameters& q = d.staircase;
    constexpr records::NumberRule gamma{.low = 0, .high = 1, .highIncluded = false};
    for (const std::string& found :
         {broken("quest.prior_sd", q.priorSd, kPriorSd), broken("quest.beta", q.beta, kBeta),
          broken("quest.grain", q.grain, kGrain),
          q.range ? broken("quest.range", *q.range, kRange) : std::string(),
          broken("quest.delta", q.delta, kLapse), broken("quest.gamma", q.gamma, gamma)}) {
        if (!found.empty()) return found;
    }
    if (d.task == records::Task::twoAfc && q.gamma != 0.5) {
        return problem("quest.gamma", q.gamma, "must be 0.5 in 2afc: one of two sides is right");
    }
    const double top = 1 - q.delta * (1 - q.gamma);
    if (!(q.pThreshold > q.gamma && q.pThreshold < top)) {
        return problem("quest.threshold_probability", q.pThreshold,
                       "must lie inside the curve, above gamma, " + exactText(q.gamma) +
                           ", and below 1 - delta (1 - gamma), " + exactText(top));
    }
    const std::string remaining = quest::validate(staircaseParameters(d));
    return remaining.empty() ? "" : problem("quest", "refused", remaining);
}

/// A strength that can be shown must lie in the staircase's table for every candidate, or the
/// posterior would be inexact.
std::string checkRange(const Design& d) {
    const quest::QuestParameters q = staircaseParameters(d);
    const double half = q.range ? *q.range / 2 : 250 * q.grain;
    double distance = 0;
    for (const Condition& condition : conditions(d)) {
        const auto [weakest, strongest] = strengthRange(d, condition);
        distance = std::max(
            {distance, std::abs(weakest - q.priorMean), std::abs(strongest - q.priorMean)});
    }
    if (distance <= half) return {};
    const double fitting = std::ceil(20 * distance) / 10;
    const std::string rule = std::string(d.frames ? "the frames" : "the limits of radius_px") +
                             " show artifacts " + exactText(std::round(distance * 1000) / 1000) +
                             " log10 units from the guess, must be at least " + exactText(fitting) +
                             " wide to hold them (or narrow " +
                             (d.frames ? "the r / a of the frames)" : "radius_px)");
    return problem("quest.range", 2 * half, rule);
}

std::string orientationText(Orientation orientation) {
    switch (orientation) {
        case Orientation::any:
            return "";
        case Orientation::horizontal:
            return "-horizontal";
        case Orientation::vertical:
            return "-vertical";
    }
    return "";
}

std::string conditionName(const Design& design, const Condition& c) {
    const Silhouette& s = c.silhouette;
    std::string name(records::toText(s.pattern));
    if (s.angleDeg) name += exactText(*s.angleDeg);
    name += orientationText(s.orientation);
    name += "-a" + std::to_string(c.artifactPx) + "-lit" + exactText(c.litLevel);
    if (design.kernels.size() > 1) name += "-" + c.kernel;
    if (design.noiseLevels.size() > 1) name += "-noise" + exactText(c.noiseLevels);
    return name;
}

double trueAngleDeg(const Design& design, const Silhouette& s, int artifactPx) {
    stimulus::SilhouetteOptions options{.artifactPx = static_cast<double>(artifactPx),
                                        .riserSpacingPx = static_cast<double>(design.windowPx)};
    if (s.pattern == records::Pattern::step) options.pattern = stimulus::Pattern::step;
    if (s.pattern == records::Pattern::line) options.pattern = stimulus::Pattern::line;
    options.angleDeg = s.angleDeg.value_or(options.angleDeg);
    return stimulus::trueAngleDeg(options);
}

std::vector<Condition> allConditions(const Design& design) {
    if (design.frames) return frameConditions(design);
    std::vector<Condition> result;
    for (const Silhouette& silhouette : design.patterns) {
        for (const int a : design.artifactPx) {
            for (const double litLevel : design.litLevels) {
                for (const std::string& kernel : design.kernels) {
                    for (const double noise : design.noiseLevels) {
                        Condition c{.name = {},
                                    .silhouette = silhouette,
                                    .angleDeg = trueAngleDeg(design, silhouette, a),
                                    .artifactPx = a,
                                    .litLevel = litLevel,
                                    .kernel = kernel,
                                    .noiseLevels = noise};
                        c.name = conditionName(design, c);
                        result.push_back(std::move(c));
                    }
                }
            }
        }
    }
    return result;
}

std::string checkOnly(const Design& d) {
    const std::vector<Condition> all = allConditions(d);
    for (std::size_t i = 0; i < d.onlyConditions.size(); ++i) {
        if (std::ranges::find(all, d.onlyConditions[i], &Condition::name) != all.end()) continue;
        std::string names;
        for (const Condition& c : all) names += (names.empty() ? "" : ", ") + c.name;
        return problem(indexed("only_conditions", i), records::quotedText(d.onlyConditions[i]),
                       "must be one of " + names);
    }
    return duplicate("only_conditions", d.onlyConditions);
}

}  // namespace

std::string validate(const Design& d) {
    if (d.name.empty() || !records::isPlainText(d.name)) {
        return problem("name", records::quotedText(d.name),
                       "must be a text of one line, not empty");
    }
    if (d.frames) {
        return firstOf([&] { return checkWindow(d); }, [&] { return validateFrames(d); },
                       [&] { return checkOnly(d); }, [&] { return checkTrials(d); },
                       [&] { return checkCurve(d); }, [&] { return checkRange(d); },
                       [&] { return checkPresentation(d); });
    }
    return firstOf([&] { return checkWindow(d); }, [&] { return checkSizes(d); },
                   [&] { return checkPatterns(d); }, [&] { return checkLitLevels(d); },
                   [&] { return checkKernels(d); }, [&] { return checkNoise(d); },
                   [&] { return checkLocalise(d); }, [&] { return checkOnly(d); },
                   [&] { return checkTrials(d); }, [&] { return checkRadius(d); },
                   [&] { return checkGuess(d); }, [&] { return checkCurve(d); },
                   [&] { return checkRange(d); }, [&] { return checkPresentation(d); });
}

quest::QuestParameters staircaseParameters(const Design& design) {
    quest::QuestParameters parameters = design.staircase;
    parameters.priorMean = -std::log10(design.guessRatio);
    return parameters;
}

std::vector<Condition> conditions(const Design& design) {
    std::vector<Condition> all = allConditions(design);
    if (design.onlyConditions.empty()) return all;
    std::erase_if(all, [&](const Condition& c) {
        return std::ranges::find(design.onlyConditions, c.name) == design.onlyConditions.end();
    });
    return all;
}

StrengthRange strengthRange(const Design& design, const Condition& condition) {
    if (!condition.frames.empty()) {
        const records::FramePair &coarse = condition.frames.front(),
                                 &fine = condition.frames.back();
        return {.weakest = quest::strength(fine.artifactPx, fine.radiusPx),
                .strongest = quest::strength(coarse.artifactPx, coarse.radiusPx)};
    }
    return {.weakest = quest::strength(condition.artifactPx, design.radius.max),
            .strongest = quest::strength(condition.artifactPx, design.radius.min)};
}

int catchTrials(const Design& d) {
    const double staircaseTrials = conditionCount(d) * d.trialsPerCondition;
    return static_cast<int>(std::lround(staircaseTrials * d.catchShare / (1 - d.catchShare)));
}

int totalTrials(const Design& d) {
    return static_cast<int>(conditions(d).size()) * d.trialsPerCondition + catchTrials(d);
}

int expectedMinutes(const Design& design) {
    const Presentation& p = design.presentation;
    const double trials = totalTrials(design);
    const double breaks =
        p.breakEveryTrials > 0 ? std::floor((trials - 1) / p.breakEveryTrials) : 0;
    const double trialS = p.blankS + p.fixationS + kTypicalAnswerS + (p.feedback ? p.feedbackS : 0);
    return static_cast<int>(std::ceil((trials * trialS + breaks * p.breakMinimumS) / 60));
}

}  // namespace study_app
