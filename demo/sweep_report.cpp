// SPDX-License-Identifier: MIT
#include "demo/sweep_report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "demo/growth_exponent.h"
#include "demo/policy_comparison.h"
#include "demo/speed_error_front.h"
#include "demo/tsv_journal.h"
#include "demo/xy_plot.h"
#include "records/html_page.h"
#include "records/whole_file.h"

namespace demo {
namespace {

namespace fs = std::filesystem;

// A working technique at half the reference's size and more is nearer than this to the reference.
constexpr double kMostErrorNearReference = 0.1;
// METHODS section 8 for straight edges in uniform directions: .12 at r/a = 3.47, and 1 / (r/a).
constexpr double kRippleTimesRatio = 0.12 * 3.47;

std::string formatted(const char* format, double value) {
    if (!std::isfinite(value)) return "n/a";
    char text[48];
    std::snprintf(text, sizeof text, format, value);
    return text;
}

/// On the page and as a file beside it.
class Tables {
  public:
    Tables(records::HtmlPage& page, fs::path folder, std::string context)
        : page_(page), folder_(std::move(folder)), context_(std::move(context)) {}

    void add(const std::string& name, const std::vector<std::string>& head,
             const std::vector<std::vector<std::string>>& rows, const std::string& caption) {
        page_.table(head, rows, caption + " (" + name + ".tsv)");
        TsvTable file(name, head);
        file.setContext(context_);
        for (const auto& row : rows) file.add(row);
        records::writeWholeFile(folder_ / (name + ".tsv"), file.toText());
    }

