// SPDX-License-Identifier: MIT
#include "analysis/reference_sizes.h"

#include <algorithm>
#include <cmath>

#include "stimulus/reference_radius.h"

namespace analysis {
namespace {

constexpr double kRadiansPerDegree = 0.017453292519943295;

}  // namespace

// A step whose angle is known has its riser spacing: tan(angle) = a / L.
std::optional<stimulus::SilhouetteOptions> silhouetteOf(const Group& group,
                                                        const Condition& condition) {
    stimulus::SilhouetteOptions options{.artifactPx = condition.artifactPx};
    const bool angled = condition.angleDeg && *condition.angleDeg > 0 && *condition.angleDeg <= 45;
    switch (group.pattern) {
        case records::Pattern::stair:
            options.pattern = stimulus::Pattern::stair;
            return options;
        case records::Pattern::step:
            if (!angled) return std::nullopt;
            options.pattern = stimulus::Pattern::step;
            options.riserSpacingPx = std::round(condition.artifactPx /
                                                std::tan(*condition.angleDeg * kRadiansPerDegree));
            return options;
        case records::Pattern::line:
            if (!angled) return std::nullopt;
            options.pattern = stimulus::Pattern::line;
            options.angleDeg = *condition.angleDeg;
            return options;
        case records::Pattern::frame:
            return std::nullopt;
    }
    return std::nullopt;
}

ReferenceSizes referenceSizes(const Study& study) {
    ReferenceSizes sizes;
    for (const Condition& condition : study.conditions) {
        const Group& group = study.groups[condition.group];
        if (group.pattern == records::Pattern::line) continue;  // seconds each: see the header
        const auto kernel = stimulus::kernelShapeFromText(group.kernel);
        const auto encoding = group.encoding == records::Encoding::srgb ? stimulus::Encoding::srgb
                                                                        : stimulus::Encoding::code;
        const auto silhouette = silhouetteOf(group, condition);
        if (!silhouette || !kernel) continue;
        const stimulus::ReferenceOptions options{.silhouette = *silhouette,
                                                 .kernel = *kernel,
                                                 .litLevel = group.litLevel,
                                                 .encoding = encoding,
                                                 .maxRadiusPx = kReferenceBoundPx};
        sizes[{group.name, condition.artifactPx}] = {
            stimulus::referenceRadius(options, stimulus::ReferenceCriterion::halfCode),
            stimulus::referenceRadius(options, stimulus::ReferenceCriterion::oneCode)};
    }
    return sizes;
}

std::optional<ReferenceSize> referenceSize(const ReferenceSizes& sizes, const Study& study,
                                           std::size_t k) {
    const Condition& condition = study.conditions[k];
    const auto found = sizes.find({study.groups[condition.group].name, condition.artifactPx});
    return found == sizes.end() ? std::nullopt : std::optional(found->second);
}

}  // namespace analysis
