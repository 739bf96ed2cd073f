// SPDX-License-Identifier: MIT
#include "renderer/layer_placement.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/renderer/technique_case.h"

namespace {

using renderer::DepthHistogram;
using renderer::kDepthBins;
using renderer::Layers;
using renderer::placeLayers;
using tests::Random;

/// Standard deviation of the bins' middles within the layers.
double deviationWithin(const DepthHistogram& histogram, const Layers& layers) {
    double squares = 0;
    double total = 0;
    int bin = 0;
    for (int layer = 0; layer < layers.count; ++layer) {
        const double end = static_cast<double>(layers.ends[static_cast<std::size_t>(layer)]);
        double count = 0;
        double sum = 0;
        double square = 0;
        for (; bin < kDepthBins && (bin + 0.5) / kDepthBins < end; ++bin) {
            const double n = histogram[static_cast<std::size_t>(bin)];
            const double depth = (bin + 0.5) / kDepthBins;
            count += n;
            sum += n * depth;
            square += n * depth * depth;
        }
        if (count > 0) squares += square - sum * sum / count;
        total += count;
    }
    return std::sqrt(std::max(squares, 0.0) / total);
}

/// Texel by texel the next of these depths.
tests::DepthMap mapOf(const std::vector<double>& depths) {
    std::size_t texel = 0;
    return tests::DepthMap(9, [&](double, double) { return depths[texel++ % depths.size()]; });
}

DepthHistogram randomHistogram(Random& random) {
    DepthHistogram histogram{};
    const double share = random(0.02, 1);
    for (auto& count : histogram)
        if (random() < share) count = static_cast<std::uint32_t>(random.whole(1, 1000));
    histogram[20] = 5;  // never empty
    return histogram;
}

TEST(LayerPlacement, CutsRightBehindEachClusterOfDepths) {
    const tests::DepthMap map = mapOf({0.1, 0.45, 0.47, 0.9});
    const Layers layers = placeLayers(depthHistogram(map.view()), 0, 0.05);
    EXPECT_EQ(layers.count, 3);
    EXPECT_NEAR(layers.ends[0], 0.1, 1.0 / kDepthBins);
    EXPECT_NEAR(layers.ends[1], 0.47, 1.0 / kDepthBins);
    EXPECT_GE(layers.ends[0], 0.1F) << "the casters belong to the nearer layer";
    EXPECT_GE(layers.ends[1], 0.47F);
    EXPECT_EQ(layers.ends[2], 1);
}

TEST(LayerPlacement, OneLayerIsEnoughForOneDepthAndForNoCaster) {
    DepthHistogram histogram{};
    EXPECT_EQ(placeLayers(histogram, 0, 0.05), Layers{});
    EXPECT_EQ(placeLayers(histogram, 16, 0.05), Layers{});
    histogram[7] = 100;
    EXPECT_EQ(placeLayers(histogram, 0, 0.05), Layers{});
    EXPECT_EQ(placeLayers(histogram, 16, 0.05), Layers{}) << "no more layers than depths";
    EXPECT_EQ(depthHistogram(tests::DepthMap(4, [](double, double) { return 1; }).view()),
              DepthHistogram{});
}

TEST(LayerPlacement, NoOtherCutsLeaveLessVariance) {
    Random random(31);
    for (int trial = 0; trial < 200; ++trial) {
        const DepthHistogram histogram = randomHistogram(random);
        const int count = random.whole(2, 6);
        const Layers layers = placeLayers(histogram, count, 0);
        const double own = deviationWithin(histogram, layers);
        for (int other = 0; other < 50; ++other) {
            Layers moved = layers;
            for (int i = 0; i + 1 < moved.count; ++i)
                moved.ends[static_cast<std::size_t>(i)] =
                    static_cast<float>(random.whole(1, kDepthBins - 1)) / kDepthBins;
            std::sort(moved.ends.begin(), moved.ends.begin() + moved.count - 1);
            EXPECT_GE(deviationWithin(histogram, moved), own - 1e-9);
        }
    }
}

TEST(LayerPlacement, AutomaticLayersAreTheFewestWithinTheDeviation) {
    Random random(32);
    for (int trial = 0; trial < 200; ++trial) {
        const DepthHistogram histogram = randomHistogram(random);
        const double most = random(0.02, 0.3);
        const Layers layers = placeLayers(histogram, 0, most);
        ASSERT_GE(layers.count, 1);
        ASSERT_LE(layers.count, renderer::kMostLayers);
        if (layers.count < renderer::kMostLayers) {
            EXPECT_LE(deviationWithin(histogram, layers), most + 1e-9);
        }
        if (layers.count > 1) {
            EXPECT_GT(deviationWithin(histogram, placeLayers(histogram, layers.count - 1, most)),
                      most);
        }
        for (std::size_t i = 1; i < static_cast<std::size_t>(layers.count); ++i)
            EXPECT_LT(layers.ends[i - 1], layers.ends[i]);
        EXPECT_EQ(layers.ends[static_cast<std::size_t>(layers.count) - 1], 1);
    }
}

// Three occluders over a receiver at depths that no even cut tells apart: even layers bleed, placed
// ones do not.
TEST(LayerPlacement, PlacedLayersStopBleedingThatEvenOnesOfTheSameNumberLetThrough) {
    const DepthHistogram scene = depthHistogram(mapOf({0.52, 0.58, 0.64, 0.7}).view());
    const Layers placed = placeLayers(scene, 4, 0);
    ASSERT_EQ(placed.count, 4);
    const tests::DepthMap map = mapOf({0.52, 0.58, 0.64});
    for (const char* name : {"lvsm", "power_cdf"}) {
        const renderer::Technique& technique = renderer::findTechnique(name);
        renderer::ParameterValues parameters = technique.standardParameters();
        const auto visibility = [&](const Layers& layers) {
            auto constants = tests::constantsFor(technique, 9, 0.5, parameters);
            useLayers(technique, layers, constants);
            return tests::CpuTechnique<double>(technique, map, constants, renderer::Storage::exact)(
                tests::receiverAt(0.5, 0.5, 0.7));
        };
        EXPECT_LT(visibility(placed), 1e-3) << name;
        if (technique.name == "lvsm") {
            EXPECT_GT(visibility(renderer::evenLayers(4)), 0.1);
        }
    }
}

}  // namespace
