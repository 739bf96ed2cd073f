// SPDX-License-Identifier: MIT
// One figure of a report: what gnuplot draws, as SVG for the page and as PDF for a paper. The
// script holds its data, so that a figure can be changed and drawn again from its script alone:
//
//     gnuplot threshold_against_size.gp    # writes threshold_against_size.svg and .pdf
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace analysis {

struct Figure {
    std::string name;     ///< of its files, without extension
    std::string caption;  ///< what is drawn, and what was chosen to be drawn
    int widthPx = 900, heightPx = 400;
    std::string data;  ///< gnuplot data blocks: they may not stand in a multiplot
    std::string plot;  ///< gnuplot commands, run once for each format
};

std::string scriptOf(const Figure& figure);

/// Writes NAME.gp, NAME.svg and NAME.pdf of every figure, in one run of gnuplot. The SVG follows
/// the reader's light or dark scheme; the PDF holds no date, so that equal data give equal files.
/// Throws std::runtime_error, located: a file cannot be written, gnuplot is missing or fails.
void drawFigures(const std::filesystem::path& folder, std::span<const Figure> figures);

// What the figures share:

inline constexpr const char* kInk = "#1a1a1a";
inline constexpr const char* kQuiet = "#767676";

/// Okabe and Ito's colours, told apart by colour-blind readers too; then again from the start.
std::string seriesColour(std::size_t index);
/// A filled point of gnuplot's, another one for each colour.
std::string seriesPoint(std::size_t index);

/// Panels beside each other, placed in px, since characters are not equally wide in SVG and PDF.
struct PanelGrid {
    std::size_t count = 1, columns = 1;
    int widthPx = 900, panelHeightPx = 300;
    double left = 60, right = 15, top = 40, bottom = 50;  ///< around the axes of each, px

    int heightPx() const;
    /// "set lmargin at screen ..." for panel `i`.
    std::string place(std::size_t i) const;
    /// "at screen x, screen y": `belowPx` under the axes of panel `i`, `rightPx` from their left.
    std::string below(std::size_t i, double belowPx, double rightPx = 0) const;
};

/// A figure of several panels.
Figure multiplot(const std::string& name, const std::string& caption, const PanelGrid& grid,
                 const std::string& data, const std::string& plots);

/// "$name << EOD ... EOD": rows of numbers or text, each ending with a line end.
std::string dataBlock(const std::string& name, const std::string& rows);

/// "('5' 5, '10' 10)": those of the rising values that stand at least `share` of the axis apart.
std::string ticsAt(std::span<const double> values, double low, double high, bool logarithmic,
                   double share = 0.07);
/// 1, 2, 5, 10, ... within the range of a logarithmic axis, finer where that gives few.
std::string logTics(double low, double high);

/// Every k-th of `count` things so that at most `most` remain, first and last included.
std::vector<std::size_t> evenlySpaced(std::size_t count, std::size_t most);

}  // namespace analysis
