// SPDX-License-Identifier: MIT
#include "stimulus/filtered_edge.h"

#include <algorithm>
#include <cmath>

namespace stimulus {
namespace {

/// The texel columns that the kernel touches around x, and a neighbour where it only meets a riser.
struct Touched {
    std::int64_t first, last;
};

Touched touched(const Silhouette& silhouette, const Kernel& kernel, double x) {
    const double reachPx = reach(kernel.shape) * kernel.radiusPx;
    const double width = silhouette.texelWidth();
    return {static_cast<std::int64_t>(std::ceil((x - reachPx) / width)) - 1,
            static_cast<std::int64_t>(std::floor((x + reachPx) / width))};
}

/// A riser as the kernel sees it, and the kernel's mass to its left.
struct Side {
    double u, mass;
};

/// The kernel's mass in the column between two risers below a tread at v.
template <KernelShape shape>
double massBelow(const Side& left, const Side& right, double v, double marginalV) {
    if constexpr (shape == KernelShape::disc)
        return quadrant(shape, right.u, right.mass, v, marginalV) -
               quadrant(shape, left.u, left.mass, v, marginalV);
    else
        return (right.mass - left.mass) * marginalV;
}

double massBelow(KernelShape shape, const Side& left, const Side& right, double v,
                 double marginalV) {
    if (shape == KernelShape::disc) return massBelow<KernelShape::disc>(left, right, v, marginalV);
    return massBelow<KernelShape::box>(left, right, v, marginalV);
}

double clampToUnit(double value) {
    return std::clamp(value, 0.0, 1.0);
}

/// The sum over texel columns, with the kernel's marginal by whatever means.
template <typename Marginal>
double visibilityBy(const Silhouette& silhouette, const Kernel& kernel, double x, double y,
                    Marginal marginalOf) {
    const KernelShape shape = kernel.shape;
    const auto [first, last] = touched(silhouette, kernel, x);
    double inShadow = 0;
    // Nothing lies left of the first column touched, all lies left of the last one's end.
    Side left{normalised(kernel, silhouette.riser(first) - x), 0};
    for (std::int64_t k = first; k <= last; ++k) {
        const double v = normalised(kernel, silhouette.height(k) - y);
        if (v > reach(shape)) {  // this tread and, as heights rise, all after it are in full shadow
            inShadow += 1 - left.mass;
            break;
        }
        const double u = normalised(kernel, silhouette.riser(k + 1) - x);
        const Side right{u, k == last ? 1 : marginalOf(u)};
        if (v >= -reach(shape)) inShadow += massBelow(shape, left, right, v, marginalOf(v));
        left = right;
    }
    return clampToUnit(1 - inShadow);
}

constexpr int kTableIntervals = 8192;

}  // namespace

double artifactVisibility(const Silhouette& silhouette, const Kernel& kernel, double x, double y) {
    return visibilityBy(silhouette, kernel, x, y,
                        [&](double t) { return marginal(kernel.shape, t); });
}

ApproximateArtifact::ApproximateArtifact(KernelShape shape) {
    table_.reserve(kTableIntervals + 2);
    for (int i = 0; i <= kTableIntervals + 1; ++i)
        table_.push_back(marginal(shape, reach(shape) * (2.0 * i / kTableIntervals - 1)));
}

double ApproximateArtifact::visibility(const Silhouette& silhouette, const Kernel& kernel, double x,
                                       double y) const {
    const double limit = reach(kernel.shape);
    // Linear interpolation is off by at most 4e-7 (at the ends of the disc, where the marginal
    // bends most); in the sum over columns the errors of a marginal cancel but for a few.
    return visibilityBy(silhouette, kernel, x, y, [&](double t) {
        const double place = (std::clamp(t / limit, -1.0, 1.0) + 1) * (kTableIntervals / 2);
        const auto i = static_cast<std::size_t>(place);
        const double share = place - static_cast<double>(i);
        return table_[i] + share * (table_[i + 1] - table_[i]);
    });
}

double straightVisibility(const Silhouette& silhouette, const Kernel& kernel, double x, double y) {
    const double d = normalised(kernel, silhouette.distance(x, y));
    return halfPlane(kernel.shape, d, silhouette.cosAngle(), silhouette.sinAngle());
}

ArtifactColumns::ArtifactColumns(const Silhouette& silhouette, const Kernel& kernel, double bottomY,
                                 std::size_t rows)
    : silhouette_(silhouette), kernel_(kernel), bottomY_(bottomY), rows_(rows) {
    validate(kernel);
}

std::optional<std::int64_t> ArtifactColumns::soleTexel(double x) const {
    const auto [first, last] = touched(silhouette_, kernel_, x);
    if (first != last) return {};
    return first;
}

ArtifactColumns::Tread ArtifactColumns::treadOf(std::int64_t k) const {
    const double height = silhouette_.height(k);
    const auto vOf = [&](std::size_t row) {
        return normalised(kernel_, height - (bottomY_ + static_cast<double>(row)));
    };
    const double limit = reach(kernel_.shape);
    // v falls from row to row: in full shadow while v > limit, not in shadow once v < -limit.
    const double reachPx = limit * kernel_.radiusPx;
    const auto nearRow = [&](double y) {
        const double row =
            std::clamp(std::floor(y - bottomY_) - 1, 0.0, static_cast<double>(rows_));
        return static_cast<std::size_t>(row);
    };
    Tread tread{.k = k, .firstRow = nearRow(height - reachPx)};
    while (tread.firstRow < rows_ && vOf(tread.firstRow) > limit) ++tread.firstRow;
    for (std::size_t row = tread.firstRow; row < rows_; ++row) {
        const double v = vOf(row);
        if (v < -limit) break;
        tread.v.push_back(v);
        tread.marginalV.push_back(marginal(kernel_.shape, v));
    }
    return tread;
}

void ArtifactColumns::moveTo(double x) {
    const auto [first, last] = touched(silhouette_, kernel_, x);
    while (!treads_.empty() && treads_.front().k < first) treads_.pop_front();
    while (!treads_.empty() && treads_.back().k > last) treads_.pop_back();
    for (std::int64_t k = treads_.empty() ? first : treads_.back().k + 1; k <= last; ++k)
        treads_.push_back(treadOf(k));

    risers_.clear();
    for (std::int64_t k = first; k <= last + 1; ++k) {
        const double u = normalised(kernel_, silhouette_.riser(k) - x);
        risers_.push_back({u, k == first ? 0 : k > last ? 1 : marginal(kernel_.shape, u)});
    }
}

template <KernelShape shape>
void ArtifactColumns::addShadows(std::span<double> inShadow) const {
    std::size_t settled = 0;  // rows below it are in the full shadow of an earlier tread
    for (std::size_t i = 0; i < treads_.size(); ++i) {
        const Tread& tread = treads_[i];
        const Side left{risers_[i].u, risers_[i].mass},
            right{risers_[i + 1].u, risers_[i + 1].mass};
        for (; settled < tread.firstRow; ++settled) inShadow[settled] += 1 - left.mass;
        double* rows = inShadow.data() + tread.firstRow;
        for (std::size_t j = 0; j < tread.v.size(); ++j)
            rows[j] += massBelow<shape>(left, right, tread.v[j], tread.marginalV[j]);
    }
}

void ArtifactColumns::evaluate(double x, std::span<double> values) {
    moveTo(x);
    std::fill(values.begin(), values.end(), 0.0);
    if (kernel_.shape == KernelShape::disc)
        addShadows<KernelShape::disc>(values);
    else
        addShadows<KernelShape::box>(values);
    for (double& value : values) value = clampToUnit(1 - value);
}

}  // namespace stimulus
