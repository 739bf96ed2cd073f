// SPDX-License-Identifier: MIT
// Filter radius against artifact size, as the paper's Fig. 4, and against the light, as its Fig. 5.
#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

#include "analysis/figure_panels.h"
#include "analysis/figures.h"
#include "analysis/gnuplot.h"
#include "analysis/number_text.h"
#include "analysis/published_slope.h"

namespace analysis {
namespace {

constexpr int kCurveSteps = 48;
constexpr double kKeyRowPx = 18;

double c(double log10c) {
    return std::pow(10.0, log10c);
}

// The threshold of one condition, px.
struct Point {
    double a, radius, low, high;
};

std::vector<Point> pointsOf(const SlopeAnalysis& analysis, std::size_t group) {
    std::vector<Point> points;
    for (std::size_t k = 0; k < analysis.conditions.size(); ++k) {
        const Condition& condition = analysis.study.conditions[k];
        if (condition.group != group || !analysis.conditions[k].c) continue;
        const LinearEstimate& own = *analysis.conditions[k].c;
        const auto ci95 = own.ci95();
        const double a = condition.artifactPx;
        points.push_back({a, a * c(own.value), a * c(ci95 ? ci95->low : own.value),
                          a * c(ci95 ? ci95->high : own.value)});
    }
    return points;
}

struct Range {
    double low = 1e300, high = 0;
    void hold(double value) {
        low = std::min(low, value);
        high = std::max(high, value);
    }
};

Range radiiOf(const SlopeAnalysis& analysis, const std::vector<Panel>& panels) {
    Range range;
    for (const Panel& panel : panels) {
        for (const Series& series : panel.series) {
            for (const Point& point : pointsOf(analysis, series.group)) {
                range.hold(point.low);
                range.hold(point.high);
            }
            for (const double a : panel.sizes) {
                range.hold(a * c(fittedLog10c(analysis, series.group, a)));
            }
        }
    }
    return range;
}

// One panel: data blocks, and the plots that show them.
class PanelScript {
  public:
    PanelScript(const SlopeAnalysis& analysis, const Panel& panel, std::size_t number,
                bool logarithmic)
        : analysis_(analysis), panel_(panel), number_(number), logarithmic_(logarithmic) {}

    std::string block(const std::string& name) const { return name + std::to_string(number_); }
    std::string reference(const std::string& name) const {
        std::string text = "$";  // appended, not added: gcc 12 sees an overlap that is none
        return text.append(block(name));
    }

    void add(const std::string& plot) { plots_ += (plots_.empty() ? "" : ", \\\n     ") + plot; }

    void addData(const std::string& name, const std::string& rows) {
        data_ += dataBlock(block(name), rows);
    }

    void addCurve(const Series& series) {
        const LinearEstimate& own = analysis_.groups[series.group].c;
        const auto ci95 = own.ci95();
        const bool law = !analysis_.slope.lawRejected;
        const double largest = panel_.sizes.back(), least = panel_.sizes.front();
        const double first = law && !logarithmic_ ? 0 : logarithmic_ ? least / 1.15 : least;
        std::ostringstream rows;
        for (int step = 0; step <= kCurveSteps; ++step) {
            const double a = first + (1.04 * largest - first) * step / kCurveSteps;
            const double radius = a > 0 ? a * c(fittedLog10c(analysis_, series.group, a)) : 0;
            rows << a << ' ' << radius << ' ' << a * c(ci95 ? ci95->low : own.value) << ' '
                 << a * c(ci95 ? ci95->high : own.value) << '\n';
        }
        const std::string name = "curve" + std::to_string(series.style) + "_";
        addData(name, rows.str());
        const std::string colour = " rgb '" + seriesColour(series.style) + "' ";
        if (law && ci95 && !logarithmic_) {
            add(reference(name) + " using 1:3:4 with filledcurves fs transparent solid 0.10 " +
                "noborder fc" + colour + "notitle");
        }
        add(reference(name) + " using 1:2 with lines lw 1.6 lc" + colour + "notitle");
    }

