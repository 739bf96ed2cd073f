// SPDX-License-Identifier: MIT
// What the GPU (or its software stand-in) draws, against closed forms and against the CPU.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <vector>

#include "renderer/cpu_filter.h"
#include "renderer/renderer.h"
#include "tests/headless_gl.h"
#include "tests/renderer/cpu_image.h"
#include "tests/renderer/edge_scene.h"
#include "tests/renderer/exact_disc.h"
#include "tests/renderer/image_check.h"

namespace {

using renderer::FloatImage;
using renderer::FrameSettings;
using renderer::ParameterValues;
using renderer::Technique;
using testing::HasSubstr;
using tests::gl;
namespace f64 = renderer::f64;

constexpr double kPi = std::numbers::pi;

const Technique* disc() {
    return &renderer::findTechnique("pcf_disc");
}

/// For what is repeated with every technique: all scenes would take minutes.
constexpr const char* kTechniqueScenes[] = {"planar_occluder", "yard"};

TEST(HeadlessContext, IsOpenGl45) {
    EXPECT_FALSE(gl().renderer.empty());
    EXPECT_THAT(gl().platform, HasSubstr("EGL"));
    EXPECT_GE(gl().maxResolution, 8192);
    RecordProperty("renderer", gl().renderer);
}

TEST(DepthPass, PlateAndGroundHaveTheirAnalyticDepth) {
    const float turn = 11;
    const renderer::Sun sun{.azimuthDeg = 30, .elevationDeg = 55};
    renderer::Renderer frame(gl(), tests::edgeScene(turn, sun), 64, 36);
    frame.setWindowFit(renderer::WindowFit::casters);
    for (const int n : {64, 257, 1024}) {
        frame.render({.technique = disc(), .resolution = n, .radiusUv = 0.01F});
        const FloatImage map = frame.readShadowMap();
        ASSERT_EQ(map.width, n);
        const glm::dmat4& m = frame.window().shadowFromWorld;
        const glm::dmat4 worldFromShadow = glm::inverse(m);
        // Depth on a horizontal plane of that height at a place on the map.
        const auto depthAt = [&](double u, double v, double height) {
            const double zero = (worldFromShadow * glm::dvec4(u, v, 0, 1)).y;
            const double one = (worldFromShadow * glm::dvec4(u, v, 1, 1)).y;
            return (height - zero) / (one - zero);
        };
        const glm::dmat4 plateFromWorld = glm::inverse(glm::dmat4(tests::plateTurn(turn)));
        int plateTexels = 0;
        for (int j = 0; j < n; ++j)
            for (int i = 0; i < n; ++i) {
                const double u = (i + 0.5) / n;
                const double v = (j + 0.5) / n;
                const double plateDepth = depthAt(u, v, tests::kPlateHeight);
                const glm::dvec4 onPlate =
                    plateFromWorld * worldFromShadow * glm::dvec4(u, v, plateDepth, 1);
                const double edge =
                    std::max(std::abs(onPlate.x), std::abs(onPlate.z)) - tests::kPlateHalfWidth;
                const double texelM = frame.window().extentM / n;
                if (std::abs(edge) < 2 * texelM) continue;  // the rasteriser decides there
                const double expected =
                    edge < 0 ? plateDepth : std::clamp(depthAt(u, v, 0), 0.0, 1.0);
                // float32 depth, and vertices snapped to 1/256 texel on planes that fall by up
                // to 1.4 a map edge.
                EXPECT_NEAR(map.at(i, j), expected, 1e-6 + 1.4 / 256 / n) << i << " " << j;
                plateTexels += edge < 0 ? 1 : 0;
            }
        EXPECT_GT(plateTexels, n * n / 5);
    }
}

TEST(DepthPass, MapInACornerOfALargerTextureIsTheSameMap) {
    renderer::Renderer frame(gl(), renderer::makeScene("yard"), 160, 90);
    const FrameSettings settings{.technique = disc(), .resolution = 200, .radiusUv = 0.01F};
    frame.render(settings);
    const FloatImage map = frame.readShadowMap();
    const FloatImage visibility = frame.readVisibility();
    EXPECT_EQ(frame.mapBytes(), 200U * 200U * 4U);
    frame.reserveMap(512);
    frame.render(
        {.technique = disc(), .resolution = 512, .radiusUv = 0.01F});  // leaves its depths behind
    frame.render(settings);
    EXPECT_EQ(frame.mapBytes(), 512U * 512U * 4U);
    EXPECT_EQ(frame.readShadowMap().values, map.values);
    EXPECT_EQ(frame.readVisibility().values, visibility.values);
}

TEST(Lookup, GpuAgreesWithCpuOnTheSameMap) {
    bool first = true;
    for (const auto& entry : renderer::builtInScenes()) {
        renderer::Renderer frame(gl(), renderer::makeScene(entry.name), 120, 68);
        frame.setLamps({});  // lamp_frame_test.cpp has theirs
        const double softness = frame.scene().softnessM / frame.window().extentM;
        std::vector<std::pair<int, double>> maps = {{64, softness}};
        if (first) maps.insert(maps.end(), {{1, 0.3}, {40, 0.0}, {24, 1.0}});
#ifdef __SANITIZE_ADDRESS__
        if (!first) break;  // a scene takes a minute there
#else
        maps.insert(maps.end(), {{333, softness}, {1024, softness}});
#endif
        first = false;
        for (const Technique& technique : renderer::techniques())
            for (const auto& [n, radius] : maps) {
                const bool filtered = technique.prefilter != renderer::Prefilter::none;
                if (filtered && n == 1024) continue;  // seconds each; 333 shows the same
                frame.render({.technique = &technique,
                              .resolution = n,
                              .radiusUv = static_cast<float>(radius),
                              .filterOutsidePenumbrae = true});
                const FloatImage gpu = frame.readVisibility();
                tests::expectImagesAgree(std::string(entry.name) + "_" +
                                             std::string(technique.name) + "_" + std::to_string(n),
                                         gpu, tests::cpuImage(frame, technique),
                                         tests::limitsAgainstCpu(technique, radius * n));
            }
    }
}

// Every value of the parameters that choose between formulas, one at a time.
TEST(Lookup, GpuAgreesWithCpuInEveryWayToReadTheMap) {
    renderer::Renderer frame(gl(), renderer::makeScene("yard"), 120, 68);
    const auto radius = static_cast<float>(frame.scene().softnessM / frame.window().extentM);
    constexpr int kN = 64;
    int ways = 0;
    for (const Technique& technique : renderer::techniques())
        for (const renderer::TechniqueParameter& parameter : technique.parameters) {
            if (!parameter.whole || parameter.high > 4) continue;
            for (float value = parameter.low; value <= parameter.high; ++value, ++ways) {
                renderer::ParameterValues parameters = technique.standardParameters();
                setParameter(technique, parameters, parameter.name, value);
                frame.render({.technique = &technique,
                              .parameters = parameters,
                              .resolution = kN,
                              .radiusUv = radius,
                              .filterOutsidePenumbrae = true});
                const FloatImage gpu = frame.readVisibility();
                const FloatImage cpu = tests::cpuImage(frame, technique);
                tests::expectImagesAgree(
                    std::string(technique.name) + "_" + std::string(parameter.name) + "_" +
                        std::to_string(static_cast<int>(value)),
                    gpu, cpu, tests::limitsAgainstCpu(technique, static_cast<double>(radius) * kN));
            }
        }
    EXPECT_GT(ways, 30);
}

// Up to 128 texels along the edge every one is counted. The second frame has the first one's count,
// of the same map.
TEST(Layers, LieWhereTheDepthsOfTheMapAreAndFollowTheScene) {
    renderer::Renderer frame(gl(), renderer::makeScene("yard"), 16, 9);
    for (const char* name : {"lvsm", "power_cdf"}) {
        const Technique& technique = renderer::findTechnique(name);
        renderer::ParameterValues parameters = technique.standardParameters();
        setParameter(technique, parameters, "layers", 0);
        const FrameSettings settings{.technique = &technique,
                                     .parameters = parameters,
                                     .resolution = 100,
                                     .radiusUv = 0.01F};
        for (const char* scene : {"yard", "planar_occluder", "planar_occluder"}) {
            frame.setScene(renderer::makeScene(scene));
            frame.render(settings);
            const FloatImage depths = frame.readShadowMap();
            const auto histogram = renderer::depthHistogram({depths.values.data(), depths.width});
            renderer::f32::ShadowConstants expected = frame.shadowConstants();
            useLayers(technique, placeLayers(technique, parameters, histogram), expected);
            EXPECT_EQ(expected.layerEnds[0], frame.shadowConstants().layerEnds[0]) << scene;
            EXPECT_EQ(expected.parameters[0], frame.shadowConstants().parameters[0]) << scene;
            EXPECT_EQ(expected.parameters[1], frame.shadowConstants().parameters[1]) << scene;
        }
    }
}

// Largest value that a technique stores, and what one rounding to its format may move it by.
double stepOf(const Technique& technique, double largest) {
    using renderer::MapFormat;
    switch (technique.format) {
        case MapFormat::r16f:
        case MapFormat::rg16f:
        case MapFormat::rgba16f:
            return std::exp2(std::ceil(std::log2(largest))) / 2048;
        case MapFormat::rg16fSplit:
            return 1;  // a high part may fall to the neighbouring step; checked joined below
        case MapFormat::rgba16:
            return 1.0 / 65535;
        default:
            return largest * 2e-6;  // float32 sums of up to 50 taps in another order
    }
}

// Two roundings to 16 bits may fall the other way in each of the three passes.
TEST(MapFilter, GpuAgreesWithCpuTexelForTexel) {
    renderer::Renderer frame(gl(), renderer::makeScene("yard"), 16, 9);
    for (const Technique& technique : renderer::techniques()) {
        if (technique.prefilter == renderer::Prefilter::none) continue;
        for (const auto& [n, radius] :
             {std::pair{100, 0.01F}, {48, 0.05F}, {1, 0.3F}, {40, 0.0F}, {24, 1.0F}}) {
            for (const float gaussian : {0.0F, 1.0F}) {
                renderer::ParameterValues parameters = technique.standardParameters();
                if (technique.parameterSlot("gaussian"))
                    setParameter(technique, parameters, "gaussian", gaussian);
                else if (gaussian == 1)
                    continue;
                frame.render({.technique = &technique,
                              .parameters = parameters,
                              .resolution = n,
                              .radiusUv = radius});
                const FloatImage depths = frame.readShadowMap();
                const renderer::CpuMap<float> gpu = tests::mapOf(depths, frame.readFilteredMap());
                const renderer::f32::ShadowConstants& shadow = frame.shadowConstants();
                const auto cpu = renderer::cpuMap<float>(technique, gpu.depths, shadow);
                ASSERT_EQ(gpu.texels.size(), cpu.texels.size()) << technique.name;
                ASSERT_EQ(gpu.sums.size(), cpu.sums.size()) << technique.name;
                // Depths in whole units are exact; their squares may be rounded the
                // other way.
                for (std::size_t i = 0; i < cpu.sums.size(); ++i) {
                    ASSERT_EQ(gpu.sums[i].x, cpu.sums[i].x) << technique.name << " N " << n;
                    const auto off = static_cast<std::int32_t>(gpu.sums[i].y - cpu.sums[i].y);
                    ASSERT_LE(std::abs(off), static_cast<int>(cpu.sums.size())) << technique.name;
                }
                double largest = 0;
                double worst = 0;
                const bool split = technique.format == renderer::MapFormat::rg16fSplit;
                const int channels = split ? 2 : 4;
                for (std::size_t i = 0; i < cpu.texels.size(); ++i) {
                    const glm::vec4 found = unpackedTexel(gpu.texels[i], shadow);
                    const glm::vec4 expected = unpackedTexel(cpu.texels[i], shadow);
                    for (int k = 0; k < channels; ++k) {
                        if (renderer::bytesPerTexel(technique.format) <= 8 && !split && k >= 2 &&
                            technique.format != renderer::MapFormat::rgba16 &&
                            technique.format != renderer::MapFormat::rgba16f)
                            continue;  // not stored
                        if (k >= 1 && (technique.format == renderer::MapFormat::r32f ||
                                       technique.format == renderer::MapFormat::r16f))
                            continue;
                        largest = std::max(largest, std::abs(static_cast<double>(expected[k])));
                        worst = std::max(worst, std::abs(static_cast<double>(found[k]) -
                                                         static_cast<double>(expected[k])));
                    }
                }
                const double step = split ? 0x1p-19 : stepOf(technique, largest);
                EXPECT_LE(worst, 3 * step) << technique.name << " N " << n << " radius " << radius
                                           << " gaussian " << gaussian;
            }
        }
    }
}

/// The texels of a map without its guard band, layer after layer, each in its own linear measure:
/// exponentials as shares of the greatest one.
template <class Map>
std::vector<glm::dvec4> texelsOf(const Technique& technique, const ParameterValues& parameters,
                                 const Map& map, const f64::ShadowConstants& shadow, int n) {
    std::vector<glm::dvec4> texels;
    const int guard = (map.edge - n) / 2;
    for (int layer = 0; layer < technique.mapLayers(parameters); ++layer)
        for (int y = guard; y < guard + n; ++y)
            for (int x = guard; x < guard + n; ++x) {
                const auto at = [&](int column, int row) {
                    return static_cast<std::size_t>((layer * map.edge + row) * map.edge + column);
                };
                if (technique.prefilter == renderer::Prefilter::sums) {
                    const glm::uvec4 units = map.sums[at(x, y)] - map.sums[at(x - 1, y)] -
                                             map.sums[at(x, y - 1)] + map.sums[at(x - 1, y - 1)];
                    texels.push_back(glm::dvec4(units) / -shadow.prefilter.w);
                    continue;
                }
                glm::dvec4 texel = unpackedTexel(glm::dvec4(map.texels[at(x, y)]), shadow);
                if (technique.prefilter == renderer::Prefilter::logMean)
                    texel.x =
                        std::exp(texel.x - static_cast<double>(
                                               parameters[*technique.parameterSlot("exponent")]));
                texels.push_back(texel);
            }
    return texels;
}

constexpr int kSampledN = 32, kParts = 8;  // texels, and parts of each along an edge

ParameterValues sampledParameters(const Technique& technique, float mapSamples) {
    ParameterValues parameters = technique.standardParameters();
    setParameter(technique, parameters, "map_samples", mapSamples);
    // The slope within a texel is another one in a part of it.
    if (technique.parameterSlot("derivative")) setParameter(technique, parameters, "derivative", 0);
    if (technique.parameterSlot("layers")) setParameter(technique, parameters, "layers", 2);
    // Of a steeper one 16 bits round off more than several samples tell.
    if (technique.parameterSlot("exponent")) setParameter(technique, parameters, "exponent", 8);
    return parameters;
}

std::vector<glm::dvec4> drawnTexels(renderer::Renderer& frame, const Technique& technique,
                                    float mapSamples) {
    const ParameterValues parameters = sampledParameters(technique, mapSamples);
    frame.render({.technique = &technique, .parameters = parameters, .resolution = kSampledN});
    return texelsOf(technique, parameters, frame.readFilteredMap(),
                    renderer::toDouble(frame.shadowConstants()), kSampledN);
}

/// Of the frame's last map: each texel the mean over its parts, from the depths of a finer map.
std::vector<glm::dvec4> meanTexels(const renderer::Renderer& frame, const Technique& technique,
                                   const FloatImage& depths) {
    f64::ShadowConstants finer = renderer::toDouble(frame.shadowConstants());
    finer.map.x = depths.width;
    finer.map.y = 1.0 / depths.width;
    const auto parts =
        texelsOf(technique, sampledParameters(technique, 1),
                 renderer::cpuMap<double>(technique, {depths.values.data(), depths.width}, finer,
                                          renderer::Storage::exact),
                 finer, depths.width);
    constexpr std::size_t kN = kSampledN;
    std::vector<glm::dvec4> means(parts.size() / (kParts * kParts), glm::dvec4(0));
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const std::size_t row = i / (kN * kParts), column = i % (kN * kParts);
        means[row / kParts * kN + column / kParts] += parts[i] / double{kParts * kParts};
    }
    return means;
}

