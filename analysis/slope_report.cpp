// SPDX-License-Identifier: MIT
#include "analysis/slope_report.h"

#include <utility>

#include "analysis/figures.h"
#include "analysis/findings.h"
#include "analysis/number_text.h"
#include "analysis/result_tables.h"
#include "records/file_checksum.h"
#include "records/html_page.h"
#include "records/run_context.h"
#include "records/whole_file.h"

namespace analysis {
namespace {

// What stands under one heading of the report.
struct Section {
    std::string heading;
    std::vector<Figure> figures;
};

std::vector<Section> sectionsOf(const SlopeAnalysis& analysis, const ReferenceSizes& reference) {
    std::vector<Section> sections;
    const auto add = [&](std::optional<Figure> figure) {
        if (figure) sections.back().figures.push_back(std::move(*figure));
    };
    sections.push_back({"Thresholds", {}});
    add(thresholdAgainstSize(analysis));
    add(referenceComparison(analysis, reference));
    add(isoContours(analysis));
    sections.push_back({"Groups, light and observers", {}});
    add(slopesByGroup(analysis));
    add(slopeAgainstLight(analysis));
    add(slopesByObserver(analysis));
    add(audienceShares(analysis));
    sections.push_back({"The answers beside the fit", {}});
    add(psychometricFunctions(analysis));
    add(staircaseTraces(analysis));
    add(residualsAgainstSize(analysis));
    return sections;
}

std::string meaningOf(const records::Slope& slope) {
    return "A filter of radius r = c a hides the stair-steps of a shadow map whose texels appear a "
           "pixels large, to the criterion named above: at that radius the mean observer still "
           "detects the artifact with probability F* (guesses and lapses taken out), which gives " +
           fixedText(slope.percentCorrect, 1) +
           (slope.task == records::Task::twoAfc ? " % correct answers." : " % \"seen\" answers.") +
           " The same number at another criterion is another radius: c means nothing without it. "
           "Numbers in brackets are 95 % intervals.";
}

void addSections(records::HtmlPage& page, const std::filesystem::path& figures,
                 const std::vector<Section>& sections) {
    int number = 0;
    for (const Section& section : sections) {
        page.heading(section.heading);
        for (const Figure& figure : section.figures) {
            page.svg(records::readWholeFile(figures / (figure.name + ".svg")),
                     "Figure " + std::to_string(++number) + ". " + figure.caption);
        }
    }
}

void addTables(records::HtmlPage& page, const std::vector<TextTable>& tables) {
    page.heading("Numbers");
    int number = 0;
    for (const TextTable& table : tables) {
        page.table(table.head, table.rows,
                   "Table " + std::to_string(++number) + ". " + table.caption);
    }
}

std::string page(const SlopeAnalysis& analysis, const records::Slope& slope,
                 const std::vector<TextTable>& tables, const std::filesystem::path& folder,
                 const std::vector<Section>& sections, const std::string& checksums) {
    records::HtmlPage page("How much blur hides the stair-steps");
    page.headline(records::describeValue(slope), records::describeTerms(slope));
    for (const std::string& warning : warnings(analysis)) page.note(warning);
    page.paragraph(meaningOf(slope));
    page.heading("What was found");
    std::vector<std::pair<std::string, std::string>> found;
    for (const Finding& finding : findings(analysis)) {
        found.emplace_back(finding.topic, finding.text);
    }
    page.terms(found);
    addSections(page, folder / "figures", sections);
    addTables(page, tables);
    page.heading("How it was done");
    page.paragraph(slope.method);
    if (!analysis.notices.empty()) {
        page.subheading("Left out, and notices");
        std::string notices;
        for (const std::string& notice : analysis.notices) notices += notice + "\n";
        page.preformatted(notices);
    }
    page.subheading("This run");
    page.preformatted(records::contextText(slope.context));
    page.subheading("The data");
    page.paragraph(
        "SHA-256 of every trial table, as sha256sum --check reads it where the command was given; "
        "also in data.sha256.");
    page.preformatted(checksums);
    return page.text();
}

}  // namespace

void writeReport(const std::filesystem::path& folder, const SlopeAnalysis& analysis,
                 const records::Slope& slope, const ReferenceSizes& reference, StageTimes* times) {
    records::createFolders(folder);
    for (const TextTable& table : fileTables(analysis, reference)) {
        records::writeWholeFile(folder / (table.name + ".tsv"), tsvText(table));
    }
    const std::string checksums = records::checksumLines(analysis.study.files);
    records::writeWholeFile(folder / "data.sha256", checksums);
    if (times) times->lap("tables and checksums");
    const std::vector<Section> sections = sectionsOf(analysis, reference);
    std::vector<Figure> figures;
    for (const Section& section : sections) {
        figures.insert(figures.end(), section.figures.begin(), section.figures.end());
    }
    drawFigures(folder / "figures", figures);
    if (times) times->lap("figures (gnuplot)");
    records::writeWholeFile(
        folder / "report.html",
        page(analysis, slope, reportTables(analysis, reference), folder, sections, checksums));
    records::writeSlope(folder / "slope.json", slope);
    if (times) times->lap("report and slope.json");
}

}  // namespace analysis
