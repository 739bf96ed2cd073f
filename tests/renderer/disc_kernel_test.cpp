// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <random>

#include "renderer/shader_math.h"
#include "tests/renderer/exact_disc.h"

namespace {

using renderer::f32::discCoverage4;
using renderer::f64::discCoverage4;

constexpr double kPi = std::numbers::pi;

template <class Real>
double coverage(double x, double y, double radius) {
    using Real4 = glm::vec<4, Real>;
    return discCoverage4(Real4(static_cast<Real>(x)), Real4(static_cast<Real>(y)),
                         static_cast<Real>(radius))
        .x;
}

struct Errors {
    double texel = 0;      // of one weight
    double halfPlane = 0;  // of a half-plane under the whole kernel
    double total = 0;      // of the sum of the weights, relative
};

template <class Real>
Errors errorsAt(double radius) {
    std::mt19937_64 random(7);
    const auto uniform = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
    Errors worst;
    for (int trial = 0; trial < 200; ++trial) {
        const double cx = uniform();
        const double cy = uniform();
        const double angle = 2 * kPi * uniform();
        const double offset = radius * (2 * uniform() - 1);
        double half = 0;
        double halfExact = 0;
        double sum = 0;
        const int reach = static_cast<int>(radius) + 2;
        for (int j = -reach; j <= reach; ++j)
            for (int i = -reach; i <= reach; ++i) {
                const double x = i + 0.5 - cx;
                const double y = j + 0.5 - cy;
                const double weight = coverage<Real>(x, y, radius);
                const double exact = tests::exactCoverage(x, y, radius);
                worst.texel = std::max(worst.texel, std::abs(weight - exact));
                sum += weight;
                if (x * std::cos(angle) + y * std::sin(angle) > offset) continue;
                half += weight;
                halfExact += exact;
            }
        const double area = kPi * radius * radius;
        worst.halfPlane = std::max(worst.halfPlane, std::abs(half - halfExact) / area);
        worst.total = std::max(worst.total, std::abs(sum / area - 1));
    }
    return worst;
}

TEST(ExactDisc, AgreesWithCountedArea) {
    // 400 x 400 sample points in a texel: an edge crosses at most about 600 of the 160,000 cells.
    for (const double radius : {0.4, 1.3, 3.47})
        for (const auto& [x, y] : {std::pair{0.1, 0.2}, {1.1, -0.3}, {-2.2, 2.4}, {0.0, 3.3}}) {
            int inside = 0;
            for (int j = 0; j < 400; ++j)
                for (int i = 0; i < 400; ++i)
                    inside +=
                        std::hypot(x - 0.5 + (i + 0.5) / 400, y - 0.5 + (j + 0.5) / 400) < radius
                            ? 1
                            : 0;
            EXPECT_NEAR(tests::exactCoverage(x, y, radius), inside / 160000.0, 0.002);
        }
}

// The bounds that disc_kernel.glsl states. Half-plane: less than a sixth of an 8-bit level at the
// radius that the study's slope asks for, less than one level for any disc of half a texel or more.
TEST(DiscKernel, WeightsAreTheSharesThatTheDiscCovers) {
    for (const double radius : {2.5, 3.47, 6.0, 14.0, 40.0}) {
        const Errors errors = errorsAt<double>(radius);
        EXPECT_LT(errors.texel, 0.012) << radius;
        EXPECT_LT(errors.halfPlane, radius < 3.47 ? 0.0012 : 0.0006) << radius;
        EXPECT_LT(errors.total, radius < 3.47 ? 0.0012 : 0.0006) << radius;
    }
    for (const double radius : {0.05, 0.25, 0.5, 1.0, 1.25, 1.5, 2.49}) {
        const Errors errors = errorsAt<double>(radius);
        EXPECT_LT(errors.texel, 0.012) << radius;
        EXPECT_LT(errors.halfPlane, 0.004) << radius;
        EXPECT_LT(errors.total, 0.004) << radius;
    }
}

TEST(DiscKernel, SinglePrecisionAddsNothingVisible) {
    for (const double radius : {0.05, 1.0, 3.47, 40.0}) {
        const Errors errors = errorsAt<float>(radius);
        EXPECT_LT(errors.halfPlane, 0.004) << radius;
        EXPECT_LT(errors.total, 0.004) << radius;
    }
}

TEST(DiscKernel, InsideIsOneAndOutsideIsZero) {
    for (const double radius : {3.0, 9.5}) {
        EXPECT_EQ(coverage<float>(0.2, -0.3, radius), 1.0F);
        EXPECT_EQ(coverage<float>(radius + 0.6, 0.0, radius), 0.0F);
        EXPECT_EQ(coverage<float>(-radius, radius, radius), 0.0F);
    }
}

}  // namespace
