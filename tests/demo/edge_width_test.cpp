// SPDX-License-Identifier: MIT
// Edges of known width come out with that width.
#include "demo/edge_width.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/demo/flat_places.h"
#include "tests/renderer/exact_disc.h"

namespace {

using renderer::FloatImage;
using tests::flatPlaces;
using tests::imageOf;

constexpr int kEdge = 160;

/// Blurred by a disc of that radius, its normal turned by 30 degrees.
FloatImage edgeUnderDisc(double radiusPx) {
    const double angle = 0.5236;
    return imageOf(kEdge, kEdge, [&](int x, int y) {
        return tests::discProfile(((x - 80) * std::sin(angle) + (y - 80) * std::cos(angle)) /
                                  radiusPx);
    });
}

TEST(EdgeWidth, OfADiscIsItsOwn) {
    const FloatImage places = flatPlaces(kEdge, kEdge, 1.0 / 512);
    const FloatImage truth = edgeUnderDisc(20);
    // Bilinear reading between pixels rounds the profile off by a hundredth of a pixel.
    for (const double radius : {10.0, 20.0, 30.0}) {
        const demo::EdgeWidth width = demo::edgeWidth(edgeUnderDisc(radius), truth, places);
        ASSERT_GT(width.places, 50U);
        EXPECT_NEAR(width.widthPx, radius * tests::discProfileWidth(), 0.05);
        EXPECT_NEAR(width.truthWidthPx, 20 * tests::discProfileWidth(), 0.05);
        EXPECT_NEAR(width.ratio, radius / 20, 0.01);
    }
}

TEST(EdgeWidth, LeavesOutEdgesThatAreNotWhole) {
    // A shadow that goes down to .3 alone.
    const FloatImage faint = imageOf(
        kEdge, kEdge, [](int x, int) { return 1 - 0.7 * std::exp(-std::pow((x - 80) / 20.0, 2)); });
    const FloatImage places = flatPlaces(kEdge, kEdge, 1.0 / 512);
    EXPECT_EQ(demo::edgeWidth(faint, faint, places).places, 0U);
    EXPECT_EQ(demo::edgeWidth(faint, faint, places).ratio, 0);
    EXPECT_THROW(demo::edgeWidth(FloatImage(3, 3), faint, places), std::invalid_argument);
}

}  // namespace
