// SPDX-License-Identifier: MIT
// The reference filter size of a study's conditions: the radius from which no display code differs
// by more than rounding (stimulus/reference_radius.h, halfCode), which needs no observer. Kreuzer
// shows it beside the perceptual size (Fig. 4).
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>

#include "analysis/study.h"

namespace analysis {

inline constexpr double kReferenceBoundPx = 600;  ///< the published window; beyond: "not reached"

/// Screen px by group name and artifact size, so that a part of the study finds its own.
using ReferenceSizes = std::map<std::pair<std::string, double>, double>;

/// Of every condition; missing where the size is not reached, or where the table does not give what
/// it takes (a step's angle, a kernel with a closed form). Lines have none here: they have no
/// period and take seconds each; the program reference_filter computes them. Where no table names
/// the encoding it is taken to be `code`, the published one.
ReferenceSizes referenceSizes(const Study& study);

std::optional<double> referenceSize(const ReferenceSizes& sizes, const Study& study,
                                    std::size_t condition);

}  // namespace analysis
