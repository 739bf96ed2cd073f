// SPDX-License-Identifier: MIT
// The answers themselves beside the fit: psychometric functions, staircases, residuals.
#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

#include "analysis/distributions.h"
#include "analysis/figure_panels.h"
#include "analysis/figures.h"
#include "analysis/gnuplot.h"
#include "analysis/number_text.h"
#include "analysis/observer_slopes.h"
#include "analysis/slope_model.h"
#include "quest/psychometric.h"

namespace analysis {
namespace {

constexpr double kBinWidth = 0.08;          // log10 units of r/a
constexpr std::size_t kMostFunctions = 24;  // panels of psychometric functions
constexpr std::size_t kTracedObservers = 6, kTraces = 12;
constexpr double kEdge = 1.2;            // between what is shown and the frame, as a factor
constexpr double kFunctionReach = 0.45;  // log10 units around the thresholds that are drawn
constexpr int kCurveSteps = 60;

double c(double log10c) {
    return std::pow(10.0, log10c);
}

// All answers of one panel, each at the r/a that it would be for the mean observer.
struct Function {
    std::string title;
    double log10c = 0;  // the fitted threshold
    double beta = 0, gammaSum = 0;
    struct Bin {
        int trials = 0, yes = 0;
        double sum = 0;  // of log10 r/a
    };
    std::map<long, Bin> bins;
    int trials = 0;
    double gamma() const { return gammaSum / trials; }
};

std::vector<Function> functionsOf(const SlopeAnalysis& analysis, bool byGroup) {
    const Study& study = analysis.study;
    const RandomObserverFit& fit = headlineFit(analysis);
    const Model model = slopeModel(study, perGroupDesign(study), analysis.options.criterion);
    std::vector<Function> functions(byGroup ? study.groups.size() : study.conditions.size());
    for (std::size_t k = 0; k < study.conditions.size(); ++k) {
        const Condition& condition = study.conditions[k];
        Function& function = functions[byGroup ? condition.group : k];
        function.title = byGroup ? study.groups[condition.group].name : conditionName(study, k);
        function.log10c = fittedLog10c(analysis, condition.group,
                                       byGroup ? referenceArtifactPx(study) : condition.artifactPx);
        function.beta = fit.parameters.beta[static_cast<std::size_t>(model.betaIndex[k])];
    }
    for (std::size_t i = 0; i < study.observers.size(); ++i) {
        for (std::size_t j = 0; j < study.observers[i].cells.size(); ++j) {
            const Cell& cell = study.observers[i].cells[j];
            const Condition& condition = study.conditions[cell.condition];
            Function& function = functions[byGroup ? condition.group : cell.condition];
            const double shift = function.log10c - fit.cellLocations[i][j];
            for (const StudyTrial& trial : cell.trials) {
                const double x = std::log10(trial.radiusPx / condition.artifactPx) + shift;
                Function::Bin& bin = function.bins[std::lround(x / kBinWidth)];
                ++bin.trials;
                bin.yes += trial.yes ? 1 : 0;
                bin.sum += x;
                ++function.trials;
                function.gammaSum += guessingRate(study.observers[i], study.task);
            }
        }
    }
    return functions;
}

struct Extent {
    double low = 1e300, high = -1e300;
    void hold(double value) {
        low = std::min(low, value);
        high = std::max(high, value);
    }
};

std::string curveRows(const Function& function, const Extent& x, double criterion, double lapse) {
    const quest::ResponseModel response{function.gamma(), lapse, function.gamma()};
    std::ostringstream rows;
    for (int step = 0; step <= kCurveSteps; ++step) {
        const double at = x.low + (x.high - x.low) * step / kCurveSteps;
        rows << c(at) << ' '
             << quest::responseProbability(
                    quest::detectionProbability(function.log10c - at, function.beta, criterion),
                    response)
             << '\n';
    }
    return rows.str();
}

// Frame of a small panel: the outer ones carry the axes' names.
std::string smallAxes(const PanelGrid& grid, std::size_t i, const std::string& title,
                      const std::string& xName, const std::string& yName) {
    std::ostringstream out;
    out << grid.place(i) << "set title " << quotedForGnuplot(title)
        << " font ',11' offset 0,-0.6\nset xlabel "
        << quotedForGnuplot(grid.columns < 3 || i + grid.columns >= grid.count ? xName : "")
        << "\nset ylabel " << quotedForGnuplot(i % grid.columns == 0 ? yName : "")
        << " offset 1.8,0\n";
    return out.str();
}

// Of the answers, as the task names them.
std::string yesName(const Study& study) {
    return study.task == records::Task::twoAfc ? "share correct" : "share seen";
}

struct Trace {
    std::size_t observer, cell;
};

// Observers evenly spaced by their c, conditions likewise.
std::vector<Trace> tracesOf(const SlopeAnalysis& analysis) {
    const Study& study = analysis.study;
    const std::vector<std::size_t> observers = observersByRisingSlope(observerSlopes(analysis));
    std::vector<std::size_t> conditions(study.conditions.size());
    for (std::size_t k = 0; k < conditions.size(); ++k) conditions[k] = k;
    std::stable_sort(conditions.begin(), conditions.end(), [&](std::size_t one, std::size_t other) {
        const auto slope = [&](std::size_t k) {
            return fittedLog10c(analysis, study.conditions[k].group,
                                study.conditions[k].artifactPx);
        };
        return slope(one) > slope(other);
    });
    const auto chosen = evenlySpaced(observers.size(), kTracedObservers);
    std::vector<Trace> traces;
    for (const std::size_t at : evenlySpaced(conditions.size(), kTraces / chosen.size())) {
        for (const std::size_t rank : chosen) {
            const std::vector<Cell>& cells = study.observers[observers[rank]].cells;
            const auto cell = std::find_if(cells.begin(), cells.end(), [&](const Cell& one) {
                return one.condition == conditions[at];
            });
            if (cell == cells.end()) continue;
            traces.push_back({observers[rank], static_cast<std::size_t>(cell - cells.begin())});
        }
    }
    if (traces.empty()) traces.push_back({observers.front(), 0});
    return traces;
}

// log10 of single thresholds over what the fit gives that observer there, by condition.
std::vector<std::vector<double>> residualsOf(const SlopeAnalysis& analysis) {
    const RandomObserverFit& fit = headlineFit(analysis);
    std::vector<std::vector<double>> residuals(analysis.study.conditions.size());
    for (const CellThreshold& cell : analysis.thresholds) {
        if (cell.state != ThresholdState::estimated) continue;
        const Condition& condition = analysis.study.conditions[cell.condition];
        residuals[cell.condition].push_back(
            cell.log10c - fittedLog10c(analysis, condition.group, condition.artifactPx) -
            fit.observerEffects[cell.observer]);
    }
    return residuals;
}

// "mean low high" with the t interval over observers, as factors; empty for a single one.
std::string meanRow(const std::vector<double>& values) {
    if (values.size() < 2) return "";
    const double count = static_cast<double>(values.size());
    double mean = 0, squares = 0;
    for (const double value : values) mean += value / count;
    for (const double value : values) squares += (value - mean) * (value - mean);
    const double half =
        studentQuantile(0.975, count - 1) * std::sqrt(squares / (count - 1) / count);
    std::ostringstream row;
    row << c(mean) << ' ' << c(mean - half) << ' ' << c(mean + half) << '\n';
    return row.str();
}

struct Drawing {
    std::string data, plot;
};

// Of panel number `p`: points and means of each series, beside each other.
Drawing residualDrawing(const SlopeAnalysis& analysis, const Panel& panel, std::size_t p,
                        const std::vector<std::vector<double>>& residuals) {
    const Study& study = analysis.study;
    Drawing drawing;
    for (std::size_t s = 0; s < panel.series.size(); ++s) {
        const Series& series = panel.series[s];
        const double place =
            static_cast<double>(s) - 0.5 * (static_cast<double>(panel.series.size()) - 1);
        std::ostringstream single, means;
        for (std::size_t k = 0; k < study.conditions.size(); ++k) {
            if (study.conditions[k].group != series.group) continue;
            const double a = study.conditions[k].artifactPx * std::pow(1.06, place);
            for (const double residual : residuals[k]) single << a << ' ' << c(residual) << '\n';
            const std::string mean = meanRow(residuals[k]);
            if (!mean.empty()) means << a * 1.02 << ' ' << mean;
        }
        if (single.str().empty()) continue;
        const std::string key = std::to_string(p) + "_" + std::to_string(s);
        const std::string colour = seriesColour(series.style);
        drawing.data += dataBlock("single" + key, single.str());
        drawing.plot += std::string(drawing.plot.empty() ? "" : ", \\\n     ") + "$single" + key +
                        " using 1:2 with points pt 7 ps 0.35 lc rgb '#90" + colour.substr(1) +
                        "' notitle";
        if (means.str().empty()) continue;
        drawing.data += dataBlock("mean" + key, means.str());
        drawing.plot += ", \\\n     $mean" + key + " using 1:2:3:4 with yerrorbars pt " +
                        seriesPoint(series.style) + " ps 0.8 lw 1.4 lc rgb '" + colour +
                        "' title " + quotedForGnuplot(series.name);
    }
    return drawing;
}

}  // namespace

Figure psychometricFunctions(const SlopeAnalysis& analysis) {
    const bool byGroup = analysis.study.conditions.size() > kMostFunctions;
    std::vector<Function> functions = functionsOf(analysis, byGroup);
    const std::size_t all = functions.size();
    if (all > kMostFunctions) {
        std::stable_sort(
            functions.begin(), functions.end(),
            [](const Function& one, const Function& other) { return one.log10c > other.log10c; });
        functions.resize(kMostFunctions);
    }
    Extent thresholds, x;
    int most = 1;
    for (const Function& function : functions) thresholds.hold(function.log10c);
    // Catch trials and first guesses far off would squeeze what matters.
    thresholds = {thresholds.low - kFunctionReach, thresholds.high + kFunctionReach};
    for (const Function& function : functions) {
        x.hold(function.log10c - 0.2);
        x.hold(function.log10c + 0.2);
        for (const auto& [key, bin] : function.bins) {
            x.hold(std::clamp(bin.sum / bin.trials, thresholds.low, thresholds.high));
            most = std::max(most, bin.trials);
        }
    }
    x = {x.low - kBinWidth, x.high + kBinWidth};
    const std::size_t columns = std::min<std::size_t>(functions.size(), 4);
    const PanelGrid grid{.count = functions.size(),
                         .columns = columns,
                         .widthPx = columns < 3 ? static_cast<int>(320 * columns) : 900,
                         .panelHeightPx = 215,
                         .left = 62,
                         .right = 10,
                         .top = 30,
                         .bottom = 62};
    const double lapse = headlineFit(analysis).parameters.lapse;
    std::string data, plots;
    for (std::size_t i = 0; i < functions.size(); ++i) {
        const Function& function = functions[i];
        const std::string number = std::to_string(i);
        std::ostringstream bins;
        for (const auto& [key, bin] : function.bins) {
            bins << c(bin.sum / bin.trials) << ' ' << static_cast<double>(bin.yes) / bin.trials
                 << ' ' << 0.25 + 0.95 * std::sqrt(static_cast<double>(bin.trials) / most) << '\n';
        }
        data +=
            dataBlock("bins" + number, bins.str()) +
            dataBlock("curve" + number, curveRows(function, x, analysis.options.criterion, lapse));
        std::ostringstream plot;
        plot << smallAxes(grid, i, function.title, "r/a (mean observer)", yesName(analysis.study))
             << "set logscale x\nset xrange [" << c(x.low) << ':' << c(x.high)
             << "]\nset yrange [-0.04:1.04]\nset xtics " << logTics(c(x.low), c(x.high))
             << "\nset ytics 0.5\nset grid ytics lc rgb '#dddddd' lw 0.6 dt solid\nunset key\n"
             << "set arrow 1 from " << c(function.log10c) << ", graph 0 to " << c(function.log10c)
             << ", graph 1 nohead dt (2,3) lw 1 lc rgb '" << kInk << "'\n"
             << "plot $curve" << number << " using 1:2 with lines lw 1.6 lc rgb '"
             << seriesColour(1) << "', \\\n     $bins" << number
             << " using 1:2:3 with points pt 7 ps variable lc rgb '" << seriesColour(0) << "'\n";
        plots += plot.str();
    }
    std::string caption =
        "Psychometric functions: share of " +
        std::string(analysis.study.task == records::Task::twoAfc ? "correct" : "\"seen\"") +
        " answers against r/a, with the fitted curve; dotted: the fitted threshold c. Points: "
        "bins of " +
        shortText(kBinWidth) + " log10 units; their area grows with the number of answers, up to " +
        std::to_string(most) +
        ". Each observer's radii are scaled by how the fit places this observer against the mean "
        "observer, so that all share one curve: the figure checks the curve's shape, not c. "
        "Answers "
        "farther than a factor of 2.8 from all thresholds are not drawn.";
    if (byGroup) caption += " Sizes of a group are drawn together.";
    if (all > functions.size()) {
        caption += " Drawn are the " + std::to_string(functions.size()) + " of " +
                   std::to_string(all) + " groups with the largest c.";
    }
    return multiplot("psychometric_functions", caption, grid, data, plots);
}

Figure staircaseTraces(const SlopeAnalysis& analysis) {
    const Study& study = analysis.study;
    const std::vector<Trace> traces = tracesOf(analysis);
    Extent y;
    std::size_t longest = 1;
    for (const Trace& trace : traces) {
        const Cell& cell = study.observers[trace.observer].cells[trace.cell];
        longest = std::max(longest, cell.trials.size());
        for (const StudyTrial& trial : cell.trials) {
            if (trial.catchTrial) continue;  // shown where they are easy, far from the rest
            y.hold(trial.radiusPx / study.conditions[cell.condition].artifactPx);
        }
    }
    const std::size_t columns = std::min<std::size_t>(traces.size(), 3);
    const PanelGrid grid{.count = traces.size(),
                         .columns = columns,
                         .widthPx = columns < 3 ? static_cast<int>(400 * columns) : 900,
                         .panelHeightPx = 200,
                         .left = 66,
                         .right = 10,
                         .top = 30,
                         .bottom = 60};
    std::string data, plots;
    for (std::size_t i = 0; i < traces.size(); ++i) {
        const Observer& observer = study.observers[traces[i].observer];
        const Cell& cell = observer.cells[traces[i].cell];
        const double a = study.conditions[cell.condition].artifactPx;
        const auto own = std::find_if(
            analysis.thresholds.begin(), analysis.thresholds.end(), [&](const CellThreshold& one) {
                return one.observer == traces[i].observer && one.condition == cell.condition &&
                       one.state == ThresholdState::estimated;
            });
        std::ostringstream path, yes, no, caught;
        int number = 0;
        for (const StudyTrial& trial : cell.trials) {
            ++number;
            std::ostringstream row;
            row << number << ' ' << std::clamp(trial.radiusPx / a, y.low / kEdge, y.high * kEdge)
                << '\n';
            if (!trial.catchTrial) path << row.str();
            (trial.catchTrial ? caught : trial.yes ? yes : no) << row.str();
        }
        const std::string key = std::to_string(i);
        data += dataBlock("path" + key, path.str()) + dataBlock("yes" + key, yes.str()) +
                dataBlock("no" + key, no.str()) + dataBlock("caught" + key, caught.str());
        std::ostringstream plot;
        plot << smallAxes(grid, i, observer.id + ": " + conditionName(study, cell.condition),
                          "trial", "r/a")
             << "set logscale y\nset xrange [0:" << longest + 1 << "]\nset yrange ["
             << y.low / kEdge << ':' << y.high * kEdge << "]\nset xtics auto\nset ytics "
             << logTics(y.low / kEdge, y.high * kEdge)
             << "\nset grid ytics lc rgb '#dddddd' lw 0.6 dt solid\nunset key\nunset arrow\n";
        if (own != analysis.thresholds.end()) {
            plot << "set arrow 1 from graph 0, first " << c(own->log10c) << " to graph 1, first "
                 << c(own->log10c) << " nohead dt (2,3) lw 1 lc rgb '" << kInk << "'\n";
        }
        plot << "plot ";
        const char* separator = "";
        const auto add = [&](const std::ostringstream& rows, const std::string& name,
                             const std::string& style) {
            if (rows.str().empty()) return;
            plot << separator << '$' << name << key << " using 1:2 with " << style;
            separator = ", \\\n     ";
        };
        const std::string blue = " lc rgb '" + seriesColour(0) + "'";
        add(path, "path", "lines lw 0.8 lc rgb '#b0b0b0'");
        add(yes, "yes", "points pt 7 ps 0.45" + blue);
        add(no, "no", "points pt 6 ps 0.45 lw 1.1" + blue);
        add(caught, "caught", "points pt 2 ps 0.6 lw 1.2 lc rgb '" + seriesColour(1) + "'");
        plots += plot.str() + "\n";
    }
    const bool twoAfc = study.task == records::Task::twoAfc;
    std::string caption = "Staircases: r/a from trial to trial in the order of the table. Filled: ";
    caption += twoAfc ? "correct; hollow: wrong; crosses: catch trials, at the edge where their "
                        "radius lies beyond it. "
                      : "seen; hollow: not seen. ";
    caption +=
        "Dotted: the observer's own threshold in this condition, where there is one. Chosen: "
        "observers evenly spaced by their c, from the lowest to the highest, in conditions "
        "evenly spaced by theirs, from the largest (" +
        std::to_string(traces.size()) + " of " + std::to_string(analysis.thresholds.size()) +
        " staircases).";
    return multiplot("staircases", caption, grid, data, plots);
}

std::optional<Figure> residualsAgainstSize(const SlopeAnalysis& analysis) {
    if (analysis.thresholds.size() < 4) return std::nullopt;
    const PanelChoice choice = choosePanels(analysis, true, 6, 7);
    const std::vector<std::vector<double>> residuals = residualsOf(analysis);
    Extent y{-0.1, 0.1};
    for (const std::vector<double>& values : residuals) {
        for (const double value : values) y.hold(value);
    }
    std::size_t keyRows = 1;
    for (const Panel& panel : choice.panels) keyRows = std::max(keyRows, panel.series.size());
    const std::size_t columns = std::min<std::size_t>(choice.panels.size(), 3);
    const PanelGrid grid{.count = choice.panels.size(),
                         .columns = columns,
                         .widthPx = columns == 1 ? 520 : 900,
                         .panelHeightPx = static_cast<int>(290 + 18 * keyRows),
                         .left = 70,
                         .right = 12,
                         .top = 32,
                         .bottom = 70 + 18.0 * static_cast<double>(keyRows)};
    std::string data, plots;
    for (std::size_t p = 0; p < choice.panels.size(); ++p) {
        const Panel& panel = choice.panels[p];
        const Drawing drawing = residualDrawing(analysis, panel, p, residuals);
        if (drawing.plot.empty()) continue;
        const double left = panel.sizes.front() / 1.5, right = panel.sizes.back() * 1.5;
        std::ostringstream axes;
        axes << smallAxes(grid, p, panel.title, "artifact size a (px)", "threshold over fit")
             << "set ylabel offset 0.5,0\nset logscale xy\nset xrange [" << left << ':' << right
             << "]\nset yrange [" << c(y.low - 0.03) << ':' << c(y.high + 0.03) << "]\nset xtics "
             << ticsAt(panel.sizes, left, right, true) << "\nset ytics "
             << logTics(c(y.low - 0.03), c(y.high + 0.03))
             << "\nset grid ytics lc rgb '#dddddd' lw 0.6 dt solid\n"
             << "set key " << grid.below(p, 58) << " left top Left reverse vertical maxrows "
             << keyRows << " samplen 1.5 spacing 1.15 font ',11.5'\n"
             << "set arrow 1 from graph 0, first 1 to graph 1, first 1 nohead lw 1 lc rgb '" << kInk
             << "'\n";
        data += drawing.data;
        plots += axes.str() + "plot " + drawing.plot + "\n";
    }
    return multiplot(
        "residuals",
        "Lack of fit: each observer's threshold in each condition over what the fit gives this "
        "observer there (small points), and the mean over observers with its 95 % t interval. A "
        "trend with size speaks against the exponent that was fitted (" +
            std::string(analysis.slope.lawRejected ? "kappa free" : "r = c a, kappa = 1") +
            "); means off 1 speak against one c per group. Thresholds that could not be estimated "
            "alone are missing." +
            choice.leftOut,
        grid, data, plots);
}

}  // namespace analysis
