// SPDX-License-Identifier: MIT
// What METHODS section 6 promises of every technique, over random maps and receivers: 100,000
// receivers for each technique and precision and promise, from fixed seeds. No GPU.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "tests/renderer/exact_technique.h"
#include "tests/renderer/technique_case.h"

namespace {

using renderer::Property;
using renderer::Storage;
using renderer::Technique;
using tests::constantsFor;
using tests::CpuTechnique;
using tests::Random;
using tests::receiverAt;
using Map = tests::DepthMap;

// Instrumented code does a tenth.
#ifdef __SANITIZE_ADDRESS__
constexpr int kShare = 10;
#else
constexpr int kShare = 1;
#endif
constexpr int kMaps = 1000 / kShare;
constexpr int kReceivers = 100;  // over each map

/// Rounding to 11 bits may take moments out of the possible ones, where no bound is left.
bool halvesBreak(const Technique& technique) {
    return technique.fileName() == "msm" || technique.fileName() == "msm16";
}

/// Runs a claim over all three precisions. The slack is what rounding of the reconstruction may do
/// to it.
template <class Claim>
void atEveryPrecision(const Technique& technique, const Claim& claim) {
    claim.template operator()<double>(Storage::exact, 1e-9);
    const bool noisy = technique.fileName() == "msm" || technique.fileName() == "msm16";
    claim.template operator()<float>(Storage::asFormat, noisy ? 0.03 : 1e-4);
    if (!halvesBreak(technique)) claim.template operator()<float>(Storage::half, 1e-4);
}

/// Parameters anywhere in their ranges, ends included.
renderer::ParameterValues randomParameters(const Technique& technique, Random& random) {
    renderer::ParameterValues values = technique.standardParameters();
    for (std::size_t i = 0; i < technique.parameters.size(); ++i) {
        const renderer::TechniqueParameter& parameter = technique.parameters[i];
        const double low = static_cast<double>(parameter.low);
        const double high = static_cast<double>(parameter.high);
        const double where = random();
        if (where < 0.5) continue;
        const double value = where < 0.6 ? low : (where < 0.7 ? high : random(low, high));
        values[i] = static_cast<float>(parameter.whole ? std::round(value) : value);
    }
    return values;
}

// 100,000 receivers per technique and precision, most of them hostile, over 1,000 maps and
// parameters.
template <class Real>
void expectUnitRange(const Technique& technique, Storage storage) {
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    constexpr double kOdd[] = {0,    1,     -1, 0.5,  1e-30,     -1e-30,
                               1e30, -1e30, 2,  kNan, kInfinity, -kInfinity};
    Random random(11);
    const auto number = [&] {
        return random() < 0.7 ? random(-0.2, 1.2) : kOdd[random.whole(0, 11)];
    };
    for (int trial = 0; trial < 1000 / kShare; ++trial) {
        const int n = random() < 0.2 ? 1 : random.whole(2, 9);
        const bool clean = random() < 0.5;
        const Map map(n, [&](double, double) { return clean ? random() : number(); });
        const double radius = random() < 0.8 ? random(0, 2.5 / n) : std::abs(number());
        auto constants = constantsFor(technique, n, radius, randomParameters(technique, random));
        if (random() < 0.3) constants.kernel.y = number();
        const CpuTechnique<Real> filter(technique, map, constants, storage);
        for (int i = 0; i < 100; ++i) {
            auto receiver = receiverAt(number(), number(), number(), {number(), number()});
            receiver.footprintUv = number();
            const double visibility = filter(receiver);
            ASSERT_TRUE(visibility >= 0 && visibility <= 1)
                << technique.name << " trial " << trial << ": " << visibility;
        }
    }
}

TEST(TechniqueProperty, AnyInputGivesANumberInTheUnitRange) {
    for (const Technique& technique : renderer::techniques()) {
        expectUnitRange<double>(technique, Storage::exact);
        expectUnitRange<float>(technique, Storage::asFormat);
        expectUnitRange<float>(technique, Storage::half);
    }
}

// What was stored may be anything, as after a driver's error or in a map of another technique.
template <class Real>
void expectUnitRangeOfAnyTexel(const Technique& technique) {
    Random random(12);
    const auto constants = [&] {
        const auto wide = constantsFor(technique, 1, 0, randomParameters(technique, random));
        if constexpr (std::is_same_v<Real, float>)
            return tests::toFloat(wide);
        else
            return wide;
    };
    for (int trial = 0; trial < 100000 / kShare; ++trial) {
        const auto shadow = constants();
        renderer::CpuMap<Real> map;
        map.edge = filteredEdge(shadow);
        glm::vec<4, Real> texel;
        for (int i = 0; i < 4; ++i) {
            const double exponent = random(-40, 38);
            const double odd = random() < 0.5 ? std::pow(10.0, exponent)
                                              : std::numeric_limits<double>::quiet_NaN();
            texel[i] = static_cast<Real>(random() < 0.8 ? random(-1, 1) : odd);
        }
        constexpr int kMostLayers = renderer::kMostLayers;
        const auto texels = static_cast<std::size_t>(kMostLayers * map.edge * map.edge);
        map.texels.assign(texels, texel);
        map.sums.assign(texels,
                        glm::uvec4(random.whole(0, 1 << 30), random.whole(0, 1 << 30), 0, 0));
        const auto wide = receiverAt(0.5, 0.5, random(-0.1, 1.1), {random(-2, 2), random(-2, 2)});
        double visibility;
        if constexpr (std::is_same_v<Real, float>)
            visibility = static_cast<double>(
                renderer::cpuVisibility(technique, map, tests::toFloat(wide), shadow));
        else
            visibility = renderer::cpuVisibility(technique, map, wide, shadow);
        ASSERT_TRUE(visibility >= 0 && visibility <= 1)
            << technique.name << " trial " << trial << ": " << visibility;
    }
}

TEST(TechniqueProperty, AnyStoredTexelGivesANumberInTheUnitRange) {
    for (const Technique& technique : renderer::techniques()) {
        if (technique.prefilter == renderer::Prefilter::none) continue;
        expectUnitRangeOfAnyTexel<double>(technique);
        expectUnitRangeOfAnyTexel<float>(technique);
    }
}

TEST(TechniqueProperty, FartherReceiversAreNeverLighter) {
    for (const Technique& technique : renderer::techniques()) {
        if (!technique.holds(Property::monotoneInDepth)) continue;
        atEveryPrecision(technique, [&]<class Real>(Storage storage, double slack) {
            Random random(5);
            for (int trial = 0; trial < kMaps; ++trial) {
                const Map map(12, [&](double, double) { return random(); });
                const double u = random();
                const double v = random();
                const CpuTechnique<Real> filter(
                    technique, map, constantsFor(technique, 12, random(0, 0.4)), storage);
                const glm::dvec2 gradient(random(-1, 1), random(-1, 1));
                double last = 1;
                for (int i = 0; i < kReceivers; ++i) {
                    const double depth = -0.2 + 1.4 * i / kReceivers;
                    const double now = filter(receiverAt(u, v, depth, gradient));
                    ASSERT_LE(now, last + slack) << technique.name << " trial " << trial;
                    last = std::min(now, last);
                }
            }
        });
    }
}

/// Of the box that holds the whole map, three quarters of its rim.
double radiusOfAll(int edge) {
    return (0.5 * edge - 0.25) / edge * 2 / std::sqrt(3.0);
}

/// Share of a kernel that lies at a depth or behind it.
class LitShare {
  public:
    explicit LitShare(const tests::Distribution& all) {
        for (std::size_t i = 0; i < all.depths.size(); ++i)
            fromNear_.emplace_back(all.depths[i], all.weights[i]);
        std::sort(fromNear_.begin(), fromNear_.end());
        long double sum = 0;
        for (auto last = fromNear_.rbegin(); last != fromNear_.rend(); ++last)
            last->second = sum += last->second;
    }
    double operator()(double depth) const {
        const auto first =
            std::lower_bound(fromNear_.begin(), fromNear_.end(), depth,
                             [](const auto& entry, double sought) { return entry.first < sought; });
        return first == fromNear_.end() ? 0 : static_cast<double>(first->second);
    }

