// SPDX-License-Identifier: MIT
#include "tests/renderer/hard_cases.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <cstdlib>
#include <functional>

#include "tests/renderer/technique_case.h"

namespace {

using renderer::MapFormat;
using renderer::Property;
using renderer::Storage;
using renderer::Technique;
using tests::CpuTechnique;
using tests::Precision;

/// What may be lost in float. 32 bits: MSM's moments of nearly one depth are noise of .03 at its
/// bias. GSM's band of light is as wide as the map's slope: a regression over a flat map finds the
/// rounding's slope, and between two depths 1e-6 apart the stored one is 16 of float's steps. All
/// others lose less than 1e-4. Sums raise the variance's floor by two of their units, in the cases
/// by up to a quarter of it: .024 of visibility at .0004 from a depth. 2 x 16 bits: 20 bits. 16
/// bits: a mean is off by 2^-11 in each pass, over the least distance of a receiver from a depth in
/// the cases.
double mostAsStored(const Technique& technique) {
    switch (technique.format) {
        case MapFormat::r16f:
        case MapFormat::rg16f:
        case MapFormat::rgba16f:
        case MapFormat::rgba16:
            return 0.15;
        case MapFormat::rg32ui:
            return 0.05;
        default:
            if (technique.name == "msm") return 0.04;
            return technique.name == "gsm_stored" ? 0.03 : 0.005;
    }
}

TEST(HardCases, TechniquesKeepToTheirFormulas) {
    for (const Technique& technique : renderer::techniques()) {
        // The midpoint rule of the disc's weights (disc_kernel_test.cpp).
        const bool disc = technique.name == "pcf_disc" || technique.name == "pcss";
        for (const tests::Variant& variant : tests::variantsOf(technique)) {
            const tests::HardError wide = worstError(technique, Precision::doubles, variant);
            const bool sums = technique.format == MapFormat::rg32ui;  // the same units in double
            EXPECT_LT(wide.worst, disc ? 0.001 : (sums ? mostAsStored(technique) : 1e-8))
                << technique.name << " " << tests::toText(variant) << ": " << wide.where;
            const tests::HardError stored = worstError(technique, Precision::asStored, variant);
            EXPECT_LT(stored.worst, mostAsStored(technique))
                << technique.name << " " << tests::toText(variant) << ": " << stored.where;
            // Formats of 32 bits stored in halves promise numbers alone.
            const tests::HardError half = worstError(technique, Precision::half, variant);
            EXPECT_LE(half.worst, 1)
                << technique.name << " " << tests::toText(variant) << ": " << half.where;
        }
    }
}

// exp(c z) is infinite in 32 bits from c = 88.73 on and in 16 from 11.1; kept as a logarithm it is
// a depth. The squares of the warps are infinite from 44.4 on, their sums over a wide kernel before
// that (below), and the table ends before either.
TEST(HardCases, ExponentsAtAndBeyondOverflowKeepToTheFormula) {
    const Technique& esm = renderer::findTechnique("esm");
    for (const float exponent : {1.0F, 11.0F, 12.0F, 88.0F, 89.0F, 200.0F, 1000.0F})
        for (const Precision precision : {Precision::asStored, Precision::doubles}) {
            const tests::HardError error = worstError(esm, precision, {{"exponent", exponent}});
            // A step of the logarithm, 2^-24 c in each of three passes, times the slope of the
            // exponential.
            const double most = precision == Precision::doubles
                                    ? 1e-6
                                    : 2e-6 + 4 * 0x1p-23 * static_cast<double>(exponent);
            EXPECT_LT(error.worst, most) << exponent << ": " << error.where;
        }
    const Technique& esm16 = renderer::findTechnique("esm16");
    for (const float exponent : {1.0F, 11.0F, 12.0F, 64.0F, 80.0F, 1000.0F}) {
        EXPECT_LT(worstError(esm16, Precision::doubles, {{"exponent", exponent}}).worst, 1e-6);
        // Half a step of 11 bits in each of three passes moves the logarithm.
        const double moved = 1.5 * std::exp2(std::floor(std::log2(exponent)) - 10);
        const tests::HardError error =
            worstError(esm16, Precision::asStored, {{"exponent", exponent}});
        EXPECT_LT(error.worst, 1 - std::exp(-moved) + 1e-3) << exponent << ": " << error.where;
    }
    for (const char* name : {"evsm2", "evsm4"}) {
        const Technique& evsm = renderer::findTechnique(name);
        const std::size_t slot = evsm.parameterSlot("positive_exponent").value();
        const float highest = evsm.parameters[slot].high;
        EXPECT_LT(highest, 44.36F) << "exp(2 c) is no longer finite";
        for (const float exponent : {1.0F, highest})
            EXPECT_LT(
                worstError(evsm, Precision::asStored, {{"positive_exponent", exponent}}).worst,
                // At 1 the least variance is less than what rounding makes of moments of e^2.
                exponent == 1 ? 0.08 : 0.02)
                << name << " " << exponent;
        renderer::ParameterValues values = evsm.standardParameters();
        EXPECT_THROW(setParameter(evsm, values, "positive_exponent", highest + 1),
                     std::invalid_argument);
    }
}

// The prefilter divides a sum by its weights at the end: at exp(84), 113 texels of a line are too
// much for 32 bits.
TEST(HardCases, SumsOfWarpsUnderWideKernelsStayFinite) {
    for (const char* name : {"evsm2", "evsm4"}) {
        const Technique& evsm = renderer::findTechnique(name);
        renderer::ParameterValues parameters = evsm.standardParameters();
        for (const char* exponent : {"positive_exponent", "negative_exponent"})
            if (const auto slot = evsm.parameterSlot(exponent))
                parameters[*slot] = evsm.parameters[*slot].high;
        // The kernel is 121 texels wide; half the map is a caster, the rest is cleared.
        const tests::DepthMap map(70, [](double u, double) { return u < 0.5 ? 0.3 : 1.0; });
        const auto constants = tests::constantsFor(evsm, map.edge, 1, parameters);
        const CpuTechnique<double> wide(evsm, map, constants, Storage::exact);
        const CpuTechnique<float> stored(evsm, map, constants);
        const auto receiver = tests::receiverAt(0.5, 0.5, 1);
        EXPECT_LT(wide(receiver), 0.9) << name << ": the caster is seen";
        // Rounding of the sums: 121 steps of 2^-24 at most in each pass.
        EXPECT_NEAR(stored(receiver), wide(receiver), 1e-4) << name;
    }
}

/// A map of one texel that holds what no depths give.
double visibilityOf(const Technique& technique, const glm::dvec4& texel, double depth) {
    const auto constants = tests::constantsFor(technique, 1, 0);
    renderer::CpuMap<double> map;
    map.edge = filteredEdge(constants);
    map.texels.assign(static_cast<std::size_t>(renderer::kMostLayers * map.edge * map.edge), texel);
    auto receiver = tests::receiverAt(0.5, 0.5, depth);
    receiver.depthError = 0;
    return renderer::cpuVisibility(technique, map, receiver, constants);
}

// Rounding may take the mean square below the square of the mean; the floor takes over, and a
// receiver on the mean is lit whatever the variance is.
TEST(HardCases, VarianceBelowZeroIsTheLeastVariance) {
    for (const char* name : {"vsm", "vsm16"}) {
        const Technique& technique = renderer::findTechnique(name);
        const auto of = [&](const char* parameter) {
            return static_cast<double>(
                technique.standardParameters()[technique.parameterSlot(parameter).value()]);
        };
        for (const double meanSquare : {0.25, 0.2499, 0.0, -1.0}) {
            const glm::dvec4 texel(0.5, meanSquare, 0, 0);
            EXPECT_EQ(visibilityOf(technique, texel, 0.5), 1) << name;
            const double beyond = 0.1 - of("bias_depth");
            const double least = of("least_variance");
            EXPECT_NEAR(visibilityOf(technique, texel, 0.6), least / (least + beyond * beyond),
                        1e-9)
                << name << " mean square " << meanSquare;
        }
    }
    // Least, mean and greatest that contradict each other: the mean is moved between them.
    const Technique& power = renderer::findTechnique("power_cdf");
    EXPECT_EQ(visibilityOf(power, {0.9, 0.2, 0.7, 0}, 0.69), 1);
    EXPECT_EQ(visibilityOf(power, {0.1, 0.2, 0.7, 0}, 0.4), 0) << "all weight on the least";
}

// High and low parts are joined before each pass and split again after it: what is lost stays at 20
// bits, and without the split it is 2^-12 and more.
TEST(HardCases, SplitHalvesKeepTwentyBitsThroughEveryPass) {
    tests::Random random(41);
    const tests::DepthMap map(24, [&](double, double) { return random(); });
    const auto worst = [&](std::string_view name, double radius) {
        const Technique& technique = renderer::findTechnique(name);
        const auto wide = tests::constantsFor(technique, map.edge, radius);
        const auto narrow = tests::toFloat(wide);
        const auto stored = renderer::cpuMap<float>(technique, map.view(), narrow);
        const auto exact = renderer::cpuMap<double>(technique, map.view(), wide, Storage::exact);
        double most = 0;
        for (std::size_t i = 0; i < exact.texels.size(); ++i) {
            const auto found = unpackedTexel(stored.texels[i], narrow);
            const auto expected = unpackedTexel(exact.texels[i], wide);
            for (int k = 0; k < 2; ++k)
                most = std::max(most, std::abs(static_cast<double>(found[k]) - expected[k]));
        }
        return most;
    };
    constexpr double kRounding = 4e-7;  // of sums in 32 bits
    EXPECT_LE(worst("vsm_split", 0), 0x1p-20 + kRounding) << "unfiltered";
    EXPECT_LE(worst("vsm_split", 0.1), 3 * 0x1p-20 + kRounding) << "rows, then columns";
    EXPECT_GT(worst("vsm16", 0), 0x1p-13);
    EXPECT_GT(worst("vsm16", 0.1), 100 * worst("vsm_split", 0.1));
}

/// 1,000 cases each, a tenth where instrumented, from one seed.
bool holds(const std::string& claim, const std::function<void()>& property) {
#ifdef __SANITIZE_ADDRESS__
    setenv("RC_PARAMS", "seed=1 max_success=100", 1);
#else
    setenv("RC_PARAMS", "seed=1 max_success=1000", 1);
#endif
    return rc::check(claim, property);
}

/// Small whole numbers shrink to readable cases.
struct ShrinkingCase {
    tests::DepthMap map{5, [](double, double) { return 0; }};
    double depth = 0;

