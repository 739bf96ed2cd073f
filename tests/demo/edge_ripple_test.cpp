// SPDX-License-Identifier: MIT
// A known ripple put along an edge comes out as that number; a straight edge through a map leaves
// what METHODS section 8 says of it.
#include "demo/edge_ripple.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/demo/flat_places.h"
#include "tests/renderer/exact_disc.h"

namespace {

using demo::edgeRipples;
using demo::summarised;
using renderer::FloatImage;
using tests::flatPlaces;
using tests::imageOf;

/// A straight edge at an angle to the texels, seen along the light: the map says of every texel
/// whether its centre is in shadow, and a disc is laid over it, in closed form.
struct StraightEdge {
    static constexpr int kPixelsPerTexel = 4;
    double degrees, radiusTexels, lengthTexels;

    int width() const { return static_cast<int>(lengthTexels) * kPixelsPerTexel; }
    double slope() const { return std::tan(degrees * std::numbers::pi / 180); }
    int height() const {
        return (4 + static_cast<int>(std::ceil(lengthTexels * slope()))) * kPixelsPerTexel;
    }
    /// Texels; the offset keeps ties of sample points and edge away.
    double edgeAt(double x) const { return 1.937 + slope() * x; }

    FloatImage truth() const {
        return imageOf(width(), height(), [&](int x, int y) {
            const double u = (x + 0.5) / kPixelsPerTexel;
            const double v = (y + 0.5) / kPixelsPerTexel;
            return tests::discProfile((v - edgeAt(u)) * std::cos(std::atan(slope())) /
                                      radiusTexels);
        });
    }
    FloatImage filteredMap() const {
        return imageOf(width(), height(), [&](int x, int y) {
            const double u = (x + 0.5) / kPixelsPerTexel;
            const double v = (y + 0.5) / kPixelsPerTexel;
            // Nobody looks at pixels away from the contour.
            if (std::abs(v - edgeAt(u)) > 2.0 / kPixelsPerTexel) return v > edgeAt(u) ? 1.0 : 0.0;
            double lit = 0;
            const auto texel = [](double at) { return static_cast<int>(std::floor(at)); };
            for (int column = texel(u - radiusTexels); column <= texel(u + radiusTexels); ++column)
                for (int row = texel(v - radiusTexels); row <= texel(v + radiusTexels); ++row)
                    if (row + 0.5 > edgeAt(column + 0.5))
                        lit += tests::exactCoverage(column + 0.5 - u, row + 0.5 - v, radiusTexels);
            return lit / (std::numbers::pi * radiusTexels * radiusTexels);
        });
    }
    /// Of the middle of the edge: at its ends there is less than a period.
    demo::EdgeRipple ripple() const {
        constexpr double kResolution = 1024;
        std::vector<float> ripples = edgeRipples(
            filteredMap(), truth(),
            flatPlaces(width(), height(), 1 / (kPixelsPerTexel * kResolution)), kResolution);
        const auto quarter = static_cast<std::ptrdiff_t>(ripples.size() / 4);
        return summarised({ripples.begin() + quarter, ripples.end() - quarter});
    }
};

TEST(EdgeRipple, OfAStraightEdgeUnderADiscIsWhatTheMethodsSay) {
    // The stair of whole texels is not quite periodic, which moves these by .003 (at 5.5 degrees
    // risers are 10 or 11 texels apart, at 3 degrees 19 or 20), and pixels are interpolated.
    for (const auto& [degrees, ripple] :
         {std::pair{1.0, 0.161}, {2.0, 0.140}, {3.0, 0.117}, {5.5, 0.072}}) {
        const StraightEdge edge{degrees, 3.47, 180};
        EXPECT_NEAR(edge.ripple().most, ripple, 0.004) << degrees << " degrees";
        EXPECT_NEAR(edge.ripple().p95, ripple, 0.008) << degrees << " degrees";
    }
}

TEST(EdgeRipple, OfAnEdgeAlmostAlongTheTexelsComesNearItsLimit) {
    // A single riser of a whole texel: 2 / (pi c), from which .2 degrees take a fifth of what 1
    // degree takes.
    constexpr double kC = 3.47;
    constexpr double kLimit = 2 / (std::numbers::pi * kC);
    const StraightEdge edge{0.2, kC, 300};
    EXPECT_NEAR(edge.ripple().most, kLimit - 0.2 * (kLimit - 0.161), 0.003);
}

TEST(EdgeRipple, FallsWithTheInverseOfTheRadius) {
    double last = 1;
    for (const double c : {1.0, 2.0, 3.47, 5.0, 8.0}) {
        const double ripple = StraightEdge{1, c, 180}.ripple().most;
        EXPECT_LT(ripple, last) << "r/a = " << c;
        EXPECT_LE(ripple, 2 / (std::numbers::pi * c) + 0.004) << "r/a = " << c;
        last = ripple;
    }
}

constexpr double kPixelUv = 1.0 / 512;

/// A wide horizontal edge: light grows by a hundredth a row, one half on row 40.3.
double ramp(double y) {
    return std::clamp(0.5 + (y - 40.3) / 100, 0.0, 1.0);
}

TEST(EdgeRipple, FindsAKnownWaveAlongAnEdge) {
    // 1.8 degrees: a period of 32 px of an edge with texels of one pixel.
    const double slope = 1.0 / 32;
    constexpr double kAmplitude = 0.04;
    const auto edge = [&](int x, int y) { return ramp(y - slope * x); };
    const FloatImage truth = imageOf(256, 80, edge);
    const FloatImage image = imageOf(256, 80, [&](int x, int y) {
        return edge(x, y) + kAmplitude * std::sin(2 * std::numbers::pi * x / 32);
    });
    std::vector<float> ripples = edgeRipples(image, truth, flatPlaces(256, 80, kPixelUv), 512);
    ASSERT_GT(ripples.size(), 200U);
    const auto found = summarised({ripples.begin() + 32, ripples.end() - 32});
    // Both extremes lie in every window of a whole period, to within a pixel of it.
    EXPECT_NEAR(found.most, 2 * kAmplitude, 1e-3);
    EXPECT_NEAR(found.p95, 2 * kAmplitude, 1e-3);
}

TEST(EdgeRipple, IsBlindToBiasAndToASlowChange) {
    const double slope = 1.0 / 8;
    const auto edge = [&](int x, int y) { return ramp(y - slope * x); };
    const FloatImage truth = imageOf(256, 80, edge);
    const FloatImage brighter = imageOf(256, 80, [&](int x, int y) { return edge(x, y) + 0.1; });
    const FloatImage places = flatPlaces(256, 80, kPixelUv);
    EXPECT_NEAR(summarised(edgeRipples(brighter, truth, places, 512)).most, 0, 1e-5);
    // .1 over 256 px is .0031 over a period of 8.
    const FloatImage slow =
        imageOf(256, 80, [&](int x, int y) { return edge(x, y) + 0.1 * x / 256; });
    EXPECT_NEAR(summarised(edgeRipples(slow, truth, places, 512)).most, 0.1 * 8 / 256, 1.5e-3);
}

TEST(EdgeRipple, ClosedContoursHaveNoEnds) {
    const auto disc = [](int x, int y) {
        return std::clamp(0.5 + (std::hypot(x - 50.2, y - 49.7) - 30) / 20, 0.0, 1.0);
    };
    const FloatImage truth = imageOf(100, 100, disc);
    const auto contours = demo::shadowContours(truth, flatPlaces(100, 100, kPixelUv));
    ASSERT_EQ(contours.size(), 1U);
    EXPECT_TRUE(contours[0].closed);
    // A circle of radius 30 px crosses each of about 60 rows and 60 columns twice.
    EXPECT_NEAR(static_cast<double>(contours[0].points.size()), 240, 8);
    for (const demo::ContourPoint& point : contours[0].points)
        EXPECT_NEAR(demo::valueAt(truth, point), 0.5, 1e-5);
}

TEST(EdgeRipple, ObjectsInFrontOfAShadowMakeNoContour) {
    // A pole before the picture: lit, at another place on the map.
    FloatImage places = flatPlaces(100, 80, kPixelUv);
    FloatImage truth = imageOf(100, 80, [](int, int y) { return ramp(y); });
    for (int y = 0; y < 80; ++y)
        for (int x = 40; x < 60; ++x) {
            places.at(x, y, demo::kPlaceU) += 0.3F;
            places.at(x, y, demo::kPlaceDepth) -= 0.3F;
            truth.at(x, y) = 1;
        }
    const auto contours = demo::shadowContours(truth, places);
    ASSERT_EQ(contours.size(), 2U);
    for (const demo::Contour& contour : contours)
        for (const demo::ContourPoint& point : contour.points) {
            const auto column = static_cast<int>(point.first % 100);
            EXPECT_TRUE(column < 40 || column >= 60) << column;
            EXPECT_EQ(static_cast<int>(point.first / 100), 40);
        }
}

TEST(EdgeRipple, SkyAndLightHaveNoContour) {
    FloatImage places = flatPlaces(20, 20, kPixelUv);
    const FloatImage lit = imageOf(20, 20, [](int, int) { return 1; });
    EXPECT_TRUE(demo::shadowContours(lit, places).empty());
    EXPECT_EQ(summarised({}).contourPixels, 0U);
    const FloatImage edge = imageOf(20, 20, [](int, int y) { return y < 10 ? 0.2 : 0.8; });
    EXPECT_EQ(demo::shadowContours(edge, places).size(), 1U);
    for (std::size_t i = demo::kPlaceIsSurface; i < places.values.size(); i += 4)
        places.values[i] = 0;
    EXPECT_TRUE(demo::shadowContours(edge, places).empty());
}

TEST(EdgeRipple, ANaNIsNotHidden) {
    const FloatImage truth = imageOf(60, 80, [](int, int y) { return ramp(y); });
    FloatImage broken = truth;
    for (int y = 0; y < 80; ++y) broken.at(30, y) = NAN;
    EXPECT_EQ(summarised(edgeRipples(broken, truth, flatPlaces(60, 80, kPixelUv), 512)).most,
              INFINITY);
}

TEST(EdgeRipple, RefusesWhatDoesNotFit) {
    const FloatImage image(20, 20);
    const FloatImage places = flatPlaces(20, 20, kPixelUv);
    EXPECT_THROW(edgeRipples(FloatImage(20, 21), image, places, 512), std::invalid_argument);
    EXPECT_THROW(edgeRipples(image, image, flatPlaces(21, 20, kPixelUv), 512),
                 std::invalid_argument);
    EXPECT_THROW(edgeRipples(image, image, places, 0), std::invalid_argument);
    EXPECT_THROW(edgeRipples(image, image, places, NAN), std::invalid_argument);
}

}  // namespace
