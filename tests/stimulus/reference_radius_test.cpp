// SPDX-License-Identifier: MIT
#include "stimulus/reference_radius.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "stimulus/difference_bound.h"
#include "stimulus/stimulus_image.h"

namespace {

using namespace stimulus;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr std::array kShapes{KernelShape::disc, KernelShape::box, KernelShape::gaussian};

SilhouetteOptions stair(double a) {
    return {.pattern = Pattern::stair, .artifactPx = a};
}
SilhouetteOptions step(double a, double spacing) {
    return {.pattern = Pattern::step, .artifactPx = a, .riserSpacingPx = spacing};
}

/// The definition, pixel by pixel on images: the smallest radius from which on every radius works.
std::optional<double> byDefinition(const ReferenceOptions& o, ReferenceCriterion criterion) {
    const auto works = [&](double radius) {
        if (criterion == ReferenceCriterion::halfCode)
            return 255 * o.litLevel * largestDifference(o, radius) < 0.5;
        // A window that holds a period of columns and, in each, the whole penumbra.
        const StimulusOptions image{
            .silhouette = o.silhouette,
            .kernel = {o.kernel, radius},
            .windowPx = static_cast<int>(12 * o.maxRadiusPx + 12 * o.silhouette.artifactPx),
            .litLevel = o.litLevel,
            .encoding = o.encoding};
        const int columns =
            o.silhouette.pattern == Pattern::line ? o.windowPx
            : o.silhouette.pattern == Pattern::step
                ? static_cast<int>(o.silhouette.riserSpacingPx)
                : static_cast<int>(2 *
                                   o.silhouette.artifactPx);  // two periods: sizes of x.5 px too
        const cv::Rect period(image.windowPx / 2 - columns / 2, 0, columns, image.windowPx);
        cv::Mat difference;
        cv::absdiff(artifactImage(image)(period), straightImage(image)(period), difference);
        double largest = 0;
        cv::minMaxLoc(difference, nullptr, &largest);
        return largest <= (criterion == ReferenceCriterion::oneCode ? 1 : 0);
    };
    double radius = std::floor(o.maxRadiusPx / kRadiusGridPx) * kRadiusGridPx;
    if (!works(radius)) return {};
    while (radius > 0 && works(radius - kRadiusGridPx)) radius -= kRadiusGridPx;
    return radius;
}

TEST(ReferenceRadius, IsThatOfTestingEveryPixelAtEveryRadius) {
    std::vector<ReferenceOptions> cases;
    for (const KernelShape shape : kShapes)
        for (const SilhouetteOptions& silhouette :
             {stair(3), stair(2.5), step(2, 16), step(3, 24),
              SilhouetteOptions{.pattern = Pattern::line, .artifactPx = 3, .angleDeg = 22.5}})
            cases.push_back(
                {.silhouette = silhouette, .kernel = shape, .windowPx = 24, .maxRadiusPx = 20});
    for (const ReferenceOptions& o : std::vector(cases)) {
        auto darker = o, light = o;
        darker.litLevel = 0.5;
        light.encoding = Encoding::srgb;
        light.litLevel = 0.3;
        cases.push_back(darker);
        cases.push_back(light);
    }
    int reached = 0;
    for (const ReferenceOptions& o : cases)
        for (const auto criterion : {ReferenceCriterion::halfCode, ReferenceCriterion::oneCode}) {
            const auto expected = byDefinition(o, criterion);
            reached += expected.has_value();
            EXPECT_EQ(referenceRadius(o, criterion), expected)
                << toText(o.kernel) << " pattern " << static_cast<int>(o.silhouette.pattern)
                << " a " << o.silhouette.artifactPx << " lit " << o.litLevel << " criterion "
                << static_cast<int>(criterion);
        }
    EXPECT_GT(reached, 60);  // the cases are not all beyond the bound
}

TEST(ReferenceRadius, IdenticalIsThatOfTestingEveryPixelAtEveryRadius) {
    int reached = 0;
    for (const KernelShape shape : kShapes)
        for (const double lit : {0.002, 0.01, 0.02, 1.0}) {
            const ReferenceOptions o{
                .silhouette = stair(4), .kernel = shape, .litLevel = lit, .maxRadiusPx = 20};
            const auto expected = byDefinition(o, ReferenceCriterion::identical);
            reached += expected.has_value();
            EXPECT_EQ(referenceRadius(o, ReferenceCriterion::identical), expected)
                << toText(shape) << " " << lit;
        }
    EXPECT_GT(reached, 0);
}

// The box in closed form, over all places: D = a L / (32 r^2) for r >= L/4, (a / 4r)(1 - 2r/L)
// below, with L = a for the stair. A pixel grid may miss the place of the maximum by a fraction of
// a pixel.
double exactBoxDifference(double a, double spacing, double r) {
    return r >= spacing / 4 ? a * spacing / (32 * r * r) : a / (4 * r) * (1 - 2 * r / spacing);
}

TEST(ReferenceRadius, BoxFollowsItsExactFormula) {
    for (const auto& [silhouette, spacing] :
         {std::pair(stair(10), 10.0), std::pair(stair(30), 30.0), std::pair(step(10, 600), 600.0),
          std::pair(step(10, 80), 80.0), std::pair(step(30, 240), 240.0)})
        for (const double share : {0.1, 0.2, 0.3, 0.6, 1.0, 2.0}) {
            const double r = share * spacing;
            if (r < silhouette.artifactPx)
                continue;  // below, pixels are too coarse to meet the top
            const double exact = exactBoxDifference(silhouette.artifactPx, spacing, r);
            const double d =
                largestDifference({.silhouette = silhouette, .kernel = KernelShape::box}, r);
            EXPECT_LE(d, exact * (1 + 1e-9)) << spacing << " " << r;
            // The nearest pixel is at most 1/2 px from the top, where V falls by 1/(2r) per px at
            // worst; measured, 3 % at a = 10 and r = a.
            EXPECT_GE(d, exact * 0.95) << spacing << " " << r;
        }
}

TEST(ReferenceRadius, BoxAnchorsOfTheMethods) {
    // R1/2 = sqrt(W a L / 16): 310 px at a = 10 and 536 px at a = 30 for the step across 600 px.
    // The 0.75 px allow for the grid of radii and for pixels beside the maximum.
    const auto radius = [](const SilhouetteOptions& s, double lit) {
        return referenceRadius({.silhouette = s, .kernel = KernelShape::box, .litLevel = lit},
                               ReferenceCriterion::halfCode);
    };
    for (const double lit : {1.0, 0.5})
        for (const double a : {5.0, 10.0, 20.0, 30.0}) {
            EXPECT_NEAR(*radius(step(a, 600), lit), std::sqrt(255 * lit * a * 600 / 16), 0.75);
            EXPECT_NEAR(*radius(stair(a), lit), std::sqrt(255 * lit * a * a / 16), 0.75);
        }
}

TEST(ReferenceRadius, GrowsWithTheArtifactForStairAndScaleFreeStep) {
    // Linear in a: twice the size, twice the radius, up to the pixel grid's share (1 px).
    for (const KernelShape shape : kShapes) {
        const auto radius = [&](const SilhouetteOptions& s) {
            return *referenceRadius({.silhouette = s, .kernel = shape},
                                    ReferenceCriterion::halfCode);
        };
        EXPECT_NEAR(radius(stair(20)), 2 * radius(stair(10)), 1.5);
        EXPECT_NEAR(radius(step(20, 160)), 2 * radius(step(10, 80)), 1.5);
    }
}

TEST(ReferenceRadius, SizesAreOrdered) {
    for (const KernelShape shape : kShapes)
        for (const double lit : {1.0, 0.5}) {
            const ReferenceOptions o{.silhouette = stair(8), .kernel = shape, .litLevel = lit};
            const auto half = referenceRadius(o, ReferenceCriterion::halfCode);
            const auto one = referenceRadius(o, ReferenceCriterion::oneCode);
            EXPECT_LE(*one, *half);
            const auto identical = referenceRadius(o, ReferenceCriterion::identical);
            EXPECT_GE(identical.value_or(o.maxRadiusPx), *one);
        }
}

TEST(ReferenceRadius, TheDiscWigglesSoTheFirstRadiusThatWorksIsNotTheAnswer) {
    ReferenceOptions o{.silhouette = stair(5), .maxRadiusPx = 60};
    int wiggles = 0;
    for (double r = 8; r < 30; r += kRadiusGridPx) {
        const double here = largestDifference(o, r), next = largestDifference(o, r + kRadiusGridPx);
        if (next <= here * (1 + 1e-6)) continue;
        ++wiggles;
        o.litLevel = 0.5 / (255 * (here + next) / 2);  // r works, the next radius does not
        if (o.litLevel > 1) continue;
        EXPECT_GT(*referenceRadius(o, ReferenceCriterion::halfCode), r + kRadiusGridPx);
    }
    EXPECT_GT(wiggles, 0);
}

TEST(ReferenceRadius, NothingToSeeNeedsNoFilter) {
    const ReferenceOptions dark{.silhouette = stair(10), .litLevel = 0};
    for (const auto criterion :
         {ReferenceCriterion::halfCode, ReferenceCriterion::oneCode, ReferenceCriterion::identical})
        EXPECT_EQ(referenceRadius(dark, criterion), 0);
}

TEST(ReferenceRadius, NotReachedWithinTheBoundIsNothing) {
    EXPECT_FALSE(referenceRadius({.silhouette = step(30, 600), .maxRadiusPx = 300},
                                 ReferenceCriterion::halfCode));
}

TEST(ReferenceRadius, RefusesBadInputByNameValueAndRule) {
    const auto refused = [](const ReferenceOptions& o, const char* sentence) {
        EXPECT_THAT([&] { referenceRadius(o, ReferenceCriterion::halfCode); },
                    ThrowsMessage<std::invalid_argument>(HasSubstr(sentence)));
    };
    refused({.litLevel = -1}, "lit level is -1: must be in [0, 1]");
    refused({.maxRadiusPx = std::nan("")}, "bound of the radius is nan px");
    refused({.maxRadiusPx = 0}, "bound of the radius is 0 px");
    refused({.windowPx = 0}, "window is 0 px");
    refused({.silhouette = {.artifactPx = 0}}, "artifact size is 0 px");
    refused({.silhouette = {.artifactPx = 0.01}}, "number of texels across the largest kernel");
    EXPECT_THROW(largestDifference({}, -1), std::invalid_argument);
}

// The proof's premise: the difference never changes faster than its bound, along each coordinate,
// by finite differences at random places, mostly near the kernel's ends where the disc bends most.
TEST(DifferenceBound, HoldsInEveryDirection) {
    std::mt19937_64 rng(11);
    const auto uniform = [&] { return static_cast<double>(rng() >> 11) * 0x1p-53; };
    double tightest = 0;
    for (const SilhouetteOptions& options :
         {stair(10), step(10, 600), step(10, 80),
          SilhouetteOptions{.pattern = Pattern::line, .artifactPx = 8, .angleDeg = 22.5},
          SilhouetteOptions{.pattern = Pattern::line, .artifactPx = 8, .angleDeg = 3}})
        for (const KernelShape shape : kShapes)
            for (int i = 0; i < 2000; ++i) {
                const Silhouette s(options);
                const double cosAngle = s.cosAngle(), sinAngle = s.sinAngle();
                const double r = options.artifactPx * (0.5 + 30 * uniform() * uniform());
                const double end = shape == KernelShape::gaussian ? 2 : 1.4;
                const double delta =
                    i % 2 ? (2 * uniform() - 1) * end
                          : (uniform() < 0.5 ? -1 : 1) * (1 + 0.1 * (uniform() - 0.5));
                const double along = (uniform() - 0.5) * 4 * s.texelWidth();
                const auto difference = [&](double place, double scaled, double radius) {
                    const double d = scaled * radius;
                    const double x = place * cosAngle - d * sinAngle;
                    const double y = s.intercept() + place * sinAngle + d * cosAngle;
                    const Kernel kernel{shape, radius};
                    return artifactVisibility(s, kernel, x, y) -
                           straightVisibility(s, kernel, x, y);
                };
                const double stepPx = 0.01, spread = stepPx / r;
                const auto bound = differenceBound(shape, delta, spread,
                                                   s.maxDeviationPx() * cosAngle / (r - stepPx),
                                                   cosAngle, sinAngle);
                const double here = difference(along, delta, r);
                const double largest = std::abs(here) + 2 * stepPx / r;
                const double changes[] = {std::abs(difference(along + stepPx, delta, r) - here),
                                          std::abs(difference(along, delta + spread, r) - here),
                                          std::abs(difference(along, delta, r + stepPx) - here)};
                const double bounds[] = {bound.along / r * stepPx, bound.across * spread,
                                         (bound.inRadius + 2 * largest) / (r - stepPx) * stepPx};
                for (int k = 0; k < 3; ++k) {
                    EXPECT_LE(changes[k], bounds[k] + 1e-12)
                        << k << " " << toText(shape) << " r " << r << " delta " << delta;
                    if (bounds[k] > 1e-6) tightest = std::max(tightest, changes[k] / bounds[k]);
                }
            }
    EXPECT_GT(tightest, 0.5);  // a bound that is always far away would prove little
}

}  // namespace
