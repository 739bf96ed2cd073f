// SPDX-License-Identifier: MIT
#include "tests/renderer/hard_cases.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

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
/// bias, all others lose less than 1e-4. 16 bits: a mean is off by 2^-11 in each pass, over the
/// least distance of a receiver from a depth in the cases.
double mostAsStored(const Technique& technique) {
    switch (technique.format) {
        case MapFormat::rg16f:
        case MapFormat::rgba16f:
        case MapFormat::rgba16:
            return 0.15;
        default:
            return technique.name == "msm" ? 0.04 : 0.02;
    }
}

TEST(HardCases, TechniquesKeepToTheirFormulas) {
    for (const Technique& technique : renderer::techniques()) {
        const tests::HardError wide = worstError(technique, Precision::doubles);
        EXPECT_LT(wide.worst, 1e-6) << technique.name << ": " << wide.where;
        const tests::HardError stored = worstError(technique, Precision::asStored);
        EXPECT_LT(stored.worst, mostAsStored(technique)) << technique.name << ": " << stored.where;
    }
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
