// SPDX-License-Identifier: MIT
#include "stimulus/kernel.h"

#include <array>
#include <utility>

#include "stimulus/sentence.h"
#include "stimulus/silhouette.h"

namespace stimulus {
namespace {

constexpr std::array<std::pair<KernelShape, std::string_view>, 3> kNames{{
    {KernelShape::disc, "disc"},
    {KernelShape::box, "box"},
    {KernelShape::gaussian, "gaussian"},
}};

/// The box projected on the edge's normal: the sum of uniform variables on +-narrow and +-wide. Its
/// distribution is a line in the middle with a parabola at each end; written so that it stays exact
/// as the edge becomes parallel to a side and narrow vanishes.
double projectedBox(double d, double narrow, double wide) {
    const double fromEnd = narrow + wide - std::abs(d);
    if (fromEnd <= 0) return d < 0 ? 0 : 1;
    const double tail = fromEnd >= 2 * narrow ? (wide - std::abs(d)) / (2 * wide)
                                              : fromEnd / narrow * (fromEnd / wide) / 8;
    return d < 0 ? tail : 1 - tail;
}

}  // namespace

std::string_view toText(KernelShape shape) {
    for (const auto& [value, name] : kNames)
        if (value == shape) return name;
    return {};
}

std::optional<KernelShape> kernelShapeFromText(std::string_view text) {
    for (const auto& [value, name] : kNames)
        if (name == text) return value;
    return {};
}

void validate(const Kernel& kernel) {
    require(kernel.radiusPx >= 0 && kernel.radiusPx <= kMaxSizePx, "filter radius", kernel.radiusPx,
            " px", "must be in [0, 65536]");
}

double halfPlane(KernelShape shape, double d, double cosAngle, double sinAngle) {
    if (shape != KernelShape::box) return marginal(shape, d);  // the same in every direction
    const double p = std::abs(sinAngle), q = std::abs(cosAngle);
    return projectedBox(d, std::min(p, q), std::max(p, q));
}

}  // namespace stimulus
