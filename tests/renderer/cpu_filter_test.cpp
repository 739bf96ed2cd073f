// SPDX-License-Identifier: MIT
// Every row of the technique table on maps that the tests make up: its promises, and its limits. No
// GPU.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "renderer/technique.h"
#include "tests/renderer/exact_disc.h"

namespace {

using renderer::Property;
using renderer::Technique;

constexpr double kPi = std::numbers::pi;

class Random {
  public:
    explicit Random(std::uint64_t seed) : engine_(seed) {}
    double operator()(double low = 0, double high = 1) {
        return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53;
    }

  private:
    std::mt19937_64 engine_;
};

struct Map {
    int edge;
    std::vector<float> texels;

    template <class Depth>
    Map(int n, const Depth& depth) : edge(n) {
        for (int j = 0; j < n; ++j)
            for (int i = 0; i < n; ++i)
                texels.push_back(static_cast<float>(depth((i + 0.5) / n, (j + 0.5) / n)));
    }
    renderer::MapView view() const { return {texels.data(), edge}; }
};

renderer::f64::ShadowConstants constants(const Technique& technique, int n, double radiusUv) {
    renderer::f64::ShadowConstants c{};
    c.map = {n, 1.0 / n, 1.0 / n, 0};
    c.kernel = {radiusUv, 0, 1, 0};
    const renderer::ParameterValues values = technique.standardParameters();
    for (std::size_t i = 0; i < values.size(); ++i)
        c.parameters[i / 4][static_cast<int>(i % 4)] = static_cast<double>(values[i]);
    return c;
}

renderer::f32::ShadowConstants toFloat(const renderer::f64::ShadowConstants& c) {
    renderer::f32::ShadowConstants f{};
    f.map = glm::vec4(c.map);
    f.kernel = glm::vec4(c.kernel);
    for (int i = 0; i < 2; ++i) f.parameters[i] = glm::vec4(c.parameters[i]);
    return f;
}

renderer::f64::ShadowReceiver receiverAt(double u, double v, double depth,
                                         glm::dvec2 gradient = glm::dvec2(0)) {
    return {.uv = {u, v},
            .depth = depth,
            .depthGradient = gradient,
            .depthError = 2e-6,
            .footprintUv = 0.001,
            .facesLight = true};
}

renderer::f32::ShadowReceiver toFloat(const renderer::f64::ShadowReceiver& r) {
    return {.uv = glm::vec2(r.uv),
            .depth = static_cast<float>(r.depth),
            .depthGradient = glm::vec2(r.depthGradient),
            .depthError = static_cast<float>(r.depthError),
            .footprintUv = static_cast<float>(r.footprintUv),
            .facesLight = r.facesLight};
}

double evaluate(const Technique& technique, const Map& map,
                const renderer::f64::ShadowReceiver& receiver, double radiusUv) {
    return renderer::cpuFilter(technique).f64(map.view(), receiver,
                                              constants(technique, map.edge, radiusUv));
}

const Technique& disc() {
    return renderer::findTechnique("pcf_disc");
}

TEST(Technique, EveryRowIsCompleteAndHasItsFile) {
    for (const Technique& technique : renderer::techniques()) {
        EXPECT_FALSE(technique.title.empty());
        EXPECT_FALSE(technique.paper.empty());
        EXPECT_FALSE(technique.cost.empty());
        EXPECT_EQ(technique.doNotHold.empty(), technique.doNotHoldBecause.empty())
            << technique.name;
        EXPECT_LE(technique.parameters.size(), renderer::kMaxTechniqueParameters);
        for (const renderer::TechniqueParameter& parameter : technique.parameters) {
            EXPECT_LE(parameter.low, parameter.standard) << parameter.name;
            EXPECT_LE(parameter.standard, parameter.high) << parameter.name;
            EXPECT_FALSE(parameter.meaning.empty());
        }
        EXPECT_NO_THROW(renderer::cpuFilter(technique)) << technique.name;
        // Reads every parameter that it names, or throws.
        const Map map(4, [](double, double) { return 1.0; });
        EXPECT_NO_THROW(evaluate(technique, map, receiverAt(0.5, 0.5, 0.5), 0.2)) << technique.name;
    }
}

TEST(Technique, RefusesUnknownNamesAndValuesOutOfRange) {
    const auto message = [](const auto& call) -> std::string {
        try {
            call();
        } catch (const std::invalid_argument& error) {
            return error.what();
        }
        return "nothing was thrown";
    };
    EXPECT_EQ(message([] { renderer::findTechnique("pfc"); }),
              "technique \"pfc\" is not known; known are: hard, pcf_disc");
    renderer::ParameterValues values = disc().standardParameters();
    EXPECT_EQ(message([&] { setParameter(disc(), values, "bias", 1); }),
              "technique pcf_disc has no parameter \"bias\"; it has: bias_texels");
    EXPECT_NE(message([&] { setParameter(disc(), values, "bias_texels", 9); }).find("is 9"),
              std::string::npos);
    EXPECT_NE(message([&] { setParameter(disc(), values, "bias_texels", NAN); }).find("nan"),
              std::string::npos);
    setParameter(disc(), values, "bias_texels", 2);
    EXPECT_EQ(values[0], 2.0F);
}

// 20,000 receivers and maps per technique and precision, most of them hostile.
TEST(Technique, AnyInputGivesANumberInTheUnitRange) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double infinity = std::numeric_limits<double>::infinity();
    const std::vector<double> odd = {0,    1,     -1, 0.5, 1e-30,    -1e-30,
                                     1e30, -1e30, 2,  nan, infinity, -infinity};
    Random random(11);
    for (const Technique& technique : renderer::techniques()) {
        const renderer::CpuFilter& filter = renderer::cpuFilter(technique);
        for (int trial = 0; trial < 20000; ++trial) {
            const auto number = [&] {
                return random() < 0.7 ? random(-0.2, 1.2)
                                      : odd[static_cast<std::size_t>(random(0, 11.999))];
            };
            const int n = random() < 0.2 ? 1 : static_cast<int>(random(2, 12));
            const bool clean = random() < 0.5;
            const Map map(n, [&](double, double) { return clean ? random() : number(); });
            auto receiver = receiverAt(number(), number(), number(), {number(), number()});
            receiver.footprintUv = number();
            const double radius = random() < 0.5 ? random(0, 1.5) : std::abs(number());
            auto c = constants(technique, n, radius);
            if (random() < 0.3) c.kernel.y = number();
            const double wide = filter.f64(map.view(), receiver, c);
            EXPECT_TRUE(wide >= 0 && wide <= 1) << technique.name << " " << trial << ": " << wide;
            const float narrow = filter.f32(map.view(), toFloat(receiver), toFloat(c));
            EXPECT_TRUE(narrow >= 0 && narrow <= 1)
                << technique.name << " " << trial << ": " << narrow;
        }
    }
}

