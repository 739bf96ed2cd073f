// SPDX-License-Identifier: MIT
#include "demo/depth_distribution.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "demo/xy_plot.h"
#include "records/whole_file.h"
#include "renderer/renderer.h"

namespace demo {
namespace {

constexpr double kGroupGap =
    0.01;  // of the depth range; a slope spans less between texels, but for rims

/// Sorted depths as parts of their range.
std::vector<double> normalized(std::vector<float> depths) {
    std::sort(depths.begin(), depths.end());
    std::vector<double> parts;
    for (const float depth : depths)
        parts.push_back(static_cast<double>(depth - depths.front()) /
                        static_cast<double>(depths.back() - depths.front()));
    return parts;
}

/// How good an example of so many groups sorted depths are; 0: none.
double evenness(const std::vector<float>& sorted, int groups) {
    std::size_t least = sorted.size(), begin = 0;
    int found = 0;
    for (std::size_t i = 1; i <= sorted.size(); ++i)
        if (i == sorted.size() || static_cast<double>(sorted[i] - sorted[i - 1]) > kGroupGap) {
            least = std::min(least, i - begin);
            begin = i;
            ++found;
        }
    if (found != groups) return 0;
    return groups == 1 ? static_cast<double>(sorted.back() - sorted.front())
                       : static_cast<double>(least);
}

}  // namespace

std::optional<PowerFit> fitPower(std::vector<float> depths) {
    if (depths.empty() || *std::min_element(depths.begin(), depths.end()) ==
                              *std::max_element(depths.begin(), depths.end()))
        return std::nullopt;
    const std::vector<double> parts = normalized(std::move(depths));
    const auto n = static_cast<double>(parts.size());
    double mean = 0;
    for (const double part : parts) mean += part / n;
    PowerFit fit{.beta = mean / (1 - mean)};
    for (std::size_t i = 0; i < parts.size();
         ++i) {  // the step at each depth: from below and from above
        const double power = std::pow(parts[i], fit.beta);
        fit.most = std::max({fit.most, std::abs(power - static_cast<double>(i) / n),
                             std::abs(power - static_cast<double>(i + 1) / n)});
    }
    return fit;
}

std::vector<float> kernelOfGroups(const renderer::FloatImage& map, int half, int groups) {
    std::vector<float> best;
    double most = 0;
    for (int y = half; y + half < map.height; y += 2)
        for (int x = half; x + half < map.width; x += 2) {
            std::vector<float> depths;
            for (int j = -half; j <= half; ++j)
                for (int i = -half; i <= half; ++i) depths.push_back(map.at(x + i, y + j));
            std::sort(depths.begin(), depths.end());
            const double score = evenness(depths, groups);
            if (score <= most) continue;
            most = score;
            best = std::move(depths);
        }
    return best;
}

std::string depthDistributionText(const std::filesystem::path& folder,
                                  const renderer::GlInfo& info) {
    constexpr int kResolution = 512, kHalf = 4;
    renderer::Renderer frame(info, renderer::makeScene("overlapping_spheres"), 320, 180);
    frame.render({.resolution = kResolution, .lit = false});
    const renderer::FloatImage map = frame.readShadowMap();

    Plot plot{.title = "Depths under a kernel, and t^beta",
              .xLabel = "t, depth from the least to the greatest under the kernel",
              .yLabel = "share of the depths before t",
              .series = {},
              .unitAxes = true};
    std::string table = "| kernel | beta | largest distance from t^beta |\n|---|---|---|\n";
    const char* const names[] = {"slope of one surface", "two depths", "three depths"};
    for (int groups = 1; groups <= 3; ++groups) {
        const std::vector<float> depths = kernelOfGroups(map, kHalf, groups);
        const auto fit = fitPower(depths);
        if (!fit) continue;
        const std::vector<double> parts = normalized(depths);
        PlotSeries steps{.name = names[groups - 1], .points = {}, .line = true};
        for (std::size_t i = 0; i < parts.size(); ++i) {
            steps.points.emplace_back(parts[i],
                                      static_cast<double>(i) / static_cast<double>(parts.size()));
            steps.points.emplace_back(
                parts[i], static_cast<double>(i + 1) / static_cast<double>(parts.size()));
        }
        char name[64];
        std::snprintf(name, sizeof name, "t^%.2f", fit->beta);
        PlotSeries power{.name = name, .points = {}, .line = true};
        constexpr int kPoints = 100;
        for (int i = 0; i <= kPoints; ++i) {
            const double t = static_cast<double>(i) / kPoints;
            power.points.emplace_back(t, std::pow(t, fit->beta));
        }
        plot.series.push_back(std::move(steps));
        plot.series.push_back(std::move(power));
        char line[128];
        std::snprintf(line, sizeof line, "| %s | %.2f | %.2f |\n", names[groups - 1], fit->beta,
                      fit->most);
        table += line;
    }
    records::writeWholeFile(folder / "power-cdf-1.svg", plotSvg(plot));
    return "## Fig. 1: the power function\n\nThree kernels of 9 x 9 texels from the map of "
           "overlapping_spheres at N = 512: "
           "the depths as they lie there (steps), and t^beta with the beta of their mean (Eq. "
           "3).\n\n"
           "![Shares of depths and power functions](power-cdf-1.svg)\n\n" +
           table +
           "\nThe paper draws a smooth distribution. Ours are real kernels: the fit is best on the "
           "slope and worst where depths lie "
           "apart, since a power has no plateaus; it keeps their mean and loses where they "
           "lie.\n\n";
}

}  // namespace demo
