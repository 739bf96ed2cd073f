// SPDX-License-Identifier: MIT
#include "demo/thin_detail.h"

#include <gtest/gtest.h>

#include "tests/demo/flat_places.h"

namespace {

using renderer::FloatImage;
using tests::flatPlaces;
using tests::imageOf;

constexpr int kMap = 256, kView = 128;
constexpr double kRadiusUv = 8.0 / kMap;

/// A wire of 4 texels at the left, a wall of 64 at the right, halfway to the ground at depth .5.
FloatImage wireAndWall() {
    return imageOf(kMap, kMap, [](int x, int) {
        return (x >= 60 && x < 64) || (x >= 160 && x < 224) ? 0.25 : 0.5;
    });
}

TEST(ThinDetail, FindsTheWireAndNotTheWall) {
    const auto thin =
        demo::behindThinCasters(wireAndWall(), flatPlaces(kView, kView, 1.0 / kView), kRadiusUv);
    // Texels 52 to 71, that is pixels 26 to 35, have the wire under the kernel.
    for (int x = 0; x < kView; ++x)
        EXPECT_EQ(thin[static_cast<std::size_t>(64 * kView + x)], x >= 26 && x < 36) << x;
}

TEST(ThinDetail, CastersBehindAReceiverDoNotShadeIt) {
    FloatImage places = flatPlaces(kView, kView, 1.0 / kView);
    for (std::size_t i = demo::kPlaceDepth; i < places.values.size(); i += 4)
        places.values[i] = 0.2F;
    const auto thin = demo::behindThinCasters(wireAndWall(), places, kRadiusUv);
    EXPECT_EQ(std::count(thin.begin(), thin.end(), true), 0);
}

TEST(ThinDetail, SaysWhichShareOfTheShadowIsLost) {
    const std::vector<bool> thin = {true, true, false, true};
    FloatImage truth(4, 1), image(4, 1);
    truth.values = {0.4F, 0.6F, 0, 1};
    image.values = {0.7F, 0.8F, 1, 1};  // half of it; the third pixel is not asked
    const demo::ThinDetail detail = demo::thinDetail(image, truth, thin);
    EXPECT_EQ(detail.pixels, 3U);
    EXPECT_NEAR(detail.lost, 0.5, 1e-6);
    EXPECT_NEAR(detail.rmse, std::sqrt((0.09 + 0.04) / 3), 1e-6);
    EXPECT_EQ(demo::thinDetail(image, truth, {false, false, false, false}).pixels, 0U);
    EXPECT_THROW(demo::thinDetail(image, truth, {true}), std::invalid_argument);
}

}  // namespace
