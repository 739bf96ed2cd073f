// SPDX-License-Identifier: MIT
#include "stimulus/display_code.h"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using namespace stimulus;

TEST(DisplayCode, EndsAreExact) {
    for (const Encoding encoding : {Encoding::srgb, Encoding::code}) {
        EXPECT_EQ(encode(0, encoding), 0);
        EXPECT_EQ(encode(1, encoding), 1);
        EXPECT_EQ(displayCode(0, 1, encoding), 0);
        EXPECT_EQ(displayCode(1, 1, encoding), 255);
        EXPECT_EQ(displayCode(1, 0.5, encoding), 128);  // 127.5, half up
        EXPECT_EQ(displayCode(1, 0, encoding), 0);
    }
}

TEST(DisplayCode, SrgbDecodesBackToLight) {
    // The standard's decoding, IEC 61966-2-1. Its rounded constants leave a gap of 3e-8 in the
    // curve.
    for (double v = 0; v <= 1; v += 1.0 / 4096) {
        const double e = encode(v, Encoding::srgb);
        const double light = e <= 0.04045 ? e / 12.92 : std::pow((e + 0.055) / 1.055, 2.4);
        EXPECT_NEAR(light, v, 1e-7);
    }
    EXPECT_EQ(displayCode(0.5, 1, Encoding::srgb), 188);  // middle light, the well-known code
    EXPECT_EQ(displayCode(0.5, 1, Encoding::code), 128);
}

TEST(DisplayCode, NeverFallsAsVisibilityOrLitLevelRises) {
    for (const Encoding encoding : {Encoding::srgb, Encoding::code}) {
        for (double lit = 0; lit <= 1; lit += 1.0 / 64)
            for (double v = 0; v < 1; v += 1.0 / 2048)
                ASSERT_LE(displayCode(v, lit, encoding),
                          displayCode(v + 1.0 / 2048, lit, encoding));
        for (double v = 0; v <= 1; v += 1.0 / 64)
            for (double lit = 0; lit < 1; lit += 1.0 / 512)
                ASSERT_LE(displayCode(v, lit, encoding), displayCode(v, lit + 1.0 / 512, encoding));
    }
}

TEST(DisplayCode, SlopeIsTheSteepestFromThereOn) {
    for (const Encoding encoding : {Encoding::srgb, Encoding::code})
        for (double v = 0; v < 0.999; v += 0.0007)
            for (const double step : {1e-6, 1e-3, 0.1}) {
                const double w = std::min(v + step, 1.0);
                // 1e-7: the gap in the standard's curve.
                EXPECT_LE(encode(w, encoding) - encode(v, encoding),
                          encodeSlope(v, encoding) * (w - v) + 1e-7);
            }
}

TEST(DisplayCode, RefusesALitLevelOutsideZeroToOne) {
    for (const double level : {-0.01, 1.01, std::nan("")})
        EXPECT_THROW(validateLitLevel(level), std::invalid_argument);
    EXPECT_NO_THROW(validateLitLevel(0));
    EXPECT_NO_THROW(validateLitLevel(1));
}

}  // namespace
