// SPDX-License-Identifier: MIT
// The self-contained HTML page that reports are written as: one file, no network, readable in light
// and dark, in print and on a phone. Pictures are embedded.
//
//   records::HtmlPage page("Slope report");
//   page.heading("Result"); page.paragraph("c = " + ...); page.svg(svgText, "Figure 1: ...");
//   page.write("report.html");
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace records {

/// Escapes & < > " for text and attributes.
std::string htmlEscaped(const std::string& text);

class HtmlPage {
  public:
    explicit HtmlPage(std::string title);

    void heading(const std::string& text);
    void subheading(const std::string& text);
    void paragraph(const std::string& text);  ///< plain text, escaped
    void headline(const std::string& number,
                  const std::string& meaning);  ///< the one number, large
    void table(const std::vector<std::string>& head,
               const std::vector<std::vector<std::string>>& rows,
               const std::string& caption);  ///< numbers right-aligned; scrolls on narrow screens
    void svg(const std::string& svgText, const std::string& caption);  ///< inline figure
    void image(const std::filesystem::path& png, const std::string& alt,
               const std::string& caption);      ///< base64
    void preformatted(const std::string& text);  ///< commands, context blocks

    std::string text() const;
    void write(const std::filesystem::path& file) const;  ///< whole or not at all; throws located

  private:
    std::string title_;
    std::string body_;
};

}  // namespace records
