// SPDX-License-Identifier: MIT
#include "stimulus/reference_radius.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "stimulus/difference_bound.h"
#include "stimulus/filtered_edge.h"
#include "stimulus/sentence.h"

namespace stimulus {
namespace {

struct Values {
    double artifact, straight;
};

struct Interval {
    double low, high;
    double middle() const { return (low + high) / 2; }
    double half() const { return (high - low) / 2; }
};

Interval turned(const Interval& interval) {
    return {-interval.high, -interval.low};
}

/// The values first, first + spacing, ... that lie in an interval; rounding at its ends is
/// forgiven.
struct GridPoints {
    double first = 0, spacing = 1;
    int count = 0;
    double at(int i) const { return first + spacing * i; }
};

GridPoints gridPoints(const Interval& interval, double origin, double spacing) {
    constexpr double slack = 1e-9;
    const double low = std::ceil((interval.low - origin) / spacing - slack);
    const double high = std::floor((interval.high - origin) / spacing + slack);
    return {origin + low * spacing, spacing, std::max(0, static_cast<int>(high - low) + 1)};
}

GridPoints pixelsIn(const Interval& interval) {
    return gridPoints(interval, 0.5, 1);
}
GridPoints radiiIn(const Interval& interval) {
    return gridPoints(interval, 0, kRadiusGridPx);
}

/// One search's fixed facts.
struct Problem {
    Silhouette silhouette;
    KernelShape kernel;
    double litLevel;
    Encoding encoding;
    ReferenceCriterion criterion;
    Interval columns;  // of pixels to examine
    /// Stair and step look the same after half a turn about (0, intercept), with light and shadow
    /// exchanged. The pixel grid does not: its phase turns too.
    bool symmetric;

    double fullCode() const { return 255 * litLevel; }

    Values at(double x, double y, double radius) const {
        const Kernel sized{kernel, radius};
        return {artifactVisibility(silhouette, sized, x, y),
                straightVisibility(silhouette, sized, x, y)};
    }

    double difference(const Values& v) const {
        return std::abs(encode(v.artifact, encoding) - encode(v.straight, encoding));
    }

    bool fails(const Values& v) const {
        if (criterion == ReferenceCriterion::halfCode) return fullCode() * difference(v) >= 0.5;
        return std::abs(code(v.artifact) - code(v.straight)) > allowedCodes();
    }

    int code(double v) const { return displayCode(v, litLevel, encoding); }
    int allowedCodes() const { return criterion == ReferenceCriterion::oneCode ? 1 : 0; }

    /// Below this difference in code units no pixel can fail, wherever rounding falls.
    double safeDifference() const {
        return criterion == ReferenceCriterion::halfCode ? 0.5 : allowedCodes();
    }

    /// Beyond this distance from the edge the two images are equal.
    double farthestPx(double radius) const {
        const double support = kernel == KernelShape::box
                                   ? silhouette.cosAngle() + silhouette.sinAngle()
                                   : reach(kernel);
        return support * radius + band();
    }
    double band() const { return silhouette.maxDeviationPx() * silhouette.cosAngle(); }
    double yOf(double x, double distance) const {
        return (silhouette.rise() * x) / silhouette.run() + silhouette.intercept() +
               distance / silhouette.cosAngle();
    }
};

/// Finds the largest radius of the grid at which a pixel fails, by branch and bound over boxes of
/// pixel columns, distances from the edge (in radii) and radii. A box is dropped when the
/// difference in its middle and the greatest possible change from there prove that nothing in it
/// can fail, and searched pixel by pixel once it holds only a few. The result is that of testing
/// every pixel at every radius.
class LargestFailure {
  public:
    explicit LargestFailure(const Problem& problem)
        : problem_(problem), approximate_(problem.kernel) {}

    /// Nothing where no radius up to the bound, a multiple of the grid, fails.
    std::optional<double> search(double bound) {
        double high = bound;
        while (high > 0 && !found_) {  // in slabs from above: the first slab with a failure has it
            const double low =
                std::max(std::floor(high * 15 / 16 / kRadiusGridPx), 1.0) * kRadiusGridPx;
            const double far = problem_.farthestPx(low) / low;
            visit({problem_.columns, {problem_.symmetric ? 0 : -far, far}, {low, high}});
            high = low - kRadiusGridPx;
        }
        const double far = problem_.farthestPx(0);
        if (!found_ && anyPixelFails(problem_.columns, {-far, far}, 0)) found_ = 0;
        return found_;
    }

