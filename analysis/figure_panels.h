// SPDX-License-Identifier: MIT
// How a study is laid out in figures: a panel for each pattern (or angle of a line), in it a series
// for each lit level, and for whatever else tells groups apart. A series looks alike in all panels.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/slope_analysis.h"

namespace analysis {

struct Series {
    std::size_t group = 0;  ///< index into Study::groups
    std::string name;       ///< "lit 0.5"
    std::size_t style = 0;  ///< for seriesColour() and seriesPoint()
};

struct Panel {
    std::string title;  ///< "line 22.5 deg"
    records::Pattern pattern = records::Pattern::stair;
    std::vector<Series> series = {};
    std::vector<double> sizes = {};  ///< rising, px
};

struct PanelChoice {
    std::vector<Panel> panels = {};
    std::string leftOut = {};  ///< a sentence for the caption; empty where nothing is
};

/// At most `most` panels of at most `mostSeries` series: those with the largest slopes. A
/// figure of one series each says so by itself.
PanelChoice choosePanels(const SlopeAnalysis& analysis, bool severalSizesOnly,
                         std::size_t most = 12, std::size_t mostSeries = 7);

/// The fit that the headline rests on: the law, or the one with a size exponent where the law is
/// rejected.
const RandomObserverFit& headlineFit(const SlopeAnalysis& analysis);
/// Its log10 c of a group at artifact size a.
double fittedLog10c(const SlopeAnalysis& analysis, std::size_t group, double artifactPx);

}  // namespace analysis