TEST(Technique, ClearedMapIsLitAndSolidMapIsDark) {
    for (const Technique& technique : renderer::techniques())
        for (const double radius : {0.0, 0.02, 0.3, 1.0}) {
            const Map cleared(16, [](double, double) { return 1.0; });
            EXPECT_EQ(evaluate(technique, cleared, receiverAt(0.5, 0.5, 1.0), radius), 1.0);
            EXPECT_EQ(evaluate(technique, cleared, receiverAt(0.5, 0.5, 1.7), radius), 1.0)
                << "beyond the far end";
            const Map solid(16, [](double, double) { return 0.0; });
            const bool inside =
                radius <= 0.5;  // a wider disc reaches over the map's edge, where it is lit
            EXPECT_NEAR(evaluate(technique, solid, receiverAt(0.5, 0.5, 0.5), radius), 0,
                        inside || !technique.soft ? 0.004 : 1);
        }
}

TEST(Technique, OutsideTheMapIsLit) {
    const Map solid(8, [](double, double) { return 0.0; });
    for (const Technique& technique : renderer::techniques())
        for (const auto& [u, v] : {std::pair{-0.3, 0.5}, {1.3, 0.5}, {0.5, -0.3}, {0.5, 1.3}})
            EXPECT_EQ(evaluate(technique, solid, receiverAt(u, v, 0.5), 0.2), 1.0)
                << technique.name;
    // Half of the disc hangs over the edge.
    EXPECT_NEAR(evaluate(disc(), solid, receiverAt(0.0, 0.5, 0.5), 0.3), 0.5, 0.001);
    // The disc covers the whole map.
    const double map = 1.0 / (kPi * 0.9 * 0.9);
    EXPECT_NEAR(evaluate(disc(), solid, receiverAt(0.5, 0.5, 0.5), 0.9), 1 - map, 0.001);
}

