// SPDX-License-Identifier: MIT
// The self-contained HTML page that reports are written as: one file, no network, readable in light
// and dark, in print and on a phone. Pictures and figures are embedded; figures keep their white
// paper in the dark, since what gnuplot draws is drawn for paper.
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
#include <vector>

namespace records {

/// Escapes & < > " ' for text and attributes.
std::string htmlEscaped(const std::string& text);

class HtmlPage {
  public:
    explicit HtmlPage(std::string title);

    void heading(const std::string& text);
    void subheading(const std::string& text);
    void paragraph(const std::string& text);
    void headline(const std::string& number,
                  const std::string& meaning);  ///< the one number, large
    void note(const std::string& text);         ///< set off: a warning, a limit, what was left out
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
