// SPDX-License-Identifier: MIT
#include "demo/paper_tables.h"

#include <memory>

#include "demo/paper_drawing.h"
#include "renderer/renderer.h"

namespace demo {
namespace {

// Samples one texel apart: pcf_grid's Gaussian spans 2.5 radii, so n samples a texel apart are a
// radius of n / 2.5.
constexpr double kRadius3 = 1.2;

std::vector<PaperTable::Row> varianceRows(const std::vector<std::vector<double>>& fps) {
    const std::vector<PaperPanel> panels = {
        {"Shadow Map", "hard"},
        {"Bil. PCF 1x1", "pcf_grid", {{"samples", 1}}},
        {"VSM", "vsm_mip"},
        {"PCF 3x3", "pcf_grid", {{"samples", 3}, {"bilinear", 0}, {"gaussian", 1}}, 1024, kRadius3},
        {"Bil. PCF 3x3", "pcf_grid", {{"samples", 3}, {"gaussian", 1}}, 1024, kRadius3},
        {"VSM 3x3", "vsm", {{"gaussian", 1}}, 1024, kRadius3},
    };
    std::vector<PaperTable::Row> rows;
    for (std::size_t i = 0; i < panels.size(); ++i)
        rows.push_back({panels[i].caption, panels[i], fps[i]});
    return rows;
}

std::vector<PaperTable> tables() {
    return {
        {.paper = "variance",
         .name = "variance-map-sizes",
         .title = "Section 5.2, first table: map size at 1024 x 768",
         .scene = "planar_occluder",
         .columns = {{"128x128", 1024, 768, 128},
                     {"256x256", 1024, 768, 256},
                     {"512x512", 1024, 768, 512},
                     {"1024x1024", 1024, 768, 1024}},
         .rows = varianceRows({{340, 334, 314, 243},
                               {224, 219, 209, 175},
                               {265, 255, 228, 154},
                               {153, 151, 149, 130},
                               {22, 22, 22, 21},
                               {254, 225, 154, 63}}),
         .finding = "A software rasteriser on a few threads against a GeForce 6800GT: frames a "
                    "second cannot be compared, ratios can, and in ours the passes over the screen "
                    "that are the same for all take a larger part. As in the paper, PCF does not "
                    "depend on the map and the blur of VSM 3x3 does. Ours differs in Bil. PCF 3x3, "
                    "which was the slowest by far and is not, since one gather reads the four "
                    "texels of a compare; in VSM, whose trilinear probes run in the shader and not "
                    "in a texture unit; and in VSM 3x3, which is blurred but has no mip chain "
                    "after that. The sun stands for the paper's spotlight."},
        {.paper = "variance",
         .name = "variance-viewports",
         .title = "Section 5.2, second table: viewport with a map of 512 x 512",
         .scene = "planar_occluder",
         .columns = {{"640x480", 640, 480, 512},
                     {"800x600", 800, 600, 512},
                     {"1024x768", 1024, 768, 512},
                     {"1280x960", 1280, 960, 512}},
         .rows = varianceRows({{470, 470, 314, 210},
                               {457, 309, 209, 133},
                               {450, 334, 228, 159},
                               {336, 229, 149, 92},
                               {53, 33, 22, 15},
                               {230, 195, 154, 119}}),
         .finding = "As in the paper, the cost of all rows grows with the pixels, that of VSM 3x3 "
                    "least in the paper. The same differences as above."},
        {.paper = "power-cdf",
         .name = "power-cdf-speeds",
         .title = "Table 1: map size at 1920 x 1080",
         .scene = "overlapping_spheres",
         .columns = {{"512x512", 1920, 1080, 512},
                     {"1024x1024", 1920, 1080, 1024},
                     {"2048x2048", 1920, 1080, 2048}},
         .rows = {{"Chebyshev", {"", "vsm", {}, 1024, 4}, {481, 342, 142}},
                  {"Exponential", {"", "esm", {}, 1024, 4}, {495, 392, 165}},
                  {"CDF recons. 32bits", {"", "power_cdf", {}, 1024, 4}, {420, 243, 82}},
                  {"CDF recons. 16bits", {"", "power_cdf16", {}, 1024, 4}, {468, 381, 160}}},
         .finding =
             "The paper does not give its kernel; ours has a radius of 4 texels on every map, so "
             "that the prefilter grows with the texels as the paper's does. Of ours a larger part "
             "is the screen's, which is the same for all, so the ratios lie nearer to 1. As in the "
             "paper 32 bits of the power CDF are the slowest at 2048; the gain of its 16 bits over "
             "variance maps is not seen here, where bytes cost less than arithmetic."},
    };
}

}  // namespace

const std::vector<PaperTable>& paperTables() {
    static const std::vector<PaperTable> all = tables();
    return all;
}

std::vector<std::vector<Spread>> timeTable(const renderer::GlInfo& info, const PaperTable& table,
                                           int rounds, const std::function<void()>& onFrame) {
    struct View {
        std::unique_ptr<renderer::Renderer> frame;
        std::unique_ptr<ShadowRun> run;
    };
    const auto settingsOf = [](const PaperTable::Row& row, const PaperTable::Column& column) {
        PaperPanel panel = row.panel;
        panel.resolution = column.resolution;
        return panelSettings(panel, 1);  // radii are in texels
    };
    std::vector<View> views;
    for (const PaperTable::Column& column : table.columns) {
        View view;
        view.frame = std::make_unique<renderer::Renderer>(info, renderer::makeScene(table.scene),
                                                          column.widthPx, column.heightPx);
        view.run =
            std::make_unique<ShadowRun>(*view.frame, info, settingsOf(table.rows.front(), column));
        views.push_back(std::move(view));
    }
    std::vector<std::vector<std::vector<double>>> ms(
        table.rows.size(), std::vector<std::vector<double>>(table.columns.size()));
    for (int round = -1; round < rounds; ++round)  // the first warms up
        for (std::size_t c = 0; c < table.columns.size(); ++c)
            for (std::size_t r = 0; r < table.rows.size(); ++r) {
                ShadowRun& run = *views[c].run;
                run.change(settingsOf(table.rows[r], table.columns[c]));
                run.step();  // allocates: one renderer goes from technique to technique
                const double frame = run.timeWholeFrames(1).median;
                if (round >= 0) ms[r][c].push_back(frame);
                if (onFrame) onFrame();
            }
    std::vector<std::vector<Spread>> spreads;
    for (const auto& row : ms) {
        spreads.emplace_back();
        for (const auto& cell : row) spreads.back().push_back(spreadOf(cell));
    }
    return spreads;
}

}  // namespace demo
