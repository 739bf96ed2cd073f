// SPDX-License-Identifier: MIT
#include "analysis/figures.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <sstream>

#include "analysis/gnuplot.h"
#include "analysis/number_text.h"

namespace analysis {
namespace {

// Okabe and Ito's colours, told apart by colour-blind readers too; one per lit level.
constexpr const char* kLitColours[] = {"#0072B2", "#D55E00", "#009E73", "#CC79A7"};
constexpr const char* kLitPoints[] = {"7", "5", "9", "13"};
constexpr const char* kReferenceColour = "#767676";
constexpr const char* kInk = "#1a1a1a";

double c(double log10c) {
    return std::pow(10.0, log10c);
}

// A pattern, or one angle of a line, with its groups by falling lit level.
struct Panel {
    std::string title;
    records::Pattern pattern = records::Pattern::stair;
    std::vector<std::size_t> groups;
    std::set<double> sizes;
};

std::vector<Panel> panelsOf(const Study& study) {
    std::map<std::pair<records::Pattern, double>, Panel> byPattern;
    for (std::size_t k = 0; k < study.conditions.size(); ++k) {
        const std::size_t g = study.conditions[k].group;
        const Group& group = study.groups[g];
        const bool line = group.pattern == records::Pattern::line;
        const double angle = line ? group.angleDeg.value_or(0) : 0;
        Panel& panel = byPattern[{group.pattern, angle}];
        panel.pattern = group.pattern;
        panel.title = records::toText(group.pattern);
        if (line && group.angleDeg) panel.title += " at " + shortText(angle) + " deg";
        if (panel.groups.empty() || panel.groups.back() != g) panel.groups.push_back(g);
        panel.sizes.insert(study.conditions[k].artifactPx);
    }
    std::vector<Panel> all, several;
    for (auto& [key, panel] : byPattern) {
        all.push_back(panel);
        if (panel.sizes.size() >= 2) several.push_back(panel);
    }
    return several.empty() ? all : several;
}

std::string terminal(int width, int height, const std::string& svgName) {
    std::ostringstream out;
    out << "reset\n"
        << "set terminal svg size " << width << "," << height
        << " enhanced font 'Helvetica,Arial,sans-serif,13' background '#ffffff'\n"
        << "set output '" << svgName << "'\n"
        << "set encoding utf8\n"
        << "set border 3 lc rgb '" << kInk << "' lw 0.8\n"
        << "set tics nomirror out scale 0.6\n"
        << "set pointintervalbox 0\n";
    return out.str();
}

// Per group: thresholds of its conditions, in px.
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

// Radius that the fit gives the group at size a: the law, or the power of it where it is rejected.
double fittedRadius(const SlopeAnalysis& analysis, std::size_t group, double a) {
    const auto g = static_cast<Eigen::Index>(group);
    if (!analysis.slope.lawRejected) return a * c(analysis.slope.law.parameters.fixed[g]);
    const Eigen::VectorXd& b = analysis.slope.sizeFit->parameters.fixed;
    const double a0 = referenceArtifactPx(analysis.study);
    return a * c(b[g] + b[b.size() - 1] * std::log10(a / a0));
}

constexpr int kCurveSteps = 48;

// Top of the frame, the same for all panels: thresholds, the published slope and its anchors fit
// in; the reference may not.
double frameHeight(const SlopeAnalysis& analysis, const std::vector<Panel>& panels) {
    double highest = 0;
    for (const Panel& panel : panels) {
        const double largest = *panel.sizes.rbegin();
        highest = std::max(highest, 1.04 * largest * kPublishedSlope);
        for (const std::size_t group : panel.groups) {
            for (const Point& point : pointsOf(analysis, group)) {
                highest = std::max(highest, point.high);
            }
        }
    }
    return 1.08 * highest;
}

// The data blocks and the plot command of one panel. They are apart because gnuplot takes no data
// block inside a multiplot.
class PanelScript {
  public:
    PanelScript(const SlopeAnalysis& analysis, const ReferenceSizes& reference, const Panel& panel,
                int number, double highest)
        : analysis_(analysis),
          reference_(reference),
          panel_(panel),
          number_(number),
          highest_(highest),
          largest_(*panel.sizes.rbegin()) {
        for (std::size_t i = 0; i < panel_.groups.size(); ++i) addGroup(i);
        addReference();
        addPublished();
    }

    std::string data() const { return data_.str(); }
    std::string plot() const { return axes() + "plot " + plots_ + "\n"; }

  private:
    std::string block(const std::string& name) const {
        return "$" + name + std::to_string(number_);
    }

    void add(const std::string& plot) { plots_ += (plots_.empty() ? "" : ", \\\n     ") + plot; }

