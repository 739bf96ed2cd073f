// SPDX-License-Identifier: MIT
// A figure of the list (paper_figures.h) drawn and measured.
#pragma once

#include <vector>

#include "demo/paper_figures.h"
#include "demo/shadow_run.h"

namespace demo {

struct DrawnPanel {
    renderer::ByteImage picture;
    renderer::FloatImage visibility;
    std::vector<double> numbers;  ///< in the figure's order
    int resolution = 0;           ///< N; the one found, where it is automatic
    double radiusTexels = 0;
    std::size_t mapBytes = 0;
    Spread frameMs;  ///< count 0 where the figure is not timed
};

/// Throws std::invalid_argument for a technique or parameter that is not known.
ShadowRun::Settings panelSettings(const PaperPanel& panel, double mapExtentM);

/// One for each of the figure's panels. `shrink` divides the view's edges, for a look that costs
/// little; timed panels take turns, `rounds` times. Throws std::invalid_argument for a scene,
/// technique or parameter that is not known.
std::vector<DrawnPanel> drawFigure(const renderer::GlInfo& info, const PaperFigure& figure,
                                   int shrink = 1, int rounds = 9);

}  // namespace demo