  private:
    struct Box {
        Interval x, delta, radius;
    };

    void visit(Box box) {
        const GridPoints columns = pixelsIn(box.x);
        GridPoints radii = radiiIn(box.radius);
        while (radii.count > 0 && found_ && radii.first <= *found_) {
            radii.first += kRadiusGridPx;
            --radii.count;
        }
        if (columns.count == 0 || radii.count == 0) return;
        box.x = {columns.first, columns.at(columns.count - 1)};
        box.radius = {radii.first, radii.at(radii.count - 1)};

        const double rows = 2 * box.delta.half() * box.radius.high / problem_.silhouette.cosAngle();
        if (columns.count * radii.count * (rows + 1) <= 4) return visitPixels(box, radii);
        const Change change = greatestChange(box);
        if (cannotFail(box, change)) return;
        // What holds one row, column or radius is not worth splitting there.
        split(box, {.x = columns.count > 1 ? change.x : -1,
                    .delta = rows > 0.5 ? change.delta : -1,
                    .radius = radii.count > 1 ? change.radius : -1});
    }

    /// How much the difference may change from the middle of a box, by each of its coordinates.
    struct Change {
        double x, delta, radius;
    };

    Change greatestChange(const Box& box) const {
        const Silhouette& s = problem_.silhouette;
        const double r = box.radius.low;
        const DifferenceBound bound =
            differenceBound(problem_.kernel, box.delta.middle(), box.delta.half(),
                            problem_.band() / r, s.cosAngle(), s.sinAngle());
        return {.x = bound.along / r * box.x.half() / s.cosAngle(),
                .delta = bound.across * box.delta.half(),
                .radius = bound.inRadius / r * box.radius.half()};
    }

    /// At least |e|, by little. Where only equal codes will do, the table's error would leave too
    /// many pixels near a change of code in doubt.
    double differenceAt(double x, double y, double radius) const {
        constexpr double roundingError = 1e-12;
        const bool exact = problem_.criterion == ReferenceCriterion::identical;
        const Kernel kernel{problem_.kernel, radius};
        const Silhouette& s = problem_.silhouette;
        const double artifact =
            exact ? artifactVisibility(s, kernel, x, y) : approximate_.visibility(s, kernel, x, y);
        return std::abs(artifact - straightVisibility(s, kernel, x, y)) +
               (exact ? roundingError : ApproximateArtifact::kError);
    }

    /// Whether a difference of at most `largest` keeps every pixel at these distances from failing:
    /// because no code can differ by more, or because all of them get the same codes.
    bool isSafe(const Interval& delta, double largest) const {
        constexpr double roundingError = 1e-9;
        const bool light = problem_.encoding == Encoding::srgb;
        const double slope = light ? encodeSlope(darkest(delta, largest), problem_.encoding) : 1;
        if (problem_.fullCode() * slope * largest < problem_.safeDifference() - roundingError)
            return true;
        if (problem_.criterion == ReferenceCriterion::halfCode) return false;
        const double brightest = std::min(straightAt(delta.high) + largest, 1.0);
        return problem_.code(brightest) - problem_.code(darkest(delta, largest)) <=
               problem_.allowedCodes();
    }

    double darkest(const Interval& delta, double largest) const {
        return std::max(straightAt(delta.low) - largest, 0.0);
    }

    double straightAt(double delta) const {
        return halfPlane(problem_.kernel, delta, problem_.silhouette.cosAngle(),
                         problem_.silhouette.sinAngle());
    }

    bool cannotFail(const Box& box, const Change& change) const {
        // The part 2 |e| / r of the bound lets e grow at most like r^2.
        const double growth = std::exp(2 * box.radius.half() / box.radius.low);
        const double changed = change.x + change.delta + change.radius;
        const auto safe = [&](double largest) {
            return isSafe(box.delta, largest) &&
                   (!problem_.symmetric || isSafe(turned(box.delta), largest));
        };
        if (!safe(changed * growth)) return false;  // whatever the middle's value
        const double x = box.x.middle(), radius = box.radius.middle();
        const double y = problem_.yOf(x, box.delta.middle() * radius);
        return safe((differenceAt(x, y, radius) + changed) * growth);
    }