    void addPoints(std::size_t i, bool withSlope) {
        const Series& series = panel_.series[i];
        // Beside each other, so that intervals of equal sizes can be told apart.
        const double place =
            static_cast<double>(i) - 0.5 * (static_cast<double>(panel_.series.size()) - 1);
        std::ostringstream rows;
        for (const Point& point : pointsOf(analysis_, series.group)) {
            rows << (logarithmic_ ? point.a * std::pow(1.02, place)
                                  : point.a + 0.016 * panel_.sizes.back() * place)
                 << ' ' << point.radius << ' ' << point.low << ' ' << point.high << '\n';
        }
        const std::string name = "points" + std::to_string(series.style) + "_";
        addData(name, rows.str());
        const std::string style = " lw 1.3 lc rgb '" + seriesColour(series.style) + "' ";
        std::string title = series.name;
        if (withSlope) {
            title += ": c = " + fixedText(c(analysis_.groups[series.group].c.value), 2);
        }
        // As two plots: gnuplot leaves a gap between a point and its own bar.
        add(reference(name) + " using 1:2:3:4 with yerrorbars pt -1" + style + "notitle");
        add(reference(name) + " using 1:2 with points pt " + seriesPoint(series.style) +
            " ps 0.75" + style + "title " + quotedForGnuplot(title));
    }

    void addPublished() {
        const double largest = 1.04 * panel_.sizes.back();
        const double first = logarithmic_ ? panel_.sizes.front() / 1.15 : 0;
        std::ostringstream rows;
        const double criterion = analysis_.options.criterion;
        for (const double a : {first, largest})
            rows << a << ' ' << a * publishedAt(criterion) << '\n';
        addData("published", rows.str());
        add(reference("published") + " using 1:2 with lines dt (2,3) lw 1.2 lc rgb '" + kInk +
            "' title " + quotedForGnuplot("published: c = " + publishedText(criterion)));
        if (panel_.pattern != records::Pattern::stair || largest < 20) return;
        std::ostringstream anchors;
        for (const auto& [a, radius] : {std::pair(10, 25.0), {20, 50.0}}) {
            anchors << a << ' ' << publishedAt(criterion, radius / a) * a << '\n';
        }
        addData("anchors", anchors.str());
        add(reference("anchors") + " using 1:2 with points pt 3 ps 0.9 lw 1.2 lc rgb '" + kInk +
            "' title 'published, stair'");
    }

    // Of the brightest lit level.
    void addReference(const ReferenceSizes& reference) {
        std::ostringstream half, one;
        for (std::size_t k = 0; k < analysis_.study.conditions.size(); ++k) {
            const Condition& condition = analysis_.study.conditions[k];
            const auto size = referenceSize(reference, analysis_.study, k);
            if (condition.group != panel_.series.front().group || !size) continue;
            if (size->halfCode) half << condition.artifactPx << ' ' << *size->halfCode << '\n';
            if (size->oneCode) one << condition.artifactPx << ' ' << *size->oneCode << '\n';
        }
        const std::string of = ", " + panel_.series.front().name;
        addReferenceLine("half", half.str(), "reference R_{1/2}", of, "dt (8,4) pt 6");
        addReferenceLine("one", one.str(), "reference R_1", of, "dt (8,3,2,3) pt 4");
    }

    const std::string& data() const { return data_; }
    const std::string& plots() const { return plots_; }

  private:
    void addReferenceLine(const std::string& name, const std::string& rows,
                          const std::string& title, const std::string& of,
                          const std::string& style) {
        if (rows.empty()) return;
        addData(name, rows);
        std::string whole = quotedForGnuplot(of);
        whole.insert(1, title);  // the title's own _{} is markup
        add(reference(name) + " using 1:2 with linespoints " + style + " ps 0.6 lw 1.2 lc rgb '" +
            kQuiet + "' title " + whole);
    }

