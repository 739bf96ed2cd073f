// SPDX-License-Identifier: MIT
// Every row of the technique table on maps that the tests make up: its promises (METHODS' list of
// properties) and its limits, in double, in float with the map as its format stores it, and with
// the map in halves. No GPU.
#include "renderer/technique.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <set>

#include "tests/renderer/exact_box.h"
#include "tests/renderer/exact_disc.h"
#include "tests/renderer/technique_case.h"

namespace {

using renderer::Property;
using renderer::Storage;
using renderer::Technique;
using testing::HasSubstr;
using tests::constantsFor;
using tests::CpuTechnique;
using tests::exactly;
using tests::halfPlane;
using tests::inBothPrecisions;
using tests::Random;
using tests::receiverAt;
using Map = tests::DepthMap;

bool isFiltered(const Technique& technique) {
    return technique.prefilter != renderer::Prefilter::none;
}

TEST(Technique, EveryRowIsCompleteAndHasItsFile) {
    std::set<std::string_view> names;
    for (const Technique& technique : renderer::techniques()) {
        EXPECT_TRUE(names.insert(technique.name).second) << technique.name << " twice";
        EXPECT_FALSE(technique.title.empty());
        EXPECT_FALSE(technique.paper.empty());
        EXPECT_FALSE(technique.cost.empty());
        for (const renderer::Exemption& exemption : technique.doNotHold) {
            EXPECT_FALSE(exemption.because.empty()) << technique.name;
            EXPECT_FALSE(technique.holds(exemption.property)) << technique.name;
        }
        EXPECT_LE(technique.parameters.size(), renderer::kMaxTechniqueParameters);
        for (const renderer::TechniqueParameter& parameter : technique.parameters) {
            EXPECT_LE(parameter.low, parameter.standard) << parameter.name;
            EXPECT_LE(parameter.standard, parameter.high) << parameter.name;
            EXPECT_FALSE(parameter.meaning.empty());
            EXPECT_TRUE(!parameter.zeroIsAuto || parameter.low == 0) << parameter.name;
        }
        EXPECT_EQ(isFiltered(technique), technique.format != renderer::MapFormat::depth32f);
        // Rows that share a file must have its parameters in the same places.
        for (const Technique& other : renderer::techniques()) {
            if (other.fileName() != technique.fileName()) continue;
            ASSERT_EQ(other.parameters.size(), technique.parameters.size());
            for (std::size_t i = 0; i < other.parameters.size(); ++i)
                EXPECT_EQ(other.parameters[i].name, technique.parameters[i].name);
        }
        // Reads every parameter that it names, or throws.
        const Map map(4, [](double, double) { return 1.0; });
        EXPECT_NO_THROW(exactly(technique, map, 0.2)(receiverAt(0.5, 0.5, 0.5))) << technique.name;
    }
}

TEST(Technique, RefusesUnknownNamesAndValuesOutOfRange) {
    const Technique& disc = renderer::findTechnique("pcf_disc");
    const Technique& vsm = renderer::findTechnique("vsm");
    const auto message = [](const auto& call) -> std::string {
        try {
            call();
        } catch (const std::invalid_argument& error) {
            return error.what();
        }
        return "nothing was thrown";
    };
    EXPECT_THAT(message([] { renderer::findTechnique("pfc"); }),
                HasSubstr("technique \"pfc\" is not known; known are: hard, pcf_disc"));
    renderer::ParameterValues values = disc.standardParameters();
    EXPECT_EQ(message([&] { setParameter(disc, values, "bias", 1); }),
              "technique pcf_disc has no parameter \"bias\"; it has: bias_texels, "
              "bias_reaches");
    EXPECT_THAT(message([&] { setParameter(disc, values, "bias_texels", -1e-9F); }),
                HasSubstr("is -1e-09, must be 0 to 4"));
    EXPECT_THAT(message([&] { setParameter(disc, values, "bias_texels", NAN); }), HasSubstr("nan"));
    setParameter(disc, values, "bias_texels", 2);
    EXPECT_NO_THROW(checkParameters(disc, values));
    renderer::ParameterValues spoilt = values;
    spoilt[1] = NAN;
    EXPECT_THAT(message([&] { checkParameters(disc, spoilt); }),
                "parameter bias_reaches of technique pcf_disc is nan, must be 0 to 2");
    EXPECT_EQ(values[0], 2.0F);
    values = vsm.standardParameters();
    EXPECT_THAT(message([&] { setParameter(vsm, values, "gaussian", 0.5F); }),
                HasSubstr("is 0.5, must be 0 or 1"));
    setParameter(vsm, values, "gaussian", 1);
    EXPECT_EQ(values[*vsm.parameterSlot("gaussian")], 1.0F);
}

TEST(Technique, ClearedMapIsLitAndSolidMapIsDark) {
    for (const Technique& technique : renderer::techniques())
        for (const double radius : {0.0, 0.02, 0.3, 1.0}) {
            const Map cleared(16, [](double, double) { return 1.0; });
            const auto constants = constantsFor(technique, 16, radius);
            const CpuTechnique<float> lit(technique, cleared, constants);
            const double least = 1 - static_cast<double>(technique.planeDarkening);
            EXPECT_GE(lit(receiverAt(0.5, 0.5, 1.0)), least) << technique.name;
            EXPECT_GE(lit(receiverAt(0.5, 0.5, 1.7)), least) << technique.name << " beyond the end";
            // A wider kernel reaches over the map's edge, where it is lit.
            const bool chain = technique.prefilter == renderer::Prefilter::mips;
            if (radius > (chain ? 0.1 : 0.5) && technique.soft) continue;  // the tent of a level
            // PCSS has the kernel's radius at this distance; vsm16's least variance leaks .008.
            const Map solid(16, [](double, double) { return 0.25; });
            // A Fourier series rings.
            const double tolerance = technique.holds(Property::monotoneInDepth) ? 0.01 : 0.02;
            EXPECT_NEAR(CpuTechnique<float>(technique, solid, constants)(receiverAt(0.5, 0.5, 0.5)),
                        0, tolerance)
                << technique.name << " radius " << radius;
        }
}

TEST(Technique, OutsideTheMapIsLit) {
    const Map solid(8, [](double, double) { return 0.0; });
    for (const Technique& technique : renderer::techniques())
        for (const auto& [u, v] : {std::pair{-0.5, 0.5}, {1.5, 0.5}, {0.5, -0.5}, {0.5, 1.5}})
            inBothPrecisions([&, at = receiverAt(u, v, 0.5)]<class Real> {
                EXPECT_EQ(exactly<Real>(technique, solid, 0.2)(at), 1.0) << technique.name;
            });
}

// A depth that is no number casts nothing; one before the light or behind the far end is clamped.
TEST(Technique, CastersOutOfRangeAreClampedOrLeftOut) {
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    for (const Technique& technique : renderer::techniques())
        for (const auto& [odd, like] :
             {std::pair{-3.0, 0.0}, {-kInfinity, 0.0}, {7.0, 1.0}, {kInfinity, 1.0}, {kNan, 1.0}}) {
            const Map map(9, [&](double u, double) { return u < 0.4 ? odd : 0.7; });
            const Map clean(9, [&](double u, double) { return u < 0.4 ? like : 0.7; });
            inBothPrecisions([&, odd = odd]<class Real> {
                const auto found = exactly<Real>(technique, map, 0.15);
                const auto expected = exactly<Real>(technique, clean, 0.15);
                for (double u = 0.1; u < 0.9; u += 0.1)
                    EXPECT_EQ(found(receiverAt(u, 0.5, 0.6)), expected(receiverAt(u, 0.5, 0.6)))
                        << technique.name << " " << odd;
            });
        }
}

const double kRadiusOfAll = 4.25 / 9 * 2 / std::sqrt(3.0);

// The gradients that the map itself gives are those of the plane, away from its rim; with them the
// receiver's depth follows the plane. Without, half of every slope goes dark (Schueler 2006, figure
// 4.2.3).
TEST(GradientShadowMap, SlopesAreLitByEveryGradientAndHalfDarkWithoutOffsets) {
    const Technique& gsm = renderer::findTechnique("gsm");
    const glm::dvec2 gradient(0.5, -0.3);
    const Map map(64, [&](double u, double v) {
        return 0.5 + gradient.x * (u - 0.5) + gradient.y * (v - 0.5);
    });
    for (const auto& [source, pattern] :
         {std::pair{0.0F, 0.0F}, {1.0F, 0.0F}, {1.0F, 1.0F}, {1.0F, 2.0F}, {2.0F, 0.0F}})
        for (const float offsets : {1.0F, 0.0F}) {
            renderer::ParameterValues parameters = gsm.standardParameters();
            setParameter(gsm, parameters, "gradient", source);
            setParameter(gsm, parameters, "pattern", pattern);
            setParameter(gsm, parameters, "offsets", offsets);
            const CpuTechnique<float> filter(gsm, map, constantsFor(gsm, 64, 0.05, parameters));
            Random random(4);
            double sum = 0;
            for (int i = 0; i < 100; ++i) {
                const double u = random(0.2, 0.8);
                const double v = random(0.2, 0.8);
                const double depth = 0.5 + gradient.x * (u - 0.5) + gradient.y * (v - 0.5);
                sum += filter(receiverAt(u, v, depth, gradient)) / 100;
            }
            if (offsets == 1)
                EXPECT_GE(sum, 0.9999)  // rounding of the regression
                    << "gradient " << source << " pattern " << pattern;
            else
                EXPECT_NEAR(sum, 0.6, 0.1) << "half, and the band of one texel";
        }
}

// Depth 1 beyond the map is no slope: taken for one, it drew a dark line along the map's edge.
TEST(GradientShadowMap, SlopesAreLitUpToTheMapsEdge) {
    const Technique& gsm = renderer::findTechnique("gsm");
    const glm::dvec2 gradient(0.3, -0.2);
    const auto depthAt = [&](double u, double v) {
        return 0.4 + gradient.x * (u - 0.5) + gradient.y * (v - 0.5);
    };
    const Map map(64, depthAt);
    for (const float source : {0.0F, 1.0F, 2.0F}) {
        renderer::ParameterValues parameters = gsm.standardParameters();
        setParameter(gsm, parameters, "gradient", source);
        const CpuTechnique<float> filter(gsm, map, constantsFor(gsm, 64, 0.05, parameters));
        double least = 1;
        for (double along = -0.08; along < 1.08; along += 0.01)
            for (double across : {-0.07, -0.03, 0.0, 0.01, 0.03, 0.07, 0.93, 0.97, 1.0, 1.03})
                for (const auto& [u, v] : {std::pair{along, across}, {across, along}})
                    least = std::min(least, filter(receiverAt(u, v, depthAt(u, v), gradient)));
        EXPECT_GT(least, 0.99) << "gradient " << source;
    }
}

/// Mean darkness of a floor along the foot of a wall, five texels to either side.
double darknessOfTheCorner(float source, float pattern, double radiusTexels) {
    const Technique& gsm = renderer::findTechnique("gsm");
    const auto depth = [](double u, double) { return u < 0.5 ? 0.6 : 0.6 - 0.8 * (u - 0.5); };
    constexpr int kN = 64;
    const Map map(kN, depth);
    renderer::ParameterValues parameters = gsm.standardParameters();
    setParameter(gsm, parameters, "gradient", source);
    setParameter(gsm, parameters, "pattern", pattern);
    setParameter(gsm, parameters, "bias", 0.25);
    const CpuTechnique<double> filter(
        gsm, map, constantsFor(gsm, kN, radiusTexels / kN, parameters), Storage::exact);
    double sum = 0;
    constexpr int kPlaces = 200;
    for (int i = 0; i < kPlaces; ++i) {
        const double u = 0.5 + (2.0 * i / kPlaces - 1) * 5 / kN;
        sum += 1 - filter(receiverAt(u, 0.5, depth(u, 0), {u < 0.5 ? 0 : -0.8, 0}));
    }
    return sum / kPlaces;
}

// The receiver's own plane runs on below the other wall, which darkens a strip along a concave
// corner; the average gradient of the kernel follows both (Schueler 2006, figure 4.2.5). That holds
// for the paper's kernel, half a texel; a kernel of four texels is darker with it.
TEST(GradientShadowMap, AverageGradientDarkensConcaveCornersLessUnderANarrowKernel) {
    for (const float pattern : {0.0F, 1.0F, 2.0F}) {
        EXPECT_GT(darknessOfTheCorner(2, pattern, 0.5), 0.04);
        EXPECT_LT(darknessOfTheCorner(1, pattern, 0.5), 0.3 * darknessOfTheCorner(2, pattern, 0.5));
        EXPECT_GT(darknessOfTheCorner(1, pattern, 4), darknessOfTheCorner(2, pattern, 4));
    }
}

// METHODS: in distances from a light of radius l (uv of the near plane) the penumbra's radius is l
// (d - b) / b x n / d. In the middle of the depth range it is the sun's, wherever the near plane
// is. Under one blocker depth the result is the full disc's of that radius.
TEST(Pcss, PenumbraOfALampFollowsTheDistancesFromIt) {
    const Technique& pcss = renderer::findTechnique("pcss");
    const Technique& disc = renderer::findTechnique("pcf_disc");
    renderer::ParameterValues parameters = pcss.standardParameters();
    setParameter(pcss, parameters, "search_taps", 256);
    const double distance = static_cast<double>(parameters[*pcss.parameterSlot("distance")]);
    const Map map = halfPlane(64, 20, 0.3, 0.4, 1);
    // The second receiver lies beyond the map's depths.
    for (const auto& [nearest, depth] :
         {std::pair{0.01, 0.9}, {0.1, 0.9}, {1.0, 0.9}, {1e6, 0.9}, {0.1, 1.5}, {1e6, 1.5}}) {
        const double farthest = nearest + 3;
        const double blocker = nearest + 0.4 * 3;
        const double receiver = nearest + depth * 3;
        constexpr double kSoftness = 0.08;
        const double middle = nearest + 1.5;
        const double lamp = kSoftness / distance * middle * middle / 3 / nearest;
        // No wider than what is searched for blockers.
        const double expected = std::min(
            lamp * (receiver - blocker) / blocker * nearest / receiver, kSoftness / distance);
        auto constants = constantsFor(pcss, 64, kSoftness, parameters);
        constants.map.w = (farthest - nearest) / nearest;
        const CpuTechnique<double> soft(pcss, map, constants, Storage::exact);
        const auto full = exactly(disc, map, expected);
        for (double v = 0.5 - 0.8 * expected; v < 0.5 + 0.8 * expected; v += 0.1 * expected) {
            const auto at = receiverAt(0.5, v, depth);
            EXPECT_NEAR(soft(at), full(at), 1e-4)  // the receiver's depth error
                << "near " << nearest << " radius " << expected;
        }
    }
}

// More terms, closer to the step: the leak close behind an occluder falls.
TEST(ConvolutionShadowMap, LeaksLessWithMoreTerms) {
    const Technique& csm = renderer::findTechnique("csm");
    const Map map(9, [](double, double) { return 0.4; });
    double last = 1;
    for (const float terms : {1.0F, 2.0F, 4.0F, 8.0F}) {
        renderer::ParameterValues parameters = csm.standardParameters();
        setParameter(csm, parameters, "terms", terms);
        const CpuTechnique<double> filter(csm, map, constantsFor(csm, 9, 0.2, parameters),
                                          Storage::exact);
        double leak = 0;
        for (double depth = 0.4; depth < 1; depth += 0.01)
            leak += filter(receiverAt(0.5, 0.5, depth)) / 60;
        EXPECT_LT(leak, 0.8 * last) << terms;
        last = leak;
    }
}

// Three occluders over a receiver: with layers between them nothing bleeds.
TEST(LayeredVariance, LayersStopTheBleedingOfTheOnesBelow) {
    int texel = 0;
    const Map map(9, [&](double, double) { return 0.1 + 0.25 * (texel++ % 3); });
    const auto receiver = receiverAt(0.5, 0.5, 0.9);
    inBothPrecisions([&]<class Real> {
        EXPECT_GT(exactly<Real>(renderer::findTechnique("vsm"), map, kRadiusOfAll)(receiver), 0.1);
        EXPECT_LT(exactly<Real>(renderer::findTechnique("lvsm"), map, kRadiusOfAll)(receiver),
                  1e-4);
    });
}

/// A planar occluder over a parallel receiver, where every technique that promises to converge
/// comes to the kernel's own profile.
/// (At this distance PCSS has the kernel's radius.)
constexpr double kReceiver = 0.7;
constexpr double kOccluder = kReceiver - 0.25;

double profile(const Technique& technique, double distance, double radius, double angleRad) {
    if (!technique.soft) return distance > 0 ? 1 : 0;
    if (isFiltered(technique))
        return tests::boxProfile(distance, radius * std::sqrt(0.75), angleRad);
    return tests::discProfile(distance / radius);
}

/// RMS difference from the profile of a straight edge at an angle to the texels.
template <class Real>
double edgeError(const Technique& technique, int n, double phase, double radius, double angleRad) {
    const double s = std::sin(angleRad);
    const double c = std::cos(angleRad);
    const Map map = halfPlane(n, angleRad * 180 / std::numbers::pi, phase, kOccluder, kReceiver);
    const auto filter = exactly<Real>(technique, map, radius);
    double sum = 0;
    int count = 0;
    for (double along = -0.2; along < 0.2; along += 0.013)
        for (double x = -1.19; x < 1.2; x += 0.05, ++count) {
            const double distance = x * radius + phase / n;
            const double v = filter(receiverAt(0.5 + along * c - s * distance,
                                               0.5 + along * s + c * distance, kReceiver));
            const double truth = profile(technique, x * radius, radius, angleRad);
            sum += (v - truth) * (v - truth);
        }
    return std::sqrt(sum / count);
}

// The median over sub-texel phases: a single phase may happen to be right.
TEST(Technique, ErrorFallsAsNGrows) {
    for (const Technique& technique : renderer::techniques()) {
        if (!technique.holds(Property::errorFallsWithN)) continue;
        inBothPrecisions([&]<class Real> {
            double last = 1;
            for (const int n : {48, 96, 192}) {
                std::vector<double> errors;
                for (const double phase : {0.03, 0.17, 0.31, 0.58, 0.72})
                    errors.push_back(
                        edgeError<Real>(technique, n, phase, 0.05, 17 * std::numbers::pi / 180));
                std::nth_element(errors.begin(), errors.begin() + 2, errors.end());
                EXPECT_LT(errors[2], 0.95 * last) << technique.name << " N " << n;
                last = errors[2];
            }
            // At 9.6 texels in a radius the profile is the kernel's; a technique with a threshold
            // of its own (light bleeding, biases) would stay away from it.
            EXPECT_LT(last, technique.soft ? 0.01 : 0.2) << technique.name;
        });
    }
}

/// Distance between the places of 10 % and 90 % across an edge, averaged along it.
double edgeWidth(const Technique& technique, int n, double radius, double angleRad) {
    const double s = std::sin(angleRad);
    const double c = std::cos(angleRad);
    const Map map = halfPlane(n, angleRad * 180 / std::numbers::pi, 0.2, kOccluder, kReceiver);
    const auto filter = exactly(technique, map, radius);
    constexpr int kSteps = 120;
    double crossing[2] = {0, 0};
    for (int i = 0; i < kSteps; ++i) {
        const double distance = (-1.5 + 3.0 * i / kSteps) * radius;
        double mean = 0;
        constexpr int kPlaces = 40;
        for (int k = 0; k < kPlaces; ++k) {
            const double along = (k + 0.5) / kPlaces * 0.3 - 0.15;
            mean += filter(receiverAt(0.5 + along * c - s * distance,
                                      0.5 + along * s + c * distance, kReceiver)) /
                    kPlaces;
        }
        if (mean < 0.1) crossing[0] = distance;
        if (mean < 0.9) crossing[1] = distance;
    }
    return crossing[1] - crossing[0];
}

// The mean over the edge is the kernel's profile convolved with a texel (and the bilinear lookup's
// tent): at 3 texels in a radius that is 4 %, steps of the measurement 2 %.
TEST(Technique, SoftnessDoesNotDependOnNAndIsTheDiscs) {
    constexpr double kRadius = 0.06;
    constexpr double kAngle = 0.4;
    const double disc = tests::discProfileWidth() * kRadius;
    for (const Technique& technique : renderer::techniques()) {
        if (!technique.holds(Property::softnessIndependentOfN)) continue;
        // A few taps make steps of the edge, and 10 % may lie on either side of one.
        const double tolerance = technique.holds(Property::errorFallsWithN) ? 0.08 : 0.25;
        const double fine = edgeWidth(technique, 256, kRadius, kAngle);
        for (const int n : {50, 100})
            EXPECT_NEAR(edgeWidth(technique, n, kRadius, kAngle) / fine, 1, tolerance)
                << technique.name << " N " << n;
        EXPECT_NEAR(fine / disc, 1, tolerance) << technique.name;
    }
}

// What a bias counts in texels or reaches shrinks with N in the same call: nothing is kept.
TEST(Technique, BiasFollowsN) {
    for (const Technique& technique : renderer::techniques()) {
        if (!technique.holds(Property::biasFollowsN)) continue;
        auto slot = technique.parameterSlot("bias_texels");
        if (!slot) slot = technique.parameterSlot("bias");
        ASSERT_TRUE(slot) << technique.name;
        renderer::ParameterValues parameters = technique.standardParameters();
        parameters[*slot] = 4;
        const glm::dvec2 gradient(0.4, 0);
        inBothPrecisions([&]<class Real> {
            const auto litFrom = [&](int n) {  // how far behind a plane a receiver is still lit
                const auto plane = [&](double u, double) { return 0.5 + gradient.x * (u - 0.5); };
                const Map map(n, plane);
                const CpuTechnique<Real> filter(
                    technique, map, constantsFor(technique, n, 0.01, parameters), Storage::exact);
                double behind = 0;
                while (behind < 0.2 &&
                       filter(receiverAt(0.5, 0.5, 0.5 + behind, gradient)) >= 0.999)
                    behind += 1e-5;
                return behind;
            };
            const double coarse = litFrom(32);
            const double fine = litFrom(128);
            EXPECT_GT(coarse - fine, 0.8 * 4 * gradient.x * (1.0 / 32 - 1.0 / 128))
                << technique.name;
        });
    }
}

}  // namespace
