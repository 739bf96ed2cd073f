// SPDX-License-Identifier: MIT
// The self-contained HTML page that reports are written as: one file, no network, readable in light
// and dark, in print and on a phone. Pictures and figures are embedded; figures are drawn for white
// paper, and in the dark their lightness is turned round.
//
//   records::HtmlPage page("Slope report");
//   page.headline("c = 3.41 [3.20, 3.63]", "F* = .646, ...");
//   page.heading("Threshold against size"); page.paragraph("...");
//   page.svg(svgText, "Figure 1: ...");
//   page.write("report.html");
//
// Every text is plain and is escaped here; control characters and broken UTF-8 do no harm.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace records {

/// Escapes & < > " ' for text and attributes.
std::string htmlEscaped(const std::string& text);

/// An SVG drawn for white paper, as a file that follows the reader's scheme: in the dark its
/// lightness is turned round and its hues stay. On a page every figure does that by itself.
std::string svgForBothSchemes(const std::string& svgText);

class HtmlPage {
  public:
    explicit HtmlPage(std::string title);

    void heading(const std::string& text);
    void subheading(const std::string& text);
    void paragraph(const std::string& text);
    /// A list of terms, each with its text.
    void terms(const std::vector<std::pair<std::string, std::string>>& list);
    void headline(const std::string& number,
                  const std::string& meaning);  ///< the one number, large
    void note(const std::string& text);         ///< set off: a warning, a limit, what was left out
    void failure(const std::string& text);      ///< the same in red: numbers not to be trusted
    /// A column whose cells are all numbers (or n/a, intervals, empty) is right-aligned. Scrolls by
    /// itself on narrow screens. Throws std::invalid_argument for a row whose length is not that of
    /// `head`.
    void table(const std::vector<std::string>& head,
               const std::vector<std::vector<std::string>>& rows, const std::string& caption);
    /// Inline figure: everything around the <svg> element is dropped, and its ids are made unique
    /// on the page. Throws std::invalid_argument where there is no <svg> element.
    void svg(const std::string& svgText, const std::string& caption);
    /// Embedded as base64. Throws std::runtime_error where the file cannot be read or is no PNG
    /// image.
    void image(const std::filesystem::path& png, const std::string& alt,
               const std::string& caption);

    struct Picture {
        std::filesystem::path png;
        std::string alt;
        std::string caption;
    };
    /// Pictures beside each other, as many in a row as fit.
    void gallery(const std::vector<Picture>& pictures);

    void preformatted(const std::string& text);  ///< commands, context blocks

    std::string text() const;
    void write(const std::filesystem::path& file) const;  ///< whole or not at all; throws located

  private:
    void element(const std::string& tag, const std::string& text);

    std::string title_;
    std::string body_;
    int figures_ = 0;
};

}  // namespace records
