// SPDX-License-Identifier: MIT
// The stimulus at the threshold as lines of equal display value (Kreuzer, section 4.1 and Fig. 2:
// what tells an artifact from a clean edge is the course of these lines).
#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include "analysis/figure_panels.h"
#include "analysis/figures.h"
#include "analysis/gnuplot.h"
#include "analysis/number_text.h"
#include "stimulus/display_code.h"
#include "stimulus/filtered_edge.h"

namespace analysis {
namespace {

constexpr std::size_t kMostPatterns = 3;
constexpr std::array kShares = {0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9};  // of the lit code
constexpr int kColumns = 160;                                                  // places along x
constexpr double kHalfWidth = 1.7;  // of the view, in filter radii
constexpr double kBisections = 30;  // 1e-9 of the view
constexpr int kAxesWidthPx = 365, kAxesHeightPx = 240;

// Where a function that rises from `low` to `high` takes a value.
template <typename Rising>
double bisect(double low, double high, double value, Rising rising) {
    for (int i = 0; i < kBisections; ++i) {
        const double middle = 0.5 * (low + high);
        (rising(middle) < value ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

struct View {
    std::string name;
    stimulus::Silhouette silhouette;
    stimulus::Kernel kernel;
    stimulus::Encoding encoding;

    double halfWidth() const {
        return std::max(kHalfWidth * kernel.radiusPx, 2 * silhouette.options().artifactPx);
    }
    double trueHeight(double x) const {
        return silhouette.rise() / silhouette.run() * x + silhouette.intercept();
    }
};

std::optional<View> viewOf(const SlopeAnalysis& analysis, std::size_t group) {
    const Study& study = analysis.study;
    const auto shape = stimulus::kernelShapeFromText(study.kernel);
    // The size nearest to the middle of the study.
    const double a0 = referenceArtifactPx(study);
    const Condition* nearest = nullptr;
    for (const Condition& condition : study.conditions) {
        if (condition.group != group) continue;
        const auto distance = [a0](const Condition& one) {
            return std::abs(std::log(one.artifactPx / a0));
        };
        if (!nearest || distance(condition) < distance(*nearest)) nearest = &condition;
    }
    const auto outline = silhouetteOf(study.groups[group], *nearest);
    if (!shape || !outline) return std::nullopt;
    const double radius =
        nearest->artifactPx * std::pow(10.0, fittedLog10c(analysis, group, nearest->artifactPx));
    if (!(radius < stimulus::kMaxSizePx)) return std::nullopt;
    return View{.name = study.groups[group].name + ", a " + shortText(nearest->artifactPx) +
                        ", r " + fixedText(radius, 1),
                .silhouette = stimulus::Silhouette(*outline),
                .kernel = {*shape, radius},
                .encoding = study.encoding == records::Encoding::srgb ? stimulus::Encoding::srgb
                                                                      : stimulus::Encoding::code};
}

// One line of equal value after the other, apart by blank lines.
template <typename Visibility>
std::string contourRows(const View& view, int columns, Visibility visibility) {
    const double reach = stimulus::reach(view.kernel.shape) * view.kernel.radiusPx +
                         2 * view.silhouette.options().artifactPx;
    std::ostringstream rows;
    for (const double share : kShares) {
        const double v = bisect(
            0, 1, share, [&](double light) { return stimulus::encode(light, view.encoding); });
        for (int i = 0; i <= columns; ++i) {
            const double x = view.halfWidth() * (2.0 * i / columns - 1);
            const double y = view.trueHeight(x);
            rows << x << ' ' << bisect(y - 2 * reach, y + 2 * reach, v, [&](double at) {
                return visibility(x, at);
            }) << '\n';
        }
        rows << '\n';
    }
    return rows.str();
}

std::string artifactOutline(const View& view) {
    const double half = view.halfWidth();
    std::ostringstream rows;
    for (auto k = view.silhouette.texelAt(-half); k <= view.silhouette.texelAt(half); ++k) {
        rows << view.silhouette.riser(k) << ' ' << view.silhouette.height(k) << '\n'
             << view.silhouette.riser(k + 1) << ' ' << view.silhouette.height(k) << '\n';
    }
    return rows.str();
}

}  // namespace

std::optional<Figure> isoContours(const SlopeAnalysis& analysis) {
    const PanelChoice choice = choosePanels(analysis, false, kMostPatterns, 1);
    std::vector<View> views;
    for (const Panel& panel : choice.panels) {
        if (auto view = viewOf(analysis, panel.series.front().group)) views.push_back(*view);
    }
    if (views.empty()) return std::nullopt;
    const PanelGrid grid{.count = 2 * views.size(),
                         .columns = 2,
                         .widthPx = 900,
                         .panelHeightPx = kAxesHeightPx + 105,
                         .left = 70,
                         .right = 450 - 70 - kAxesWidthPx,
                         .top = 40,
                         .bottom = 65};
    std::string data, plots;
    for (std::size_t i = 0; i < views.size(); ++i) {
        const View& view = views[i];
        const stimulus::ApproximateArtifact artifact(view.kernel.shape);
        const double half = view.halfWidth();
        std::ostringstream straight;
        straight << -half << ' ' << view.trueHeight(-half) << '\n'
                 << half << ' ' << view.trueHeight(half) << '\n';
        const std::string key = std::to_string(i);
        data +=
            dataBlock("outline" + key + "_0", artifactOutline(view)) +
            dataBlock("outline" + key + "_1", straight.str()) +
            dataBlock("lines" + key + "_0", contourRows(view, kColumns,
                                                        [&](double x, double y) {
                                                            return artifact.visibility(
                                                                view.silhouette, view.kernel, x, y);
                                                        })) +
            dataBlock("lines" + key + "_1", contourRows(view, 1, [&](double x, double y) {
                          return stimulus::straightVisibility(view.silhouette, view.kernel, x, y);
                      }));
        for (std::size_t side = 0; side < 2; ++side) {
            // Where half the light shows as half the code is not where half the light is.
            const double half50 = bisect(
                0, 1, 0.5, [&](double light) { return stimulus::encode(light, view.encoding); });
            const double reach = stimulus::reach(view.kernel.shape) * view.kernel.radiusPx;
            const double middle =
                bisect(view.trueHeight(0) - 2 * reach, view.trueHeight(0) + 2 * reach, half50,
                       [&](double y) {
                           return stimulus::straightVisibility(view.silhouette, view.kernel, 0, y);
                       });
            const double halfHeight = half * kAxesHeightPx / kAxesWidthPx;
            const std::string which = key + "_" + std::to_string(side);
            std::ostringstream plot;
            plot << grid.place(2 * i + side) << "set title "
                 << quotedForGnuplot(view.name +
                                     (side == 0 ? ": with the artifact" : ": without it"))
                 << " font ',13'\nset xrange [" << -half << ':' << half << "]\nset yrange ["
                 << middle - halfHeight << ':' << middle + halfHeight
                 << "]\nset xlabel 'px'\nset ylabel '" << (side == 0 ? "px" : "")
                 << "' offset 1,0\nset border 15\nset clip two\nunset key\nplot $outline" << which
                 << " using 1:2 with lines lw 3 lc rgb '#c8c8c8', \\\n     $lines" << which
                 << " using 1:2 with lines lw 1.2 lc rgb '" << seriesColour(side == 0 ? 1 : 0)
                 << "'\n";
            plots += plot.str();
        }
    }
    return multiplot(
        "iso_contours",
        "What the mean observer sees at the threshold: lines of equal display value, 10 % to 90 % "
        "of the lit side in steps of 10 %, of the filtered artifact (left) and of the filtered "
        "straight edge (right); grey: the edge before filtering. Of each pattern the group with "
        "the largest c, at the size nearest to the middle of the study. What is left of the "
        "artifact at the threshold is the waviness on the left." +
            choice.leftOut,
        grid, data, plots);
}

}  // namespace analysis