glm::dvec4 rmsDifference(const std::vector<glm::dvec4>& a, const std::vector<glm::dvec4>& b) {
    glm::dvec4 squares(0);
    for (std::size_t i = 0; i < a.size(); ++i) squares += (a[i] - b[i]) * (a[i] - b[i]);
    return glm::sqrt(squares / static_cast<double>(a.size()));
}

// Four samples in place of one know a texel's share to about a quarter of it. Whatever is stored of
// a depth.
TEST(MapFilter, SeveralSamplesOfATexelKnowTheShareThatIsCovered) {
    renderer::Renderer frame(gl(), tests::edgeScene(11, {.azimuthDeg = 30, .elevationDeg = 55}), 16,
                             9);
    frame.setWindowFit(renderer::WindowFit::casters);
    GLint most = 0;
    glGetIntegerv(GL_MAX_DEPTH_TEXTURE_SAMPLES, &most);
    ASSERT_GE(most, 4);
    frame.render({.technique = disc(), .resolution = kSampledN * kParts});
    const FloatImage depths = frame.readShadowMap();
    int rows = 0;
    for (const Technique& technique : renderer::techniques()) {
        if (!technique.parameterSlot("map_samples")) continue;
        ++rows;
#ifdef __SANITIZE_ADDRESS__
        if (rows % 4 != 1) continue;  // all of them take a minute there
#endif
        const auto one = drawnTexels(frame, technique, 1);
        const auto four = drawnTexels(frame, technique, 4);
        const auto mean = meanTexels(frame, technique, depths);
        ASSERT_EQ(one.size(), mean.size());
        const glm::dvec4 errorOfOne = rmsDifference(one, mean);
        const glm::dvec4 errorOfFour = rmsDifference(four, mean);
        // A least and a greatest are no means.
        const bool bounds = technique.prefilter == renderer::Prefilter::minMaxMean;
        const bool split = technique.format == renderer::MapFormat::rg16fSplit;
        const int channels = bounds ? 1 : split ? 2 : renderer::channelsOf(technique.format);
        for (int channel = 0; channel < channels; ++channel)
            EXPECT_LT(errorOfFour[channel], 0.6 * errorOfOne[channel])
                << technique.name << ", channel " << channel;
        for (std::size_t i = 0; bounds && i < four.size(); ++i) {
            ASSERT_LE(four[i].y, four[i].x + 1e-3) << technique.name;
            ASSERT_GE(four[i].z, four[i].x - 1e-3) << technique.name;
        }
    }
    EXPECT_GE(rows, 16);
    const Technique& vsm = renderer::findTechnique("vsm");
    if (most < 16) {
        EXPECT_THROW(drawnTexels(frame, vsm, 16), std::invalid_argument);
        EXPECT_NO_THROW(drawnTexels(frame, vsm, 1)) << "and it goes on working";
    }
}

