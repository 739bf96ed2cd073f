// SPDX-License-Identifier: MIT
#include "stimulus/kernel.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "numerical_convolution.h"
#include "stimulus/silhouette.h"

namespace {

using namespace stimulus;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr std::array kShapes{KernelShape::disc, KernelShape::box, KernelShape::gaussian};

// Grid that has the middle, the ends, both sides of them and places between.
const std::vector<double> kPlaces{-5,  -4.1, -1.3, -1,  -0.999, -0.8, -0.6, -0.25, -1e-9,
                                  0.0, 1e-9, 0.3,  0.6, 0.8,    0.97, 1,    1.7,   5};

TEST(Kernel, QuadrantAgreesWithNumericalIntegration) {
    for (const KernelShape shape : kShapes)
        for (const double u : kPlaces)
            for (const double v : kPlaces)
                // 1e-9: what the numerical integration itself reaches.
                EXPECT_NEAR(quadrant(shape, u, v), numerical::quadrantMass(shape, u, v), 1e-9)
                    << toText(shape) << " " << u << " " << v;
}

TEST(Kernel, IntegratesToOne) {
    for (const KernelShape shape : kShapes) {
        EXPECT_EQ(marginal(shape, 9), 1);
        EXPECT_EQ(quadrant(shape, 9, 9), 1);
        EXPECT_NEAR(numerical::quadrantMass(shape, 9, 9), 1, 1e-12);
        EXPECT_EQ(halfPlane(shape, 9, 0.6, 0.8), 1);
        EXPECT_NEAR(marginal(shape, -9), 0, 1e-70);
    }
}

TEST(Kernel, FourQuadrantsOfAPointAddUpToTheWhole) {
    for (const KernelShape shape : kShapes)
        for (const double u : kPlaces)
            for (const double v : kPlaces) {
                const double four = quadrant(shape, u, v) + quadrant(shape, -u, v) +
                                    quadrant(shape, u, -v) + quadrant(shape, -u, -v);
                EXPECT_NEAR(four, 1, 1e-14) << toText(shape) << " " << u << " " << v;
            }
}

TEST(Kernel, HalfPlaneAlongTheAxesIsTheMarginal) {
    for (const KernelShape shape : kShapes)
        for (const double d : kPlaces) {
            EXPECT_NEAR(halfPlane(shape, d, 1, 0), marginal(shape, d), 1e-15);
            EXPECT_NEAR(halfPlane(shape, d, 0, 1), marginal(shape, d), 1e-15);
        }
}

TEST(Kernel, HalfPlaneOfTheBoxIsTheFourTermFormula) {
    const auto f = [](double s) { return std::max(s, 0.0) * std::max(s, 0.0) / 2; };
    for (const double degrees : {0.5, 3.0, 20.0, 45.0, 70.0})
        for (const double d : kPlaces) {
            const double p = std::sin(degrees * std::numbers::pi / 180);
            const double q = std::cos(degrees * std::numbers::pi / 180);
            const double formula =
                (f(d + p + q) - f(d + q - p) - f(d - q + p) + f(d - p - q)) / (4 * p * q);
            // The formula itself loses up to 1e-16 d^2 / (4 p q) to cancellation: 1e-13 here.
            EXPECT_NEAR(halfPlane(KernelShape::box, d, q, p), formula, 1e-12)
                << degrees << " " << d;
        }
}

TEST(Kernel, HalfPlaneOfTheBoxStaysExactAsTheEdgeBecomesLevel) {
    for (const double angle : {1e-3, 1e-6, 1e-9, 1e-15, 1e-200, 0.0})
        for (const double d : {-0.9, -0.2, 0.0, 0.5, 0.9})
            EXPECT_NEAR(halfPlane(KernelShape::box, d, std::cos(angle), std::sin(angle)),
                        (d + 1) / 2, angle * angle + 1e-15);
}

TEST(Kernel, MassesRiseWithEveryArgument) {
    for (const KernelShape shape : kShapes)
        for (const double v : kPlaces)
            for (double u = -5; u < 5; u += 0.01) {
                EXPECT_LE(quadrant(shape, u, v), quadrant(shape, u + 0.01, v) + 1e-15);
                EXPECT_LE(quadrant(shape, v, u), quadrant(shape, v, u + 0.01) + 1e-15);
            }
}

TEST(Kernel, NamesAreReadBack) {
    for (const KernelShape shape : kShapes) EXPECT_EQ(kernelShapeFromText(toText(shape)), shape);
    EXPECT_FALSE(kernelShapeFromText("tent"));
    EXPECT_FALSE(kernelShapeFromText(""));
}

TEST(Kernel, RefusesARadiusThatIsNoLength) {
    for (const double radius : {-1.0, -1e-9, std::nan(""), std::numeric_limits<double>::infinity(),
                                -std::numeric_limits<double>::infinity(), 65537.0})
        EXPECT_THAT(
            [&] {
                validate(Kernel{KernelShape::disc, radius});
            },
            ThrowsMessage<std::invalid_argument>(HasSubstr("filter radius is ")));
    EXPECT_NO_THROW(validate(Kernel{KernelShape::disc, 0}));
}

}  // namespace
