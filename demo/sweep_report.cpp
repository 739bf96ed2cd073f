// SPDX-License-Identifier: MIT
#include "demo/sweep_report.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "demo/automatic_against_fixed.h"
#include "demo/direct_run.h"
#include "demo/growth_exponent.h"
#include "demo/growth_run.h"
#include "demo/picture.h"
#include "demo/policy_comparison.h"
#include "demo/speed_error_front.h"
#include "demo/tsv_journal.h"
#include "demo/xy_plot.h"
#include "records/html_page.h"
#include "records/whole_file.h"

namespace demo {
namespace {

namespace fs = std::filesystem;

// A working technique at half the reference's size and more is nearer than this to the reference,
// where the kernel is wide enough in texels to hide them (the published slope).
constexpr double kMostErrorNearReference = 0.1;
constexpr double kLeastTexelsInRadius = 3.47;
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
                      ": the automatic size has no c of which all sizes were measured.");
            continue;
        }
        if (comparison.bound > kRippleBound)
            page.note(comparison.technique +
                      ": no c brings the automatic size, which stops where texels are pixels, to "
                      "an edge ripple of " +
                      formatted("%.2f", kRippleBound) + "; the policies are compared at " +
                      formatted("%.3f", comparison.bound) + ", the least that it leaves.");
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
                " scenes, both with an edge ripple of at most " +
                formatted("%.3f", comparison.bound) +
                " at 95 % of the contour pixels of every scene's path.");
    }
}

/// Why there is no result, or how the one from the table was confirmed.
std::string standing(const PolicyComparison& comparison, const PolicyComparison::Entry& entry,
                     const std::optional<DirectResult>& direct) {
    if (entry.result) return direct ? "measured directly" : "from the table";
    if (!entry.nearest) return "no parameter has all its sizes measured";
    return "cannot keep to " + formatted("%.3f", comparison.bound) + ": nearest shown";
}

void addPolicyTable(Tables& tables, const std::string& name,
                    const std::vector<PolicyComparison>& comparisons, const SweepTable& table,
                    const std::vector<DirectRow>& directRows, const std::string& caption) {
    std::vector<std::vector<std::string>> rows;
    for (const PolicyComparison& comparison : comparisons)
        for (const auto& entry : comparison.entries) {
            const std::optional<PolicyResult>& result = entry.result ? entry.result : entry.nearest;
            const std::optional<DirectResult> direct =
                entry.result ? directResult(directRows, table, *entry.result, comparison.over)
                             : std::nullopt;
            std::vector<std::string> row = {comparison.technique, std::string(entry.policy->name)};
            const auto number = [&](const char* format, double value) {
                row.push_back(formatted(format, value));
            };
            number("%.3f", comparison.bound);
            number("%.4g", result ? result->parameter : NAN);
            row.push_back(result ? std::to_string(result->smallest) + " to " +
                                       std::to_string(result->largest)
                                 : "n/a");
            number("%.3f", result ? result->ripple(comparison.over) : NAN);
            number("%.4f", result ? result->worstRmse : NAN);
            number("%.2f", result ? result->geometricMeanMs : NAN);
            number("%.3f", entry.timesOurs);
            number("%.3f", direct ? direct->rippleP95 : NAN);
            number("%.2f", direct ? direct->geometricMeanMs : NAN);
            row.push_back(standing(comparison, entry, direct));
            for (std::size_t i = 0; i < table.scenes.size(); ++i)
                number("%.2f", entry.result && comparison.ours
                                   ? entry.result->sceneMs[i] / comparison.ours->sceneMs[i]
                                   : NAN);
            rows.push_back(std::move(row));
        }
    std::vector<std::string> head = {"technique",   "policy",        "bound",      "parameter",
                                     "sizes",       "ripple p95",    "worst RMSE", "ms",
                                     "time / ours", "direct ripple", "direct ms",  "standing"};
    for (const std::string& scene : table.scenes) head.push_back(scene);
    tables.add(name, head, rows, caption);
}