bool isSeparable(const Technique& technique) {
    return technique.prefilter == renderer::Prefilter::mean ||
           technique.prefilter == renderer::Prefilter::logMean ||
           technique.prefilter == renderer::Prefilter::minMaxMean;
}

// Bit for bit, though the texture holds another sun's map wherever nothing was filtered.
TEST(MapFilter, LeavingOutWhatIsNotSeenChangesNoPixel) {
    bool left = false;
    for (const char* scene : {"yard", "terrain"}) {
        renderer::Renderer frame(gl(), renderer::makeScene(scene), 120, 68);
        const renderer::Sun sun = frame.scene().sun;
        renderer::Sun other = sun;
        other.azimuthDeg += 70;
        for (const Technique& technique : renderer::techniques()) {
            renderer::ParameterValues parameters = technique.standardParameters();
            if (technique.parameterSlot("layers")) setParameter(technique, parameters, "layers", 3);
            for (const float radius : {0.0F, 0.02F}) {
                if (!isSeparable(technique)) continue;
                const auto drawn = [&](const renderer::Sun& light, bool filterUnseen) {
                    frame.setSun(light);
                    // Layers lie where the depths of the frame before were.
                    for (int again = 0; again < (technique.termsParameter == "layers" ? 2 : 1);
                         ++again)
                        frame.render({.technique = &technique,
                                      .parameters = parameters,
                                      .resolution = 200,
                                      .radiusUv = radius,
                                      .lit = false,
                                      .filterUnseen = filterUnseen,
                                      .filterOutsidePenumbrae = true});
                    return frame.readVisibility().values;
                };
                const auto whole = drawn(sun, true);
                EXPECT_EQ(frame.readFilteredShare(), 1);
                drawn(other, true);
                EXPECT_EQ(drawn(sun, false), whole)
                    << scene << ' ' << technique.name << ' ' << radius;
                left = left || (radius > 0 && frame.readFilteredShare() < 0.5);
            }
        }
    }
    EXPECT_TRUE(left) << "nothing was left out";
}

