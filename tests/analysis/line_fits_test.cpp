// SPDX-License-Identifier: MIT
#include "analysis/line_fits.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/analysis/simulated_study.h"

namespace {

using namespace analysis;

// Thresholds that lie on a curve exactly.
LineFits fitsOf(const std::vector<double>& sizes, double (*radius)(double)) {
    const Study study = tests::simulateStudy({.observers = 2, .sizes = sizes, .trials = 2}, 601);
    std::vector<CellThreshold> thresholds;
    for (std::size_t k = 0; k < study.conditions.size(); ++k) {
        const double a = study.conditions[k].artifactPx;
        thresholds.push_back(
            {.condition = k, .log10c = std::log10(radius(a) / a), .radiusPx = radius(a)});
    }
    CellThreshold censored = thresholds.back();
    censored.state = ThresholdState::allYes;
    censored.radiusPx = 1e9;
    thresholds.push_back(censored);
    return lineFits(study, thresholds);
}

TEST(LineFits, FindTheLineThatTheThresholdsLieOn) {
    const LineFits proportional = fitsOf({5, 10, 20, 30}, [](double a) { return 3.2 * a; });
    EXPECT_EQ(proportional.cells, 4);
    EXPECT_NEAR(proportional.throughOrigin.value(), 3.2, 1e-12);
    EXPECT_NEAR(proportional.affine->interceptPx, 0, 1e-10);
    EXPECT_NEAR(proportional.powerLaw->exponent, 1, 1e-12);
    EXPECT_NEAR(proportional.residualPx, 0, 1e-10);
    const LineFits affine = fitsOf({5, 10, 20, 30}, [](double a) { return 7 + 2.5 * a; });
    EXPECT_NEAR(affine.affine->interceptPx, 7, 1e-10);
    EXPECT_NEAR(affine.affine->slope, 2.5, 1e-12);
    EXPECT_NEAR(affine.affineResidualPx, 0, 1e-10);
    EXPECT_GT(affine.residualPx, 1);
    const LineFits power = fitsOf({5, 10, 20, 30}, [](double a) { return 4 * std::pow(a, 0.8); });
    EXPECT_NEAR(power.powerLaw->exponent, 0.8, 1e-12);
    const double a0 = std::pow(5.0 * 10 * 20 * 30, 0.25);
    EXPECT_NEAR(power.powerLaw->referencePx, a0, 1e-12);
    EXPECT_NEAR(power.powerLaw->log10c, std::log10(4 * std::pow(a0, -0.2)), 1e-12);
    EXPECT_NEAR(power.powerLawResidualPx, 0, 1e-10);
}

TEST(LineFits, OneSizeHasNoSlopeOtherThanThroughTheOrigin) {
    const LineFits fits = fitsOf({10}, [](double a) { return 3 * a; });
    EXPECT_NEAR(fits.throughOrigin.value(), 3, 1e-12);
    EXPECT_FALSE(fits.affine);
    EXPECT_FALSE(fits.powerLaw);
}

}  // namespace
