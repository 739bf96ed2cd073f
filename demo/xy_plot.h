// SPDX-License-Identifier: MIT
// Points and lines over two axes, as an SVG picture on white paper.
#pragma once

#include <string>
#include <vector>

namespace demo {

struct PlotSeries {
    std::string name;                               ///< in the legend; empty: not in it
    std::vector<std::pair<double, double>> points;  ///< what the axes do not reach is left out
    bool line = false;                              ///< joins the points, without marks
    bool grey = false;                              ///< drawn below the others
};

struct Plot {
    std::string title, xLabel, yLabel;
    std::vector<PlotSeries> series;
    bool unitAxes = false;  ///< both axes linear from 0 to 1; else logarithmic
};

/// An empty frame where there is no point.
std::string plotSvg(const Plot& plot);

}  // namespace demo