// What is left out outside penumbrae changes nearly nothing: most visibilities differ by less than
// the last bit of a picture. The greatest differences, beside silhouettes that a kernel just does
// not reach, were .03, and pixels that differ by a level of 255 were at most .1 % of a picture. A
// low sun holds the steepest planes, and tiles of a step of brightness would show on them.
void expectTheWholeMapsPicture(renderer::Renderer& frame, const Technique& technique,
                               float gaussian, int n, const std::string& name, double& left) {
    renderer::ParameterValues parameters = technique.standardParameters();
    if (gaussian > 0) setParameter(technique, parameters, "gaussian", gaussian);
    const auto radius = static_cast<float>(2 * frame.scene().softnessM / frame.window().extentM);
    const auto drawn = [&](bool whole) {
        frame.render({.technique = &technique,
                      .parameters = parameters,
                      .resolution = n,
                      .radiusUv = radius,
                      .lit = false,
                      .filterUnseen = whole,
                      .filterOutsidePenumbrae = whole});
        std::vector<FloatImage> lights;
        for (std::size_t light = 0; light < frame.lights(); ++light)
            lights.push_back(frame.readVisibility(light));
        return lights;
    };
    drawn(true);  // layers lie where the depths of the frame before were
    const std::vector<FloatImage> whole = drawn(true);
    EXPECT_EQ(frame.readFilteredShare(), 1) << name;
    const std::vector<FloatImage> found = drawn(false);
    left += 1 - frame.readFilteredShare();
    for (std::size_t light = 0; light < frame.lights(); ++light)
        tests::expectImagesAgree("penumbrae_" + name + "_" + std::to_string(light), found[light],
                                 whole[light],
                                 {.most = 0.06, .often = 1.0 / 255, .shareBeyondOften = 0.002});
}

