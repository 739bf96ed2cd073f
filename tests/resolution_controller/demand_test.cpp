// SPDX-License-Identifier: MIT
#include "resolution_controller/demand.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include "resolution_controller/resolution_controller.h"

namespace {

namespace rc = resolution_controller;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();

TEST(Demand, IsTheLawWhereNoPixelBoundsIt) {
    EXPECT_FLOAT_EQ(rc::demand(3.47f, 0.0347f, 0), 100);
    EXPECT_FLOAT_EQ(rc::demand(3.47f, 2.0f, 0), 1.735f) << "a filter wider than the map";
}

TEST(Demand, NeverAsksForTexelsSmallerThanAPixel) {
    const float footprint = 1.0f / 700;
    EXPECT_FLOAT_EQ(rc::demand(3.47f, 1e-6f, footprint), 700);
    EXPECT_FLOAT_EQ(rc::demand(3.47f, 0, footprint), 700) << "contact";
    EXPECT_FLOAT_EQ(rc::demand(3.47f, 0, footprint, 2), 1400);
    EXPECT_FLOAT_EQ(rc::demand(3.47f, 0.0347f, footprint), 100);
}

TEST(Demand, RejectsWhatIsNoRadius) {
    for (const float radius : {kNan, -kNan, -1.0f, -0.001f, kInf, -kInf}) {
        EXPECT_EQ(rc::demand(3.47f, radius, 0.01f), 0) << radius;
    }
    for (const float c : {kNan, 0.0f, -3.47f, kInf}) {
        EXPECT_EQ(rc::demand(c, 0.01f, 0.01f), 0) << c;
    }
}

TEST(Demand, AnUnusableFootprintSetsNoBound) {
    for (const float footprint : {kNan, 0.0f, -1.0f, kInf}) {
        EXPECT_FLOAT_EQ(rc::demand(3.47f, 0.0347f, footprint), 100) << footprint;
        EXPECT_EQ(rc::demand(3.47f, 0, footprint), kInf);
    }
    for (const float bound : {kNan, 0.0f, -1.0f}) {
        EXPECT_FLOAT_EQ(rc::demand(3.47f, 0.0347f, 0.1f, bound), 100) << bound;
    }
}

TEST(Demand, WithoutItsTermsTheRuleIsThePlainForm) {
    std::mt19937_64 rng(9);
    std::uniform_real_distribution<float> log10(-6, 1);
    for (int i = 0; i < 1000; ++i) {
        const float r = std::pow(10.0f, log10(rng)), footprint = std::pow(10.0f, log10(rng));
        EXPECT_EQ(rc::demand(rc::DemandRule{.c = 2}, {.radiusUv = r, .footprint = footprint}),
                  rc::demand(2.0f, r, footprint));
    }
}

TEST(Demand, FaintEdgesAskForLess) {
    const rc::DemandRule rule{.contrastExponent = 0.3f};
    const float full = rc::demand(rule, {.radiusUv = 0.01f});
    EXPECT_FLOAT_EQ(full, 347);
    EXPECT_NEAR(rc::demand(rule, {.radiusUv = 0.01f, .contrast = 0.5f}), 347 * std::pow(0.5, 0.3),
                1e-3);
    for (const float unusable : {kNan, -1.0f, 2.0f, kInf}) {
        EXPECT_EQ(rc::demand(rule, {.radiusUv = 0.01f, .contrast = unusable}), full);
    }
}

TEST(Demand, ThinCastersAskForTexelsThatHitThem) {
    const rc::DemandRule rule{};
    rc::DemandPoint point{.radiusUv = 0.05f, .casterWidthUv = 0.002f};
    EXPECT_FLOAT_EQ(rc::demand(rule, point), 1000) << "two texels across it";
    point.footprint = 1.0f / 600;
    EXPECT_FLOAT_EQ(rc::demand(rule, point), 600) << "but none smaller than a pixel";
    point = {.radiusUv = 0.001f, .casterWidthUv = 0.002f};
    EXPECT_FLOAT_EQ(rc::demand(rule, point), 3470) << "the law asks for more";
    for (const float unusable : {kNan, -1.0f, 0.0f, kInf}) {
        point = {.radiusUv = 0.05f, .casterWidthUv = unusable};
        EXPECT_FLOAT_EQ(rc::demand(rule, point), 69.4f) << unusable;
    }
    EXPECT_EQ(rc::demand(rule, {.radiusUv = kNan, .casterWidthUv = 0.002f}), 0);
}

/// Singular values through the eigenvalues of J'J, in double.
std::pair<double, double> singularValues(const rc::UvDerivatives& d) {
    const double a = double(d.dudx) * d.dudx + double(d.dvdx) * d.dvdx;
    const double b = double(d.dudx) * d.dudy + double(d.dvdx) * d.dvdy;
    const double c = double(d.dudy) * d.dudy + double(d.dvdy) * d.dvdy;
    const double middle = (a + c) / 2, spread = std::hypot((a - c) / 2, b);
    return {std::sqrt(std::max(0.0, middle - spread)), std::sqrt(middle + spread)};
}

TEST(Demand, FootprintIsTheSmallerSingularValueWithinTheAnisotropyLimit) {
    std::mt19937_64 rng(1);
    std::uniform_real_distribution<float> uniform(-0.01f, 0.01f);
    for (int i = 0; i < 1000; ++i) {
        const rc::UvDerivatives d{uniform(rng), uniform(rng), uniform(rng), uniform(rng)};
        const auto [smaller, larger] = singularValues(d);
        EXPECT_NEAR(rc::pixelFootprint(d), std::max(smaller, larger / 4), 1e-5 * larger);
    }
    // Grazing: the long side of the pixel's footprint is 100 times the short one.
    EXPECT_FLOAT_EQ(rc::pixelFootprint({.dudx = 0.001f, .dvdy = 0.1f}), 0.025f);
    // Turned by 45 degrees it is the same pixel.
    const float s = std::sqrt(0.5f);
    EXPECT_NEAR(
        rc::pixelFootprint(
            {.dudx = 0.002f * s, .dvdx = 0.002f * s, .dudy = -0.004f * s, .dvdy = 0.004f * s}),
        0.002f, 1e-8);
}

TEST(Demand, FootprintOfUnusableDerivativesIsNone) {
    EXPECT_EQ(rc::pixelFootprint({}), 0);
    for (const float bad : {kNan, kInf, -kInf, 3e38f}) {
        EXPECT_EQ(rc::pixelFootprint({bad, bad, bad, bad}), 0) << bad;
        EXPECT_EQ(rc::pixelFootprint({0.01f, bad, 0, bad}), 0) << bad;
    }
}

TEST(DemandHistogram, BinsAreQuarterOctavesOpenBelow) {
    for (std::size_t b = 0; b < rc::DemandHistogram::kBins; ++b) {
        const double edge = std::exp2(double(b + 1) / 4);
        const auto below = std::nextafter(float(edge), 0.0f) <= edge && float(edge) > edge
                               ? std::nextafter(float(edge), 0.0f)
                               : float(edge);  // the largest float up to the edge
        EXPECT_EQ(rc::DemandHistogram::binOf(below), int(b));
        EXPECT_EQ(rc::DemandHistogram::binOf(std::nextafter(below, kInf)),
                  std::min(int(b) + 1, 63));
        EXPECT_EQ(rc::DemandHistogram::upperEdge(b), std::int32_t(std::ceil(edge - 1e-9)));
    }
}

TEST(DemandHistogram, EveryFloatHasABinWhoseEdgeMeetsIt) {
    std::mt19937_64 rng(2);
    for (int i = 0; i < 200000; ++i) {
        const auto n = std::bit_cast<float>(std::uint32_t(rng()));
        const int bin = rc::DemandHistogram::binOf(n);
        if (!(n > 0)) {
            EXPECT_EQ(bin, -1) << n;
        } else if (n <= 65536) {
            ASSERT_GE(bin, 0);
            EXPECT_GE(float(rc::DemandHistogram::upperEdge(std::size_t(bin))), n);
        } else {
            EXPECT_EQ(bin, 63) << n;
        }
    }
    for (const float rejected : {0.0f, -0.0f, kNan, -kNan, -1.0f, -kInf}) {
        EXPECT_EQ(rc::DemandHistogram::binOf(rejected), -1);
    }
    EXPECT_EQ(rc::DemandHistogram::binOf(kInf), 63);
    EXPECT_EQ(rc::DemandHistogram::binOf(std::numeric_limits<float>::denorm_min()), 0);
}

// An edge of 500 pixels weighs the same whatever its penumbra's width, within the rounding of each
// point's weight, by a half.
TEST(DemandWeight, OfAnEdgeIsItsLengthHoweverWideItsPenumbra) {
    constexpr float kFootprint = 1.0f / 3000;
    constexpr std::uint64_t kLengthPx = 500;
    for (const std::uint64_t widthPx : {1u, 2u, 3u, 7u, 16u, 40u}) {
        const float radiusUv = kFootprint * static_cast<float>(widthPx) / 2;
        std::uint64_t weight = 0;
        for (std::uint64_t pixel = 0; pixel < kLengthPx * widthPx; ++pixel)
            weight += rc::demandWeight(radiusUv, kFootprint);
        const std::uint64_t whole = kLengthPx * rc::kWholeDemandWeight;
        EXPECT_NEAR(static_cast<double>(weight), static_cast<double>(whole),
                    0.5 * static_cast<double>(kLengthPx * widthPx))
            << widthPx;
    }
}

TEST(DemandWeight, IsOneToAWholeAndOneWhereNothingIsKnown) {
    EXPECT_EQ(rc::demandWeight(0, 0.001f), rc::kWholeDemandWeight) << "a contact is an edge";
    EXPECT_EQ(rc::demandWeight(0.0001f, 0.001f), rc::kWholeDemandWeight) << "within a pixel";
    EXPECT_EQ(rc::demandWeight(1, 1e-30f), 1u);
    for (const float unusable : {0.0f, -1.0f, kNan, kInf})
        EXPECT_EQ(rc::demandWeight(0.01f, unusable), 1u) << unusable;
    for (const float unusable : {-1.0f, kNan, kInf})
        EXPECT_EQ(rc::demandWeight(unusable, 0.001f), 1u) << unusable;
}

TEST(DemandHistogram, CountsAndMerges) {
    rc::DemandHistogram a, b;
    for (const float n : {100.0f, 101.0f, 5000.0f}) a.add(n);
    for (const float n : {100.0f, kNan, 0.0f, kInf}) b.add(n);
    a += b;
    EXPECT_EQ(a.total(), 5u);
    EXPECT_EQ(a.rejected, 2u);
    EXPECT_EQ(a.counts[26], 3u) << "(90.5, 107.6]";
    EXPECT_EQ(a.counts[63], 1u);
    a.add(5000, 64);
    a.add(kNan, 7);
    EXPECT_EQ(a.total(), 69u);
    EXPECT_EQ(a.rejected, 9u);
}

TEST(RecentDemand, IsTheSumOfTheLastFrames) {
    for (const int frames : {1, 2, 16, 36, rc::RecentDemand::kMostFrames}) {
        rc::RecentDemand recent(frames);
        std::vector<rc::DemandHistogram> all;
        std::mt19937 random(frames);
        for (int i = 0; i < 3 * frames; ++i) {
            rc::DemandHistogram& newest = all.emplace_back();
            for (int point = 0; point < 20; ++point)
                newest.add(std::exp2(static_cast<float>(random() % 16)),
                           static_cast<std::uint32_t>(random() % 64));
            newest.add(kNan, static_cast<std::uint32_t>(random() % 3));
            rc::DemandHistogram expected;
            for (std::size_t k = all.size() - std::min(all.size(), std::size_t(frames));
                 k < all.size(); ++k)
                expected += all[k];
            EXPECT_EQ(recent.add(newest), expected) << frames << ' ' << i;
        }
        recent.clear();
        EXPECT_EQ(recent.sum(), rc::DemandHistogram());
        EXPECT_EQ(recent.add(all.front()), all.front()) << "what was cleared does not come back";
        EXPECT_EQ(recent.frames(), frames);
    }
}

TEST(RecentDemand, AddsItsOwnSumAsAnyOther) {
    for (const int frames : {1, 2, 3, 16}) {
        rc::RecentDemand recent(frames), expected(frames);
        for (int i = 0; i < 3 * frames; ++i) {
            rc::DemandHistogram newest;
            newest.add(std::exp2(static_cast<float>(i % 12)), static_cast<std::uint32_t>(1 + i));
            newest.add(kNan, static_cast<std::uint32_t>(i));
            recent.add(newest);
            expected.add(newest);
            const rc::DemandHistogram sum = expected.sum();
            EXPECT_EQ(recent.add(recent.sum()), expected.add(sum)) << frames << ' ' << i;
        }
    }
}

TEST(RecentDemand, HearsAnEdgeAfterTheFramesThatItsShareSays) {
    constexpr int kFrames = 16;
    constexpr double kPercentile = 0.98;
    rc::DemandHistogram before;
    before.add(500, 1000);
    for (const std::uint32_t weight : {25u, 50u, 100u, 200u, 400u}) {
        rc::RecentDemand recent(kFrames);
        rc::ResolutionController controller({.percentile = kPercentile});
        for (int i = 0; i < kFrames; ++i) recent.add(before);
        ASSERT_EQ(controller.update(recent.sum()).size, 512);
        rc::DemandHistogram after;
        after.add(500, 1000 - weight);
        after.add(4000, weight);
        int frames = 1;
        for (recent.add(after); controller.update(recent.sum()).size == 512; recent.add(after)) {
            ASSERT_LT(++frames, kFrames);
        }
        EXPECT_EQ(controller.size(), 4096);
        // Heard in the frame in which its weight is more than what the percentile leaves out.
        const double expected = kFrames * (1 - kPercentile) * 1000 / weight;
        EXPECT_GE(frames, expected) << weight;
        EXPECT_LE(frames, expected + 1) << weight;
    }
}

TEST(RecentDemand, TakesTheNearerEndForAnUnusableNumberOfFrames) {
    EXPECT_EQ(rc::RecentDemand(0).frames(), 1);
    EXPECT_EQ(rc::RecentDemand(-7).frames(), 1);
    EXPECT_EQ(rc::RecentDemand(1000).frames(), rc::RecentDemand::kMostFrames);
}

constexpr rc::DemandHistogram filledAtCompileTime() {
    rc::DemandHistogram h;
    h.add(1024);
    return h;
}
static_assert(filledAtCompileTime().counts[39] == 1);
static_assert(rc::DemandHistogram::upperEdge(39) == 1024);

}  // namespace
