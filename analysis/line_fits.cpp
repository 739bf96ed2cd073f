// SPDX-License-Identifier: MIT
#include "analysis/line_fits.h"

#include <cmath>

namespace analysis {
namespace {

struct Point {
    double artifactPx, radiusPx;
};

double mean(const std::vector<Point>& points, auto&& value) {
    double sum = 0;
    for (const Point& point : points) sum += value(point);
    return sum / static_cast<double>(points.size());
}

struct Line {
    double atZero, slope;
};

// Least squares of y on x; nothing where all x are equal.
std::optional<Line> lineThrough(const std::vector<Point>& points, auto&& x, auto&& y) {
    const double meanX = mean(points, x), meanY = mean(points, y);
    double xx = 0, xy = 0;
    bool twoSizes = false;
    for (const Point& point : points) {
        const double off = x(point) - meanX;
        xx += off * off;
        xy += off * (y(point) - meanY);
        twoSizes = twoSizes || point.artifactPx != points.front().artifactPx;
    }
    if (!twoSizes) return std::nullopt;
    const double slope = xy / xx;
    return Line{meanY - slope * meanX, slope};
}

double residual(const std::vector<Point>& points, auto&& radiusAt) {
    return std::sqrt(mean(points, [&](const Point& point) {
        return std::pow(point.radiusPx - radiusAt(point.artifactPx), 2);
    }));
}

}  // namespace

LineFits lineFits(const Study& study, const std::vector<CellThreshold>& thresholds,
                  std::optional<std::size_t> group) {
    std::vector<Point> points;
    for (const CellThreshold& cell : thresholds) {
        const Condition& condition = study.conditions[cell.condition];
        if (group && condition.group != *group) continue;
        if (cell.state != ThresholdState::estimated) continue;
        points.push_back({condition.artifactPx, cell.radiusPx});
    }
    LineFits fits;
    fits.cells = static_cast<int>(points.size());
    if (points.empty()) return fits;
    double ar = 0, aa = 0;
    for (const auto& [a, r] : points) {
        ar += a * r;
        aa += a * a;
    }
    const double c = ar / aa;
    fits.throughOrigin = c;
    fits.residualPx = residual(points, [c](double a) { return c * a; });

    const auto affine = lineThrough(
        points, [](const Point& p) { return p.artifactPx; },
        [](const Point& p) { return p.radiusPx; });
    if (!affine) return fits;
    fits.affine = {.interceptPx = affine->atZero, .slope = affine->slope};
    fits.affineResidualPx =
        residual(points, [&](double a) { return affine->atZero + affine->slope * a; });

    const double a0 = referenceArtifactPx(study);
    const auto power = lineThrough(
        points, [a0](const Point& p) { return std::log10(p.artifactPx / a0); },
        [](const Point& p) { return std::log10(p.radiusPx); });
    fits.powerLaw = {
        .log10c = power->atZero - std::log10(a0), .exponent = power->slope, .referencePx = a0};
    fits.powerLawResidualPx = residual(points, [&](double a) {
        return std::pow(10.0, power->atZero) * std::pow(a / a0, power->slope);
    });
    return fits;
}

}  // namespace analysis