TEST(MapFilter, LeavingOutWhatLiesInNoPenumbraChangesNoPicture) {
    double left = 0;
    int frames = 0;
    for (const char* scene : {"planar_occluder", "yard", "overlapping_spheres", "contact_posts",
                              "foliage", "city:cascades=3", "terrain", "knob", "lamps"}) {
        renderer::Renderer frame(gl(), renderer::makeScene(scene), 160, 90);
        for (const Technique& technique : renderer::techniques()) {
            if (!isSeparable(technique)) continue;
            const std::string name = scene + ("_" + std::string(technique.name));
            expectTheWholeMapsPicture(frame, technique, 0, 512, name, left);
            ++frames;
            if (technique.name != "vsm") continue;
            expectTheWholeMapsPicture(frame, technique, 1, 512, name + "_gaussian", left);
            // A map of which no whole number of tiles is made.
            expectTheWholeMapsPicture(frame, technique, 0, 97, name + "_97", left);
            frames += 2;
        }
    }
    EXPECT_GT(left, 0.4 * frames) << "little was left out";
}

TEST(MapFilter, LeavingOutWhatLiesInNoPenumbraShowsNoTilesUnderALowSun) {
    double left = 0;
    for (const char* scene : {"yard", "contact_posts"}) {
        renderer::Renderer frame(gl(), renderer::makeScene(scene), 160, 90);
        renderer::Sun sun = frame.scene().sun;
        sun.elevationDeg = 8;
        frame.setSun(sun);
        for (const char* technique : {"vsm", "evsm4", "msm", "msm16", "lvsm"})
            expectTheWholeMapsPicture(frame, renderer::findTechnique(technique), 0, 128,
                                      std::string("low_") + scene + "_" + technique, left);
    }
    EXPECT_GT(left, 0.5);
}

// Lists of tiles where they are few, the whole map from two thirds of the tiles on: the wider the
// kernel, the more of them it reaches a silhouette from.
TEST(MapFilter, DoesTheWholeMapWhereListsOfTilesWouldCostMore) {
    renderer::Renderer frame(gl(), renderer::makeScene("city"), 160, 90);
    int listed = 0, whole = 0;
    for (float radius = 0.002F; radius < 0.05F; radius *= 1.2F) {
        FrameSettings settings{.technique = &renderer::findTechnique("vsm"),
                               .resolution = 512,
                               .radiusUv = radius,
                               .lit = false,
                               .filterUnseen = true};
        frame.render(settings);
        const double share = frame.readFilteredShare();
        EXPECT_TRUE(share < 0.67 || share == 1) << share << " of the tiles at " << radius;
        ++(share < 1 ? listed : whole);
        if (share < 1) continue;
        const FloatImage found = frame.readVisibility();
        settings.filterOutsidePenumbrae = true;
        frame.render(settings);
        EXPECT_EQ(frame.readVisibility().values, found.values) << radius;
    }
    EXPECT_GT(listed, 2);
    EXPECT_GT(whole, 2);
}

// Whole numbers: exact at every size, however often they went round.
TEST(MapFilter, SumsAreExactUpTo2048) {
    renderer::Renderer frame(gl(), renderer::makeScene("yard"), 16, 9);
    const Technique& technique = renderer::findTechnique("vsm_sat");
    for (const int n : {1, 333, 2048}) {
        frame.render({.technique = &technique, .resolution = n, .radiusUv = 0.004F});
        const FloatImage depths = frame.readShadowMap();
        const renderer::FilteredTexels found = frame.readFilteredMap();
        const renderer::f32::ShadowConstants& shadow = frame.shadowConstants();
        const auto edge = static_cast<std::size_t>(found.edge);
        ASSERT_EQ(found.sums.size(), edge * edge);
        std::vector<std::uint64_t> above(edge, 0);
        std::size_t wrong = 0;
        for (std::size_t y = 0; y < edge; ++y) {
            std::uint64_t row = 0;
            for (std::size_t x = 0; x < edge; ++x) {
                const glm::ivec2 texel(static_cast<int>(x), static_cast<int>(y));
                const float depth = casterDepth({depths.values.data(), n}, texel, 0, shadow);
                // The texel's units in the map's own float32, which may round .4999... up: sums are
                // what is claimed here, and one unit more would stand in all that follow.
                const glm::uvec4 units = unitsOf(glm::vec4(depth), shadow);
                EXPECT_NEAR(units.x, static_cast<double>(depth) * -shadow.prefilter.w, 0.5 + 1e-6);
                row += units.x;
                above[x] += row;
                if (found.sums[y * edge + x].x != static_cast<std::uint32_t>(above[x])) ++wrong;
            }
        }
        EXPECT_EQ(wrong, 0U) << "N " << n;
        if (n == 2048) {
            EXPECT_GT(above.back() >> 32, 1000U) << "nothing went round";
        }
    }
}
/// Distances from the shadow's edge in radii, and visibility there, for the ground pixels beside
/// the edge's middle.
std::vector<std::pair<double, double>> edgeSamples(renderer::Renderer& frame, float turn,
                                                   double radiusUv) {
    const tests::PixelReceivers pixels(frame);
    const FloatImage visibility = frame.readVisibility();
    std::vector<std::pair<double, double>> samples;
    for (int y = 0; y < visibility.height; ++y)
        for (int x = 0; x < visibility.width; ++x) {
            const auto receiver = pixels.at(x, y);
            if (!receiver || std::abs(pixels.heightAt(x, y)) > 0.01) continue;
            const tests::EdgePlace place = tests::placeAtEdge(frame.window(), turn, receiver->uv);
            if (std::abs(place.alongUv) > place.halfLengthUv - 2 * radiusUv ||
                std::abs(place.distanceUv) > 2 * radiusUv)
                continue;
            samples.emplace_back(place.distanceUv / radiusUv, visibility.at(x, y));
        }
    return samples;
}