TEST(Technique, FartherReceiversAreNeverLighter) {
    Random random(5);
    for (const Technique& technique : renderer::techniques()) {
        if (!technique.holds(Property::monotoneInDepth)) continue;
        for (int trial = 0; trial < 300; ++trial) {
            const Map map(12, [&](double, double) { return random(); });
            const double u = random();
            const double v = random();
            const double radius = random(0, 0.4);
            const glm::dvec2 gradient(random(-1, 1), random(-1, 1));
            double last = 1;
            for (double depth = -0.2; depth <= 1.2; depth += 0.05) {
                const double now =
                    evaluate(technique, map, receiverAt(u, v, depth, gradient), radius);
                EXPECT_LE(now, last) << technique.name;
                last = now;
            }
        }
    }
}

TEST(Technique, PlaneDoesNotShadowItselfAtAnyTilt) {
    for (const Technique& technique : renderer::techniques()) {
        if (!technique.holds(Property::planeLit)) continue;
        for (const int n : {16, 64, 257})
            for (const glm::dvec2 gradient :
                 {glm::dvec2(0, 0), {0.4, 0}, {-0.3, 0.5}, {0.01, -0.6}}) {
                const auto plane = [&](double u, double v) {
                    return 0.5 + gradient.x * (u - 0.5) + gradient.y * (v - 0.5);
                };
                const Map map(n, plane);
                Random random(9);
                for (int i = 0; i < 50; ++i) {
                    const double u = random(0.05, 0.95);
                    const double v = random(0.05, 0.95);
                    const auto receiver = receiverAt(u, v, plane(u, v), gradient);
                    EXPECT_EQ(evaluate(technique, map, receiver, 0.04), 1.0)
                        << technique.name << " N " << n;
                    EXPECT_EQ(
                        renderer::cpuFilter(technique).f32(map.view(), toFloat(receiver),
                                                           toFloat(constants(technique, n, 0.04))),
                        1.0F)
                        << technique.name << " N " << n;
                }
            }
    }
}

TEST(PcfDisc, IsTheConvolutionOfNearestTexelVisibilityWithTheDisc) {
    Random random(21);
    for (int trial = 0; trial < 400; ++trial) {
        const int n = static_cast<int>(random(1, 40));
        const Map map(n, [&](double, double) { return random() < 0.5 ? 0.2 : 0.8; });
        const double u = random(-0.1, 1.1);
        const double v = random(-0.1, 1.1);
        const double radiusTexels = std::exp(random(std::log(0.05), std::log(20)));
        const double radius = std::min(radiusTexels / n, 1.0);
        double occluded = 0;
        for (int j = 0; j < n; ++j)
            for (int i = 0; i < n; ++i)
                if (map.view().at(i, j) < 0.5F)
                    occluded += tests::exactCoverage(i + 0.5 - u * n, j + 0.5 - v * n, radius * n);
        const double truth = 1 - occluded / (kPi * radius * radius * n * n);
        // The kernel's bound (disc_kernel_test.cpp), for a map that is not a half-plane.
        const double tolerance = radius * n < 3.47 ? 0.006 : 0.0015;
        EXPECT_NEAR(evaluate(disc(), map, receiverAt(u, v, 0.5), radius), truth, tolerance)
            << "N " << n << " radius " << radius * n << " texels";
    }
}

TEST(PcfDisc, RadiusZeroIsTheHardShadow) {
    Random random(2);
    const Map map(9, [&](double, double) { return random(); });
    for (int i = 0; i < 500; ++i) {
        const auto receiver = receiverAt(random(), random(), random());
        EXPECT_EQ(evaluate(disc(), map, receiver, 0),
                  evaluate(renderer::findTechnique("hard"), map, receiver, 0));
    }
}

/// A half-plane at an angle to the texel grid, lit above, as a map would hold it.
Map halfPlane(int n, double angleDeg, double phase) {
    const double s = std::sin(angleDeg * kPi / 180);
    const double c = std::cos(angleDeg * kPi / 180);
    return Map(n, [=](double u, double v) {
        return c * (v - 0.5) - s * (u - 0.5) > phase / n ? 1.0 : 0.0;
    });
}

