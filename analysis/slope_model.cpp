// SPDX-License-Identifier: MIT
#include "analysis/slope_model.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <set>
#include <tuple>

namespace analysis {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr double kStartBeta = 3.5, kStartLapse = 0.02;
constexpr double kStartTau = 0.1, kStartOmega = 0.05;  // log10, METHODS section 5
// Slopes are searched this far (log10: a factor of 10) beyond the r/a shown, where the answers no
// longer depend on the slope. An optimum must be better than that by the second number (in ln L).
constexpr double kBeyondShown = 1.0;
constexpr double kBetterThanNone = 0.05;
constexpr double kGridStep = 0.04;

Index index(std::size_t i) {
    return static_cast<Index>(i);
}

// Pooled answers of the conditions for which `belongs` is true.
template <typename Belongs>
GroupCheck check(const Study& study, double criterion, const std::string& name, Belongs belongs) {
    std::vector<std::pair<CellTrials, Curve>> cells;
    std::set<double> shown, placed;  // log10 r/a; without catch trials
    int yes = 0, trials = 0;
    for (const Observer& observer : study.observers) {
        const double gamma = guessingRate(observer, study.task);
        for (const Cell& cell : observer.cells) {
            if (!belongs(cell.condition)) continue;
            const double a = study.conditions[cell.condition].artifactPx;
            cells.emplace_back(cellTrials(cell.trials, a),
                               Curve{.beta = kStartBeta,
                                     .criterion = criterion,
                                     .response = {gamma, kStartLapse, gamma}});
            for (const StudyTrial& trial : cell.trials) {
                shown.insert(std::log10(trial.radiusPx / a));
                if (!trial.catchTrial) placed.insert(std::log10(trial.radiusPx / a));
                yes += trial.yes ? 1 : 0;
                ++trials;
            }
        }
    }
    const double offset = quest::criterionOffset(criterion, kStartBeta) -
                          quest::criterionOffset(quest::kPaperCriterion, kStartBeta);
    const double low = *shown.begin() - kBeyondShown - offset;
    const double high = *shown.rbegin() + kBeyondShown - offset;
    const auto logLikelihood = [&](double y) {
        double sum = 0;
        for (const auto& [cell, curve] : cells) sum += locationTerms(cell, y, curve).value;
        return sum;
    };
    const double atLow = logLikelihood(low), atHigh = logLikelihood(high);
    double best = atLow, bestAt = low;
    for (double y = low + kGridStep; y < high; y += kGridStep) {
        const double value = logLikelihood(y);
        if (value > best) {
            best = value;
            bestAt = y;
        }
    }
    GroupCheck result{.log10c = bestAt, .oneRadius = placed.size() <= 1};
    const bool above = atHigh > atLow && atHigh > best - kBetterThanNone;
    const bool below = atLow >= atHigh && atLow > best - kBetterThanNone;
    if (!above && !below) return result;
    result.state = above ? GroupState::aboveShown : GroupState::belowShown;
    char range[96];
    std::snprintf(range, sizeof range, "r/a from %.3g to %.3g", std::pow(10.0, *shown.begin()),
                  std::pow(10.0, *shown.rbegin()));
    result.sentence =
        name + ": " + std::to_string(yes) + " of " + std::to_string(trials) +
        (study.task == records::Task::twoAfc ? " answers right" : " answers \"seen\"") + " at " +
        range + ": the threshold lies " + (above ? "above" : "below") + " every radius shown";
    return result;
}

}  // namespace

CellTrials cellTrials(std::span<const StudyTrial> of, double artifactPx) {
    CellTrials trials;
    for (const bool yes : {true, false}) {
        for (const StudyTrial& trial : of) {
            if (trial.yes == yes) {
                trials.strength.push_back(std::log10(artifactPx / trial.radiusPx));
            }
        }
        if (yes) trials.yesCount = trials.strength.size();
    }
    // Sorted, so that the order of the rows does not move the last digit.
    const auto middle = trials.strength.begin() + static_cast<std::ptrdiff_t>(trials.yesCount);
    std::sort(trials.strength.begin(), middle);
    std::sort(middle, trials.strength.end());
    return trials;
}