    void addGroup(std::size_t i) {
        const std::size_t group = panel_.groups[i];
        const std::string colour = kLitColours[i % std::size(kLitColours)];
        const std::string title = "lit " + shortText(analysis_.study.groups[group].litLevel) +
                                  ", c = " + fixedText(c(analysis_.groups[group].c.value), 2);
        const std::string suffix = std::to_string(i) + "_";
        addBandAndCurve(group, suffix, colour);
        // Beside each other, so that intervals of equal sizes can be told apart.
        const double aside =
            0.016 * largest_ *
            (static_cast<double>(i) - 0.5 * (static_cast<double>(panel_.groups.size()) - 1));
        data_ << block("points" + suffix) << " << EOD\n";
        for (const Point& point : pointsOf(analysis_, group)) {
            data_ << point.a + aside << ' ' << point.radius << ' ' << point.low << ' ' << point.high
                  << '\n';
        }
        data_ << "EOD\n";
        const std::string style = " lw 1.3 lc rgb '" + colour + "' ";
        const std::string points =
            std::string(" pt ") + kLitPoints[i % std::size(kLitPoints)] + " ps 0.75" + style;
        // As two plots: gnuplot leaves a gap between a point and its own bar.
        add(block("points" + suffix) + " using 1:2:3:4 with yerrorbars pt -1" + style + "notitle");
        add(block("points" + suffix) + " using 1:2 with points" + points + "title " +
            quotedForGnuplot(title));
    }

    void addBandAndCurve(std::size_t group, const std::string& suffix, const std::string& colour) {
        const LinearEstimate& own = analysis_.groups[group].c;
        const auto ci95 = own.ci95();
        const bool law = !analysis_.slope.lawRejected;
        data_ << block("curve" + suffix) << " << EOD\n";
        const double first = law ? 0 : *panel_.sizes.begin();
        for (int step = 0; step <= kCurveSteps; ++step) {
            const double a = first + (1.04 * largest_ - first) * step / kCurveSteps;
            const double radius = a > 0 ? fittedRadius(analysis_, group, a) : 0;
            data_ << a << ' ' << radius << ' ' << a * c(ci95 ? ci95->low : own.value) << ' '
                  << a * c(ci95 ? ci95->high : own.value) << '\n';
        }
        data_ << "EOD\n";
        if (law && ci95) {
            add(block("curve" + suffix) +
                " using 1:3:4 with filledcurves fs transparent solid "
                "0.10 noborder fc rgb '" +
                colour + "' notitle");
        }
        add(block("curve" + suffix) + " using 1:2 with lines lw 1.6 lc rgb '" + colour +
            "' notitle");
    }

    // Of the first group: the brightest lit level.
    void addReference() {
        const std::size_t group = panel_.groups.front();
        double nearest = 0, nearestSize = 0;
        data_ << block("reference") << " << EOD\n";
        for (std::size_t k = 0; k < analysis_.study.conditions.size(); ++k) {
            const Condition& condition = analysis_.study.conditions[k];
            const auto radius = referenceSize(reference_, analysis_.study, k);
            if (condition.group != group || !radius) continue;
            data_ << condition.artifactPx << ' ' << *radius << '\n';
            if (nearest == 0) {
                nearest = *radius;
                nearestSize = condition.artifactPx;
            }
        }
        data_ << "EOD\n";
        if (nearest == 0) return;
        std::string title =
            "reference R_{1/2}, lit " + shortText(analysis_.study.groups[group].litLevel);
        if (nearest > highest_) {  // the line leaves the frame before it enters
            title += ": " + fixedText(nearest, 0) + " px at a = " + shortText(nearestSize) +
                     ", above the frame";
        }
        add(block("reference") +
            " using 1:2 with linespoints dt (8,4) pt 2 ps 0.6 lw 1.2 lc rgb '" + kReferenceColour +
            "' title '" + title + "'");
    }

    void addPublished() {
        data_ << block("published") << " << EOD\n0 0\n"
              << 1.04 * largest_ << ' ' << 1.04 * largest_ * kPublishedSlope << "\nEOD\n";
        add(block("published") + " using 1:2 with lines dt (2,3) lw 1.2 lc rgb '" + kInk +
            "' title 'published, worst case: c = 3.47'");
        if (panel_.pattern != records::Pattern::stair || largest_ < 10) return;
        data_ << block("anchors") << " << EOD\n10 25\n20 50\nEOD\n";
        add(block("anchors") + " using 1:2 with points pt 3 ps 0.9 lw 1.2 lc rgb '" + kInk +
            "' title 'published, stair: 25 px, 50 px or more'");
    }

