// SPDX-License-Identifier: MIT
#include "demo/sweep_error_report.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "demo/direct_run.h"
#include "demo/picture.h"
#include "demo/speed_error_front.h"
#include "demo/tsv_journal.h"
#include "demo/xy_plot.h"

namespace demo {
namespace {

namespace fs = std::filesystem;

// METHODS section 8 for straight edges in uniform directions: .12 at r/a = 3.47, and 1 / (r/a).
constexpr double kRippleTimesRatio = 0.12 * 3.47;

struct RootMeanSquare {
    double squares = 0;
    int count = 0;

    void add(double value) {
        if (!std::isfinite(value)) return;
        squares += value * value;
        ++count;
    }
    double value() const { return std::sqrt(squares / count); }
};

}  // namespace

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

void addFronts(records::HtmlPage& page, ReportTables& tables, const SweepTable& table) {
    page.heading("Speed against error");
    page.paragraph(
        "Whole-frame time against resolution error (the worst frame's RMSE in visibility over "
        "penumbra pixels, against the same technique and radius on its largest map). Grey: another "
        "technique or size is both faster and more exact.");
    TableRows rows;
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
    tables.add({.name = "front",
                .caption = "By time.",
                .head = {"scene", "technique", "N", "ms", "worst RMSE", "standing"},
                .rows = rows});
}

void addRipples(records::HtmlPage& page, const SweepTable& table) {
    page.heading("Stair-steps against r/a");
    Plot plot{.title = "Edge ripple over filter radius in texels",
              .xLabel = "r/a, kernel radius over a texel of the map",
              .yLabel = "edge ripple, 95 % of the contour pixels",
              .series = {}};
    PlotSeries predicted{.name = "straight edges", .points = {}, .line = true};
    // Grey: there are more series than colours.
    PlotSeries limit{.name = "limit 2/(pi r/a)", .points = {}, .line = true, .grey = true};
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

void addErrors(records::HtmlPage& page, ReportTables& tables, const SweepTable& table) {
    page.heading("Errors");
    TableRows rows;
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
    tables.add(
        {.name = "errors",
         .caption =
             "First frame of each path, resolution error on visibility. Edge width is 10 to 90 % "
             "over the reference's; thin lost the share of thin casters' shadow that is gone; "
             "flicker the RMS of what changes otherwise than in the reference when the light "
             "moves by less than a texel, the camera orbits by one degree, and N comes from the "
             "size below.",
         .head = {"scene", "technique", "N", "reference", "RMSE", "max", "p95", "bias", "> 1/255",
                  "> 2 %", "> 5 %", "SSIM", "ripple p95", "ripple max", "edge width", "thin lost",
                  "light flicker", "orbit flicker", "size pop"},
         .rows = rows});
}

void addTemporalErrors(records::HtmlPage& page, ReportTables& tables, const SweepTable& table) {
    page.heading("From frame to frame");
    TableRows rows;
    for (const std::string& technique : table.techniques)
        for (const int size : table.sizes) {
            RootMeanSquare light, orbit, sizeChange;
            double worst = 0;
            std::string where = "none";
            for (const SweepCell& cell : table.cells) {
                if (cell.technique != technique || cell.resolution != size || !cell.measured() ||
                    cell.resolution == cell.reference || !table.convergedAgainst(cell))
                    continue;
                light.add(cell.flickerLight);
                orbit.add(cell.flickerOrbit);
                sizeChange.add(cell.flickerSize);
                if (cell.flickerLight > worst) {
                    worst = cell.flickerLight;
                    where = cell.scene;
                }
            }
            if (light.count == 0) continue;
            rows.push_back({technique, std::to_string(size), formatted("%.4f", light.value()),
                            formatted("%.4f", worst), where, formatted("%.4f", orbit.value()),
                            formatted("%.4f", sizeChange.value()), std::to_string(light.count)});
        }
    tables.add({.name = "temporal",
                .caption = "RMS, over the frames of all paths, of what changes in visibility "
                           "otherwise than in the reference: when the light moves by less than a "
                           "texel (with the worst frame and its scene), when the camera orbits by "
                           "one degree, and when N comes from the size below.",
                .head = {"technique", "N", "light moves", "worst", "in", "camera orbits",
                         "size changes", "frames"},
                .rows = rows});
}

void addModelErrors(records::HtmlPage& page, const fs::path& folder) {
    const fs::path file = folder / "model_errors.tsv";
    page.heading("Model errors");
    if (!fs::exists(file)) {
        page.paragraph("Not measured: --model casts rays to the area light.");
        return;
    }
    const TsvTable table = readTsv(file);
    TableRows rows;
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

}  // namespace demo
