// SPDX-License-Identifier: MIT
#include "stimulus/silhouette.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

namespace {

using namespace stimulus;
using testing::HasSubstr;
using testing::ThrowsMessage;

SilhouetteOptions line(double angleDeg, double artifactPx = 10) {
    return {.pattern = Pattern::line, .artifactPx = artifactPx, .angleDeg = angleDeg};
}

double angleOfSlope(double slope) {
    return std::atan(slope) * 180 / std::numbers::pi;
}

/// Mean of (artifact - true silhouette) over the texel columns from `first`, px: zero when the line
/// bisects the steps.
double meanOffset(const Silhouette& s, int first, int count) {
    double sum = 0;
    for (int k = first; k < first + count; ++k) {
        const double middle = (s.riser(k) + s.riser(k + 1)) / 2;
        sum += s.height(k) - (s.rise() / s.run() * middle + s.intercept());
    }
    return sum / count;
}

TEST(Silhouette, StairIsTheDefinition) {
    const Silhouette s({.pattern = Pattern::stair, .artifactPx = 7});
    for (int i = -5; i < 5; ++i) {
        EXPECT_EQ(s.riser(i), 7 * i);
        EXPECT_EQ(s.height(i), 7 * i + 0.25);
        EXPECT_EQ(s.texelAt(7 * i), i);
        EXPECT_EQ(s.texelAt(7 * i + 6.5), i);
    }
    EXPECT_EQ(s.angleDeg(), 45);
    EXPECT_EQ(s.distance(10, 10 - 3.5 + 0.25), 0);
    EXPECT_GT(s.distance(0, 5), 0);
}

TEST(Silhouette, StepHasOneRiserInTheWindow) {
    const Silhouette s({.pattern = Pattern::step, .artifactPx = 10, .riserSpacingPx = 600});
    EXPECT_EQ(s.height(s.texelAt(-0.5)), -5 + 0.25);
    EXPECT_EQ(s.height(s.texelAt(-299.5)), -5 + 0.25);
    EXPECT_EQ(s.height(s.texelAt(0.5)), 5 + 0.25);
    EXPECT_EQ(s.height(s.texelAt(299.5)), 5 + 0.25);
    EXPECT_NEAR(s.angleDeg(), angleOfSlope(10.0 / 600), 1e-12);
    EXPECT_EQ(trueAngleDeg({.pattern = Pattern::step, .artifactPx = 10}), s.angleDeg());
}

TEST(Silhouette, LineBisectsItsStepsAtEverySlope) {
    // Fractions p/q of all three kinds of parity, over whole periods of q columns on either side.
    for (int q = 1; q <= 13; ++q)
        for (int p = 1; p <= q; ++p) {
            if (std::gcd(p, q) != 1) continue;
            const Silhouette s(line(angleOfSlope(static_cast<double>(p) / q)));
            EXPECT_NEAR(meanOffset(s, 0, 3 * q), 0, 1e-9) << p << "/" << q;
            EXPECT_NEAR(meanOffset(s, -5 * q, 2 * q), 0, 1e-9) << p << "/" << q;
        }
}

TEST(Silhouette, AnglesWithThreeDecimalsCountAsTheirFraction) {
    // atan(1/3) = 18.43495: without the shift every third column would be off by a/6 = 1.7 px on
    // the average, upwards on one side of the window and downwards on the other.
    const Silhouette s(line(18.435));
    EXPECT_NEAR(meanOffset(s, 0, 60), 0, 0.01);
    EXPECT_NEAR(meanOffset(s, -60, 60), 0, 0.01);
}

TEST(Silhouette, LineAt45IsTheStair) {
    const Silhouette diagonal(line(45)), stair({.pattern = Pattern::stair, .artifactPx = 10});
    for (int k = -100; k <= 100; ++k) EXPECT_EQ(diagonal.height(k), stair.height(k));
    EXPECT_EQ(diagonal.distance(3.5, 8.5), stair.distance(3.5, 8.5));
}

TEST(Silhouette, LineOfSlopeOneEighthIsTheStepWithRisersEveryEightTexels) {
    const Silhouette s(line(angleOfSlope(1.0 / 8)));
    const Silhouette step({.pattern = Pattern::step, .artifactPx = 10, .riserSpacingPx = 80});
    for (double x = -399.5; x < 400; x += 1)  // the step's riser is 4 texels and half a height away
        EXPECT_EQ(s.height(s.texelAt(x + 40)), step.height(step.texelAt(x)) + 5) << x;
}

TEST(Silhouette, ArtifactStaysWithinItsStatedDeviation) {
    for (const SilhouetteOptions& options :
         {line(1), line(7.3), line(22.5), line(40.5), line(45), line(33, 3.7),
          SilhouetteOptions{.pattern = Pattern::stair, .artifactPx = 4.5},
          SilhouetteOptions{.pattern = Pattern::step, .artifactPx = 30, .riserSpacingPx = 240}}) {
        const Silhouette s(options);
        for (double x = -400.03; x < 400; x += 0.37) {
            const double straight = s.rise() / s.run() * x + s.intercept();
            EXPECT_LE(std::abs(s.height(s.texelAt(x)) - straight), s.maxDeviationPx() + 1e-9);
        }
    }
}

TEST(Silhouette, PeriodsAreThoseOfThePattern) {
    const auto stair = Silhouette({.pattern = Pattern::stair, .artifactPx = 10});
    EXPECT_EQ(stair.artifactPeriod()->dx, 10);
    EXPECT_EQ(stair.artifactPeriod()->dy, 10);
    EXPECT_EQ(stair.straightPeriod()->dx, 1);
    const auto step =
        Silhouette({.pattern = Pattern::step, .artifactPx = 10, .riserSpacingPx = 600});
    EXPECT_EQ(step.artifactPeriod()->dx, 600);
    EXPECT_EQ(step.artifactPeriod()->dy, 10);
    EXPECT_EQ(step.straightPeriod()->dx, 60);
    EXPECT_EQ(step.straightPeriod()->dy, 1);
    const auto half = Silhouette({.pattern = Pattern::stair, .artifactPx = 10.5});
    EXPECT_EQ(half.artifactPeriod()->dx, 21);
    EXPECT_EQ(half.artifactPeriod()->dy, 21);
    EXPECT_FALSE(Silhouette({.pattern = Pattern::stair, .artifactPx = 10.3}).artifactPeriod());
    EXPECT_FALSE(Silhouette({.artifactPx = 10, .verticalPhasePx = 0.1}).artifactPeriod());
    EXPECT_FALSE(Silhouette(line(22.5)).artifactPeriod());
    EXPECT_FALSE(Silhouette(line(22.5)).straightPeriod());
}

TEST(Silhouette, StraightEdgeCanBeTurned) {
    const Silhouette s({.pattern = Pattern::step, .artifactPx = 10});
    const Silhouette turned = s.withStraightEdgeAt(-0.5);
    EXPECT_NEAR(turned.angleDeg(), -0.5, 1e-12);
    EXPECT_NEAR(turned.distance(0, 0.25), 0, 1e-12);
    EXPECT_GT(turned.distance(-100, 0), s.distance(-100, 0) - 3);
    EXPECT_EQ(turned.height(3), s.height(3));
    EXPECT_THROW(s.withStraightEdgeAt(45), std::invalid_argument);
    EXPECT_THROW(s.withStraightEdgeAt(std::nan("")), std::invalid_argument);
}

void expectRefused(const SilhouetteOptions& options, const char* sentence) {
    EXPECT_THAT([&] { Silhouette s(options); },
                ThrowsMessage<std::invalid_argument>(HasSubstr(sentence)));
}

TEST(Silhouette, RefusesBadInputByNameValueAndRule) {
    const double nan = std::nan(""), infinite = std::numeric_limits<double>::infinity();
    expectRefused({.artifactPx = 0}, "artifact size is 0 px: must be in (0, 65536]");
    expectRefused({.artifactPx = -3}, "artifact size is -3 px");
    expectRefused({.artifactPx = nan}, "artifact size is nan px");
    expectRefused({.artifactPx = infinite}, "artifact size is inf px");
    expectRefused(line(0), "angle of the line is 0 degrees: must be in (0, 45]");
    expectRefused(line(45.1), "angle of the line is 45.1 degrees");
    expectRefused(line(-5), "angle of the line is -5 degrees");
    expectRefused(line(nan), "angle of the line is nan degrees");
    expectRefused({.pattern = Pattern::step, .artifactPx = 10, .riserSpacingPx = 5},
                  "riser spacing is 5 px: must be at least the artifact size");
    expectRefused({.pattern = Pattern::step, .riserSpacingPx = nan}, "riser spacing is nan px");
    expectRefused({.verticalPhasePx = nan}, "vertical phase is nan px");
    expectRefused({.verticalPhasePx = 11}, "vertical phase is 11 px: must be in [-1, 1]");
}

}  // namespace