TEST(Lookup, PenumbraOfAStraightEdgeIsTheDiscsProfile) {
    constexpr double kRadius = 0.03;
    for (const float turn : {7.0F, 31.0F}) {
        renderer::Renderer frame(
            gl(), tests::edgeScene(turn, {.azimuthDeg = 20, .elevationDeg = 60, .mapTurnDeg = 0}),
            320, 180);
        frame.setWindowFit(renderer::WindowFit::casters);
        for (const int n : {128, 256, 512, 1024}) {
            frame.render(
                {.technique = disc(), .resolution = n, .radiusUv = static_cast<float>(kRadius)});
            const auto samples = edgeSamples(frame, turn, kRadius);
            ASSERT_GT(samples.size(), 2000U);
            // The staircase leaves at most half a ripple beside the profile; the kernel's weights
            // .0012.
            const double tolerance = 1.05 / (kPi * kRadius * n) + 0.0012;
            double worst = 0;
            for (const auto& [x, v] : samples)
                worst = std::max(worst, std::abs(v - tests::discProfile(x)));
            EXPECT_LT(worst, tolerance) << "turn " << turn << " N " << n;
        }
    }
}

/// The 10-90 % width in radii, from means over narrow bins of distance.
double edgeWidth(const std::vector<std::pair<double, double>>& samples) {
    constexpr double kBin = 0.04;
    std::map<int, std::pair<double, int>> bins;
    for (const auto& [x, v] : samples) {
        auto& [sum, count] = bins[static_cast<int>(std::floor(x / kBin))];
        sum += v;
        ++count;
    }
    const auto crossing = [&](double level) {
        double lastX = -2;
        double lastV = 0;
        for (const auto& [bin, sumCount] : bins) {
            const double x = (bin + 0.5) * kBin;
            const double v = sumCount.first / sumCount.second;
            if (v >= level) return lastX + (x - lastX) * (level - lastV) / (v - lastV);
            lastX = x;
            lastV = v;
        }
        return 2.0;
    };
    return crossing(0.9) - crossing(0.1);
}

// The mean over the edge is the disc convolved with one texel, which widens it by about (a/r)^2 /
// 12: .7 % at the smallest N here. Bins and pixel positions add about 1 %.
TEST(Lookup, SoftnessDoesNotDependOnN) {
    constexpr double kRadius = 0.03;
    const float turn = 23;
    renderer::Renderer frame(
        gl(), tests::edgeScene(turn, {.azimuthDeg = 20, .elevationDeg = 60, .mapTurnDeg = 0}), 320,
        180);
    frame.setWindowFit(renderer::WindowFit::casters);
    for (const int n : {116, 200, 333, 512, 1024, 1500}) {
        frame.render(
            {.technique = disc(), .resolution = n, .radiusUv = static_cast<float>(kRadius)});
        EXPECT_NEAR(edgeWidth(edgeSamples(frame, turn, kRadius)) / tests::discProfileWidth(), 1,
                    0.02)
            << n;
    }
}

TEST(Lookup, EdgeRippleAtTheStudysSlopeStaysBelowItsLimit) {
    constexpr double kRadius = 0.03;
    const int n = static_cast<int>(std::lround(3.47 / kRadius));
    for (const float turn : {1.5F, 4.0F, 12.0F, 40.0F}) {
        renderer::Renderer frame(
            gl(), tests::edgeScene(turn, {.azimuthDeg = 0, .elevationDeg = 70, .mapTurnDeg = 0}),
            480, 270);
        frame.setWindowFit(renderer::WindowFit::casters);
        frame.render(
            {.technique = disc(), .resolution = n, .radiusUv = static_cast<float>(kRadius)});
        double low = 0;
        double high = 0;
        for (const auto& [x, v] : edgeSamples(frame, turn, kRadius)) {
            if (std::abs(x) > 0.1) continue;
            low = std::min(low, v - tests::discProfile(x));
            high = std::max(high, v - tests::discProfile(x));
        }
        EXPECT_LT(high - low, 2 / (kPi * 3.47)) << turn;
        EXPECT_GT(high - low, 0.005) << "nothing was measured at " << turn;
    }
}