    static ShrinkingCase draw() {
        ShrinkingCase drawn;
        const auto depths = *rc::gen::container<std::vector<int>>(25, rc::gen::inRange(0, 1001));
        for (std::size_t i = 0; i < depths.size(); ++i)
            drawn.map.texels[i] = static_cast<float>(depths[i]) / 1000;
        drawn.depth = *rc::gen::inRange(-100, 1201) / 1000.0;
        return drawn;
    }
    /// The box of 1.7 texels to either side around the middle.
    static constexpr double kRadius = 0.4;

    template <class Real>
    double visibility(const Technique& technique, Storage storage, double farther = 0) const {
        return CpuTechnique<Real>(technique, map, tests::constantsFor(technique, map.edge, kRadius),
                                  storage)(tests::receiverAt(0.5, 0.5, depth + farther));
    }
};

TEST(HardCases, ShrinkingCasesKeepToTheUnitRangeAndToTheOrderOfDepths) {
    for (const Technique& technique : renderer::techniques()) {
        EXPECT_TRUE(holds(std::string(technique.name), [&] {
            const ShrinkingCase drawn = ShrinkingCase::draw();
            const double step = *rc::gen::inRange(0, 500) / 1000.0;
            const double wide = drawn.visibility<double>(technique, Storage::exact);
            for (const double visibility :
                 {wide, drawn.visibility<float>(technique, Storage::asFormat),
                  drawn.visibility<float>(technique, Storage::half)})
                RC_ASSERT(visibility >= 0 && visibility <= 1);
            if (technique.holds(Property::monotoneInDepth))
                RC_ASSERT(drawn.visibility<double>(technique, Storage::exact, step) <= wide + 1e-9);
        })) << technique.name;
    }
}

}  // namespace
