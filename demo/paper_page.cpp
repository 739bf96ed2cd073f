// SPDX-License-Identifier: MIT
#include "demo/paper_page.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <thread>

#include "demo/depth_distribution.h"
#include "demo/paper_drawing.h"
#include "demo/paper_tables.h"
#include "program/progress.h"
#include "records/whole_file.h"

namespace demo {
namespace {

std::string formatted(const char* format, double value) {
    char text[48];
    std::snprintf(text, sizeof text, format, value);
    return text;
}

/// Three digits, or what is left of them.
std::string number(double value) {
    return formatted(value >= 100 ? "%.0f" : value >= 10 ? "%.1f" : "%.2f", value);
}

std::string processor() {
    std::ifstream lines("/proc/cpuinfo");
    for (std::string line; std::getline(lines, line);)
        if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
    return "unknown processor";
}

std::string contextLine(const records::RunContext& context) {
    double load = 0;
    getloadavg(&load, 1);
    const unsigned threads = std::thread::hardware_concurrency();
    return "Measured " + context.date + ", revision " + context.revision + ", " +
           context.buildType + ", " + context.compiler + "; " + context.glRenderer.value_or("") +
           ", " + context.glVersion.value_or("") + "; " + processor() + ", " +
           std::to_string(threads) + " threads, load " + formatted("%.1f", load) + " at the start" +
           (load > threads ? "; other work ran beside it: the times are not to be relied on" : "") +
           ".";
}

std::string valueText(PaperNumber what, double value) {
    if (what == PaperNumber::litDark) return formatted("%.1f", 100 * value);
    if (what == PaperNumber::edgeWidth) return formatted("%.1f", value);
    return formatted("%.4f", value);
}

std::string row(const std::vector<std::string>& cells) {
    std::string text = "|";
    for (const std::string& cell : cells) text += " " + cell + " |";
    return text + "\n";
}
std::string rule(std::size_t columns) {
    std::string text = "|";
    for (std::size_t i = 0; i < columns; ++i) text += "---|";
    return text + "\n";
}

/// "hard", or "pcf_grid samples=3 bilinear=0".
std::string panelText(const PaperPanel& panel) {
    std::string text = "`" + panel.technique;
    for (const auto& [name, value] : panel.parameters)
        text += " " + name + "=" + formatted("%g", value);
    return text + "`";
}

std::string figureText(const std::filesystem::path& folder, const PaperFigure& figure,
                       const renderer::GlInfo& info, int rounds) {
    const std::vector<DrawnPanel> drawn = drawFigure(info, figure, 1, rounds);
    // Two beside each other keep the pictures readable.
    constexpr std::size_t kAcross = 2;
    std::string text = "## " + figure.title + "\n\n" + figure.setting + "\n\n";
    for (std::size_t first = 0; first < drawn.size(); first += kAcross) {
        std::vector<std::string> captions, pictures;
        for (std::size_t i = first; i < std::min(first + kAcross, drawn.size()); ++i) {
            const std::string file =
                figure.name + "-" + std::string(1, static_cast<char>('a' + i)) + ".png";
            writePng(folder / file, drawn[i].picture);
            std::string caption = figure.panels[i].caption;
            if (drawn[i].frameMs.count > 0)
                caption += ": " + std::to_string(drawn[i].resolution) + " x " +
                           std::to_string(drawn[i].resolution) + ", " +
                           number(drawn[i].frameMs.median) + " ms";
            captions.push_back(caption);
            pictures.push_back("![" + figure.panels[i].caption + "](" + file + ")");
        }
        if (first == 0)
            text += row(captions) + rule(captions.size()) + row(pictures);
        else
            text += row(captions) + row(pictures);
    }
    std::vector<std::string> head{"picture", "technique", "N", "radius, texels"};
    for (const PaperNumber what : figure.numbers) head.push_back(toText(what));
    if (figure.timed)
        head.insert(head.end(), {"map, MB", "frame ms, median (quartiles)", "frames a second"});
    text += "\n" + row(head) + rule(head.size());
    for (std::size_t i = 0; i < drawn.size(); ++i) {
        const DrawnPanel& one = drawn[i];
        std::vector<std::string> cells{figure.panels[i].caption, panelText(figure.panels[i]),
                                       std::to_string(one.resolution) +
                                           (figure.panels[i].resolution == 0 ? " (automatic)" : ""),
                                       formatted("%.1f", one.radiusTexels)};
        for (std::size_t n = 0; n < figure.numbers.size(); ++n)
            cells.push_back(valueText(figure.numbers[n], one.numbers[n]));
        if (figure.timed) {
            cells.push_back(formatted("%.2f", static_cast<double>(one.mapBytes) / 1e6));
            cells.push_back(number(one.frameMs.median) + " (" + number(one.frameMs.p25) + "-" +
                            number(one.frameMs.p75) + ")");
            cells.push_back(number(1000 / one.frameMs.median));
        }
        text += row(cells);
    }
    return text + "\n" + figure.finding + "\n\n";
}

std::string tableText(const PaperTable& table, const renderer::GlInfo& info, int rounds) {
    program::Progress progress(table.name, table.rows.size() * table.columns.size() *
                                               static_cast<std::size_t>(rounds + 1));
    const auto ms = timeTable(info, table, rounds, [&] { progress.advance(); });
    std::vector<std::string> head{""};
    for (const PaperTable::Column& column : table.columns) head.push_back(column.title);
    std::string speeds = row(head) + rule(head.size());
    std::string ratios = speeds;
    for (std::size_t r = 0; r < table.rows.size(); ++r) {
        const PaperTable::Row& of = table.rows[r];
        std::vector<std::string> speed{of.title + ", " + panelText(of.panel)}, ratio{of.title};
        for (std::size_t c = 0; c < table.columns.size(); ++c) {
            const Spread& cell = ms[r][c];
            speed.push_back(number(1000 / cell.median) + " (" + number(1000 / cell.p75) + "-" +
                            number(1000 / cell.p25) + "); " + number(of.paperFps[c]));
            ratio.push_back(formatted("%.2f", ms[0][c].median / cell.median) + "; " +
                            formatted("%.2f", of.paperFps[c] / table.rows[0].paperFps[c]));
        }
        speeds += row(speed);
        ratios += row(ratio);
    }
    return "## " + table.title + "\n\nFrames a second, ours (median and quartiles of " +
           std::to_string(rounds) + " interleaved rounds); the paper's. Scene " + table.scene +
           ".\n\n" + speeds + "\nSpeed against " + table.rows[0].title +
           ", ours; the paper's:\n\n" + ratios + "\n" + table.finding + "\n\n";
}

}  // namespace

const std::vector<PaperTitle>& paperTitles() {
    static const std::vector<PaperTitle> titles = {
        {"variance", "Donnelly, Lauritzen 2006: Variance shadow maps"},
        {"power-cdf",
         "Gumbau, Szirmay-Kalos, Sbert, Chover 2011: Improving shadow map filtering with "
         "statistical analysis"},
        {"gradient", "Schüler 2006: Multisampling extension for gradient shadow maps"},
        {"perception", "Kreuzer: Using perception-based filtering to hide shadow artifacts"},
    };
    return titles;
}

void writePaperPage(const std::filesystem::path& folder, const std::string& name,
                    const renderer::GlInfo& info, const records::RunContext& context, int rounds) {
    const auto& titles = paperTitles();
    const auto paper = std::find_if(titles.begin(), titles.end(),
                                    [&](const PaperTitle& one) { return one.name == name; });
    if (paper == titles.end()) {
        std::string known;
        for (const PaperTitle& one : titles) known += (known.empty() ? "" : ", ") + one.name;
        throw std::invalid_argument("paper \"" + name + "\" is not known; known are: " + known);
    }
    records::createFolders(folder);
    std::string text = "# " + paper->title + "\n\nDrawn and measured again by `./run papers " +
                       name + "`. " + contextLine(context) + "\n\n";
    for (const PaperTable& table : paperTables())
        if (table.paper == name) text += tableText(table, info, rounds);
    if (name == "power-cdf") text += depthDistributionText(folder, info);
    for (const PaperFigure& figure : paperFigures())
        if (figure.paper == name) text += figureText(folder, figure, info, rounds);
    text.pop_back();
    records::writeWholeFile(folder / (name + ".md"), text);
}

}  // namespace demo