void addPolicies(records::HtmlPage& page, Tables& tables,
                 const std::vector<PolicyComparison>& comparisons, const SweepTable& table,
                 const std::vector<DirectRow>& directRows) {
    page.heading("Sizing policies at equal quality");
    page.paragraph(
        "Every policy has one parameter, set to the fastest value at which the edge ripple of 95 % "
        "of the contour pixels stays within the bound. Times are whole frames from one measured "
        "table; above 1 a policy is slower than ours, below 1 we lose. Then each policy drew the "
        "frames itself with that parameter: the direct columns.");
    addPolicyTable(tables, "policies", comparisons, table, directRows,
                   "The bound holds in every scene's path. One row for each technique and policy. "
                   "Where no value of the parameter keeps to the bound, the one with the least "
                   "ripple stands there, and no ratio. The last columns are time over ours by "
                   "scene.");
    addPolicyTable(tables, "policies_together", comparePolicies(table, RippleOver::allTogether),
                   table, directRows,
                   "The bound holds over the contour pixels of all scenes together, so that a "
                   "scene with few of them may be over it.");
    std::vector<std::pair<std::string, std::string>> terms;
    for (const SizingPolicy& policy : sizingPolicies())
        terms.emplace_back(policy.name, std::string(policy.title) + ": " +
                                            std::string(policy.source) +
                                            "; parameter: " + std::string(policy.parameter));
    page.terms(terms);
}

/// The two largest powers of two among the sweep's sizes, which are what engines fix; ascending.
std::vector<int> fixedSizes(const SweepTable& table) {
    std::vector<int> sizes;
    for (const int size : table.sizes)
        if (std::has_single_bit(static_cast<unsigned>(size))) sizes.push_back(size);
    if (sizes.size() > 2) sizes.erase(sizes.begin(), sizes.end() - 2);
    return sizes;
}

/// One number for all techniques that have one.
void addOverallHeadline(records::HtmlPage& page, const std::vector<DirectRow>& direct,
                        const SweepTable& table) {
    const std::vector<int> sizes = fixedSizes(table);
    if (sizes.empty()) return;
    double logs = 0, rmse = 0;
    std::string techniques;
    int count = 0;
    for (const AutomaticAgainstFixed& one : automaticAgainstFixed(direct, table, {sizes.back()})) {
        if (!std::isfinite(one.geometricMean)) continue;
        logs += std::log(one.geometricMean);
        rmse = std::max(rmse, one.worstRmse);
        techniques += (count++ == 0 ? "" : ", ") + one.technique;
    }
    if (count == 0) return;
    page.headline(formatted("%.1fx", std::exp(logs / count)) + " the speed",
                  "of a fixed map of " + std::to_string(sizes.back()) +
                      " at the automatic size, both of the same softness: whole frames, geometric "
                      "mean over " +
                      std::to_string(table.scenes.size()) + " scenes and " + techniques +
                      "; resolution error of the automatic size at most " +
                      formatted("%.3f", rmse) + " RMSE in a frame.");
}

/// What `--resolution auto` does, in all and cell by cell.
void addAutomatic(records::HtmlPage& page, Tables& tables, const std::vector<DirectRow>& direct,
                  const SweepTable& table) {
    std::vector<std::vector<std::string>> summary;
    for (const AutomaticAgainstFixed& one :
         automaticAgainstFixed(direct, table, fixedSizes(table))) {
        std::vector<std::string> row = {one.technique,
                                        std::to_string(one.fixed),
                                        formatted("%.2f", one.geometricMean),
                                        formatted("%.4f", one.worstRmse),
                                        formatted("%.3f", one.rippleP95),
                                        formatted("%.3f", one.rippleMost)};
        for (const double times : one.times) row.push_back(formatted("%.2f", times));
        summary.push_back(std::move(row));
    }
    std::vector<std::vector<std::string>> rows;
    for (const DirectRow& row : direct)
        if (row.policy == kControllerRun)
            rows.push_back({row.scene, std::to_string(row.frame), row.technique, row.parameter,
                            std::to_string(row.resolution), std::to_string(row.reference),
                            formatted("%.2f", row.frameMs), formatted("%.4f", row.rmse),
                            formatted("%.3f", row.rippleP95)});
    if (rows.empty()) return;
    page.heading("The automatic size");
    std::vector<std::string> head = {"technique",  "fixed",      "times as fast",
                                     "worst RMSE", "ripple p95", "ripple max"};
    head.insert(head.end(), table.scenes.begin(), table.scenes.end());
    tables.add("automatic_against_fixed", head, summary,
               "Time at a fixed size over that at the automatic one: geometric mean over the "
               "scenes, then by scene; 1 and below: nothing is saved there. Errors are those of "
               "the automatic size over all frames; ripple max is that of the worst pixel.");
    tables.add("automatic",
               {"scene", "frame", "technique", "c", "N", "reference", "ms", "RMSE", "ripple p95"},
               rows,
               "What --resolution auto takes with the slope as it is, thin casters counted, asking "
               "included in the time; errors against the sweep's reference.");
}