    const SlopeAnalysis& analysis_;
    const Panel& panel_;
    std::size_t number_;
    bool logarithmic_;
    std::string data_, plots_;
};

std::string axesText(const SlopeAnalysis& analysis, const Panel& panel, bool logarithmic,
                     const Range& r, std::size_t keyRows, const PanelGrid& grid, std::size_t i) {
    const double low = logarithmic ? panel.sizes.front() / 1.25 : 0;
    const double high = panel.sizes.back() * (logarithmic ? 1.25 : 1.06);
    const auto pxPerDeg = analysis.study.pxPerDeg;
    std::ostringstream out;
    out << grid.place(i) << "set title " << quotedForGnuplot(panel.title) << " font ',15'\n"
        << "set xlabel 'artifact size a (px)'\n"
        << "set ylabel 'filter radius r (px)' offset 1.2,0\n"
        << (logarithmic ? "set logscale xy\n" : "unset logscale\n") << "set xtics "
        << ticsAt(panel.sizes, low, high, logarithmic) << '\n'
        << "set ytics " << (logarithmic ? logTics(r.low, r.high) : "auto") << '\n'
        << "set grid ytics lc rgb '#dddddd' lw 0.6 dt solid\n"
        << "set xrange [" << low << ':' << high << "]\n"
        << "set yrange [" << r.low << ':' << r.high << "]\n";
    if (pxPerDeg && !logarithmic) {
        // Degrees on the right.
        out << "set border 11\n"
            << "set link y2 via y/" << *pxPerDeg << " inverse y*" << *pxPerDeg << '\n'
            << "set y2tics\n"
            << "set y2label 'degrees' offset -1.2,0\n";
    }
    out << "set key " << grid.below(i, 68) << " left top Left reverse vertical maxrows " << keyRows
        << " samplen 2.2 spacing 1.15 font ',11.5'\n";
    return out.str();
}

// With `keyRows` lines of key below each panel.
PanelGrid gridOf(std::size_t count, std::size_t keyRows, bool degrees) {
    const double key = kKeyRowPx * static_cast<double>(keyRows);
    const std::size_t columns = std::min<std::size_t>(count, 3);
    return {.count = count,
            .columns = columns,
            .widthPx = columns == 1 ? 520 : 900,
            .panelHeightPx = static_cast<int>(360 + key),
            .left = 70,
            .right = degrees ? 52.0 : 12.0,
            .top = 46,
            .bottom = 80 + key};
}

std::size_t mostSeries(const std::vector<Panel>& panels) {
    std::size_t most = 0;
    for (const Panel& panel : panels) most = std::max(most, panel.series.size());
    return most;
}

std::string criterionText(const SlopeAnalysis& analysis) {
    return "F* = " + fixedText(analysis.options.criterion, 4);
}

}  // namespace

Figure thresholdAgainstSize(const SlopeAnalysis& analysis) {
    const PanelChoice choice = choosePanels(analysis, true);
    const std::vector<Panel>& panels = choice.panels;
    Range radii = radiiOf(analysis, panels);
    const double published = publishedAt(analysis.options.criterion);
    for (const Panel& panel : panels) radii.hold(1.04 * panel.sizes.back() * published);
    radii = {0, 1.08 * radii.high};
    const std::size_t keyRows = mostSeries(panels) + 2;
    const PanelGrid grid = gridOf(panels.size(), keyRows, analysis.study.pxPerDeg.has_value());
    std::string data, plots;
    for (std::size_t i = 0; i < panels.size(); ++i) {
        PanelScript script(analysis, panels[i], i, false);
        for (const Series& series : panels[i].series) script.addCurve(series);
        for (std::size_t s = 0; s < panels[i].series.size(); ++s)
            script.addPoints(s, !analysis.slope.lawRejected);
        script.addPublished();
        data += script.data();
        plots += axesText(analysis, panels[i], false, radii, keyRows, grid, i) + "plot " +
                 script.plots() + "\n";
    }
    std::string caption =
        "Filter radius at which the mean observer still detects the artifact with probability " +
        criterionText(analysis) +
        ", against the artifact's size. Points: each condition by itself, with its 95 % interval "
        "where there is one. ";
    caption += analysis.slope.lawRejected
                   ? "Curves: the fit with a size exponent, since the law r = c a is rejected."
                   : "Lines and bands: the fitted law r = c a with its 95 % interval.";
    caption +=
        " Dotted: the published worst case, c = " + publishedText(analysis.options.criterion);
    if (std::any_of(panels.begin(), panels.end(), [](const Panel& panel) {
            return panel.pattern == records::Pattern::stair && panel.sizes.back() * 1.04 >= 20;
        })) {
        caption +=
            "; stars: stairs of 10 px, published as hidden at about 25 px, and of 20 px, at "
            "50 px or more (moved with the criterion like c)";
    }
    caption += "." + choice.leftOut;
    return multiplot("threshold_against_size", caption, grid, data, plots);
}

std::optional<Figure> referenceComparison(const SlopeAnalysis& analysis,
                                          const ReferenceSizes& reference) {
    PanelChoice choice = choosePanels(analysis, true);
    std::vector<Panel>& panels = choice.panels;
    // Only what has a reference.
    std::erase_if(panels, [&](const Panel& panel) {
        for (std::size_t k = 0; k < analysis.study.conditions.size(); ++k) {
            const auto size = referenceSize(reference, analysis.study, k);
            if (analysis.study.conditions[k].group == panel.series.front().group && size &&
                (size->halfCode || size->oneCode)) {
                return false;
            }
        }
        return true;
    });
    if (panels.empty()) return std::nullopt;
    Range radii = radiiOf(analysis, panels);
    for (const auto& [key, size] : reference) {
        if (size.halfCode) radii.hold(*size.halfCode);
        if (size.oneCode) radii.hold(*size.oneCode);
    }
    radii = {radii.low / 1.3, radii.high * 1.3};
    const std::size_t keyRows = mostSeries(panels) + 4;
    const PanelGrid grid = gridOf(panels.size(), keyRows, false);
    std::string data, plots;
    for (std::size_t i = 0; i < panels.size(); ++i) {
        PanelScript script(analysis, panels[i], i, true);
        for (const Series& series : panels[i].series) script.addCurve(series);
        for (std::size_t s = 0; s < panels[i].series.size(); ++s) script.addPoints(s, false);
        script.addReference(reference);
        script.addPublished();
        data += script.data();
        plots += axesText(analysis, panels[i], true, radii, keyRows, grid, i) + "plot " +
                 script.plots() + "\n";
    }
    return multiplot(
        "reference_size",
        "The same thresholds beside the reference filter sizes, which need no observer, on "
        "logarithmic axes (a law r = c a has slope 1). R1/2: the radius from which the filtered "
        "artifact and the filtered straight edge differ nowhere by more than rounding; R1: from "
        "which no display code differs by more than 1. Sizes that are not reached within " +
            shortText(kReferenceBoundPx) + " px are not drawn." + choice.leftOut,
        grid, data, plots);
}

std::optional<Figure> slopeAgainstLight(const SlopeAnalysis& analysis) {
    if (!analysis.contrastExponent) return std::nullopt;
    PanelChoice choice = choosePanels(analysis, false, 7, 1000);
    std::erase_if(choice.panels, [](const Panel& panel) { return panel.series.size() < 2; });
    if (choice.panels.empty()) return std::nullopt;
    const double e = analysis.contrastExponent->value;
    std::string data, plots;
    Range lit, slopes;
    for (std::size_t i = 0; i < choice.panels.size(); ++i) {
        const Panel& panel = choice.panels[i];
        std::ostringstream points, line;
        double meanLog = 0;
        Range own;
        for (const Series& series : panel.series) {
            const LinearEstimate& estimate = analysis.groups[series.group].c;
            const auto ci95 = estimate.ci95();
            const double level = analysis.study.groups[series.group].litLevel;
            const double low = c(ci95 ? ci95->low : estimate.value);
            const double high = c(ci95 ? ci95->high : estimate.value);
            points << level * std::pow(1.015, static_cast<double>(i)) << ' ' << c(estimate.value)
                   << ' ' << low << ' ' << high << '\n';
            own.hold(level);
            slopes.hold(low);
            slopes.hold(high);
            meanLog +=
                (estimate.value - e * std::log10(level)) / static_cast<double>(panel.series.size());
        }
        lit.hold(own.low);
        lit.hold(own.high);
        for (const double level : {own.low, own.high}) {
            line << level << ' ' << c(meanLog + e * std::log10(level)) << '\n';
        }
        const std::string number = std::to_string(i);
        data += dataBlock("points" + number, points.str()) + dataBlock("line" + number, line.str());
        const std::string style = " lw 1.4 lc rgb '" + seriesColour(i) + "' ";
        plots += std::string(i > 0 ? ", \\\n     " : "") + "$line" + number +
                 " using 1:2 with lines" + style + "notitle, \\\n     $points" + number +
                 " using 1:2:3:4 with yerrorbars pt -1" + style + "notitle, \\\n     $points" +
                 number + " using 1:2 with points pt " + seriesPoint(i) + " ps 0.8" + style +
                 "title " + quotedForGnuplot(panel.title);
    }
    std::vector<double> levels;
    for (const Group& group : analysis.study.groups) levels.push_back(group.litLevel);
    std::sort(levels.begin(), levels.end());
    levels.erase(std::unique(levels.begin(), levels.end()), levels.end());
    const double left = lit.low / 1.15, right = lit.high * 1.15;
    std::ostringstream axes;
    axes << "set logscale xy\nset xrange [" << left << ':' << right << "]\nset yrange ["
         << slopes.low / 1.1 << ':' << slopes.high * 1.1 << "]\n"
         << "set xlabel 'lit level (share of full white)'\nset ylabel 'slope c = r/a'\n"
         << "set xtics " << ticsAt(levels, left, right, true) << "\nset ytics "
         << logTics(slopes.low / 1.1, slopes.high * 1.1) << '\n'
         << "set grid ytics lc rgb '#dddddd' lw 0.6 dt solid\n"
         << "set key outside right top Left reverse samplen 1.6 spacing 1.2\nplot ";
    return Figure{.name = "slope_against_light",
                  .caption =
                      "Slope c against the light on the lit side, with 95 % intervals where there "
                      "are any, on logarithmic axes. Lines: the fitted exponent e of c(C) = c C^e "
                      "through the mean of each pattern." +
                      choice.leftOut,
                  .widthPx = 640,
                  .heightPx = 360,
                  .data = data,
                  .plot = axes.str() + plots + "\n"};
}

}  // namespace analysis