/// max - min of V along the edge's 0.5 contour.
double edgeRipple(int n, double angleDeg, double radiusTexels, double phase) {
    const Map map = halfPlane(n, angleDeg, phase);
    const double s = std::sin(angleDeg * kPi / 180);
    const double c = std::cos(angleDeg * kPi / 180);
    const double period = 1 / s;  // of the risers, in texels along the contour
    double low = 1;
    double high = 0;
    for (double t = -0.5 * period; t < 0.5 * period; t += period / 256) {
        const double u = 0.5 + (t * c - phase * s) / n;
        const double v = 0.5 + (t * s + phase * c) / n;
        const double value = evaluate(disc(), map, receiverAt(u, v, 0.5), radiusTexels / n);
        low = std::min(low, value);
        high = std::max(high, value);
    }
    return high - low;
}

// METHODS section 8 tabulates the ripple of a straight edge at r = 3.47 a, with the limit 2 / (pi
// c).
TEST(PcfDisc, EdgeRippleAtTheStudysSlopeIsWhatTheMethodsSheetStates) {
    const double limit = 2 / (kPi * 3.47);
    for (const auto& [angle, stated] :
         {std::pair{1.0, .161}, {2.0, .140}, {3.0, .117}, {5.5, .072}}) {
        double worst = 0;
        for (const double phase : {0.13, 0.29, 0.41})  // not 0, where texel centres lie on the edge
            worst = std::max(worst, edgeRipple(256, angle, 3.47, phase));
        EXPECT_NEAR(worst, stated, 0.002) << angle;
        EXPECT_LT(worst, limit) << angle;
    }
}

// The staircase leaves at most half a ripple, 1 / (pi r / a), beside the profile.
TEST(PcfDisc, ProfileOfAStraightEdgeIsTheDiscsAtEveryN) {
    constexpr double kRadius = 0.05;
    for (const int n : {64, 128, 256, 512})
        for (const double angle : {7.0, 22.5, 37.0}) {
            const Map map = halfPlane(n, angle, 0.2);
            const double s = std::sin(angle * kPi / 180);
            const double c = std::cos(angle * kPi / 180);
            for (double x = -1.2; x <= 1.2; x += 0.05) {
                const double distance = x * kRadius + 0.2 / n;
                const double v = evaluate(
                    disc(), map, receiverAt(0.5 - s * distance, 0.5 + c * distance, 0.5), kRadius);
                EXPECT_NEAR(v, tests::discProfile(x), 1.05 / (kPi * kRadius * n))
                    << "N " << n << " angle " << angle;
            }
        }
}

// The median over sub-texel phases: a single phase may happen to be right.
TEST(Technique, ErrorFallsAsNGrows) {
    constexpr double kRadius = 0.05;
    constexpr double kAngle = 17;
    const double s = std::sin(kAngle * kPi / 180);
    const double c = std::cos(kAngle * kPi / 180);
    for (const Technique& technique : renderer::techniques()) {
        if (!technique.holds(Property::errorFallsWithN)) continue;
        double last = 1;
        for (const int n : {48, 96, 192, 384}) {
            std::vector<double> errors;
            for (const double phase : {0.03, 0.17, 0.31, 0.46, 0.58, 0.72, 0.91}) {
                const Map map = halfPlane(n, kAngle, phase);
                double sum = 0;
                int count = 0;
                for (double along = -0.2; along < 0.2; along += 0.013)
                    for (double x = -1.19; x < 1.2; x += 0.05, ++count) {
                        const double distance = x * kRadius + phase / n;
                        const double v = evaluate(technique, map,
                                                  receiverAt(0.5 + along * c - s * distance,
                                                             0.5 + along * s + c * distance, 0.5),
                                                  kRadius);
                        const double truth =
                            technique.soft ? tests::discProfile(x) : (x > 0 ? 1 : 0);
                        sum += (v - truth) * (v - truth);
                    }
                errors.push_back(std::sqrt(sum / count));
            }
            std::nth_element(errors.begin(), errors.begin() + 3, errors.end());
            EXPECT_LT(errors[3], 0.95 * last) << technique.name << " N " << n;
            last = errors[3];
        }
    }
}

}  // namespace
