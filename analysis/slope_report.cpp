// SPDX-License-Identifier: MIT
#include "analysis/slope_report.h"

#include "analysis/figures.h"
#include "analysis/findings.h"
#include "analysis/number_text.h"
#include "analysis/result_tables.h"
#include "records/html_page.h"
#include "records/run_context.h"
#include "records/whole_file.h"

namespace analysis {
namespace {

std::vector<Figure> figuresOf(const SlopeAnalysis& analysis, const ReferenceSizes& reference) {
    std::vector<Figure> figures = {thresholdAgainstSize(analysis)};
    const auto add = [&](std::optional<Figure> figure) {
        if (figure) figures.push_back(std::move(*figure));
    };
    add(referenceComparison(analysis, reference));
    add(slopeAgainstLight(analysis));
    add(isoContours(analysis));
    add(slopesByGroup(analysis));
    add(slopesByObserver(analysis));
    add(psychometricFunctions(analysis));
    add(staircaseTraces(analysis));
    add(residualsAgainstSize(analysis));
    return figures;
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
        page.svg(records::readWholeFile(folder / "figures" / (figure.name + ".svg")),
                 figure.caption);
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
    if (times) times->lap("tables");
    const std::vector<Figure> drawn = figuresOf(analysis, reference);
    drawFigures(folder / "figures", drawn);
    if (times) times->lap("figures (gnuplot)");
    records::writeWholeFile(folder / "report.html",
                            page(analysis, slope, reference, folder, drawn));
    records::writeSlope(folder / "slope.json", slope);
    if (times) times->lap("report and slope.json");
}

}  // namespace analysis
