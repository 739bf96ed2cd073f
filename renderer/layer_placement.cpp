// SPDX-License-Identifier: MIT
#include "renderer/layer_placement.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace renderer {
namespace {

constexpr auto kBins = static_cast<std::size_t>(kDepthBins);

/// Sums over the first bins of the histogram, from which the sum of squared deviations of any run
/// of bins follows.
class RunningSums {
  public:
    explicit RunningSums(const DepthHistogram& histogram) {
        for (std::size_t i = 0; i < kBins; ++i) {
            const double count = histogram[i];
            const double depth = (static_cast<double>(i) + 0.5) / kDepthBins;
            counts_[i + 1] = counts_[i] + count;
            depths_[i + 1] = depths_[i] + count * depth;
            squares_[i + 1] = squares_[i] + count * depth * depth;
        }
    }
    double total() const { return counts_[kBins]; }
    double squaredDeviations(std::size_t from, std::size_t to) const {
        const double count = counts_[to] - counts_[from];
        if (count <= 0) return 0;
        const double sum = depths_[to] - depths_[from];
        return std::max(squares_[to] - squares_[from] - sum * sum / count, 0.0);
    }

  private:
    std::array<double, kBins + 1> counts_{}, depths_{}, squares_{};
};

/// least[k][j]: the least sum of squared deviations of bins 0..j in k + 1 runs; from[k][j]: where
/// the last of these runs begins.
struct BestCuts {
    std::array<std::array<double, kBins + 1>, kMostLayers> least{};
    std::array<std::array<std::size_t, kBins + 1>, kMostLayers> from{};

    explicit BestCuts(const RunningSums& sums) {
        for (std::size_t j = 0; j <= kBins; ++j) least[0][j] = sums.squaredDeviations(0, j);
        for (std::size_t k = 1; k < kMostLayers; ++k)
            for (std::size_t j = 0; j <= kBins; ++j) {
                least[k][j] = std::numeric_limits<double>::infinity();
                for (std::size_t i = 0; i <= j; ++i) {
                    const double cost = least[k - 1][i] + sums.squaredDeviations(i, j);
                    if (cost < least[k][j]) {
                        least[k][j] = cost;
                        from[k][j] = i;
                    }
                }
            }
    }
};

}  // namespace

DepthHistogram depthHistogram(MapView depths) {
    DepthHistogram histogram{};
    for (int row = 0; row < depths.edge; ++row)
        for (int column = 0; column < depths.edge; ++column) {
            const float depth = depths.at(column, row);
            if (!(depth < 1)) continue;
            ++histogram[static_cast<std::size_t>(std::max(depth, 0.0F) * kDepthBins)];
        }
    return histogram;
}

Layers placeLayers(const DepthHistogram& histogram, int asked, double mostDeviation) {
    const RunningSums sums(histogram);
    const auto depths = static_cast<int>(
        std::count_if(histogram.begin(), histogram.end(), [](auto count) { return count > 0; }));
    if (depths == 0) return {};
    const BestCuts cuts(sums);
    const int most = std::min(depths, asked == 0 ? kMostLayers : std::min(asked, kMostLayers));
    int count = asked == 0 ? 1 : most;
    const auto deviation = [&](int layers) {
        return std::sqrt(cuts.least[static_cast<std::size_t>(layers) - 1][kBins] / sums.total());
    };
    if (asked == 0)
        while (count < most && deviation(count) > mostDeviation) ++count;

    Layers layers;
    layers.count = count;
    std::size_t end = kBins;
    for (auto k = static_cast<std::size_t>(count) - 1; k > 0; --k) {
        end = cuts.from[k][end];
        // Behind the last caster of the nearer layer: the empty range belongs to the receivers
        // behind it, which are the farther from its casters.
        while (end > 1 && histogram[end - 1] == 0) --end;
        layers.ends[k - 1] = static_cast<float>(end) / kDepthBins;
    }
    return layers;
}

Layers evenLayers(int count) {
    Layers layers;
    layers.count = std::clamp(count, 1, kMostLayers);
    for (int i = 0; i + 1 < layers.count; ++i)
        layers.ends[static_cast<std::size_t>(i)] =
            static_cast<float>(i + 1) / static_cast<float>(layers.count);
    return layers;
}

bool hasLayers(const Technique& technique) {
    return technique.parameterSlot("layers").has_value();
}

Layers placeLayers(const Technique& technique, const ParameterValues& values,
                   const DepthHistogram& histogram) {
    if (!hasLayers(technique)) return {};
    const auto value = [&](std::string_view name) {
        return values[technique.parameterSlot(name).value()];
    };
    return placeLayers(histogram, static_cast<int>(value("layers")),
                       static_cast<double>(value("layer_deviation")));
}

}  // namespace renderer
