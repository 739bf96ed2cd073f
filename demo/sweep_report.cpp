// SPDX-License-Identifier: MIT
#include "demo/sweep_report.h"

#include <cmath>

#include "demo/direct_run.h"
#include "demo/policy_comparison.h"
#include "demo/report_tables.h"
#include "demo/stability_report.h"
#include "demo/sweep_cost_report.h"
#include "demo/sweep_error_report.h"
#include "demo/sweep_policy_report.h"
#include "records/html_page.h"
#include "records/whole_file.h"

namespace demo {
namespace {

namespace fs = std::filesystem;

// A working technique at half the reference's size and more is nearer than this to the reference,
// where the kernel is wide enough in texels to hide them (the published slope).
constexpr double kMostErrorNearReference = 0.1;
constexpr double kLeastTexelsInRadius = 3.47;

void addGaps(records::HtmlPage& page, const SweepTable& table) {
    TableRows rows;
    std::size_t noisy = 0;
    for (const SweepCell& cell : table.cells)
        if (!cell.measured())
            rows.push_back({cell.scene, std::to_string(cell.frame), cell.technique,
                            std::to_string(cell.resolution), cell.status});
        else
            noisy += cell.noisy();
    // Of shards that have not run, and of a killed sweep.
    for (const std::string& scene : table.scenes)
        for (int frame = 0; frame < table.frames; ++frame)
            for (const std::string& technique : table.techniques)
                for (const int size : table.sizes)
                    if (table.find(scene, frame, technique, size) == nullptr)
                        rows.push_back({scene, std::to_string(frame), technique,
                                        std::to_string(size), "not in the journals"});
    page.heading("What was not measured, or is noisy");
    page.paragraph(std::to_string(noisy) + " of " + std::to_string(table.cells.size()) +
                   " cells are noisy: visited fewer than three times, or with quartiles further "
                   "apart than a quarter of the median.");
    if (rows.empty())
        page.paragraph("Every cell has its numbers.");
    else
        page.table({"scene", "frame", "technique", "N", "why"}, rows,
                   "Skipped, failed and unfinished cells.");
}

/// For documents that quote the sweep.
std::string summaryText(const SweepHeadline& headline,
                        const std::vector<PolicyComparison>& comparisons,
                        const std::vector<DirectRow>& direct, const SweepTable& table) {
    std::string text;
    if (!headline.number.empty())
        text += "**" + headline.number + "** " + headline.meaning + "\n\n";
    std::vector<NamedTable> quoted = {techniqueTable(comparisons)};
    if (!direct.empty()) quoted.push_back(automaticTable(direct, table));
    for (const NamedTable& one : quoted)
        text += one.caption + " ([" + one.name + ".tsv](" + one.name + ".tsv))\n\n" +
                markdownTable(one) + "\n";
    return text;
}

}  // namespace

std::vector<std::string> brokenTechniques(const SweepTable& table) {
    std::vector<std::string> broken;
    for (const std::string& technique : table.techniques) {
        std::string why;
        std::vector<double> nearReference;
        for (const SweepCell& cell : table.cells) {
            if (cell.technique != technique) continue;
            const std::string where =
                " at " + std::to_string(cell.resolution) + " in " + cell.scene;
            if (why.empty() && cell.status.starts_with("failed")) why = where + ": " + cell.status;
            if (why.empty() && cell.measured() && !std::isfinite(cell.rmse))
                why = where + ": visibility is no number";
            if (cell.measured() && table.convergedAgainst(cell) &&
                cell.resolution != cell.reference && 2 * cell.resolution >= cell.reference &&
                cell.radiusUv * cell.resolution >= kLeastTexelsInRadius)
                nearReference.push_back(cell.rmse);
        }
        // Thin casters and steep ground keep single scenes from converging.
        const double typical = spreadOf(std::move(nearReference)).median;
        if (why.empty() && !(typical <= kMostErrorNearReference))
            why = ": does not converge, median RMSE " + formatted("%.3f", typical) +
                  " at half the reference's size and above";
        if (!why.empty()) broken.push_back(technique + why);
    }
    return broken;
}

fs::path writeSweepReport(const fs::path& folder, const SweepTable& table,
                          const std::optional<fs::path>& stability) {
    const std::vector<PolicyComparison> comparisons = comparePolicies(table);
    const std::vector<DirectRow> direct = readDirect(folder);
    const SweepHeadline headline = sweepHeadline(direct, comparisons, table);
    records::HtmlPage page("Speed against error");
    for (const std::string& what : brokenTechniques(table)) page.failure("Broken: " + what + ".");
    if (!headline.number.empty()) page.headline(headline.number, headline.meaning);
    ReportTables tables(page, folder, table.context);
    addTechniques(page, tables, comparisons);
    addAutomatic(page, tables, direct, table);
    addPictures(page, table, folder);
    addFronts(page, tables, table);
    addPolicies(page, tables, comparisons, table, direct);
    addSlopes(page, tables, table);
    addRipples(page, table);
    addErrors(page, tables, table);
    addTemporalErrors(page, tables, table);
    addCosts(page, tables, table);
    addGrowth(page, tables, table);
    addGrowthRun(page, folder);
    addModelErrors(page, folder);
    addStability(page, stability);
    addGaps(page, table);
    page.heading("How it was measured");
    page.preformatted(table.context);
    records::writeWholeFile(folder / "summary.md",
                            summaryText(headline, comparisons, direct, table));
    const fs::path file = folder / "sweep.html";
    page.write(file);
    return file;
}

}  // namespace demo
