// SPDX-License-Identifier: MIT
#include "stimulus/tap_kernel.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "stimulus/filtered_edge.h"
#include "stimulus/stimulus_image.h"

namespace stimulus {
namespace {

TEST(TapKernel, HasOneTextAndReadsNoOther) {
    for (int taps = 1; taps <= kMostTaps; ++taps) {
        for (const TapTurn turn : {TapTurn::perPixel, TapTurn::perImage}) {
            const TapKernel kernel{.taps = taps, .turn = turn};
            EXPECT_EQ(tapKernelFromText(toText(kernel)), kernel);
        }
    }
    for (const char* text :
         {"", "disc", "poisson", "poisson0", "poisson016", "poisson257", "poisson-1", "poisson16-",
          "poisson16-moving", "poisson 16", "poisson16.5", "Poisson16", "poisson99999999999"}) {
        EXPECT_FALSE(tapKernelFromText(text)) << text;
    }
}

TEST(PoissonTaps, FillRingsOfEqualAreaAndKeepApart) {
    for (const int n : {1, 2, 9, 16, 64, 256}) {
        const std::vector<Point> taps = poissonTaps(n);
        ASSERT_EQ(taps.size(), static_cast<std::size_t>(n));
        double nearest = 4;
        for (std::size_t i = 0; i < taps.size(); ++i) {
            EXPECT_NEAR(std::hypot(taps[i].x, taps[i].y),
                        std::sqrt((static_cast<double>(i) + 0.5) / n), 1e-12);
            for (std::size_t j = 0; j < i; ++j)
                nearest =
                    std::min(nearest, std::hypot(taps[i].x - taps[j].x, taps[i].y - taps[j].y));
        }
        // Points thrown blindly come as near as about 1 / n; a hexagonal grid keeps 1.9 / sqrt(n).
        if (n > 1) {
            EXPECT_GT(nearest, 0.35 / std::sqrt(n)) << n;
        }
    }
    EXPECT_THROW(poissonTaps(0), std::invalid_argument);
    EXPECT_THROW(poissonTaps(kMostTaps + 1), std::invalid_argument);
}

TEST(SharpEdges, AreTheEdgesWithoutAFilter) {
    std::mt19937_64 rng(3);
    const auto uniform = [&] { return 200 * (static_cast<double>(rng() >> 11) * 0x1p-53 - 0.5); };
    for (const SilhouetteOptions& options :
         {SilhouetteOptions{.pattern = Pattern::stair, .artifactPx = 7},
          SilhouetteOptions{.pattern = Pattern::step, .artifactPx = 10, .riserSpacingPx = 200},
          SilhouetteOptions{.pattern = Pattern::line, .artifactPx = 5, .angleDeg = 22.5}}) {
        const Silhouette silhouette(options);
        const SharpEdges edges(silhouette, 100);
        const Kernel none{.radiusPx = 0};
        for (int i = 0; i < 20000; ++i) {
            const double x = uniform(), y = uniform();
            ASSERT_EQ(edges.artifact(x, y), artifactVisibility(silhouette, none, x, y));
            ASSERT_EQ(edges.straight(x, y), straightVisibility(silhouette, none, x, y));
        }
    }
}

StimulusOptions withTaps(int taps, TapTurn turn = TapTurn::perPixel) {
    StimulusOptions o;
    o.silhouette = {.pattern = Pattern::stair, .artifactPx = 8};
    o.kernel.radiusPx = 20;
    o.windowPx = 96;
    o.taps = TapKernel{.taps = taps, .turn = turn};
    o.seed = 5;
    return o;
}

bool same(const cv::Mat& a, const cv::Mat& b) {
    return cv::countNonZero(a != b) == 0;
}

TEST(TurnedTaps, AreMeansOfLightAndShadowAndTheSameForOneSeed) {
    for (const int taps : {1, 4, 16}) {
        const StimulusOptions o = withTaps(taps);
        const cv::Mat v = artifactVisibilityImage(o);
        for (int row = 0; row < v.rows; ++row)
            for (int c = 0; c < v.cols; ++c) {
                const double halves = 2 * taps * v.at<double>(row, c);
                ASSERT_EQ(halves, std::round(halves));
            }
        EXPECT_TRUE(same(v, artifactVisibilityImage(o)));
        StimulusOptions other = o;
        other.seed = 6;
        EXPECT_FALSE(same(v, artifactVisibilityImage(other)));
    }
}

// A pixel's variance is at most 1/4; pixels are turned independently. 5 sd, wrong once in 2
// million; the rings in place of the disc move the mean by less than 1 / n^2 of the band's own
// area.
TEST(SharpEdges, AreAlikeAroundAPointOnlyWhereNoEdgeIsNear) {
    std::mt19937_64 rng(5);
    std::uniform_real_distribution<double> place(-40, 40), radius(0.1, 30), unit(-1, 1);
    for (const Pattern pattern : {Pattern::stair, Pattern::step}) {
        const Silhouette silhouette(
            SilhouetteOptions{.pattern = pattern, .artifactPx = 7, .riserSpacingPx = 80});
        const SharpEdges edges(silhouette, 80);
        int alike = 0;
        for (int i = 0; i < 3000; ++i) {
            const double x = place(rng), y = place(rng), r = radius(rng);
            const auto artifact = edges.artifactAround(x, y, r);
            const auto straight = edges.straightAround(x, y, r);
            alike += artifact && straight ? 1 : 0;
            for (int k = 0; k < 30; ++k) {
                const Point turn = randomDirection(rng);
                const double share = std::abs(unit(rng)) * r;
                const double u = x + share * turn.x, v = y + share * turn.y;
                if (artifact) {
                    ASSERT_EQ(edges.artifact(u, v), *artifact);
                }
                if (straight) {
                    ASSERT_EQ(edges.straight(u, v), *straight);
                }
            }
        }
        EXPECT_GT(alike, 300);
    }
}

TEST(TurnedTaps, AreADiscInTheMean) {
    const StimulusOptions o = withTaps(16);
    StimulusOptions disc = o;
    disc.taps.reset();
    for (const auto image : {artifactVisibilityImage, straightVisibilityImage}) {
        const cv::Mat taps = image(o), exact = image(disc);
        double sum = 0;
        int count = 0;
        for (int row = 0; row < taps.rows; ++row)
            for (int c = 0; c < taps.cols; ++c) {
                const double v = exact.at<double>(row, c);
                ASSERT_NEAR(taps.at<double>(row, c), v, 0.5);
                if (v == 0 || v == 1) {
                    ASSERT_EQ(taps.at<double>(row, c), v);
                }
                if (v < 0.1 || v > 0.9) continue;
                sum += taps.at<double>(row, c) - v;
                ++count;
            }
        ASSERT_GT(count, 500);
        EXPECT_NEAR(sum / count, 0, 5 * 0.5 / std::sqrt(count) + 1.0 / 256);
    }
}

// Turned once, the taps of two pixels that see the same stair see the same light.
TEST(TurnedTaps, OncePerImageKeepThePatternsPeriod) {
    const cv::Mat v = artifactVisibilityImage(withTaps(16, TapTurn::perImage));
    int differing = 0;
    for (int row = 8; row < 96; ++row)
        for (int c = 0; c + 8 < 96; ++c)
            differing += v.at<double>(row, c) != v.at<double>(row - 8, c + 8) ? 1 : 0;
    EXPECT_EQ(differing, 0);
    const cv::Mat perPixel = artifactVisibilityImage(withTaps(16));
    EXPECT_FALSE(same(v, perPixel));
}

TEST(ImageNoise, HasTheDeviationAskedForAndHoldsCodesInRange) {
    StimulusOptions o = withTaps(16);
    o.taps.reset();
    o.kernel.radiusPx = 40;
    o.encoding = Encoding::code;
    o.noiseLevels = 6;
    const cv::Mat v = straightVisibilityImage(o), codes = straightImage(o);
    double sum = 0, squares = 0;
    int count = 0, atWhite = 0;
    for (int row = 0; row < v.rows; ++row)
        for (int c = 0; c < v.cols; ++c) {
            const double exact = 255 * v.at<double>(row, c);
            const double error = codes.at<std::uint8_t>(row, c) - exact;
            if (exact == 255) atWhite += error == 0 ? 1 : 0;
            if (exact < 40 || exact > 215) continue;
            sum += error;
            squares += error * error;
            ++count;
        }
    ASSERT_GT(count, 1000);
    EXPECT_GT(atWhite, 0);                          // half of the noise is cut off there
    const double sd = std::sqrt(6 * 6 + 1.0 / 12);  // and the rounding
    // Relative standard error of a deviation 1 / sqrt(2 n); 5 of each, wrong once in 2 million.
    EXPECT_NEAR(sum / count, 0, 5 * sd / std::sqrt(count));
    EXPECT_NEAR(std::sqrt(squares / count), sd, 5 * sd / std::sqrt(2.0 * count));
    EXPECT_TRUE(same(codes, straightImage(o)));
    EXPECT_FALSE(same(codes, artifactImage(o)));
}

TEST(ImageNoise, IsRefusedOutOfRange) {
    StimulusOptions o = withTaps(16);
    o.noiseLevels = -1;
    EXPECT_THROW(artifactImage(o), std::invalid_argument);
    o.noiseLevels = std::nan("");
    EXPECT_THROW(artifactImage(o), std::invalid_argument);
    o = withTaps(0);
    EXPECT_THROW(artifactImage(o), std::invalid_argument);
    o = withTaps(16);
    o.kernel.shape = KernelShape::box;
    EXPECT_THROW(artifactImage(o), std::invalid_argument);
}

}  // namespace
}  // namespace stimulus
