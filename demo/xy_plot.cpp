// SPDX-License-Identifier: MIT
#include "demo/xy_plot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "records/html_page.h"

namespace demo {
namespace {

// Px of the drawing; it scales with the page.
constexpr double kWidth = 860, kLeft = 70, kRight = 640, kTop = 34, kBottom = 340, kHeight = 390;
constexpr double kLegendRow = 19;

// Okabe and Ito's colours, told apart by every reader.
constexpr std::array<const char*, 7> kColours = {"#0072B2", "#D55E00", "#009E73", "#CC79A7",
                                                 "#E69F00", "#56B4E9", "#000000"};

std::string formatted(const char* format, double value) {
    char text[48];
    std::snprintf(text, sizeof text, format, value);
    return text;
}

std::string px(double value) {
    return formatted("%.1f", value);
}

struct Axis {
    double low = 1, high = 10;  // whole powers of ten, or 0 and 1
    double from = 0, to = 1;    // px
    bool unit = false;

    void fit(double least, double most) {
        if (unit) return;
        low = std::pow(10, std::floor(std::log10(least)));
        high = std::pow(10, std::ceil(std::log10(most)));
        if (!(high > low)) high = 10 * low;
    }
    double at(double value) const {
        if (unit) return from + (to - from) * value;
        return from + (to - from) * std::log(value / low) / std::log(high / low);
    }
    bool reaches(double value) const {
        return unit ? value >= 0 && value <= 1 : value > 0 && std::isfinite(value);
    }
    std::vector<double> ticks() const {
        if (unit) return {0, 0.2, 0.4, 0.6, 0.8, 1};
        std::vector<double> values;
        for (double v = low; v <= high * 1.0001; v *= 10) values.push_back(v);
        return values;
    }
};

bool drawable(const std::pair<double, double>& point, const Axis& x, const Axis& y) {
    return x.reaches(point.first) && y.reaches(point.second);
}

std::string textAt(double x, double y, const std::string& text, const std::string& more = "") {
    return "<text x=\"" + px(x) + "\" y=\"" + px(y) + "\" " + more + ">" +
           records::htmlEscaped(text) + "</text>\n";
}

std::string grid(const Axis& x, const Axis& y) {
    std::string svg;
    const auto line = [&](double x1, double y1, double x2, double y2) {
        svg += "<path d=\"M" + px(x1) + " " + px(y1) + "L" + px(x2) + " " + px(y2) +
               "\" stroke=\"#dddddd\"/>\n";
    };
    for (const double v : x.ticks()) {
        line(x.at(v), kTop, x.at(v), kBottom);
        svg += textAt(x.at(v), kBottom + 18, formatted("%g", v), "text-anchor=\"middle\"");
    }
    for (const double v : y.ticks()) {
        line(kLeft, y.at(v), kRight, y.at(v));
        svg += textAt(kLeft - 6, y.at(v) + 4, formatted("%g", v), "text-anchor=\"end\"");
    }
    return svg;
}

std::string drawn(const PlotSeries& series, const Axis& x, const Axis& y,
                  const std::string& colour) {
    std::string svg;
    std::string path;
    for (const auto& point : series.points) {
        if (!drawable(point, x, y)) continue;
        const std::string at = px(x.at(point.first)) + "\" cy=\"" + px(y.at(point.second));
        path += (path.empty() ? "M" : "L") + px(x.at(point.first)) + " " + px(y.at(point.second));
        if (!series.line) svg += "<circle cx=\"" + at + "\" r=\"3\" fill=\"" + colour + "\"/>\n";
    }
    if (series.line && !path.empty())
        svg += "<path d=\"" + path + "\" fill=\"none\" stroke=\"" + colour +
               "\" stroke-width=\"1.6\"/>\n";
    return svg;
}

}  // namespace

std::string plotSvg(const Plot& plot) {
    Axis x{.from = kLeft, .to = kRight, .unit = plot.unitAxes};
    Axis y{.from = kBottom, .to = kTop, .unit = plot.unitAxes};
    double least[2] = {INFINITY, INFINITY};
    double most[2] = {0, 0};
    for (const PlotSeries& series : plot.series)
        for (const auto& point : series.points) {
            if (!drawable(point, x, y)) continue;
            least[0] = std::min(least[0], point.first);
            least[1] = std::min(least[1], point.second);
            most[0] = std::max(most[0], point.first);
            most[1] = std::max(most[1], point.second);
        }
    if (most[0] > 0) {
        x.fit(least[0], most[0]);
        y.fit(least[1], most[1]);
    }
    std::string below, above, legend;
    std::size_t colours = 0;
    double row = kTop + 10;
    for (const PlotSeries& series : plot.series) {
        const std::string colour = series.grey ? "#c8c8c8" : kColours[colours++ % kColours.size()];
        (series.grey ? below : above) += drawn(series, x, y, colour);
        if (series.name.empty()) continue;
        legend += "<rect x=\"" + px(kRight + 16) + "\" y=\"" + px(row - 9) +
                  "\" width=\"10\" height=\"10\" fill=\"" + colour + "\"/>\n" +
                  textAt(kRight + 32, row, series.name);
        row += kLegendRow;
    }
    const double height = std::max(kHeight, row);
    return "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + px(kWidth) + " " +
           px(height) + "\" font-family=\"sans-serif\" font-size=\"13\" fill=\"#222222\">\n" +
           "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n" +
           textAt(kLeft, 20, plot.title, "font-weight=\"bold\"") + grid(x, y) + below + above +
           legend +
           textAt(0.5 * (kLeft + kRight), kBottom + 40, plot.xLabel, "text-anchor=\"middle\"") +
           "<text transform=\"translate(16 " + px(0.5 * (kTop + kBottom)) +
           ") rotate(-90)\" text-anchor=\"middle\">" + records::htmlEscaped(plot.yLabel) +
           "</text>\n</svg>\n";
}

}  // namespace demo
