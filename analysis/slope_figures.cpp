// SPDX-License-Identifier: MIT
// Slopes beside each other: of groups, and of observers.
#include <algorithm>
#include <cmath>
#include <sstream>

#include "analysis/figures.h"
#include "analysis/gnuplot.h"
#include "analysis/number_text.h"
#include "analysis/observer_slopes.h"
#include "analysis/published_slope.h"

namespace analysis {
namespace {

constexpr std::size_t kMostRows = 60;        // of groups, and of observers with their names
constexpr std::size_t kMostObservers = 400;  // beyond: evenly spaced

double c(double log10c) {
    return std::pow(10.0, log10c);
}

// One row of a forest plot, log10 c.
struct Line {
    std::string name;
    double value = 0;
    std::optional<records::Interval> ci95;
    std::size_t style = 0;              // 0 single, 1 summary
    std::optional<double> second = {};  // drawn hollow
};

// Rows from the top, on a logarithmic axis, with the published slope as a vertical line.
Figure forest(std::string name, std::string caption, const std::vector<Line>& lines,
              const std::string& axis, bool named, double criterion) {
    const double published = publishedAt(criterion);
    double low = published, high = published;
    std::ostringstream rows[2], second, tics;
    // A summary has a name, which takes more room than a row without one.
    const double summaryRows = named ? 1 : 4;
    double row = 0;
    for (const Line& line : lines) row += line.style == 1 ? summaryRows : 1;
    const double allRows = row;
    for (const Line& line : lines) {
        if (line.style == 1) row -= summaryRows - 1;
        const double from = c(line.ci95 ? line.ci95->low : line.value);
        const double to = c(line.ci95 ? line.ci95->high : line.value);
        low = std::min(low, from);
        high = std::max(high, to);
        rows[line.style] << c(line.value) << ' ' << row << ' ' << from << ' ' << to << '\n';
        if (line.second) second << c(*line.second) << ' ' << row << '\n';
        if (named || line.style == 1) {
            tics << (tics.tellp() > 0 ? ", " : "") << quotedForGnuplot(line.name) << ' ' << row;
        }
        row -= 1;
    }
    const int rowPx = !named ? 5 : lines.size() <= 20 ? 26 : 18;
    std::ostringstream plot;
    plot << "set logscale x\n"
         << "set xrange [" << low / 1.15 << ':' << high * 1.15 << "]\n"
         << "set yrange [0.3:" << allRows + 0.7 << "]\n"
         << "set xlabel " << quotedForGnuplot(axis) << '\n'
         << "set xtics " << logTics(low / 1.15, high * 1.15) << '\n'
         << "set ytics (" << tics.str() << ") scale 0\n"
         << "set grid xtics lc rgb '#dddddd' lw 0.6 dt solid\n"
         << "set arrow 1 from " << published << ", graph 0 to " << published
         << ", graph 1 nohead dt (2,3) lw 1.2 lc rgb '" << kInk << "'\n"
         << "set label 1 " << quotedForGnuplot("published " + publishedText(criterion)) << " at "
         << published << ", graph 1 center offset 0,0.7 font ',11.5'\n"
         << "set tmargin 2.5\nunset key\nplot ";
    const char* separator = "";
    if (rows[0].tellp() > 0) {
        plot << "$single using 1:2:3:4 with xerrorbars pt 7 ps " << (rowPx < 10 ? 0.4 : 0.8)
             << " lw " << (rowPx < 10 ? 0.7 : 1.4) << " lc rgb '" << seriesColour(0) << "'";
        separator = ", \\\n     ";
    }
    if (second.tellp() > 0) {
        plot << separator << "$second using 1:2 with points pt 6 ps " << (rowPx < 10 ? 0.3 : 0.6)
             << " lw 1.2 lc rgb '" << kInk << "'";
    }
    if (rows[1].tellp() > 0) {
        plot << separator << "$summary using 1:2:3:4 with xerrorbars pt 13 ps 1.2 lw 1.8 lc rgb '"
             << seriesColour(1) << "'";
    }
    plot << '\n';
    return {.name = std::move(name),
            .caption = std::move(caption),
            .widthPx = 760,
            .heightPx = 120 + static_cast<int>(rowPx * allRows),
            .data = dataBlock("single", rows[0].str()) + dataBlock("second", second.str()) +
                    dataBlock("summary", rows[1].str()),
            .plot = plot.str()};
}

}  // namespace

Figure slopesByGroup(const SlopeAnalysis& analysis) {
    std::vector<Line> lines;
    for (std::size_t g = 0; g < analysis.groups.size(); ++g) {
        const LinearEstimate& own = analysis.groups[g].c;
        lines.push_back({analysis.study.groups[g].name, own.value, own.ci95(), 0, {}});
    }
    std::string chosen;
    if (lines.size() > kMostRows) {
        std::sort(lines.begin(), lines.end(),
                  [](const Line& one, const Line& other) { return one.value > other.value; });
        chosen = " Drawn are the " + std::to_string(kMostRows) + " largest of " +
                 std::to_string(lines.size()) + " groups, by falling c.";
        lines.resize(kMostRows);
    }
    if (analysis.groups.size() > 1) {
        lines.push_back({"geometric mean", analysis.overall.value, analysis.overall.ci95(), 1, {}});
    }
    const WorstGroup& headline = analysis.slope.headline;
    lines.push_back({"headline", headline.value, headline.ci95, 1, {}});
    const bool people = analysis.slope.law.observers > 1;
    if (people) lines.push_back({"90th percentile", headline.value90, headline.ci95For90, 1, {}});
    return forest(
        "slopes_by_group",
        "Slope c of every group with its 95 % interval where there is one, on a "
        "logarithmic scale; the geometric mean over groups where there are several; the "
        "headline, which is the worst group, its interval accounting for the choice" +
            std::string(people ? ", for the mean and for the 90th-percentile observer." : ".") +
            (analysis.slope.lawRejected
                 ? " The law being rejected, the headline is of another fit than the groups: c "
                   "where it is largest over the sizes, not over all of them."
                 : "") +
            chosen,
        lines, "slope c = r/a", true, analysis.options.criterion);
}

std::optional<Figure> slopesByObserver(const SlopeAnalysis& analysis) {
    const std::vector<ObserverSlope> slopes = observerSlopes(analysis);
    if (slopes.size() < 2) return std::nullopt;
    std::vector<std::size_t> order = observersByRisingSlope(slopes);
    std::reverse(order.begin(), order.end());
    const WorstGroup& headline = analysis.slope.headline;
    std::vector<Line> lines;
    for (const std::size_t at : evenlySpaced(order.size(), kMostObservers)) {
        const ObserverSlope& slope = slopes[order[at]];
        const double shrunken = headline.value + slope.shrunken;
        Line line{.name = analysis.study.observers[order[at]].id,
                  .value = headline.value + slope.own.value_or(slope.shrunken),
                  .ci95 = {},
                  .style = 0,
                  .second = shrunken};
        if (slope.own) {
            const double half = kNormal95 * slope.standardError;
            line.ci95 = records::Interval{line.value - half, line.value + half};
        }
        lines.push_back(std::move(line));
    }
    const bool named = lines.size() <= kMostRows;
    std::string caption =
        "Each observer's c in the worst group, " + analysis.slope.worstGroup +
        ". Filled: from the observer's own thresholds in all conditions, with 95 % interval "
        "(answers and conditions, not other people); hollow: as the one-stage fit has it, drawn "
        "towards the mean observer. Below: the mean and the 90th-percentile observer, with the "
        "intervals of the headline.";
    if (!named) caption += " Observers by falling c, without names: observers.tsv has them.";
    if (lines.size() < order.size()) {
        caption += " Drawn are " + std::to_string(lines.size()) + " of " +
                   std::to_string(order.size()) + ", evenly spaced in rank.";
    }
    lines.push_back({"mean observer", headline.value, headline.ci95, 1, {}});
    lines.push_back({"90th percentile", headline.value90, headline.ci95For90, 1, {}});
    return forest("slopes_by_observer", caption, lines, "slope c = r/a in the worst group", named,
                  analysis.options.criterion);
}

std::optional<Figure> audienceShares(const SlopeAnalysis& analysis) {
    if (!analysis.audience || !analysis.audience->populationKnown) return std::nullopt;
    const AudienceCurve& curve = *analysis.audience;
    std::ostringstream rows, plot;
    for (const AudienceCurve::Point& point : curve.points) {
        rows << point.slope;
        for (const double share : point.observerShares) rows << ' ' << 100 * share;
        rows << '\n';
    }
    const double low = curve.points.front().slope, high = curve.points.back().slope;
    const double headline = c(analysis.slope.headline.value);
    plot << "set logscale x\nset xrange [" << low << ':' << high
         << "]\nset yrange [0:100]\nset xlabel 'c: shadows filtered at r = c a'\n"
         << "set ylabel 'observers who notice (%)'\nset xtics " << logTics(low, high)
         << "\nset ytics 10\nset grid xtics ytics lc rgb '#dddddd' lw 0.6 dt solid\n"
         << "set arrow 1 from " << headline << ", graph 0 to " << headline
         << ", graph 1 nohead dt (2,3) lw 1.2 lc rgb '" << kInk << "'\nset label 1 "
         << quotedForGnuplot("headline " + fixedText(headline, 2)) << " at " << headline
         << ", graph 1 center offset 0,0.7 font ',11.5'\n"
         << "set tmargin 2.5\nset key outside right top Left reverse samplen 1.8 spacing 1.3 "
            "title 'at least one trial in'\nplot ";
    for (std::size_t i = 0; i < std::size(kTrialShares); ++i) {
        plot << (i > 0 ? ", \\\n     " : "") << "$shares using 1:" << i + 2
             << " with lines lw 2 lc rgb '" << seriesColour(i) << "' title '"
             << shortText(1 / kTrialShares[i]) << "'";
    }
    plot << '\n';
    return Figure{
        .name = "audience",
        .caption =
            "Who still notices: share of observers who detect the artifact of the worst "
            "group, " +
            analysis.slope.worstGroup +
            ", on at least one trial in 20, 10, 4 or 2 (guesses taken out), against the c "
            "that shadows are filtered with; by the fitted spread between observers (" +
            fixedText(curve.tau, 3) + " log10) and psychometric slope (beta " +
            fixedText(curve.beta, 2) + ").",
        .widthPx = 760,
        .heightPx = 380,
        .data = dataBlock("shares", rows.str()),
        .plot = plot.str()};
}

}  // namespace analysis