TEST(Lookup, PlanesAreLitAtEveryNTiltAndLightAngle) {
    for (const float tilt : {0.0F, 25.0F, 60.0F})
        for (const float elevation : {10.0F, 35.0F, 70.0F, 90.0F}) {
            renderer::Scene scene;
            scene.name = "plane";
            constexpr float kHalfM = 2;
            const glm::mat4 turned = glm::rotate(glm::mat4(1), glm::radians(tilt),
                                                 glm::normalize(glm::vec3(1, 0, 0.3F)));
            scene.objects.push_back(
                {"plane", transformed(renderer::groundPlane(kHalfM, 8), turned), {}});
            scene.casters = boundsOf(scene.objects.front().mesh);
            scene.casters.high.y += 0.5F;
            // A cleared texel, 1, beside the far end of a plane at depth 1 would lie before the
            // plane's continuation.
            scene.casters.low.y -= 1.5F;
            scene.sun = {.azimuthDeg = 37, .elevationDeg = elevation};
            scene.camera = {.pitchDeg = 70, .distanceM = 5};
            renderer::Renderer frame(gl(), scene, 96, 54);
            const glm::vec3 eye = scene.camera.eye();
            const auto fromRimM = [&](const FloatImage& positions, int x, int y) {
                const glm::vec3 seen = eye + glm::vec3(positions.at(x, y, 0), positions.at(x, y, 1),
                                                       positions.at(x, y, 2));
                const glm::vec3 local = glm::transpose(glm::mat3(turned)) * seen;
                return kHalfM - std::max(std::abs(local.x), std::abs(local.z));
            };
            for (const Technique& technique : renderer::techniques()) {
                if (!technique.holds(renderer::Property::planeLit)) continue;
                for (const int n : {32, 100, 512, 2048}) {
                    // A prefilter at 2048 takes seconds.
                    if (technique.prefilter != renderer::Prefilter::none && n > 512) continue;
                    frame.render({.technique = &technique, .resolution = n, .radiusUv = 0.01F});
                    const FloatImage visibility = frame.readVisibility();
                    const FloatImage planes = frame.readPlanes();
                    const FloatImage positions = frame.readPositions();
                    const float least =
                        1 - std::max(technique.planeDarkening, technique.steepDarkening);
                    // Along its rim a plane and the nothing beside it are two depths, of which
                    // moments may see more than there is.
                    const bool rimMayDarken = technique.steepDarkening > technique.planeDarkening;
                    const auto rimM = static_cast<float>((0.02 + 4.0 / n) * frame.window().extentM);
                    int lit = 0;
                    int shadowed = 0;
                    for (int y = 0; y < visibility.height; ++y)
                        for (int x = 0; x < visibility.width; ++x) {
                            const glm::vec3 normal(planes.at(x, y, 0), planes.at(x, y, 1),
                                                   planes.at(x, y, 2));
                            const float facing = dot(normal, frame.window().towardsLight);
                            if (facing < 0.02F) continue;
                            if (rimMayDarken && fromRimM(positions, x, y) < rimM / facing) continue;
                            ++(visibility.at(x, y) >= least ? lit : shadowed);
                        }
                    EXPECT_EQ(shadowed, 0) << technique.name << " tilt " << tilt << " sun "
                                           << elevation << " N " << n << " lit " << lit;
                }
            }
        }
}

TEST(Lookup, RoundReceiversAreLitWhereTheyFaceTheLight) {
    renderer::Scene scene;
    scene.name = "ball";
    scene.objects.push_back({"ball", renderer::sphere({0, 0, 0}, 1), {}});
    scene.casters = boundsOf(scene.objects.front().mesh);
    scene.sun = {.azimuthDeg = 30, .elevationDeg = 30};
    scene.camera = {.distanceM = 4, .verticalFieldDeg = 40};
    renderer::Renderer frame(gl(), scene, 160, 90);
    for (const int n : {64, 512, 2048}) {
        frame.render({.technique = disc(), .resolution = n, .radiusUv = 0.01F});
        const tests::PixelReceivers pixels(frame);
        const FloatImage visibility = frame.readVisibility();
        for (int y = 0; y < visibility.height; ++y)
            for (int x = 0; x < visibility.width; ++x) {
                if (!pixels.at(x, y)) continue;
                const glm::vec3 normal(pixels.planes.at(x, y, 0), pixels.planes.at(x, y, 1),
                                       pixels.planes.at(x, y, 2));
                if (dot(normal, frame.window().towardsLight) > 0.1F) {
                    EXPECT_EQ(visibility.at(x, y), 1) << x << " " << y << " N " << n;
                }
            }
    }
}

// The same blur in metres from both, converged: a window that cut off a caster or a kernel would
// show. What differs is the staircase of two grids, of the coarser one at most 2 a / (pi r).
TEST(Lookup, AWindowNarrowedToTheViewShowsTheSameShadows) {
    for (const char* name : {"yard", "terrain"}) {
        renderer::Renderer frame(gl(), renderer::makeScene(name), 160, 90);
        renderer::OrbitCamera camera = frame.scene().camera;
        camera.distanceM *= 0.15F;
        frame.setCamera(camera);
        const auto softness = static_cast<float>(2 * frame.scene().softnessM);
        const auto drawn = [&](renderer::WindowFit fit) {
            frame.setWindowFit(fit);
            frame.render({.technique = disc(),
                          .resolution = 1500,
                          .radiusUv = softness / static_cast<float>(frame.window().extentM)});
            return frame.readVisibility();
        };
        const FloatImage whole = drawn(renderer::WindowFit::casters);
        const double extentOfAll = frame.window().extentM;
        const double ripple = 2 * extentOfAll / (kPi * 1500 * static_cast<double>(softness));
        const FloatImage narrowed = drawn(renderer::WindowFit::view);
        EXPECT_LT(frame.window().extentM, 0.9 * extentOfAll) << name << ": nothing was compared";
        tests::expectImagesAgree(std::string("narrowed_") + name, narrowed, whole,
                                 {.most = 0.6, .often = ripple, .shareBeyondOften = 0.02});
    }
}