  private:
    records::HtmlPage& page_;
    fs::path folder_;
    std::string context_;
};

void addHeadline(records::HtmlPage& page, const std::vector<PolicyComparison>& comparisons,
                 const SweepTable& table) {
    for (const PolicyComparison& comparison : comparisons) {
        if (!comparison.ours) {
            page.note(comparison.technique +
                      ": the automatic size does not reach the bound with any c in the sweep.");
            continue;
        }
        const auto fixed =
            std::find_if(comparison.entries.begin(), comparison.entries.end(),
                         [](const auto& entry) { return entry.policy->name == "fixed"; });
        if (fixed == comparison.entries.end() || !fixed->result) continue;
        page.headline(
            formatted("%.2fx", fixed->timesOurs) + " the speed",
            "of the best fixed size (" + formatted("%.0f", fixed->result->parameter) + "), " +
                comparison.technique +
                " at automatic size with c = " + formatted("%.2f", comparison.ours->parameter) +
                ": whole frames, geometric mean over " + std::to_string(table.scenes.size()) +
                " scenes, both with an edge ripple of at most " + formatted("%.2f", kRippleBound) +
                " at 95 % of the contour pixels.");
    }
}

void addPolicies(records::HtmlPage& page, Tables& tables,
                 const std::vector<PolicyComparison>& comparisons, const SweepTable& table) {
    page.heading("Sizing policies at equal quality");
    page.paragraph(
        "Every policy has one parameter, set to the fastest value at which edge ripple over all "
        "scenes' paths stays within the bound. Times are whole frames from one measured table; "
        "above 1 a policy is slower than ours, below 1 we lose.");
    std::vector<std::vector<std::string>> rows;
    for (const PolicyComparison& comparison : comparisons)
        for (const auto& entry : comparison.entries) {
            std::vector<std::string> row = {comparison.technique, std::string(entry.policy->name)};
            if (!entry.result) {
                row.insert(row.end(), {"n/a", "n/a", "n/a", "n/a", "n/a", "n/a"});
                for (std::size_t i = 0; i < table.scenes.size(); ++i) row.emplace_back("n/a");
                rows.push_back(std::move(row));
                continue;
            }
            const PolicyResult& result = *entry.result;
            for (const std::string& cell :
                 {formatted("%.4g", result.parameter),
                  std::to_string(result.smallest) + " to " + std::to_string(result.largest),
                  formatted("%.3f", result.rippleP95), formatted("%.4f", result.worstRmse),
                  formatted("%.2f", result.geometricMeanMs), formatted("%.3f", entry.timesOurs)})
                row.push_back(cell);
            for (std::size_t i = 0; i < table.scenes.size(); ++i)
                row.push_back(comparison.ours ? formatted("%.2f", result.sceneMs[i] /
                                                                      comparison.ours->sceneMs[i])
                                              : "n/a");
            rows.push_back(std::move(row));
        }
    std::vector<std::string> head = {"technique",  "policy",     "parameter", "sizes",
                                     "ripple p95", "worst RMSE", "ms",        "time / ours"};
    for (const std::string& scene : table.scenes) head.push_back(scene);
    tables.add("policies", head, rows,
               "One row for each technique and policy; n/a where no value of the parameter keeps "
               "to the bound with measured sizes. The last columns are time over ours by scene.");
    std::vector<std::pair<std::string, std::string>> terms;
    for (const SizingPolicy& policy : sizingPolicies())
        terms.emplace_back(policy.name, std::string(policy.title) + ": " +
                                            std::string(policy.source) +
                                            "; parameter: " + std::string(policy.parameter));
    page.terms(terms);
}

void addFronts(records::HtmlPage& page, Tables& tables, const SweepTable& table) {
    page.heading("Speed against error");
    page.paragraph(
        "Whole-frame time against resolution error (the worst frame's RMSE in visibility over "
        "penumbra pixels, against the same technique and radius on its largest map). Grey: another "
        "technique or size is both faster and more exact.");
    std::vector<std::vector<std::string>> rows;
    std::vector<std::string> parts = {""};
    parts.insert(parts.end(), table.scenes.begin(), table.scenes.end());
    for (const std::string& scene : parts) {
        const std::string name = scene.empty() ? "all scenes" : scene;
        Plot plot{.title = name,
                  .xLabel = "frame, ms",
                  .yLabel = "resolution error, RMSE",
                  .series = {{.name = "dominated", .points = {}, .grey = true}}};
        for (const std::string& technique : table.techniques)
            plot.series.push_back({.name = technique, .points = {}});
        for (const SpeedAndError& point : speedAndErrors(table, scene)) {
            const auto which =
                std::find(table.techniques.begin(), table.techniques.end(), point.technique) -
                table.techniques.begin();
            plot.series[point.dominated ? 0 : static_cast<std::size_t>(which) + 1]
                .points.emplace_back(point.frameMs, point.error);
            rows.push_back({name, point.technique, std::to_string(point.resolution),
                            formatted("%.2f", point.frameMs), formatted("%.5f", point.error),
                            point.dominated ? "dominated" : "front"});
        }
        page.svg(plotSvg(plot), name);
    }
    tables.add("front", {"scene", "technique", "N", "ms", "worst RMSE", "standing"}, rows,
               "By time.");
}

void addSlopes(records::HtmlPage& page, Tables& tables, const SweepTable& table) {
    page.heading("What c buys");
    std::vector<std::vector<std::string>> rows;
    for (const std::string& technique : table.techniques)
        for (const SlopeStep& step : sweepOverSlope(table, technique, {1, 2, 3.47, 5, 8})) {
            const PolicyResult& result = step.result;
            rows.push_back(
                {technique, formatted("%.2f", step.c), formatted("%.2f", result.geometricMeanMs),
                 formatted("%.3f", result.rippleP95), formatted("%.4f", result.worstRmse),
                 std::to_string(result.smallest) + " to " + std::to_string(result.largest),
                 result.complete() ? "" : result.missing});
        }
    tables.add("slopes", {"technique", "c", "ms", "ripple p95", "worst RMSE", "sizes", "missing"},
               rows, "The automatic size with other slopes, in steps of 2^(1/4).");
}

void addCosts(records::HtmlPage& page, Tables& tables, const SweepTable& table) {
    page.heading("Where the time goes");
    std::vector<std::vector<std::string>> rows;
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
    tables.add("cost",
               {"scene", "technique", "N", "ms", "ms p25", "ms p75", "visits", "depth", "prefilter",
                "prepass", "lookup", "lit", "MiB", "note"},
               rows,
               "First frame of each path: medians of whole frames, and one frame with its passes "
               "finished one by one. Noisy: fewer than three visits, or quartiles further apart "
               "than a quarter of the median.");
}

// Below, fixed costs of a pass hide how it grows.
constexpr int kLeastGrowingSize = 512;

void addGrowth(records::HtmlPage& page, Tables& tables, const SweepTable& table) {
    page.heading("How cost grows with N");
    std::vector<std::vector<std::string>> rows;
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
        "growth",
        {"scene", "technique", "depth", "off by", "prefilter", "off by ", "lookup", "off by  "},
        rows,
        "Exponents e of time = k N^e at constant softness, from N = 512 on, over all frames "
        "of the path, and the RMS by which times are off the power, as a share. Expected: "
        "full-kernel lookups grow with 2, separable prefilters with 3.");
}

void addRipples(records::HtmlPage& page, const SweepTable& table) {
    page.heading("Stair-steps against r/a");
    Plot plot{.title = "Edge ripple over filter radius in texels",
              .xLabel = "r/a, kernel radius over a texel of the map",
              .yLabel = "edge ripple, 95 % of the contour pixels",
              .series = {}};
    PlotSeries predicted{.name = "straight edges", .points = {}, .line = true};
    PlotSeries limit{.name = "limit 2/(pi r/a)", .points = {}, .line = true};
    for (double ratio = 0.5; ratio < 70; ratio *= 1.2) {
        predicted.points.emplace_back(ratio, kRippleTimesRatio / ratio);
        limit.points.emplace_back(ratio, 2 / (std::numbers::pi * ratio));
    }
    for (const std::string& technique : table.techniques) {
        PlotSeries series{.name = technique, .points = {}};
        for (const SweepCell& cell : table.cells)
            if (cell.technique == technique && cell.measured() && cell.resolution != cell.reference)
                series.points.emplace_back(cell.radiusUv * cell.resolution, cell.rippleP95);
        plot.series.push_back(std::move(series));
    }
    plot.series.push_back(std::move(predicted));
    plot.series.push_back(std::move(limit));
    page.svg(plotSvg(plot),
             "Each point is a frame of a path. Lines: straight edges in uniform directions under a "
             "disc, and the most that an edge along the texels can leave.");
}

void addErrors(records::HtmlPage& page, Tables& tables, const SweepTable& table) {
    page.heading("Errors");
    std::vector<std::vector<std::string>> rows;
    for (const SweepCell& cell : table.cells) {
        if (!cell.measured() || cell.frame != 0) continue;
        std::vector<std::string> row = {cell.scene, cell.technique, std::to_string(cell.resolution),
                                        std::to_string(cell.reference)};
        for (const double number :
             {cell.rmse, cell.most, cell.p95, cell.bias, cell.shareBeyondLevel,
              cell.shareBeyond2Percent, cell.shareBeyond5Percent, cell.ssim, cell.rippleP95,
              cell.rippleMost, cell.edgeWidthRatio, cell.thinLost, cell.flickerLight,
              cell.flickerOrbit, cell.flickerSize})
            row.push_back(formatted("%.4f", number));
        rows.push_back(std::move(row));
    }
    tables.add("errors",
               {"scene", "technique", "N", "reference", "RMSE", "max", "p95", "bias", "> 1/255",
                "> 2 %", "> 5 %", "SSIM", "ripple p95", "ripple max", "edge width", "thin lost",
                "light flicker", "orbit flicker", "size pop"},
               rows,
               "First frame of each path, resolution error on visibility. Edge width is 10 to 90 % "
               "over the reference's; thin lost the share of thin casters' shadow that is gone; "
               "flicker the RMS of what changes otherwise than in the reference when the light "
               "moves by less than a texel, the camera orbits by one degree, and N comes from the "
               "size below.");
}

void addGaps(records::HtmlPage& page, const SweepTable& table) {
    std::vector<std::vector<std::string>> rows;
    for (const SweepCell& cell : table.cells)
        if (!cell.measured())
            rows.push_back({cell.scene, std::to_string(cell.frame), cell.technique,
                            std::to_string(cell.resolution), cell.status});
    page.heading("What was not measured");
    if (rows.empty())
        page.paragraph("Nothing: every cell has its numbers.");
    else
        page.table({"scene", "frame", "technique", "N", "why"}, rows,
                   "Skipped, failed and unfinished cells.");
}

}  // namespace

