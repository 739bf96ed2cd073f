// SPDX-License-Identifier: MIT
#include "demo/time_bars.h"

#include <algorithm>
#include <array>
#include <cstdio>

#include "records/html_page.h"

namespace demo {
namespace {

// Px of the drawing; it scales with the page.
constexpr int kWidth = 860, kLabelWidth = 130, kBarWidth = 470, kRow = 26, kBar = 17, kHead = 34,
              kLegend = 30;

// Okabe and Ito's colours, told apart by every reader; index is renderer::Pass.
constexpr std::array<const char*, renderer::kPasses> kColours = {"#D55E00", "#E69F00", "#999999",
                                                                 "#0072B2", "#CCCCCC", "#009E73"};

std::string formatted(const char* format, double value) {
    char text[48];
    std::snprintf(text, sizeof text, format, value);
    return text;
}

std::string textAt(double x, double y, const std::string& text, const std::string& more = "") {
    return "<text x=\"" + formatted("%.1f", x) + "\" y=\"" + formatted("%.1f", y) + "\" " + more +
           ">" + records::htmlEscaped(text) + "</text>\n";
}

std::string rectangle(double x, double y, double width, double height, const char* colour) {
    return "<rect x=\"" + formatted("%.2f", x) + "\" y=\"" + formatted("%.1f", y) + "\" width=\"" +
           formatted("%.2f", width) + "\" height=\"" + formatted("%.1f", height) + "\" fill=\"" +
           colour + "\"/>\n";
}

double sumOfPasses(const BenchmarkCell& cell) {
    double sum = 0;
    for (const Spread& spread : cell.passesMs.passes) sum += spread.median;
    return sum;
}

std::string legend() {
    std::string svg;
    double x = kLabelWidth;
    for (const renderer::Pass pass : renderer::kAllPasses) {
        const std::string name(toText(pass));
        svg += rectangle(x, 9, 12, 12, kColours[static_cast<std::size_t>(pass)]);
        svg += textAt(x + 17, 20, name);
        x += 40 + 8 * static_cast<double>(name.size());
    }
    return svg;
}

std::string groupSvg(const BenchmarkGroup& group, double top) {
    double most = 0;
    for (const BenchmarkCell& cell : group.cells) most = std::max(most, sumOfPasses(cell));
    std::string svg = textAt(0, top + 22, group.scene + ", " + std::string(group.technique->title),
                             "font-weight=\"bold\"");
    double y = top + kHead;
    for (const BenchmarkCell& cell : group.cells) {
        const std::string label =
            (cell.chosen.automatic ? "auto " : "fixed ") + std::to_string(cell.chosen.resolution);
        svg += textAt(kLabelWidth - 8, y + 13, label, "text-anchor=\"end\"");
        double x = kLabelWidth;
        for (const renderer::Pass pass : renderer::kAllPasses) {
            const double width = kBarWidth *
                                 cell.passesMs.passes[static_cast<std::size_t>(pass)].median /
                                 std::max(most, 1e-9);
            svg += rectangle(x, y, width, kBar, kColours[static_cast<std::size_t>(pass)]);
            x += width;
        }
        const std::string error =
            cell.isReference ? "reference" : "RMSE " + formatted("%.4f", cell.error.rmse);
        svg += textAt(x + 8, y + 13, formatted("%.1f ms", cell.frameMs.median) + ", " + error);
        y += kRow;
    }
    return svg;
}

}  // namespace

std::string timeBarsSvg(const BenchmarkResult& result) {
    std::string body;
    double top = kLegend;
    for (const BenchmarkGroup& group : result.groups) {
        body += groupSvg(group, top);
        top += kHead + kRow * static_cast<double>(group.cells.size()) + 6;
    }
    return "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + std::to_string(kWidth) +
           " " + formatted("%.0f", top) +
           "\" font-family=\"sans-serif\" font-size=\"13\" fill=\"#222222\">\n" +
           "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n" + legend() + body +
           "</svg>\n";
}

}  // namespace demo
