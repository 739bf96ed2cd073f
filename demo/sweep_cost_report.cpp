// SPDX-License-Identifier: MIT
#include "demo/sweep_cost_report.h"

#include <cmath>

#include "demo/growth_exponent.h"
#include "demo/growth_run.h"

namespace demo {
namespace {

// Below, fixed costs of a pass hide how it grows.
constexpr int kLeastGrowingSize = 512;

}  // namespace

void addCosts(records::HtmlPage& page, ReportTables& tables, const SweepTable& table) {
    page.heading("Where the time goes");
    TableRows rows;
    for (const SweepCell& cell : table.cells) {
        if (cell.frame != 0 || !cell.measured()) continue;
        std::vector<std::string> row = {cell.scene, cell.technique,
                                        std::to_string(cell.resolution)};
        for (const double ms : {cell.frameMs.median, cell.frameMs.p25, cell.frameMs.p75})
            row.push_back(formatted("%.2f", ms));
        row.push_back(std::to_string(cell.frameMs.count));
        for (const double ms : cell.passMs) row.push_back(formatted("%.2f", ms));
        row.push_back(formatted("%.2f", cell.mapBytes / (1 << 20)));
        row.emplace_back(cell.noisy() ? "noisy" : "");
        rows.push_back(std::move(row));
    }
    tables.add(
        {.name = "cost",
         .caption =
             "First frame of each path: medians of whole frames, and one frame with its passes "
             "finished one by one. Noisy: fewer than three visits, or quartiles further apart "
             "than a quarter of the median.",
         .head = {"scene", "technique", "N", "ms", "ms p25", "ms p75", "visits", "depth",
                  "prefilter", "prepass", "lookup", "lit", "MiB", "note"},
         .rows = rows});
}

void addGrowth(records::HtmlPage& page, ReportTables& tables, const SweepTable& table) {
    page.heading("How cost grows with N");
    TableRows rows;
    for (const std::string& scene : table.scenes)
        for (const std::string& technique : table.techniques) {
            std::vector<std::string> row = {scene, technique};
            // Depth, prefilter and lookup.
            for (const std::size_t pass : {std::size_t{0}, std::size_t{1}, std::size_t{3}}) {
                std::vector<std::pair<double, double>> points;
                for (const SweepCell& cell : table.cells)
                    if (cell.scene == scene && cell.technique == technique && cell.measured() &&
                        cell.resolution >= kLeastGrowingSize)
                        points.emplace_back(cell.resolution, cell.passMs[pass]);
                const GrowthExponent growth = growthExponent(points);
                row.push_back(growth.points == 0 ? "n/a" : formatted("%.2f", growth.exponent));
                row.push_back(growth.points == 0 ? "n/a" : formatted("%.2f", growth.residual));
            }
            rows.push_back(std::move(row));
        }
    tables.add(
        {.name = "growth",
         .caption =
             "Exponents e of time = k N^e at constant softness, from N = 512 on, over all frames "
             "of the path, and the RMS by which times are off the power, as a share. Expected: "
             "full-kernel lookups grow with 2, separable prefilters with 3.",
         .head = {"scene", "technique", "depth", "depth off by", "prefilter", "prefilter off by",
                  "lookup", "lookup off by"},
         .rows = rows});
}

/// Where it was measured (growth_run.h).
void addGrowthRun(records::HtmlPage& page, const std::filesystem::path& folder) {
    if (!hasGrowth(folder)) return;
    page.heading("How cost grows with each thing alone");
    TableRows rows;
    for (const Growth& growth : readGrowth(folder)) {
        const GrowthExponent& fit = growth.exponent;
        const bool fitted = fit.points > 0;
        rows.push_back({growth.axis, growth.scene, growth.technique, growth.pass,
                        formatted("%.0f", growth.medians.front().first) + " to " +
                            formatted("%.0f", growth.medians.back().first),
                        formatted("%.3g", growth.medians.front().second) + " to " +
                            formatted("%.3g", growth.medians.back().second),
                        formatted("%.2f", fitted ? fit.exponent : NAN),
                        formatted("%.2f", fitted ? fit.exponent - fit.halfWidth95 : NAN) + " to " +
                            formatted("%.2f", fitted ? fit.exponent + fit.halfWidth95 : NAN),
                        formatted("%.2f", fitted ? fit.residual : NAN)});
    }
    page.table({"grows", "scene", "technique", "pass", "over", "ms", "exponent", "95 %", "off by"},
               rows,
               "Exponents e of time = k x^e over medians, one thing growing and the rest as it is "
               "(N = 1024, of lights 256; the scene's own triangles, the run's viewport), with the "
               "95 % interval "
               "of the fit. Fixed costs hold an exponent down: growth is seen in the pass that "
               "does the work. (growth_fits.tsv)");
}

}  // namespace demo
