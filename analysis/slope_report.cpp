// SPDX-License-Identifier: MIT
#include "analysis/slope_report.h"

#include "analysis/figures.h"
#include "analysis/findings.h"
#include "analysis/gnuplot.h"
#include "analysis/number_text.h"
#include "analysis/result_tables.h"
#include "records/html_page.h"
#include "records/run_context.h"
#include "records/whole_file.h"

namespace analysis {
namespace {

struct Figure {
    std::string name, caption, script;
};

std::vector<Figure> figures(const SlopeAnalysis& analysis, const ReferenceSizes& reference) {
    const std::string criterion = "F* = " + fixedText(analysis.options.criterion, 3);
    const std::string drawn =
        analysis.slope.lawRejected
            ? "Lines: the fit with a size exponent, since the law r = c a is rejected"
            : "Lines and bands: the fitted law r = c a with its 95 % interval";
    return {{"threshold_against_size",
             "Filter radius at which the artifact is detected with probability " + criterion +
                 ", against the artifact's size, for the mean observer. Points: each condition by "
                 "itself with its 95 % interval. " +
                 drawn +
                 ". Reference R1/2: the radius from which no display code differs by more than "
                 "rounding (of the brightest lit level; outside the frame where it is not drawn).",
             thresholdAgainstSizeScript(analysis, reference, "threshold_against_size.svg")},
            {"slopes_by_group",
             "Slope c of every group with its 95 % interval, on a logarithmic scale; the geometric "
             "mean over groups; the headline (the worst group, its interval accounting for the "
             "choice) for the mean and for the 90th-percentile observer.",
             slopesByGroupScript(analysis, "slopes_by_group.svg")}};
}

std::string page(const SlopeAnalysis& analysis, const records::Slope& slope,
                 const ReferenceSizes& reference, const std::filesystem::path& folder,
                 const std::vector<Figure>& figures) {
    records::HtmlPage page("How much blur hides the stair-steps");
    page.headline(records::describeValue(slope), records::describeTerms(slope));
    page.paragraph(
        "A filter of radius r = c a hides the stair-steps of a shadow map whose texels appear a "
        "pixels large, to the criterion named above: at that radius the mean observer still "
        "detects the artifact with probability F* (guesses and lapses taken out), which gives " +
        fixedText(slope.percentCorrect, 1) +
        (slope.task == records::Task::twoAfc ? " % correct answers." : " % \"seen\" answers.") +
        " The same number at another criterion is another radius: c means nothing without it.");
    for (const std::string& warning : warnings(analysis)) page.note(warning);
    for (const Finding& finding : findings(analysis)) {
        page.paragraph(finding.topic + ": " + finding.text);
    }
    page.heading("Threshold against size");
    for (const Figure& figure : figures) {
        page.svg(records::readWholeFile(folder / (figure.name + ".svg")), figure.caption);
    }
    page.heading("Numbers");
    for (const TextTable& table : reportTables(analysis, reference)) {
        page.table(table.head, table.rows, table.caption);
    }
    page.heading("How it was done");
    page.paragraph(slope.method);
    if (!analysis.notices.empty()) page.subheading("Left out, and warnings");
    for (const std::string& notice : analysis.notices) page.paragraph(notice);
    page.subheading("This run");
    page.preformatted(records::contextText(slope.context));
    return page.text();
}

}  // namespace

void writeReport(const std::filesystem::path& folder, const SlopeAnalysis& analysis,
                 const records::Slope& slope, const ReferenceSizes& reference, StageTimes* times) {
    records::createFolders(folder);
    for (const TextTable& table : fileTables(analysis, reference)) {
        records::writeWholeFile(folder / (table.name + ".tsv"), tsvText(table));
    }
    const std::vector<Figure> drawn = figures(analysis, reference);
    std::vector<std::string> scripts;
    for (const Figure& figure : drawn) {
        scripts.push_back(figure.name + ".gp");
        records::writeWholeFile(folder / scripts.back(), figure.script);
    }
    if (times) times->lap("tables");
    runGnuplot(folder, scripts);
    if (times) times->lap("figures (gnuplot)");
    records::writeWholeFile(folder / "report.html",
                            page(analysis, slope, reference, folder, drawn));
    records::writeSlope(folder / "slope.json", slope);
    if (times) times->lap("report and slope.json");
}

}  // namespace analysis
