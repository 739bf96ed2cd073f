// SPDX-License-Identifier: MIT
#include "stimulus/silhouette.h"

#include <cmath>
#include <numbers>
#include <numeric>

#include "stimulus/sentence.h"

namespace stimulus {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

double slopeOf(double angleDeg) {
    return angleDeg == 45 ? 1 : std::tan(angleDeg * kDegree);  // tan(pi/4) is not 1 in double
}

/// The shift of a line, in texels, that centres the rounded heights on it (header). An angle given
/// with three decimals counts as the fraction it means: until |t - p/q| has added up to half a tie
/// over the window, the line makes the same steps as p/q. Beyond q = 99 the offset is below a/200.
double tieShift(double slope) {
    constexpr double tolerance = 1e-4;
    for (int q = 1; q <= 99; q += 2) {
        const double p = std::round(slope * q);
        if (std::fmod(p, 2) == 1 && std::abs(slope * q - p) <= tolerance) return -0.5 / q;
    }
    return 0;
}

void validate(const SilhouetteOptions& o) {
    const double a = o.artifactPx;
    require(a > 0 && a <= kMaxSizePx, "artifact size", a, " px", "must be in (0, 65536]");
    require(std::abs(o.verticalPhasePx) <= 1, "vertical phase", o.verticalPhasePx, " px",
            "must be in [-1, 1]");
    if (o.pattern == Pattern::line)
        require(o.angleDeg > 0 && o.angleDeg <= 45, "angle of the line", o.angleDeg, " degrees",
                "must be in (0, 45]");
    if (o.pattern == Pattern::step)
        require(o.riserSpacingPx >= a && o.riserSpacingPx <= kMaxSizePx, "riser spacing",
                o.riserSpacingPx, " px", "must be at least the artifact size, at most 65536");
}

bool isWhole(double value) {
    return value == std::floor(value);
}

/// With ten binary places, every coordinate and product of this folder is exact in double.
bool isExact(double value) {
    return isWhole(value * 1024);
}

}  // namespace

Silhouette::Silhouette(const SilhouetteOptions& options) : options_(options) {
    validate(options);
    const double a = options.artifactPx;
    switch (options.pattern) {
        case Pattern::stair:
            width_ = a;
            intercept_ = -a / 2;
            break;
        case Pattern::step:
            width_ = options.riserSpacingPx;
            run_ = options.riserSpacingPx;
            rise_ = a;
            break;
        case Pattern::line:
            width_ = a;
            rise_ = slopeOf(options.angleDeg);
            lineShift_ = tieShift(rise_);
            intercept_ = lineShift_ * a;
            break;
    }
    intercept_ += options.verticalPhasePx;
    length_ = std::hypot(run_, rise_);
}

std::int64_t Silhouette::texelAt(double x) const {
    return static_cast<std::int64_t>(std::floor(x / width_));
}

double Silhouette::height(std::int64_t k) const {
    const double a = options_.artifactPx;
    const auto column = static_cast<double>(k);
    double texels = column;
    if (options_.pattern == Pattern::step) texels = column + 0.5;
    if (options_.pattern == Pattern::line)
        texels = std::floor(rise_ * (column + 0.5) + lineShift_ + 0.5);
    return a * texels + options_.verticalPhasePx;
}

double Silhouette::angleDeg() const {
    return std::atan2(rise_, run_) / kDegree;
}

double Silhouette::distance(double x, double y) const {
    // Whole run and rise (stair, step) make the numerator exact: equal distances have equal bits.
    return (run_ * (y - intercept_) - rise_ * x) / length_;
}

double Silhouette::maxDeviationPx() const {
    const double a = options_.artifactPx;
    return options_.pattern == Pattern::line ? a / 2 * (1 + rise_) : a / 2;
}

std::optional<Period> Silhouette::artifactPeriod() const {
    const double dx = options_.pattern == Pattern::step ? width_ : options_.artifactPx;
    const double dy = options_.artifactPx;
    const bool regular = options_.pattern != Pattern::line || rise_ == 1;
    if (!regular || !isExact(intercept_)) return {};
    for (const int repeats : {1, 2, 4, 8})
        if (isWhole(repeats * dx) && isWhole(repeats * dy))
            return Period{static_cast<int>(repeats * dx), static_cast<int>(repeats * dy)};
    return {};
}

std::optional<Period> Silhouette::straightPeriod() const {
    if (!isWhole(run_) || !isWhole(rise_) || !isExact(intercept_)) return {};
    const Period whole{static_cast<int>(run_), static_cast<int>(rise_)};
    const int divisor = std::gcd(whole.dx, whole.dy);
    return Period{whole.dx / divisor, whole.dy / divisor};
}

Silhouette Silhouette::withStraightEdgeAt(double angleDeg) const {
    require(angleDeg > -45 && angleDeg < 45, "tilt of the straight edge", angleDeg, " degrees",
            "must be in (-45, 45)");
    Silhouette turned = *this;
    turned.run_ = std::cos(angleDeg * kDegree);
    turned.rise_ = std::sin(angleDeg * kDegree);
    turned.length_ = 1;
    return turned;
}

double trueAngleDeg(const SilhouetteOptions& options) {
    return Silhouette(options).angleDeg();
}

}  // namespace stimulus