MatrixXd perGroupDesign(const Study& study) {
    MatrixXd design = MatrixXd::Zero(index(study.conditions.size()), index(study.groups.size()));
    for (std::size_t k = 0; k < study.conditions.size(); ++k) {
        design(index(k), index(study.conditions[k].group)) = 1;
    }
    return design;
}

std::optional<MatrixXd> sizeExponentDesign(const Study& study) {
    bool twoSizes = false;  // conditions come by group, so two of one group are two sizes
    for (std::size_t k = 1; k < study.conditions.size(); ++k) {
        twoSizes = twoSizes || study.conditions[k].group == study.conditions[k - 1].group;
    }
    if (!twoSizes) return std::nullopt;
    MatrixXd design = perGroupDesign(study);
    design.conservativeResize(Eigen::NoChange, design.cols() + 1);
    const double a0 = referenceArtifactPx(study);
    for (std::size_t k = 0; k < study.conditions.size(); ++k) {
        design(index(k), design.cols() - 1) = std::log10(study.conditions[k].artifactPx / a0);
    }
    return design;
}

MatrixXd oneSlopeDesign(const Study& study) {
    return MatrixXd::Ones(index(study.conditions.size()), 1);
}

std::vector<std::size_t> groupsWithout(const Study& study, std::size_t factor) {
    std::vector<std::size_t> merged;
    std::vector<std::pair<std::string, std::vector<std::string>>> kinds;
    for (const Group& group : study.groups) {
        std::vector<std::string> others = group.levels;
        others.erase(others.begin() + static_cast<std::ptrdiff_t>(factor));
        const std::pair kind(group.kind, others);
        const auto same = std::find(kinds.begin(), kinds.end(), kind);
        merged.push_back(static_cast<std::size_t>(same - kinds.begin()));
        if (same == kinds.end()) kinds.push_back(kind);
    }
    return merged;
}

MatrixXd mergedDesign(const Study& study, const std::vector<std::size_t>& merged) {
    const std::size_t count = *std::max_element(merged.begin(), merged.end()) + 1;
    MatrixXd design = MatrixXd::Zero(index(study.conditions.size()), index(count));
    for (std::size_t k = 0; k < study.conditions.size(); ++k) {
        design(index(k), index(merged[study.conditions[k].group])) = 1;
    }
    return design;
}

MatrixXd perConditionDesign(const Study& study) {
    const Index n = index(study.conditions.size());
    return MatrixXd::Identity(n, n);
}

std::optional<MatrixXd> contrastDesign(const Study& study) {
    using Kind = std::tuple<records::Pattern, double, std::vector<std::string>>;
    std::map<Kind, std::set<double>> levels;
    const auto patternOf = [](const Group& group) {
        const bool line = group.pattern == records::Pattern::line;
        return Kind(group.pattern, line ? group.angleDeg.value_or(-1.0) : -1.0, group.levels);
    };
    for (const Group& group : study.groups) levels[patternOf(group)].insert(group.litLevel);
    const bool two = std::any_of(levels.begin(), levels.end(),
                                 [](const auto& entry) { return entry.second.size() >= 2; });
    if (!two) return std::nullopt;
    MatrixXd design = MatrixXd::Zero(index(study.conditions.size()), index(levels.size() + 1));
    for (std::size_t k = 0; k < study.conditions.size(); ++k) {
        const Group& group = study.groups[study.conditions[k].group];
        const auto column = std::distance(levels.begin(), levels.find(patternOf(group)));
        design(index(k), column) = 1;
        design(index(k), design.cols() - 1) = std::log10(group.litLevel);
    }
    return design;
}

