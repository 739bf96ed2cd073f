// SPDX-License-Identifier: MIT
// The full-disc filter on maps that the tests make up, against closed forms. No GPU.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/renderer/exact_disc.h"
#include "tests/renderer/technique_case.h"

namespace {

using renderer::Technique;
using tests::exactly;
using tests::halfPlane;
using tests::Random;
using tests::receiverAt;
using Map = tests::DepthMap;

constexpr double kPi = std::numbers::pi;

const Technique& disc() {
    return renderer::findTechnique("pcf_disc");
}

double evaluate(const Technique& technique, const Map& map,
                const renderer::f64::ShadowReceiver& receiver, double radiusUv) {
    return exactly(technique, map, radiusUv)(receiver);
}

TEST(PcfDisc, IsCutAtTheMapsEdge) {
    const Map solid(8, [](double, double) { return 0.0; });
    // Half of the disc hangs over the edge.
    EXPECT_NEAR(evaluate(disc(), solid, receiverAt(0.0, 0.5, 0.5), 0.3), 0.5, 0.001);
    // The disc covers the whole map.
    const double map = 1.0 / (kPi * 0.9 * 0.9);
    EXPECT_NEAR(evaluate(disc(), solid, receiverAt(0.5, 0.5, 0.5), 0.9), 1 - map, 0.001);
}

TEST(PcfDisc, IsTheConvolutionOfNearestTexelVisibilityWithTheDisc) {
    Random random(21);
    for (int trial = 0; trial < 400; ++trial) {
        const int n = static_cast<int>(random(1, 40));
        const Map map(n, [&](double, double) { return random() < 0.5 ? 0.2 : 0.8; });
        const double u = random(-0.1, 1.1);
        const double v = random(-0.1, 1.1);
        const double radiusTexels = std::exp(random(std::log(0.05), std::log(20)));
        const double radius = std::min(radiusTexels / n, 1.0);
        double occluded = 0;
        for (int j = 0; j < n; ++j)
            for (int i = 0; i < n; ++i)
                if (map.view().at(i, j) < 0.5F)
                    occluded += tests::exactCoverage(i + 0.5 - u * n, j + 0.5 - v * n, radius * n);
        const double truth = 1 - occluded / (kPi * radius * radius * n * n);
        // The kernel's bound (disc_kernel_test.cpp), for a map that is not a half-plane.
        const double tolerance = radius * n < 3.47 ? 0.006 : 0.0015;
        EXPECT_NEAR(evaluate(disc(), map, receiverAt(u, v, 0.5), radius), truth, tolerance)
            << "N " << n << " radius " << radius * n << " texels";
    }
}

TEST(PcfDisc, RadiusZeroIsTheHardShadow) {
    Random random(2);
    const Map map(9, [&](double, double) { return random(); });
    for (int i = 0; i < 500; ++i) {
        const auto receiver = receiverAt(random(), random(), random());
        EXPECT_EQ(evaluate(disc(), map, receiver, 0),
                  evaluate(renderer::findTechnique("hard"), map, receiver, 0));
    }
}

/// max - min of V along the edge's 0.5 contour.
double edgeRipple(int n, double angleDeg, double radiusTexels, double phase) {
    const Map map = halfPlane(n, angleDeg, phase);
    const double s = std::sin(angleDeg * kPi / 180);
    const double c = std::cos(angleDeg * kPi / 180);
    const double period = 1 / s;  // of the risers, in texels along the contour
    double low = 1;
    double high = 0;
    for (double t = -0.5 * period; t < 0.5 * period; t += period / 256) {
        const double u = 0.5 + (t * c - phase * s) / n;
        const double v = 0.5 + (t * s + phase * c) / n;
        const double value = evaluate(disc(), map, receiverAt(u, v, 0.5), radiusTexels / n);
        low = std::min(low, value);
        high = std::max(high, value);
    }
    return high - low;
}

// METHODS section 8 tabulates the ripple of a straight edge at r = 3.47 a, with the limit 2 / (pi
// c).
TEST(PcfDisc, EdgeRippleAtTheStudysSlopeIsWhatTheMethodsSheetStates) {
    const double limit = 2 / (kPi * 3.47);
    for (const auto& [angle, stated] :
         {std::pair{1.0, .161}, {2.0, .140}, {3.0, .117}, {5.5, .072}}) {
        double worst = 0;
        for (const double phase : {0.13, 0.29, 0.41})  // not 0, where texel centres lie on the edge
            worst = std::max(worst, edgeRipple(256, angle, 3.47, phase));
        EXPECT_NEAR(worst, stated, 0.002) << angle;
        EXPECT_LT(worst, limit) << angle;
    }
}

// The staircase leaves at most half a ripple, 1 / (pi r / a), beside the profile.
TEST(PcfDisc, ProfileOfAStraightEdgeIsTheDiscsAtEveryN) {
    constexpr double kRadius = 0.05;
    for (const int n : {64, 128, 256, 512})
        for (const double angle : {7.0, 22.5, 37.0}) {
            const Map map = halfPlane(n, angle, 0.2);
            const double s = std::sin(angle * kPi / 180);
            const double c = std::cos(angle * kPi / 180);
            for (double x = -1.2; x <= 1.2; x += 0.05) {
                const double distance = x * kRadius + 0.2 / n;
                const double v = evaluate(
                    disc(), map, receiverAt(0.5 - s * distance, 0.5 + c * distance, 0.5), kRadius);
                EXPECT_NEAR(v, tests::discProfile(x), 1.05 / (kPi * kRadius * n))
                    << "N " << n << " angle " << angle;
            }
        }
}

}  // namespace