/// What the automatic size is off by, in the first frame of each path.
void addPictures(records::HtmlPage& page, const SweepTable& table, const fs::path& folder) {
    bool any = false;
    for (const std::string& scene : table.scenes) {
        std::vector<records::HtmlPage::Picture> pictures;
        if (fs::exists(litPicture(folder, scene)))
            pictures.push_back({litPicture(folder, scene), scene + " at automatic size", scene});
        for (const std::string& technique : table.techniques) {
            const fs::path file = errorPicture(folder, scene, technique);
            if (fs::exists(file))
                pictures.push_back(
                    {file,
                     scene + ": difference in visibility of " + technique + " from its reference",
                     technique});
        }
        if (pictures.empty()) continue;
        if (!any) {
            page.heading("Where the automatic size is off");
            const fs::path legend = folder / "pictures" / "legend.png";
            writePng(legend, differenceLegend(kFullErrorInPictures));
            page.image(legend, "colours from too dark, blue, over white to too light, orange",
                       "Visibility at automatic size less that of the reference: blue where it is "
                       "too dark, orange where light leaks in.");
        }
        any = true;
        page.gallery(pictures);
    }
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
    tables.add(
        "slopes", {"technique", "c", "ms", "ripple p95", "worst RMSE", "sizes", "missing"}, rows,
        "The automatic size with other slopes, in steps of 2^(1/8); ripple p95 of the scene in "
        "which it is largest.");
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

/// Where it was measured (growth_run.h).
void addGrowthRun(records::HtmlPage& page, const fs::path& folder) {
    if (!hasGrowth(folder)) return;
    page.heading("How cost grows with each thing alone");
    std::vector<std::vector<std::string>> rows;
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

/// Where they were measured (model_error.h).
void addModelErrors(records::HtmlPage& page, const fs::path& folder) {
    const fs::path file = folder / "model_errors.tsv";
    if (!fs::exists(file)) return;
    const TsvTable table = readTsv(file);
    page.heading("Model errors");
    std::vector<std::vector<std::string>> rows;
    for (const TsvRow& row : table.rows()) {
        rows.emplace_back();
        for (const std::string& column : table.columns()) {
            const bool isError = column == "rmse" || column == "bias" || column == "p95";
            // Told where the truth itself is not exact enough for the number.
            const bool loose =
                isError && std::abs(row.number(column)) < 10 * row.number("standard_error");
            rows.back().push_back((loose ? "(" : "") + row.text(column) + (loose ? ")" : ""));
        }
    }
    page.table(table.columns(), rows,
               "Against an area light by ray casting, whatever N is: not the resolution error of "
               "the other tables. In brackets: less than ten of the truth's standard errors. "
               "(model_errors.tsv)");
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
    records::HtmlPage page("Speed against error");
    for (const std::string& what : brokenTechniques(table)) page.failure("Broken: " + what + ".");
    const std::vector<DirectRow> direct = readDirect(folder);
    addOverallHeadline(page, direct, table);
    addHeadline(page, comparisons, table);
    Tables tables(page, folder, table.context);
    addPolicies(page, tables, comparisons, table, direct);
    addAutomatic(page, tables, direct, table);
    addPictures(page, table, folder);
    addFronts(page, tables, table);
    addSlopes(page, tables, table);
    addRipples(page, table);
    addErrors(page, tables, table);
    addCosts(page, tables, table);
    addGrowth(page, tables, table);
    addGrowthRun(page, folder);
    addModelErrors(page, folder);
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