    void split(const Box& box, const Change& worth) {
        Box lower = box, upper = box;
        if (worth.radius >= std::max(worth.x, worth.delta)) {
            lower.radius.high = upper.radius.low = box.radius.middle();
        } else if (worth.x >= worth.delta) {
            lower.x.high = upper.x.low = box.x.middle();
        } else {
            lower.delta.high = upper.delta.low = box.delta.middle();
        }
        visit(upper);  // larger radii first: a failure there makes the others needless
        visit(lower);
    }

    void visitPixels(const Box& box, const GridPoints& radii) {
        for (int i = radii.count - 1; i >= 0; --i) {
            const double radius = radii.at(i);
            const Interval near{box.delta.low * radius, box.delta.high * radius};
            if (anyPixelFails(box.x, near, radius) ||
                (problem_.symmetric && anyPixelFails(turned(box.x), turned(near), radius))) {
                found_ = radius;
                return;
            }
        }
    }

    bool anyPixelFails(const Interval& xs, const Interval& distances, double radius) const {
        const GridPoints columns = pixelsIn(xs);
        for (int i = 0; i < columns.count; ++i) {
            const double x = columns.at(i);
            const GridPoints rows =
                pixelsIn({problem_.yOf(x, distances.low), problem_.yOf(x, distances.high)});
            for (int j = 0; j < rows.count; ++j)
                if (fails(x, rows.at(j), radius)) return true;
        }
        return false;
    }

    bool fails(double x, double y, double radius) const {
        const double delta = problem_.silhouette.distance(x, y) / radius;
        const bool clearlyNot = radius > 0 && isSafe({delta, delta}, differenceAt(x, y, radius));
        return !clearlyNot && problem_.fails(problem_.at(x, y, radius));
    }

    Problem problem_;
    ApproximateArtifact approximate_;
    std::optional<double> found_;
};

Problem problemOf(const ReferenceOptions& o, ReferenceCriterion criterion) {
    validate(o);
    const Silhouette silhouette(o.silhouette);
    const auto period = silhouette.artifactPeriod();
    const double left = -(o.windowPx / 2) + 0.5;  // as the images have it
    const Interval columns =
        period ? Interval{0.5, period->dx - 0.5} : Interval{left, left + o.windowPx - 1};
    const bool columnsTurn = period || columns.low == -columns.high;
    return {silhouette,
            o.kernel,
            o.litLevel,
            o.encoding,
            criterion,
            columns,
            o.silhouette.pattern != Pattern::line && columnsTurn};
}

}  // namespace

void validate(const ReferenceOptions& o) {
    Silhouette{o.silhouette};  // throws
    validateLitLevel(o.litLevel);
    require(o.windowPx >= 1 && o.windowPx <= kMaxWindowPx, "window", o.windowPx, " px",
            "must be in 1..8192");
    require(o.maxRadiusPx >= 1 && o.maxRadiusPx <= kMaxWindowPx, "bound of the radius",
            o.maxRadiusPx, " px", "must be in [1, 8192]");
    const double texels = 2 * reach(o.kernel) * o.maxRadiusPx / o.silhouette.artifactPx;
    require(texels <= 20000, "number of texels across the largest kernel", texels, "",
            "must be at most 20000 (smaller bound of the radius or larger artifact)");
}

std::optional<double> referenceRadius(const ReferenceOptions& options,
                                      ReferenceCriterion criterion) {
    LargestFailure failure(problemOf(options, criterion));
    const double bound = std::floor(options.maxRadiusPx / kRadiusGridPx) * kRadiusGridPx;
    const auto largest = failure.search(bound);
    if (!largest) return 0;
    if (*largest >= bound) return {};
    return *largest + kRadiusGridPx;
}

double largestDifference(const ReferenceOptions& options, double radiusPx) {
    validate(Kernel{options.kernel, radiusPx});
    const Problem problem = problemOf(options, ReferenceCriterion::halfCode);
    const double far = problem.farthestPx(radiusPx);
    const GridPoints columns = pixelsIn(problem.columns);
    double largest = 0;
    for (int i = 0; i < columns.count; ++i) {
        const double x = columns.at(i);
        const GridPoints rows = pixelsIn({problem.yOf(x, -far), problem.yOf(x, far)});
        for (int j = 0; j < rows.count; ++j)
            largest = std::max(largest, problem.difference(problem.at(x, rows.at(j), radiusPx)));
    }
    return largest;
}

}  // namespace stimulus