  private:
    std::vector<std::pair<long double, long double>> fromNear_;  // depth, weight from there on
};

/// In double and float, with exact storage: rounded moments are those of no depths. Kernels of any
/// width, on the texels' centres and off them, over the map's edge too.
void expectNoDarkerThanTheKernel(const Technique& technique,
                                 const renderer::ParameterValues& parameters, double floatSlack) {
    const auto check = [&]<class Real>(double slack) {
        Random random(6);
        constexpr int kEdge = 9;
        for (int trial = 0; trial < kMaps; ++trial) {
            const double radius = random() < 0.3 ? radiusOfAll(kEdge) : random(0, 0.7);
            const auto constants = constantsFor(technique, kEdge, radius, parameters);
            const int depths = random.whole(1, 81);
            const Map map(kEdge, [&](double, double) {
                return depths > 4 ? random() : 0.1 + 0.2 * random.whole(0, depths - 1);
            });
            const CpuTechnique<Real> filter(technique, map, constants, Storage::exact);
            const auto place = [&](bool centre) {
                return centre ? (random.whole(0, kEdge - 1) + 0.5) / kEdge : random();
            };
            const bool centre = random() < 0.3;
            const double u = place(centre);
            const double v = place(centre);
            const LitShare litShare(
                depthsUnderTheKernel(technique, map, receiverAt(u, v, 0.5), constants));
            for (int i = 0; i < kReceivers; ++i) {
                const double depth = random();
                ASSERT_GE(filter(receiverAt(u, v, depth)), litShare(depth) - slack)
                    << technique.name << " trial " << trial << " radius " << radius << " at " << u
                    << ' ' << v << " depth " << depth;
            }
        }
    };
    check.template operator()<double>(1e-6);  // the kernel's reach is a float
    check.template operator()<float>(floatSlack);
}

// Chebyshev's and Markov's inequalities, on the depths under the kernel.
TEST(TechniqueProperty, UpperBoundsAreNoLessThanTheLitShareOfTheKernel) {
    for (const std::string_view name : {"vsm", "vsm16", "vsm_split", "vsm_sat", "vsm_mip",
                                        "vsm_samples", "esm", "esm16", "evsm2", "evsm4", "lvsm"}) {
        const Technique& technique = renderer::findTechnique(name);
        expectNoDarkerThanTheKernel(technique, technique.standardParameters(), 1e-4);
    }
}

TEST(TechniqueProperty, MomentsShadowNoMoreThanIsInShadow) {
    const Technique& technique = renderer::findTechnique("msm");
    renderer::ParameterValues parameters = technique.standardParameters();
    setParameter(technique, parameters, "moment_bias", 0);
    // Without the bias, float32 moments of few depths are noise (docs/results/technique-errors.md).
    expectNoDarkerThanTheKernel(technique, parameters, 1);
}

/// Share of the texels under the box of radiusOfAll() over a map's middle that lie at `depth` or
/// behind it: LitShare there, without its list of depths for each of 100,000 maps.
double litShareOfAll(const Map& map, double depth) {
    const auto weight = [&](int i) { return i % (map.edge - 1) == 0 ? 0.75 : 1; };
    double lit = 0;
    for (int j = 0; j < map.edge; ++j)
        for (int i = 0; i < map.edge; ++i)
            if (static_cast<double>(map.view().at(i, j)) >= depth)
                lit += weight(i) * weight(j) / ((map.edge - 0.5) * (map.edge - 0.5));
    return lit;
}

// Donnelly and Lauritzen 2006, section 3.1: for one occluder over a parallel receiver the bound is
// the share itself.
TEST(TechniqueProperty, VarianceOfAPlanarOccluderOverAPlanarReceiverIsPcf) {
    const Technique& vsm = renderer::findTechnique("vsm");
    renderer::ParameterValues parameters = vsm.standardParameters();
    setParameter(vsm, parameters, "least_variance", 0);
    setParameter(vsm, parameters, "derivative", 0);
    constexpr int kEdge = 5;
    const auto constants = constantsFor(vsm, kEdge, radiusOfAll(kEdge), parameters);
    const auto check = [&]<class Real>(double slack) {
        Random random(8);
        for (int trial = 0; trial < 100000 / kShare; ++trial) {
            const double occluder = random(0, 0.8);
            const double plane = random(occluder + 0.1, 0.95);
            const double share = random();
            const Map map(kEdge,
                          [&](double, double) { return random() < share ? occluder : plane; });
            const CpuTechnique<Real> filter(vsm, map, constants, Storage::exact);
            const double found = filter(receiverAt(0.5, 0.5, plane));
            // The map holds floats: the plane may be stored a rounding step before the receiver.
            ASSERT_NEAR(found, litShareOfAll(map, plane - 1e-7), slack) << "trial " << trial;
        }
    };
    // The receiver's depth error, 2e-6, over the least distance and the least share in shadow; and
    // the cancellation in the mean square, 2^-23 over the square of that distance.
    check.template operator()<double>(1e-4);
    check.template operator()<float>(1e-3);
}

TEST(TechniqueProperty, PlanesDoNotShadowThemselvesAtAnyTilt) {
    for (const Technique& technique : renderer::techniques()) {
        if (!technique.holds(Property::planeLit)) continue;
        const auto check = [&]<class Real>(Storage storage, double widest, double darkening) {
            Random random(9);
            for (int trial = 0; trial < kMaps; ++trial) {
                const int n = widest < 0.02 ? random.whole(64, 96) : random.whole(8, 24);
                const double radius = random(0, widest);
                const double tilt = random() < 0.1 ? 0 : random(0, 0.6);
                const double turn = random(0, 6.2832);
                const glm::dvec2 gradient(tilt * std::cos(turn), tilt * std::sin(turn));
                const auto plane = [&](double u, double v) {
                    return 0.5 + gradient.x * (u - 0.5) + gradient.y * (v - 0.5);
                };
                const Map map(n, plane);
                const CpuTechnique<Real> filter(technique, map, constantsFor(technique, n, radius),
                                                storage);
                // Away from the rim, beyond which nothing is in the way: not the plane.
                const double rim = 0.1 + 1.0 / n;
                for (int i = 0; i < kReceivers; ++i) {
                    const double u = random(rim, 1 - rim);
                    const double v = random(rim, 1 - rim);
                    ASSERT_GE(filter(receiverAt(u, v, plane(u, v), gradient)), 1 - darkening)
                        << technique.name << " N " << n << " radius " << radius << " tilt " << tilt;
                }
            }
        };
        // In halves the default biases of the 32-bit formats are too small: not promised.
        // The built-in scenes' kernels are no wider than .0115 of their maps, which have hundreds
        // of texels.
        constexpr double kHardlySeen = 0.05;
        const auto most = static_cast<double>(technique.steepDarkening);
        for (const auto& [widest, darkening] :
             {std::pair{0.06, most}, std::pair{0.0125, std::min(most, kHardlySeen)}}) {
            check.template operator()<double>(Storage::exact, widest, darkening);
            check.template operator()<float>(Storage::asFormat, widest, darkening);
        }
    }
}

// A grazing light: the plane goes through all of the map's depths in a few texels.
TEST(TechniqueProperty, SteepPlanesDoNotShadowThemselvesUnderCompares) {
    for (const char* name : {"pcf_disc", "gsm"}) {
        const Technique& technique = renderer::findTechnique(name);
        const auto check = [&]<class Real>(Storage storage) {
            Random random(10);
            for (int trial = 0; trial < kMaps / 20; ++trial) {
                constexpr int kEdge = 128;
                const double radius = random(0, 0.01);
                const double tilt = random(4, 12);
                const double turn = random(0, 6.2832);
                const glm::dvec2 gradient(tilt * std::cos(turn), tilt * std::sin(turn));
                const auto plane = [&](double u, double v) {
                    return 0.5 + gradient.x * (u - 0.5) + gradient.y * (v - 0.5);
                };
                const Map map(kEdge, plane);
                const CpuTechnique<Real> filter(technique, map,
                                                constantsFor(technique, kEdge, radius), storage);
                // As far as kernels see depths within the map's range.
                const double reach = (0.5 / 12 - 0.01 - 1.5 / kEdge) / std::numbers::sqrt2;
                for (int i = 0; i < kReceivers; ++i) {
                    const double u = 0.5 + random(-reach, reach);
                    const double v = 0.5 + random(-reach, reach);
                    ASSERT_GE(filter(receiverAt(u, v, plane(u, v), gradient)), 1 - 1e-5)
                        << name << " radius " << radius << " tilt " << tilt;
                }
            }
        };
        check.template operator()<double>(Storage::exact);
        check.template operator()<float>(Storage::asFormat);
    }
}

// A hollow mesh or rolling ground: along a crease the texel that holds a receiver may have its
// centre on the next facet, nearer to the light than the receiver's plane. Slopes that differ by up
// to half of the lesser are the mesh's, not an occluder.
TEST(TechniqueProperty, FacetsOfHollowSurfacesDoNotShadowEachOther) {
    for (const char* name : {"hard", "pcss"}) {
        const Technique& technique = renderer::findTechnique(name);
        const auto check = [&]<class Real>(Storage storage) {
            Random random(13);
            for (int trial = 0; trial < kMaps; ++trial) {
                const int n = random.whole(8, 64);
                const double turn = random(0, 6.2832);
                const glm::dvec2 slope =
                    random(0.1, 0.6) * glm::dvec2(std::cos(turn), std::sin(turn));
                const double most = 0.5 * (std::abs(slope.x) + std::abs(slope.y)) / 1.5;
                const double share = random();
                const glm::dvec2 change(most * share * (random() < 0.5 ? 1 : -1),
                                        most * (1 - share) * (random() < 0.5 ? 1 : -1));
                const glm::dvec2 crease(0.5 + random(-0.5, 0.5) / n, 0.5 + random(-0.5, 0.5) / n);
                const auto gradientAt = [&](glm::dvec2 uv) {
                    return glm::dot(change, uv - crease) < 0 ? slope + change : slope;
                };
                const auto depth = [&](double u, double v) {
                    const glm::dvec2 uv(u, v);
                    return 0.5 + glm::dot(slope, uv - crease) +
                           std::min(glm::dot(change, uv - crease), 0.0);
                };
                const Map map(n, depth);
                // A penumbra so narrow that PCSS, too, comes down to one texel.
                const CpuTechnique<Real> filter(technique, map, constantsFor(technique, n, 0.002),
                                                storage);
                for (int i = 0; i < kReceivers; ++i) {
                    const glm::dvec2 uv(random(0.2, 0.8), random(0.2, 0.8));
                    ASSERT_EQ(filter(receiverAt(uv.x, uv.y, depth(uv.x, uv.y), gradientAt(uv))), 1)
                        << name << " N " << n << " at " << uv.x << ", " << uv.y;
                }
            }
        };
        check.template operator()<double>(Storage::exact);
        check.template operator()<float>(Storage::asFormat);
    }
}

}  // namespace
