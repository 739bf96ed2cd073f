// SPDX-License-Identifier: MIT
#include "analysis/figure.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <sstream>
#include <string_view>
#include <thread>

#include "analysis/gnuplot.h"
#include "analysis/number_text.h"
#include "analysis/parallel.h"
#include "records/html_page.h"
#include "records/whole_file.h"

namespace analysis {
namespace {

constexpr const char* kColours[] = {"#0072B2", "#D55E00", "#009E73", "#CC79A7",
                                    "#E69F00", "#56B4E9", "#6A3D9A"};
constexpr const char* kPoints[] = {"7", "5", "9", "13", "11", "15", "4"};

// A paper's text width: 900 px are 7 inches.
constexpr double kPxPerInch = 900 / 7.0;

// cairo writes when it drew. Overwritten in place, since a PDF is a table of byte offsets.
std::string withoutDate(std::string pdf) {
    const std::size_t start = pdf.find("/CreationDate (");
    const std::size_t end = start == std::string::npos ? start : pdf.find(')', start);
    if (end != std::string::npos) {
        std::fill(pdf.begin() + static_cast<std::ptrdiff_t>(start),
                  pdf.begin() + static_cast<std::ptrdiff_t>(end) + 1, ' ');
    }
    return pdf;
}

// gnuplot titles what has no title in the key by its command, and a browser shows that under the
// mouse.
std::string withoutCommands(std::string svg) {
    constexpr std::string_view kStart = "<title>$", kEnd = "</title>";
    for (std::size_t at; (at = svg.find(kStart)) != std::string::npos;) {
        svg.erase(at, svg.find(kEnd, at) + kEnd.size() - at);
    }
    return svg;
}

std::string scriptName(const Figure& figure) {
    return figure.name + ".gp";
}

// The scripts, divided among as many runs of gnuplot as there are processors. What a script takes
// goes by its data; starting gnuplot takes as long as a small figure.
std::vector<std::vector<std::string>> evenShares(std::span<const Figure> figures) {
    std::vector<const Figure*> largestFirst;
    for (const Figure& figure : figures) largestFirst.push_back(&figure);
    std::stable_sort(
        largestFirst.begin(), largestFirst.end(),
        [](const Figure* a, const Figure* b) { return a->data.size() > b->data.size(); });
    const std::size_t processors = std::max(1U, std::thread::hardware_concurrency());
    const std::size_t runs = std::min(figures.size(), processors);
    std::vector<std::vector<std::string>> shares(runs);
    std::vector<std::size_t> load(runs, 0);
    for (const Figure* figure : largestFirst) {
        const auto least = std::min_element(load.begin(), load.end());
        shares[static_cast<std::size_t>(least - load.begin())].push_back(scriptName(*figure));
        *least += figure->data.size() + figure->plot.size();
    }
    return shares;
}

}  // namespace

std::string scriptOf(const Figure& figure) {
    std::ostringstream out;
    out << "reset\nset encoding utf8\n"
        << figure.data << "do for [format in 'svg pdf'] {\n"
        << "if (format eq 'svg') {\n"
        << "set terminal svg size " << figure.widthPx << ',' << figure.heightPx
        << " enhanced font 'Helvetica,Arial,sans-serif,13' background '#ffffff'\n"
        << "} else {\n"
        << "set terminal pdfcairo size " << figure.widthPx / kPxPerInch << ','
        << figure.heightPx / kPxPerInch
        << " enhanced font 'Helvetica,13' fontscale 0.5 lw 1.2 background '#ffffff'\n"
        << "}\n"
        << "set output '" << figure.name << ".'.format\n"
        << "set border 3 lc rgb '" << kInk << "' lw 0.8\n"
        << "set tics nomirror out scale 0.6\n"
        << "set pointintervalbox 0\n"
        << figure.plot << "unset output\n}\n";
    return out.str();
}

void drawFigures(const std::filesystem::path& folder, std::span<const Figure> figures) {
    records::createFolders(folder);
    for (const Figure& figure : figures) {
        records::writeWholeFile(folder / scriptName(figure), scriptOf(figure));
    }
    const std::vector<std::vector<std::string>> shares = evenShares(figures);
    inParallel(shares.size(), 0, [&](std::size_t i) { runGnuplot(folder, shares[i]); });
    for (const Figure& figure : figures) {
        const std::filesystem::path svg = folder / (figure.name + ".svg");
        records::writeWholeFile(
            svg, records::svgForBothSchemes(withoutCommands(records::readWholeFile(svg))));
        const std::filesystem::path pdf = folder / (figure.name + ".pdf");
        records::writeWholeFile(pdf, withoutDate(records::readWholeFile(pdf)));
    }
}

std::string seriesColour(std::size_t index) {
    return kColours[index % std::size(kColours)];
}

std::string seriesPoint(std::size_t index) {
    return kPoints[index % std::size(kPoints)];
}

int PanelGrid::heightPx() const {
    return panelHeightPx * static_cast<int>((count + columns - 1) / columns);
}

std::string PanelGrid::place(std::size_t i) const {
    const double panelWidth = widthPx / static_cast<double>(columns), height = heightPx();
    const double x = panelWidth * static_cast<double>(i % columns);
    const double y = height - panelHeightPx * static_cast<double>(i / columns);  // from below
    std::ostringstream out;
    out << "set lmargin at screen " << (x + left) / widthPx << "\nset rmargin at screen "
        << (x + panelWidth - right) / widthPx << "\nset tmargin at screen " << (y - top) / height
        << "\nset bmargin at screen " << (y - panelHeightPx + bottom) / height << '\n';
    return out.str();
}

std::string PanelGrid::below(std::size_t i, double belowPx, double rightPx) const {
    const double panelWidth = widthPx / static_cast<double>(columns), height = heightPx();
    const double x = panelWidth * static_cast<double>(i % columns) + left + rightPx;
    const double y =
        height - panelHeightPx * static_cast<double>(i / columns + 1) + bottom - belowPx;
    std::ostringstream out;
    out << "at screen " << x / widthPx << ", screen " << y / height;
    return out.str();
}

Figure multiplot(const std::string& name, const std::string& caption, const PanelGrid& grid,
                 const std::string& data, const std::string& plots) {
    return {.name = name,
            .caption = caption,
            .widthPx = grid.widthPx,
            .heightPx = grid.heightPx(),
            .data = data,
            .plot = "set multiplot\n" + plots + "unset multiplot\n"};
}

std::string dataBlock(const std::string& name, const std::string& rows) {
    return "$" + name + " << EOD\n" + rows + "EOD\n";
}

std::string ticsAt(std::span<const double> values, double low, double high, bool logarithmic,
                   double share) {
    const auto place = [&](double value) {
        return logarithmic ? std::log(value / low) / std::log(high / low)
                           : (value - low) / (high - low);
    };
    std::string tics = "(";
    double last = -1;
    for (const double value : values) {
        if (tics.size() > 1 && place(value) - last < share) continue;
        last = place(value);
        const std::string text = shortText(value);
        tics += (tics.size() > 1 ? ", " : "") + quotedForGnuplot(text) + " " + text;
    }
    return tics + ")";
}

std::string logTics(double low, double high) {
    const double decades = std::log10(high / low);
    std::vector<double> steps = {1, 2, 5};
    if (decades < 0.5)
        steps = {1, 1.2, 1.5, 2, 2.5, 3, 3.5, 4, 4.5, 5, 6, 7, 8, 9};
    else if (decades < 1.2)
        steps = {1, 1.5, 2, 3, 4, 5, 7};
    if (decades > 3) steps = {1};
    std::vector<double> values;
    for (double decade = std::pow(10, std::floor(std::log10(low))); decade <= high; decade *= 10) {
        for (const double step : steps) {
            const double value = decade * step;
            if (value >= low * 0.999 && value <= high * 1.001) values.push_back(value);
        }
    }
    return ticsAt(values, low, high, true, 0.04);
}

std::vector<std::size_t> evenlySpaced(std::size_t count, std::size_t most) {
    std::vector<std::size_t> chosen;
    if (count <= most) {
        for (std::size_t i = 0; i < count; ++i) chosen.push_back(i);
    } else if (most == 1) {
        chosen.push_back(count / 2);
    } else {
        for (std::size_t i = 0; i < most; ++i) chosen.push_back(i * (count - 1) / (most - 1));
    }
    return chosen;
}

}  // namespace analysis
