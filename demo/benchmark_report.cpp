// SPDX-License-Identifier: MIT
#include "demo/benchmark_report.h"

#include <algorithm>
#include <cstdio>
#include <stdexcept>

#include "demo/benchmark_log.h"
#include "demo/time_bars.h"
#include "records/html_page.h"
#include "records/slope_file.h"
#include "records/whole_file.h"

namespace demo {
namespace {

namespace fs = std::filesystem;

constexpr int kDetailScale = 4;
constexpr double kFullDifference = 0.25;  // visibility at which error pictures reach full colour

std::string formatted(const char* format, double value) {
    char text[48];
    std::snprintf(text, sizeof text, format, value);
    return text;
}

/// "auto 368" or "512": the first column that tells rows of a scene apart.
std::string sizeOf(const BenchmarkCell& cell) {
    return (cell.chosen.automatic ? "auto\u00a0" : "") + std::to_string(cell.chosen.resolution);
}

/// The scene, and the technique where there are several.
std::string groupName(const BenchmarkResult& result, const BenchmarkGroup& group) {
    const bool one = std::all_of(
        result.groups.begin(), result.groups.end(),
        [&](const BenchmarkGroup& other) { return other.technique == group.technique; });
    return one ? group.scene : group.scene + ", " + std::string(group.technique->name);
}

std::string nameOf(const BenchmarkCell& cell) {
    return cell.chosen.automatic ? "auto" : "fixed " + std::to_string(cell.chosen.resolution);
}

/// Three digits or more, no more width than they need.
std::string milliseconds(double ms) {
    return formatted(ms < 10 ? "%.2f" : (ms < 100 ? "%.1f" : "%.0f"), ms);
}

std::string withSpread(const Spread& spread) {
    if (spread.count == 0) return "n/a";
    return milliseconds(spread.median) + " [" + milliseconds(spread.p25) + ", " +
           milliseconds(spread.p75) + "]";
}

std::string passText(const BenchmarkCell& cell, renderer::Pass pass) {
    return withSpread(cell.passesMs.passes[static_cast<std::size_t>(pass)]);
}

void addTimeTable(records::HtmlPage& page, const BenchmarkResult& result) {
    std::vector<std::vector<std::string>> rows;
    for (const BenchmarkGroup& group : result.groups)
        for (const BenchmarkCell& cell : group.cells) {
            const double speed = group.reference().frameMs.median / cell.frameMs.median;
            rows.push_back({groupName(result, group), sizeOf(cell),
                            formatted("%.1f", static_cast<double>(cell.mapBytes) / (1 << 20)),
                            withSpread(cell.frameMs), formatted("%.2f", speed),
                            passText(cell, renderer::Pass::depth),
                            passText(cell, renderer::Pass::lookup)});
        }
    page.table({"scene", "N", "map MiB", "frame ms", "speed", "depth ms", "lookup ms"}, rows,
               "Medians with quartiles. Speed is against the reference, the largest fixed map.");
}

void addErrorTable(records::HtmlPage& page, const BenchmarkResult& result) {
    std::vector<std::vector<std::string>> rows;
    for (const BenchmarkGroup& group : result.groups)
        for (const BenchmarkCell& cell : group.cells) {
            if (cell.isReference) continue;
            const VisibilityError& e = cell.error;
            rows.push_back({groupName(result, group), sizeOf(cell), formatted("%.4f", e.rmse),
                            formatted("%.4f", e.p95), formatted("%.3f", e.most),
                            formatted("%+.5f", e.bias), formatted("%.1f", 100 * e.shareBeyondLevel),
                            formatted("%.1f", 100 * e.shareBeyond2Percent),
                            formatted("%.1f", 100 * e.shareBeyond5Percent),
                            std::to_string(e.penumbraPixels)});
        }
    page.table(
        {"scene", "N", "RMSE", "p95", "max", "bias", "% > 1/255", "% > .02", "% > .05", "pixels"},
        rows,
        "Resolution error: visibility against the reference, the largest fixed map, over "
        "penumbra pixels. Bias "
        "is positive where light leaks into shadow; then the shares of these pixels that "
        "are off by more than "
        "one 8-bit level, .02 and .05.");
}

void addPictures(records::HtmlPage& page, const fs::path& folder, const BenchmarkGroup& group) {
    std::vector<records::HtmlPage::Picture> whole;
    std::vector<records::HtmlPage::Picture> details;
    std::vector<records::HtmlPage::Picture> errors;
    for (const BenchmarkCell& cell : group.cells) {
        const std::string stem =
            group.scene + "_" + std::string(group.technique->name) + "_" +
            (cell.chosen.automatic ? "auto" : std::to_string(cell.chosen.resolution));
        const fs::path picture = folder / (stem + ".png");
        const fs::path detail = folder / (stem + "_detail.png");
        const fs::path error = folder / (stem + "_error.png");
        writePng(picture, cell.picture);
        writePng(detail, enlarged(cell.picture, group.detail, kDetailScale));
        const std::string size =
            nameOf(cell) +
            (cell.chosen.automatic ? ", N = " + std::to_string(cell.chosen.resolution) : "");
        const std::string time = formatted("%.1f ms a frame", cell.frameMs.median);
        whole.push_back(
            {picture, group.scene + " rendered with map size " + size, size + ": " + time});
        details.push_back({detail, "enlarged detail, map size " + size, size});
        if (cell.isReference) continue;
        writePng(error,
                 differencePicture(cell.visibility, group.reference().visibility, kFullDifference));
        errors.push_back({error, "difference in visibility, map size " + size,
                          size + ": RMSE " + formatted("%.4f", cell.error.rmse)});
    }
    page.subheading(group.scene + ", " + std::string(group.technique->title));
    page.paragraph("Radius " + formatted("%.3f", group.softness.radiusM) + " m, " +
                   formatted("%.5f", group.softness.radiusUv) + " of the map's extent of " +
                   formatted("%.2f", group.mapExtentM) + " m; " + std::to_string(group.triangles) +
                   " triangles.");
    page.gallery(whole);
    page.paragraph("A detail, enlarged " + std::to_string(kDetailScale) +
                   " times, at the place where the smallest map is furthest from the reference:");
    page.gallery(details);
    page.paragraph(
        "Difference in visibility from the reference: orange where light leaks in, blue where it "
        "is too "
        "dark, full colour at " +
        formatted("%.2f", kFullDifference) + ":");
    page.gallery(errors);
}

void addFit(records::HtmlPage& page, const fs::path& folder) {
    const records::Slope slope = records::readSlope(folder / "slope.json");
    page.heading("The slope that chose the sizes");
    page.paragraph(records::describe(slope) + ".");
    page.paragraph(slope.method);
    for (const auto& [name, caption] :
         {std::pair{"threshold_against_size", "Filter radius at threshold against artifact size."},
          std::pair{"slopes_by_group", "Slope c of every group, and the headline."}}) {
        page.svg(records::readWholeFile(folder / "figures" / (std::string(name) + ".svg")),
                 caption);
    }
}

}  // namespace

fs::path writeReport(const fs::path& folder, const BenchmarkResult& result,
                     const records::RunContext& context, const LoadedSlope& slope,
                     const std::optional<fs::path>& fitFolder) {
    const std::string figure = timeBarsSvg(result);
    records::writeWholeFile(folder / "benchmark.tsv", benchmarkLog(result, context, slope));
    records::writeWholeFile(folder / "frame_time.svg", figure);

    records::HtmlPage page("Shadow maps at automatic and fixed size");
    for (const Headline& headline : headlines(result))
        page.headline(headline.number, headline.meaning + ".");
    page.paragraph("Sizes were chosen by " + slope.text + ".");
    for (const std::string& note : slope.notes) page.note("Note: " + note + ".");
    if (context.softwareRasteriser.value_or(false))
        page.note(
            "Timed on a software rasteriser: the queue is finished around each pass and a steady "
            "clock read; "
            "whole frames come from separate runs without inner finishes. Ratios on a GPU differ.");
    page.heading("Where the time goes");
    page.svg(figure,
             "Median time of each pass, whole-frame time and resolution error. Each scene has its "
             "own scale.");
    addTimeTable(page, result);
    addErrorTable(page, result);
    page.heading("Pictures");
    for (const BenchmarkGroup& group : result.groups) addPictures(page, folder, group);
    if (fitFolder) addFit(page, *fitFolder);
    page.heading("How it was measured");
    page.preformatted(records::contextText(context) + "\ntiming     " + result.timing);
    const fs::path report = folder / "report.html";
    page.write(report);
    return report;
}

}  // namespace demo