    std::string axes() const {
        std::ostringstream out;
        out << "set title " << quotedForGnuplot(panel_.title) << " font ',15' offset 0,-0.3\n"
            << "set xlabel 'artifact size a (px)' offset 0,0.6\n"
            << "set ylabel 'filter radius r (px)'\n"
            << "set xtics (";
        bool first = true;
        for (const double size : panel_.sizes) {
            out << (first ? "" : ", ") << quotedForGnuplot(shortText(size)) << ' ' << size;
            first = false;
        }
        out << ")\nset ytics auto\n"
            << "set grid ytics lc rgb '#dddddd' lw 0.6 dt solid\n"
            << "set xrange [0:" << 1.06 * largest_ << "]\n"
            << "set yrange [0:" << highest_ << "]\n"
            << "set bmargin 9.5\n"
            << "set xtics offset 0,0.3\n"
            << "set key at graph 0, graph -0.33 left top Left reverse vertical samplen 2.2 spacing "
               "1.15 font ',11.5'\n";
        return out.str();
    }

    const SlopeAnalysis& analysis_;
    const ReferenceSizes& reference_;
    const Panel& panel_;
    int number_;
    double highest_, largest_;
    std::ostringstream data_;
    std::string plots_;
};

}  // namespace

std::string thresholdAgainstSizeScript(const SlopeAnalysis& analysis,
                                       const ReferenceSizes& reference,
                                       const std::string& svgName) {
    const std::vector<Panel> panels = panelsOf(analysis.study);
    const int count = static_cast<int>(panels.size());
    const int columns = std::min(count, 3), rows = (count + columns - 1) / columns;
    const double height = frameHeight(analysis, panels);
    std::string data, plots;
    for (int i = 0; i < count; ++i) {
        const PanelScript panel(analysis, reference, panels[static_cast<std::size_t>(i)], i,
                                height);
        data += panel.data();
        plots += panel.plot();
    }
    std::ostringstream out;
    out << terminal(40 + 420 * columns, 460 * rows, svgName) << data << "set multiplot layout "
        << rows << "," << columns << "\n"
        << plots << "unset multiplot\n";
    return out.str();
}

std::string slopesByGroupScript(const SlopeAnalysis& analysis, const std::string& svgName) {
    struct Line {
        std::string name;
        double value;
        std::optional<records::Interval> ci95;
        bool summary;
    };
    std::vector<Line> lines;
    for (std::size_t g = 0; g < analysis.groups.size(); ++g) {
        const LinearEstimate& own = analysis.groups[g].c;
        lines.push_back({analysis.study.groups[g].name, own.value, own.ci95(), false});
    }
    if (analysis.groups.size() > 1) {
        lines.push_back({"overall", analysis.overall.value, analysis.overall.ci95(), true});
    }
    const WorstGroup& headline = analysis.slope.headline;
    lines.push_back({"headline", headline.value, headline.ci95, true});
    lines.push_back({"90th percentile", headline.value90, headline.ci95For90, true});

    double low = kPublishedSlope, high = kPublishedSlope;
    std::ostringstream groups, summary, tics;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const double row = static_cast<double>(lines.size() - i);
        const Line& line = lines[i];
        const double from = c(line.ci95 ? line.ci95->low : line.value);
        const double to = c(line.ci95 ? line.ci95->high : line.value);
        low = std::min(low, from);
        high = std::max(high, to);
        (line.summary ? summary : groups)
            << c(line.value) << ' ' << row << ' ' << from << ' ' << to << '\n';
        tics << (i > 0 ? ", " : "") << quotedForGnuplot(line.name) << ' ' << row;
    }
    std::ostringstream out;
    out << terminal(760, 120 + 26 * static_cast<int>(lines.size()), svgName) << "$groups << EOD\n"
        << groups.str() << "EOD\n"
        << "$summary << EOD\n"
        << summary.str() << "EOD\n"
        << "set logscale x\n"
        << "set xrange [" << low / 1.15 << ":" << high * 1.15 << "]\n"
        << "set yrange [0.3:" << static_cast<double>(lines.size()) + 0.7 << "]\n"
        << "set xlabel 'slope c = r/a'\n"
        << "set xtics (0.5, 1, 1.5, 2, 3, 4, 5, 7, 10, 15, 20, 30, 50)\n"
        << "set ytics (" << tics.str() << ") scale 0\n"
        << "set grid xtics lc rgb '#dddddd' lw 0.6 dt solid\n"
        << "set arrow 1 from " << kPublishedSlope << ", graph 0 to " << kPublishedSlope
        << ", graph 1 nohead dt (2,3) lw 1.2 lc rgb '" << kInk << "'\n"
        << "set label 1 'published 3.47' at " << kPublishedSlope
        << ", graph 1.03 center font ',11.5'\n"
        << "unset key\n"
        << "plot $groups using 1:2:3:4 with xerrorbars pt 7 ps 0.8 lw 1.4 lc rgb '"
        << kLitColours[0] << "', \\\n"
        << "     $summary using 1:2:3:4 with xerrorbars pt 13 ps 1.2 lw 1.8 lc rgb '"
        << kLitColours[1] << "'\n";
    return out.str();
}

}  // namespace analysis
