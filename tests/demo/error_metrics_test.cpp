// SPDX-License-Identifier: MIT
// A known error put into an image comes out as that number.
#include "demo/error_metrics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/demo/flat_places.h"

namespace {

using demo::compareVisibility;
using demo::VisibilityError;
using renderer::FloatImage;
using tests::imageOf;

/// Dark left of column 100, lit right of column 200, a ramp between them.
double ramp(double x) {
    return std::clamp((x - 100) / 100, 0.0, 1.0);
}

TEST(VisibilityError, OfAnImageAgainstItselfIsZero) {
    const FloatImage image = imageOf(300, 4, [](int x, int) { return ramp(x); });
    const VisibilityError error = compareVisibility(image, image);
    EXPECT_EQ(error.penumbraPixels, 99U * 4U);  // the ramp without its two ends
    EXPECT_EQ(error.rmse, 0);
    EXPECT_EQ(error.most, 0);
    EXPECT_EQ(error.bias, 0);
    EXPECT_EQ(error.shareBeyondLevel, 0);
}

TEST(VisibilityError, FindsABiasWithItsSign) {
    const FloatImage reference = imageOf(200, 10, [](int x, int) { return 0.2 + 0.003 * x; });
    for (const double bias : {0.03, -0.03}) {
        const FloatImage image =
            imageOf(200, 10, [&](int x, int) { return 0.2 + 0.003 * x + bias; });
        const VisibilityError error = compareVisibility(image, reference);
        EXPECT_NEAR(error.bias, bias, 1e-6);
        EXPECT_NEAR(error.rmse, 0.03, 1e-6);
        EXPECT_NEAR(error.most, 0.03, 1e-6);
        EXPECT_NEAR(error.p95, 0.03, 1e-6);
        EXPECT_EQ(error.shareBeyondLevel, 1);
        EXPECT_EQ(error.shareBeyond2Percent, 1);
        EXPECT_EQ(error.shareBeyond5Percent, 0);
    }
}

TEST(VisibilityError, FindsAShift) {
    // On a ramp of slope .01 a px, a shift by 2.5 px is a difference of .025.
    const FloatImage reference = imageOf(300, 4, [](int x, int) { return ramp(x); });
    const FloatImage image = imageOf(300, 4, [](int x, int) { return ramp(x - 2.5); });
    const VisibilityError error = compareVisibility(image, reference);
    EXPECT_NEAR(error.bias, -0.025, 0.001);  // both ends of the ramp take part
    EXPECT_NEAR(error.rmse, 0.025, 0.001);
    EXPECT_NEAR(error.most, 0.025, 1e-6);
    EXPECT_NEAR(error.p95, 0.025, 1e-6);
}

TEST(VisibilityError, FindsABlur) {
    // A box of width b takes a wave of wave number k down by sin(kb/2)/(kb/2): 1 - that, times
    // amplitude / sqrt 2.
    constexpr double kWave = 2 * std::numbers::pi / 40;
    constexpr double kBox = 12;
    const double kept = std::sin(kWave * kBox / 2) / (kWave * kBox / 2);
    const FloatImage reference =
        imageOf(400, 2, [](int x, int) { return 0.5 + 0.4 * std::sin(kWave * x); });
    const FloatImage image =
        imageOf(400, 2, [&](int x, int) { return 0.5 + 0.4 * kept * std::sin(kWave * x); });
    const VisibilityError error = compareVisibility(image, reference);
    EXPECT_NEAR(error.rmse, 0.4 * (1 - kept) / std::numbers::sqrt2, 1e-6);
    EXPECT_NEAR(error.most, 0.4 * (1 - kept), 1e-6);
    EXPECT_NEAR(error.bias, 0, 1e-7);
}

TEST(VisibilityError, CountsSharesAndThe95thPercentile) {
    // Of 100 pixels, 10 are off by .03 and 4 by .2.
    const FloatImage reference = imageOf(100, 1, [](int, int) { return 0.5; });
    const FloatImage image =
        imageOf(100, 1, [](int x, int) { return 0.5 + (x < 10 ? 0.03 : (x < 14 ? -0.2 : 0)); });
    const VisibilityError error = compareVisibility(image, reference);
    EXPECT_NEAR(error.shareBeyondLevel, 0.14, 1e-12);
    EXPECT_NEAR(error.shareBeyond2Percent, 0.14, 1e-12);
    EXPECT_NEAR(error.shareBeyond5Percent, 0.04, 1e-12);
    EXPECT_NEAR(error.p95, 0.03, 1e-6);
    EXPECT_NEAR(error.bias, (10 * 0.03 - 4 * 0.2) / 100, 1e-7);
}

TEST(VisibilityError, AShadowThatIsMissingAltogetherCounts) {
    const FloatImage reference = imageOf(100, 1, [](int x, int) { return x < 50 ? 0 : 1; });
    const FloatImage lit = imageOf(100, 1, [](int, int) { return 1; });
    const VisibilityError error = compareVisibility(lit, reference);
    EXPECT_EQ(error.penumbraPixels, 50U);
    EXPECT_EQ(error.rmse, 1);
    EXPECT_EQ(error.bias, 1);
}

TEST(VisibilityError, NoPenumbraIsNoErrorAndNaNIsNotHidden) {
    const FloatImage lit = imageOf(10, 10, [](int, int) { return 1; });
    EXPECT_EQ(compareVisibility(lit, lit).penumbraPixels, 0U);
    EXPECT_EQ(compareVisibility(lit, lit).rmse, 0);
    FloatImage broken = lit;
    broken.at(3, 3) = NAN;
    EXPECT_TRUE(std::isnan(compareVisibility(broken, lit).rmse));
    EXPECT_EQ(compareVisibility(broken, lit).most, INFINITY);
}

TEST(TemporalError, IsWhatChangesOtherwiseThanTheTruth) {
    const auto moved = [](double by, double bias = 0) {
        return imageOf(300, 4, [&](int x, int) { return ramp(x - by) + bias; });
    };
    // An image with a lasting error that moves as the truth does does not flicker.
    EXPECT_NEAR(demo::temporalError({moved(0, 0.03), moved(2, 0.03), moved(0), moved(2)}), 0, 1e-6);
    // A shift by 2 px too much is .02 on a ramp of slope .01.
    EXPECT_NEAR(demo::temporalError({moved(0), moved(4), moved(0), moved(2)}), 0.02, 1e-3);
    const FloatImage still = moved(0);
    EXPECT_EQ(demo::temporalError({still, still, still, still}), 0);
    const FloatImage lit = imageOf(300, 4, [](int, int) { return 1; });
    EXPECT_EQ(demo::temporalError({lit, lit, lit, lit}), 0);
    EXPECT_THROW(demo::temporalError({lit, FloatImage(2, 2), lit, lit}), std::invalid_argument);
}

TEST(StructuralSimilarity, Is1ForEqualImagesAndFallsWithNoise) {
    const FloatImage image = imageOf(64, 64, [](int x, int) { return ramp(5 * x); });
    EXPECT_NEAR(demo::structuralSimilarity(image, image), 1, 1e-6);
    double last = 1;
    for (const double amplitude : {0.01, 0.05, 0.2}) {
        const double similarity = demo::structuralSimilarity(
            imageOf(64, 64,
                    [&](int x, int y) { return ramp(5 * x) + ((x + y) % 2 ? 1 : -1) * amplitude; }),
            image);
        EXPECT_LT(similarity, last);
        last = similarity;
    }
    EXPECT_THROW(demo::structuralSimilarity(image, FloatImage(64, 63)), std::invalid_argument);
}

TEST(VisibilityError, RefusesImagesOfDifferentSize) {
    EXPECT_THROW(compareVisibility(FloatImage(3, 4), FloatImage(4, 3)), std::invalid_argument);
}

}  // namespace
