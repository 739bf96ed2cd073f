// SPDX-License-Identifier: MIT
// The models of METHODS section 5 as design matrices over a study's conditions, for
// random_observer_fit.h and pooled_fit.h.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "analysis/marginal_likelihood.h"
#include "analysis/study.h"

namespace analysis {

/// log10 c per group, one column each: r = c a.
Eigen::MatrixXd perGroupDesign(const Study& study);
/// One more column, kappa - 1: r = c a0 (a/a0)^kappa, with the groups' c at a0. Absent where no
/// group has two sizes.
std::optional<Eigen::MatrixXd> sizeExponentDesign(const Study& study);
/// One log10 c for all groups.
Eigen::MatrixXd oneSlopeDesign(const Study& study);
/// For every group the index of what it is without that factor (Study::factors), counted from 0.
std::vector<std::size_t> groupsWithout(const Study& study, std::size_t factor);
/// log10 c per such index.
Eigen::MatrixXd mergedDesign(const Study& study, const std::vector<std::size_t>& merged);
/// log10 c per condition.
Eigen::MatrixXd perConditionDesign(const Study& study);
/// log10 c at full white per pattern (angle), and last the exponent e of c(C) = c C^e. Absent where
/// no pattern has two lit levels.
std::optional<Eigen::MatrixXd> contrastDesign(const Study& study);

/// The trials of a cell as the likelihood takes them.
CellTrials cellTrials(std::span<const StudyTrial> trials, double artifactPx);

/// The patterns of the study, each with a psychometric slope of its own: index j is the model's
/// beta j.
std::vector<records::Pattern> betaPatterns(const Study& study);

/// The model with that design. The psychometric slope is one per pattern. Yes/no: gamma and the
/// guess on a lapse are the observer's shrunk false-alarm rate.
Model slopeModel(const Study& study, Eigen::MatrixXd design, double criterion);

/// Where a fit can start, from a slope per condition (log10 c): the nearest that the design can do,
/// beta 3.5, the spreads at typical values, or at 0 where the data cannot tell them.
struct Start {
    ModelParameters parameters;
    bool estimateTau = true, estimateOmega = true;
};
Start startOf(const Model& model, const Eigen::VectorXd& perCondition);

/// Whether the answers of a group have a slope at all.
enum class GroupState {
    estimable,
    aboveShown,  ///< all but all answers "yes": the threshold lies beyond the largest r/a shown
    belowShown   ///< as good as guessing throughout: it lies below the smallest
};
struct GroupCheck {
    GroupState state = GroupState::estimable;
    double log10c = 0;          ///< of the pooled answers, where estimable
    bool oneRadius = false;     ///< a single r/a was shown: the slope rests on the prior of beta
    std::string sentence = {};  ///< what is wrong, with numbers; empty when nothing is
};
/// One per group.
std::vector<GroupCheck> checkGroups(const Study& study, double criterion);
/// The same for each condition by itself.
std::vector<GroupCheck> checkConditions(const Study& study, double criterion);

}  // namespace analysis
