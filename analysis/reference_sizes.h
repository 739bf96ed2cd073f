// SPDX-License-Identifier: MIT
// The reference filter sizes of a study's conditions (stimulus/reference_radius.h), which need no
// observer: R1/2, from which no display code differs by more than rounding, and R1, from which none
// differs by more than one. Kreuzer shows the reference beside the perceptual size (Fig. 4).
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>

#include "analysis/study.h"
#include "stimulus/silhouette.h"

namespace analysis {

inline constexpr double kReferenceBoundPx = 600;  ///< the published window; beyond: "not reached"

struct ReferenceSize {
    std::optional<double> halfCode;  ///< R1/2, screen px; absent where it is not reached
    std::optional<double> oneCode;   ///< R1
};

/// The outlines that a condition shows; nothing where the table does not give what they take (a
/// step's or line's angle), or for frames of a renderer.
std::optional<stimulus::SilhouetteOptions> silhouetteOf(const Group& group,
                                                        const Condition& condition);

/// By group name and artifact size, so that a part of the study finds its own.
using ReferenceSizes = std::map<std::pair<std::string, double>, ReferenceSize>;

/// Of every condition; missing where the table does not give what it takes (a step's angle, a
/// kernel with a closed form). Lines have none here: they have no period and take seconds each; the
/// program reference_filter computes them. Where no table names the encoding it is taken to be
/// `code`, the published one.
ReferenceSizes referenceSizes(const Study& study);

/// Nothing where it was not computed.
std::optional<ReferenceSize> referenceSize(const ReferenceSizes& sizes, const Study& study,
                                           std::size_t condition);

}  // namespace analysis
