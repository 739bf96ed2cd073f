// SPDX-License-Identifier: MIT
#include "stimulus/stimulus_image.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <tuple>
#include <vector>

namespace {

using namespace stimulus;
using testing::HasSubstr;
using testing::ThrowsMessage;

bool identical(const cv::Mat& a, const cv::Mat& b) {
    if (a.size() != b.size() || a.type() != b.type()) return false;
    for (int row = 0; row < a.rows; ++row)
        if (std::memcmp(a.ptr(row), b.ptr(row), a.elemSize() * static_cast<std::size_t>(a.cols)))
            return false;
    return true;
}

/// Centre of a pixel of an even or odd window, y up: the header's rule.
double xOf(int column, int window) {
    return column - window / 2 + 0.5;
}
double yOf(int row, int window) {
    return window - 1 - row - window / 2 + 0.5;
}

StimulusOptions options(const SilhouetteOptions& silhouette, const Kernel& kernel,
                        int window = 120) {
    return {.silhouette = silhouette, .kernel = kernel, .windowPx = window};
}

const std::vector<SilhouetteOptions> kSilhouettes{
    {.pattern = Pattern::stair, .artifactPx = 10},
    {.pattern = Pattern::stair, .artifactPx = 7},
    {.pattern = Pattern::stair, .artifactPx = 7.3},
    {.pattern = Pattern::step, .artifactPx = 10, .riserSpacingPx = 120},
    {.pattern = Pattern::step, .artifactPx = 6, .riserSpacingPx = 48},
    {.pattern = Pattern::step, .artifactPx = 6.5, .riserSpacingPx = 52},
    {.pattern = Pattern::line, .artifactPx = 8, .angleDeg = 22.5},
    {.pattern = Pattern::line, .artifactPx = 8, .angleDeg = 45},
    {.pattern = Pattern::line, .artifactPx = 3, .angleDeg = 1}};

TEST(StimulusImage, PixelsAreTheClosedFormToTheLastBit) {
    for (const SilhouetteOptions& silhouette : kSilhouettes)
        for (const KernelShape shape : {KernelShape::disc, KernelShape::box, KernelShape::gaussian})
            for (const double radius : {0.0, 3.25, 21.0, 90.0})
                for (const int window : {120, 121}) {
                    const Silhouette s(silhouette);
                    const Kernel kernel{shape, radius};
                    const auto stimulus = options(silhouette, kernel, window);
                    const cv::Mat artifact = artifactVisibilityImage(stimulus);
                    const cv::Mat straight = straightVisibilityImage(stimulus);
                    for (int row = 0; row < window; row += 7)
                        for (int column = 0; column < window; ++column) {
                            const double x = xOf(column, window), y = yOf(row, window);
                            ASSERT_EQ(artifact.at<double>(row, column),
                                      artifactVisibility(s, kernel, x, y))
                                << row << " " << column;
                            ASSERT_EQ(straight.at<double>(row, column),
                                      straightVisibility(s, kernel, x, y))
                                << row << " " << column;
                        }
                }
}

TEST(StimulusImage, CodesAreThoseOfTheVisibility) {
    for (const SilhouetteOptions& silhouette : kSilhouettes)
        for (const Encoding encoding : {Encoding::srgb, Encoding::code})
            for (const double lit : {1.0, 0.5}) {
                auto stimulus = options(silhouette, {KernelShape::disc, 30});
                stimulus.encoding = encoding;
                stimulus.litLevel = lit;
                const cv::Mat codes = artifactImage(stimulus),
                              v = artifactVisibilityImage(stimulus);
                ASSERT_EQ(codes.type(), CV_8UC1);
                for (int row = 0; row < codes.rows; ++row)
                    for (int column = 0; column < codes.cols; ++column)
                        ASSERT_EQ(codes.at<std::uint8_t>(row, column),
                                  displayCode(v.at<double>(row, column), lit, encoding));
            }
}

TEST(StimulusImage, LitSideIsAboveAndTheEdgeIsInTheMiddle) {
    const auto stimulus = options(kSilhouettes[3], {KernelShape::disc, 12});
    for (const cv::Mat& image : {artifactImage(stimulus), straightImage(stimulus)}) {
        EXPECT_EQ(image.at<std::uint8_t>(0, 60), 255);
        EXPECT_EQ(image.at<std::uint8_t>(119, 60), 0);
    }
    const auto hard = artifactImage(options(kSilhouettes[3], {KernelShape::disc, 0}));
    // The step's riser lies between columns 59 and 60; shadow up to -5 on its left, +5 on its
    // right.
    for (int row = 0; row < 120; ++row) {
        EXPECT_EQ(hard.at<std::uint8_t>(row, 59), row < 65 ? 255 : 0);
        EXPECT_EQ(hard.at<std::uint8_t>(row, 60), row < 55 ? 255 : 0);
    }
}

TEST(StimulusImage, RovingMovesTurnsAndMirrorsTheSameValues) {
    for (const SilhouetteOptions& silhouette : kSilhouettes) {
        auto stimulus = options(silhouette, {KernelShape::disc, 17});
        const cv::Mat plain = artifactVisibilityImage(stimulus);
        for (int shift : {-5, 3})
            for (const bool mirror : {false, true})
                for (int turns = 0; turns < 4; ++turns) {
                    stimulus.roving = {.shiftPx = shift, .mirror = mirror, .quarterTurns = turns};
                    const cv::Mat roved = artifactVisibilityImage(stimulus);
                    for (int row = 10; row < 110; ++row)
                        for (int column = 0; column < 120; ++column) {
                            // Where the pixel of the plain image went, step by step.
                            int r = row - shift, c = mirror ? 119 - column : column;
                            for (int turn = 0; turn < turns; ++turn)
                                std::tie(r, c) = std::pair(119 - c, r);
                            ASSERT_EQ(roved.at<double>(r, c), plain.at<double>(row, column));
                        }
                }
    }
}

TEST(StimulusImage, StraightPanelTakesItsTilt) {
    auto stimulus = options(kSilhouettes[3], {KernelShape::disc, 12});
    stimulus.roving.straightTiltDeg = -2.5;
    const cv::Mat v = straightVisibilityImage(stimulus);
    const Silhouette tilted = Silhouette(stimulus.silhouette).withStraightEdgeAt(-2.5);
    for (int row = 0; row < 120; row += 3)
        for (int column = 0; column < 120; column += 3)
            ASSERT_EQ(v.at<double>(row, column),
                      straightVisibility(tilted, stimulus.kernel, xOf(column, 120), yOf(row, 120)));
    const cv::Mat artifact = artifactVisibilityImage(stimulus);
    stimulus.roving.straightTiltDeg.reset();
    EXPECT_TRUE(identical(artifact, artifactVisibilityImage(stimulus)));
    // No tilt at all is a level edge, not the default angle.
    stimulus.roving.straightTiltDeg = 0;
    const cv::Mat level = straightVisibilityImage(stimulus);
    EXPECT_TRUE(identical(level.col(0), level.col(119)));
}

TEST(StimulusImage, DitherKeepsTheMeanAndChangesNoFlatPart) {
    auto stimulus = options({.pattern = Pattern::stair, .artifactPx = 10}, {KernelShape::disc, 60});
    stimulus.encoding = Encoding::code;
    stimulus.dither = true;
    stimulus.seed = 7;
    const cv::Mat v = artifactVisibilityImage(stimulus), codes = artifactImage(stimulus);
    double sum = 0;
    int count = 0;
    for (int row = 0; row < codes.rows; ++row)
        for (int column = 0; column < codes.cols; ++column) {
            const double exact = 255 * v.at<double>(row, column);
            const double error = codes.at<std::uint8_t>(row, column) - exact;
            ASSERT_LT(std::abs(error), 1);
            sum += error;
            ++count;
        }
    // Each error has variance <= 1/4, so the mean's sd is <= .5 / 120: 5 sd, wrong once in a
    // million.
    EXPECT_NEAR(sum / count, 0, 5 * 0.5 / std::sqrt(count));
    EXPECT_TRUE(identical(codes, artifactImage(stimulus)));  // same seed, same image
    stimulus.seed = 8;
    EXPECT_FALSE(identical(codes, artifactImage(stimulus)));
}

TEST(StimulusImage, DitherMovesWithTheImage) {
    auto stimulus = options({.pattern = Pattern::stair, .artifactPx = 10}, {KernelShape::disc, 60});
    stimulus.dither = true;
    stimulus.seed = 7;
    cv::Mat turned;
    cv::rotate(artifactImage(stimulus), turned, cv::ROTATE_90_COUNTERCLOCKWISE);
    stimulus.roving.quarterTurns = 1;
    EXPECT_TRUE(identical(turned, artifactImage(stimulus)));
}

TEST(StimulusImage, SmallestWindowsWork) {
    for (const int window : {1, 2, 3}) {
        const auto stimulus = options(kSilhouettes[0], {KernelShape::disc, 30}, window);
        EXPECT_EQ(artifactImage(stimulus).rows, window);
        EXPECT_EQ(straightImage(stimulus).cols, window);
    }
}

void expectRefused(const StimulusOptions& stimulus, const char* sentence) {
    for (const auto image :
         {artifactImage, straightImage, artifactVisibilityImage, straightVisibilityImage})
        EXPECT_THAT([&] { image(stimulus); },
                    ThrowsMessage<std::invalid_argument>(HasSubstr(sentence)));
}

TEST(StimulusImage, RefusesBadInputByNameValueAndRule) {
    const StimulusOptions good;
    auto bad = good;
    bad.windowPx = 0;
    expectRefused(bad, "window is 0 px: must be in 1..8192");
    bad.windowPx = -600;
    expectRefused(bad, "window is -600 px");
    bad = good;
    bad.kernel.radiusPx = std::nan("");
    expectRefused(bad, "filter radius is nan px");
    bad = good;
    bad.litLevel = 1.5;
    expectRefused(bad, "lit level is 1.5: must be in [0, 1]");
    bad = good;
    bad.silhouette.artifactPx = 0;
    expectRefused(bad, "artifact size is 0 px");
    bad = good;
    bad.roving.quarterTurns = 4;
    expectRefused(bad, "number of quarter turns is 4");
    bad = good;
    bad.roving.shiftPx = 1000;
    expectRefused(bad, "shift is 1000 px");
    bad = good;
    bad.silhouette.artifactPx = 1e-3;
    expectRefused(bad, "number of texels across the kernel is 200000");
    bad = good;
    bad.roving.straightTiltDeg = 60;
    EXPECT_THROW(straightImage(bad), std::invalid_argument);
}

}  // namespace