std::vector<std::string> brokenTechniques(const SweepTable& table) {
    std::vector<std::string> broken;
    for (const std::string& technique : table.techniques)
        for (const SweepCell& cell : table.cells) {
            if (cell.technique != technique) continue;
            std::string why;
            if (cell.status.starts_with("failed"))
                why = cell.status;
            else if (cell.measured() && !std::isfinite(cell.rmse))
                why = "visibility is no number";
            else if (cell.measured() && table.convergedAgainst(cell) &&
                     2 * cell.resolution >= cell.reference && cell.rmse > kMostErrorNearReference)
                why = "RMSE " + formatted("%.3f", cell.rmse) + " against " +
                      std::to_string(cell.reference);
            if (why.empty()) continue;
            broken.push_back(technique + " at " + std::to_string(cell.resolution) + " in " +
                             cell.scene + ": " + why);
            break;
        }
    return broken;
}

fs::path writeSweepReport(const fs::path& folder, const SweepTable& table,
                          const std::optional<fs::path>& stability) {
    const std::vector<PolicyComparison> comparisons = comparePolicies(table);
    records::HtmlPage page("Speed against error");
    for (const std::string& what : brokenTechniques(table)) page.headline("BROKEN", what + ".");
    addHeadline(page, comparisons, table);
    Tables tables(page, folder, table.context);
    addPolicies(page, tables, comparisons, table);
    addFronts(page, tables, table);
    addSlopes(page, tables, table);
    addRipples(page, table);
    addErrors(page, tables, table);
    addCosts(page, tables, table);
    addGrowth(page, tables, table);
    if (stability) {
        page.heading("Numerical stability");
        page.preformatted(records::readWholeFile(*stability));
    }
    addGaps(page, table);
    page.heading("How it was measured");
    page.preformatted(table.context);
    const fs::path file = folder / "sweep.html";
    page.write(file);
    return file;
}

}  // namespace demo