TEST(Frame, ExtremeSettingsGiveFiniteVisibilityInTheUnitRange) {
    for (const char* name : kTechniqueScenes) {
        renderer::Renderer frame(gl(), renderer::makeScene(name), 48, 27);
        for (const Technique& technique : renderer::techniques())
            for (const int n : {1, 2, 3, 17})
                for (const float radius : {0.0F, 1e-6F, 0.3F, 1.0F}) {
                    frame.render({.technique = &technique,
                                  .resolution = n,
                                  .radiusUv = radius,
                                  .minRadiusUv = 1});
                    const FloatImage visibility = frame.readVisibility();
                    for (const float v : visibility.values) EXPECT_TRUE(v >= 0 && v <= 1) << v;
                }
    }
}

// At 16 texels over a few metres every texel is many pixels wide.
TEST(Lookup, LeastRadiusEnlargesTheKernelWhereTexelsShow) {
    renderer::Renderer frame(gl(), renderer::makeScene("yard"), 240, 135);
    frame.render({.technique = disc(), .resolution = 16, .radiusUv = 0.1F});
    const FloatImage wide = frame.readVisibility();
    frame.render({.technique = disc(), .resolution = 16, .radiusUv = 0.01F, .minRadiusUv = 0.1F});
    // But for a few pixels that see a surface edge-on.
    tests::expectImagesAgree("least_radius", frame.readVisibility(), wide,
                             {.most = 1, .often = 0, .shareBeyondOften = 0.001});
    // And not where the map is finer than the screen.
    frame.resize(24, 13);
    frame.render({.technique = disc(), .resolution = 2048, .radiusUv = 0.01F});
    const FloatImage narrow = frame.readVisibility();
    frame.render({.technique = disc(), .resolution = 2048, .radiusUv = 0.01F, .minRadiusUv = 0.1F});
    tests::expectImagesAgree("least_radius_unseen", frame.readVisibility(), narrow, {});
}

TEST(Frame, RefusesSettingsOutOfRange) {
    renderer::Renderer frame(gl(), renderer::makeScene("yard"), 16, 9);
    const auto message = [&](FrameSettings settings) -> std::string {
        try {
            frame.render(settings);
        } catch (const std::exception& error) {
            return error.what();
        }
        return "nothing was thrown";
    };
    EXPECT_THAT(message({.resolution = 0}), HasSubstr("resolution is 0, must be in [1, "));
    EXPECT_THAT(message({.resolution = -5}), HasSubstr("resolution is -5"));
    EXPECT_THAT(message({.resolution = 1 << 20}), HasSubstr("what the driver allows"));
    EXPECT_THAT(message({.radiusUv = NAN}), HasSubstr("radiusUv is nan"));
    EXPECT_THAT(message({.radiusUv = 1.5F}), HasSubstr("radiusUv is 1.5"));
    EXPECT_THAT(message({.minRadiusUv = -1}), HasSubstr("minRadiusUv is -1"));
    EXPECT_THROW(frame.resize(0, 9), std::invalid_argument);
    EXPECT_THROW(frame.setSun({.elevationDeg = -3}), std::invalid_argument);
    EXPECT_EQ(message({.resolution = 8}), "nothing was thrown") << "and it goes on working";
}

// Mesa refuses sizes that it could never hold; a real lack of memory goes the same way.
TEST(Frame, SaysWhichTextureTheDriverRefusesAndGoesOn) {
    const auto message = [](const auto& call) -> std::string {
        try {
            call();
        } catch (const std::runtime_error& error) {
            return error.what();
        }
        return "nothing was thrown";
    };
    const int wider = 2 * gl().maxResolution;
    EXPECT_THAT(
        message([] { renderer::makeTextureArray(GL_RGBA32F, 8192, 8192, 2048, 1, "stack"); }),
        HasSubstr("texture \"stack\" of 8192 x 8192 texels: the driver refuses it"));
    EXPECT_THAT(message([&] { renderer::makeTexture(GL_R32F, wider, 1, "map"); }),
                HasSubstr("texture \"map\" of " + std::to_string(wider) + " x 1 texels"));
    renderer::Renderer frame(gl(), renderer::makeScene("yard"), 16, 9);
    EXPECT_NO_THROW(frame.render({.resolution = 64}));
}

TEST(Frame, ClockTimesThePassesThatTheFrameHad) {
    renderer::Renderer frame(gl(), renderer::makeScene("yard"), 64, 36);
    renderer::PassClock clock(gl());
    frame.render({.technique = disc(), .resolution = 64, .radiusUv = 0.01F, .lit = false}, &clock);
    renderer::PassTimesMs times = clock.collectMs();
    using renderer::Pass;
    for (const Pass pass : {Pass::depth, Pass::prepass, Pass::lookup})
        EXPECT_GT(times[static_cast<std::size_t>(pass)], 0);
    for (const Pass pass : {Pass::lit, Pass::demand})
        EXPECT_EQ(times[static_cast<std::size_t>(pass)], 0);
}

}  // namespace