std::vector<records::Pattern> betaPatterns(const Study& study) {
    std::set<records::Pattern> patterns;
    for (const Group& group : study.groups) patterns.insert(group.pattern);
    return {patterns.begin(), patterns.end()};
}

Model slopeModel(const Study& study, MatrixXd design, double criterion) {
    Model model;
    model.design = std::move(design);
    model.criterion = criterion;
    const std::vector<records::Pattern> patterns = betaPatterns(study);
    model.betaCount = static_cast<int>(patterns.size());
    for (const Condition& condition : study.conditions) {
        const auto at =
            std::find(patterns.begin(), patterns.end(), study.groups[condition.group].pattern);
        model.betaIndex.push_back(static_cast<int>(at - patterns.begin()));
    }
    for (const Observer& observer : study.observers) {
        const double gamma = guessingRate(observer, study.task);
        ModelObserver modelled{.gamma = gamma, .lapseGuess = gamma, .cells = {}};
        for (const Cell& cell : observer.cells) {
            modelled.cells.push_back(
                {static_cast<int>(cell.condition),
                 cellTrials(cell.trials, study.conditions[cell.condition].artifactPx)});
        }
        model.observers.push_back(std::move(modelled));
    }
    return model;
}

namespace {

// Of the cells x columns matrix: the design alone, and with one more column for every observer.
// Only what the latter adds tells observers from groups, and only cells beyond it tell omega.
struct Ranks {
    Index design, withObservers, cells;
};

Ranks ranksOf(const Model& model) {
    const Index p = model.design.cols(), n = index(model.observers.size());
    MatrixXd gram = MatrixXd::Zero(p + n, p + n);
    Index cells = 0;
    for (Index i = 0; i < n; ++i) {
        for (const ModelCell& cell : model.observers[static_cast<std::size_t>(i)].cells) {
            std::vector<std::pair<Index, double>> row = {{p + i, 1.0}};  // what is not 0: little
            for (Index j = 0; j < p; ++j) {
                const double value = model.design(cell.condition, j);
                if (value != 0) row.emplace_back(j, value);
            }
            for (const auto& [a, valueA] : row) {
                for (const auto& [b, valueB] : row) gram(a, b) += valueA * valueB;
            }
            ++cells;
        }
    }
    const auto rank = [](const MatrixXd& of) {
        Eigen::FullPivLU<MatrixXd> lu(of);
        lu.setThreshold(1e-9);
        return lu.rank();
    };
    return {rank(gram.topLeftCorner(p, p)), rank(gram), cells};
}

}  // namespace

Start startOf(const Model& model, const Eigen::VectorXd& perCondition) {
    Start start;
    start.parameters.fixed = (model.design.transpose() * model.design)
                                 .ldlt()
                                 .solve(model.design.transpose() * perCondition);
    start.parameters.beta.assign(static_cast<std::size_t>(model.betaCount), kStartBeta);
    start.parameters.lapse = kStartLapse;
    const Ranks ranks = ranksOf(model);
    start.estimateTau = ranks.withObservers > ranks.design;
    start.estimateOmega = ranks.cells > ranks.withObservers;
    start.parameters.tau = start.estimateTau ? kStartTau : 0;
    start.parameters.omega = start.estimateOmega ? kStartOmega : 0;
    return start;
}

std::vector<GroupCheck> checkGroups(const Study& study, double criterion) {
    std::vector<GroupCheck> checks;
    for (std::size_t g = 0; g < study.groups.size(); ++g) {
        checks.push_back(check(study, criterion, study.groups[g].name,
                               [&](std::size_t k) { return study.conditions[k].group == g; }));
    }
    return checks;
}

std::vector<GroupCheck> checkConditions(const Study& study, double criterion) {
    std::vector<GroupCheck> checks;
    for (std::size_t k = 0; k < study.conditions.size(); ++k) {
        checks.push_back(check(study, criterion, conditionName(study, k),
                               [k](std::size_t other) { return other == k; }));
    }
    return checks;
}

}  // namespace analysis
