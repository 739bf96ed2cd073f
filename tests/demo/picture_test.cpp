// SPDX-License-Identifier: MIT
#include "demo/picture.h"

#include <gtest/gtest.h>

#include <cmath>

#include "demo/spread.h"

namespace {

using renderer::ByteImage;
using renderer::FloatImage;

TEST(Spread, IsMedianAndQuartiles) {
    const demo::Spread spread = demo::spreadOf({5, 1, 4, 2, 3});
    EXPECT_EQ(spread.count, 5);
    EXPECT_EQ(spread.median, 3);
    EXPECT_EQ(spread.p25, 2);
    EXPECT_EQ(spread.p75, 4);
    EXPECT_EQ(spread.least, 1);
    EXPECT_EQ(demo::spreadOf({7}).median, 7);
    EXPECT_EQ(demo::spreadOf({1, 2}).median, 1.5);
    EXPECT_EQ(demo::spreadOf({}).count, 0);
}

TEST(Picture, AveragesInLight) {
    ByteImage image(2, 2, 3);
    for (int channel = 0; channel < 3; ++channel)
        image.at(0, 0, channel) = image.at(1, 1, channel) = 255;
    const ByteImage small = demo::averagedInLight(image, 2);
    ASSERT_EQ(small.width, 1);
    EXPECT_EQ(small.at(0, 0, 1), 188);  // half of the light is code 188
    EXPECT_EQ(demo::averagedInLight(image, 1).values, image.values);
    EXPECT_THROW(demo::averagedInLight(image, 3), std::invalid_argument);
    ByteImage flat(4, 4, 3);
    for (int code = 0; code < 256; ++code) {
        std::fill(flat.values.begin(), flat.values.end(), static_cast<std::uint8_t>(code));
        EXPECT_EQ(demo::averagedInLight(flat, 4).at(0, 0, 0), code);
    }
}

TEST(Picture, EnlargesAPartThatIsMovedInside) {
    ByteImage image(8, 6, 3);
    for (int y = 0; y < 6; ++y)
        for (int x = 0; x < 8; ++x) image.at(x, y, 0) = static_cast<std::uint8_t>(10 * y + x);
    const ByteImage part = demo::enlarged(image, {.x = 6, .y = -3, .width = 4, .height = 2}, 3);
    EXPECT_EQ(part.width, 12);
    EXPECT_EQ(part.height, 6);
    EXPECT_EQ(part.at(0, 0, 0), 4);
    EXPECT_EQ(part.at(11, 5, 0), 17);
}

TEST(Picture, FindsWhereImagesDiffer) {
    FloatImage reference(64, 48);
    FloatImage image = reference;
    for (int y = 30; y < 38; ++y)
        for (int x = 40; x < 52; ++x) image.at(x, y) = 1;
    const demo::Part part = demo::worstPart(image, reference, 16, 12);
    EXPECT_LE(part.x, 40);
    EXPECT_GE(part.x + part.width, 52);
    EXPECT_LE(part.y, 30);
    EXPECT_GE(part.y + part.height, 38);
    EXPECT_EQ(demo::worstPart(image, reference, 100, 100).width, 64);
}

TEST(Picture, DifferenceShowsItsSign) {
    FloatImage reference(3, 1);
    FloatImage image(3, 1);
    image.at(0, 0) = 0.5F;
    image.at(2, 0) = -0.5F;
    const ByteImage picture = demo::differencePicture(image, reference, 0.25);
    EXPECT_GT(picture.at(0, 0, 0), picture.at(0, 0, 2));  // leak: orange
    EXPECT_LT(picture.at(2, 0, 0), picture.at(2, 0, 2));  // too dark: blue
    for (int channel = 0; channel < 3; ++channel) EXPECT_EQ(picture.at(1, 0, channel), 255);
}

}  // namespace
