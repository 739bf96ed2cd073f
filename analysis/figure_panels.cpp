// SPDX-License-Identifier: MIT
#include "analysis/figure_panels.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace analysis {
namespace {

// "line 22.5 deg, lit 1" is the series "lit 1" of the panel "line 22.5 deg".
std::pair<std::string, std::string> panelAndSeries(const std::string& groupName) {
    const std::size_t comma = groupName.find(", ");
    if (comma == std::string::npos) return {groupName, groupName};
    return {groupName.substr(0, comma), groupName.substr(comma + 2)};
}

double slopeOfGroup(const SlopeAnalysis& analysis, std::size_t group) {
    return analysis.groups[group].c.value;
}

double largestSlope(const SlopeAnalysis& analysis, const Panel& panel) {
    double largest = -1e300;
    for (const Series& series : panel.series) {
        largest = std::max(largest, slopeOfGroup(analysis, series.group));
    }
    return largest;
}

std::vector<Panel> allPanels(const Study& study) {
    std::vector<Panel> panels;
    std::vector<std::string> seriesNames;
    for (std::size_t g = 0; g < study.groups.size(); ++g) {
        const auto [title, name] = panelAndSeries(study.groups[g].name);
        auto panel =
            std::find_if(panels.begin(), panels.end(),
                         [&, &wanted = title](const Panel& p) { return p.title == wanted; });
        if (panel == panels.end()) {
            panels.push_back({.title = title, .pattern = study.groups[g].pattern});
            panel = panels.end() - 1;
        }
        auto style = std::find(seriesNames.begin(), seriesNames.end(), name);
        if (style == seriesNames.end()) style = seriesNames.insert(style, name);
        panel->series.push_back({g, name, static_cast<std::size_t>(style - seriesNames.begin())});
    }
    for (Panel& panel : panels) {
        std::set<double> sizes;
        for (const Condition& condition : study.conditions) {
            for (const Series& series : panel.series) {
                if (series.group == condition.group) sizes.insert(condition.artifactPx);
            }
        }
        panel.sizes.assign(sizes.begin(), sizes.end());
    }
    return panels;
}

// Keeps the `most` with the largest slopes, in their order. True where some had to go.
template <typename T, typename Slope>
bool keepLargest(std::vector<T>& all, std::size_t most, Slope slope) {
    if (all.size() <= most) return false;
    std::vector<double> slopes;
    for (const T& one : all) slopes.push_back(slope(one));
    std::nth_element(slopes.begin(), slopes.begin() + static_cast<std::ptrdiff_t>(most) - 1,
                     slopes.end(), std::greater<>());
    const double least = slopes[most - 1];
    std::erase_if(all, [&](const T& one) { return slope(one) < least; });
    if (all.size() > most) all.resize(most);  // equal slopes
    return true;
}

}  // namespace

PanelChoice choosePanels(const SlopeAnalysis& analysis, bool severalSizesOnly, std::size_t most,
                         std::size_t mostSeries) {
    PanelChoice choice{.panels = allPanels(analysis.study)};
    std::vector<Panel>& panels = choice.panels;
    const auto several = [](const Panel& panel) { return panel.sizes.size() > 1; };
    if (severalSizesOnly && std::any_of(panels.begin(), panels.end(), several) &&
        !std::all_of(panels.begin(), panels.end(), several)) {
        std::erase_if(panels, [&](const Panel& panel) { return !several(panel); });
        choice.leftOut += " Patterns that were shown at one size are not drawn.";
    }
    if (keepLargest(panels, most,
                    [&](const Panel& panel) { return largestSlope(analysis, panel); })) {
        choice.leftOut +=
            " Drawn are the " + std::to_string(most) + " patterns or angles with the largest c.";
    }
    bool fewer = false;
    for (Panel& panel : panels) {
        fewer = keepLargest(
                    panel.series, mostSeries,
                    [&](const Series& series) { return slopeOfGroup(analysis, series.group); }) ||
                fewer;
    }
    if (fewer && mostSeries > 1) {
        choice.leftOut +=
            " Of each, the " + std::to_string(mostSeries) + " groups with the largest c.";
    }
    return choice;
}

const RandomObserverFit& headlineFit(const SlopeAnalysis& analysis) {
    return analysis.slope.lawRejected ? *analysis.slope.sizeFit : analysis.slope.law;
}

double fittedLog10c(const SlopeAnalysis& analysis, std::size_t group, double artifactPx) {
    const Eigen::VectorXd& b = headlineFit(analysis).parameters.fixed;
    const double log10c = b[static_cast<Eigen::Index>(group)];
    if (!analysis.slope.lawRejected) return log10c;
    // The last column is kappa - 1.
    return log10c + b[b.size() - 1] * std::log10(artifactPx / referenceArtifactPx(analysis.study));
}

}  // namespace analysis
