// SPDX-License-Identifier: MIT
// The papers' tables of frames per second, with the papers' numbers, measured again.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "demo/paper_figures.h"
#include "demo/spread.h"
#include "renderer/gl_context.h"

namespace demo {

struct PaperTable {
    struct Column {
        std::string title;
        int widthPx, heightPx;
        int resolution;  ///< N
    };
    struct Row {
        std::string title;  ///< the paper's word
        PaperPanel panel;   ///< of which technique, parameters and radius in texels hold
        std::vector<double> paperFps;
    };
    std::string paper, name, title, scene;
    std::vector<Column> columns;
    std::vector<Row> rows;  ///< speeds are also given against the first
    std::string finding;
};
const std::vector<PaperTable>& paperTables();

/// Milliseconds of whole frames, [row][column]. All cells take turns in every round, so that
/// whatever else the machine does falls on all of them. `onFrame` after each of rows x columns x
/// (rounds + 1).
std::vector<std::vector<Spread>> timeTable(const renderer::GlInfo& info, const PaperTable& table,
                                           int rounds, const std::function<void()>& onFrame = {});

}  // namespace demo
